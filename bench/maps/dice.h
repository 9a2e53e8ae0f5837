// What the makers of maps draw: on top of the simulator's numbers, which are the same on every machine.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <utility>
#include <vector>

#include "sim/random.h"

namespace kb::bench {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : random_(seed) {}

  /// Uniform in [0, n), n above 0, but for a share of n / 2^32.
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>((random_.next() >> 32) * n >> 32); }
  bool chance(float probability) { return random_.chance(probability); }
  /// An index, each as probable as its share of the weights.
  std::uint32_t pick(std::initializer_list<std::uint32_t> weights) {
    std::uint32_t sum = 0;
    for (const std::uint32_t w : weights) sum += w;
    std::uint32_t drawn = below(sum), at = 0;
    for (const std::uint32_t w : weights) {
      if (drawn < w) break;
      drawn -= w;
      ++at;
    }
    return at;
  }
  template <class T>
  void shuffle(std::vector<T>& items) {
    for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(static_cast<std::uint32_t>(i))]);
  }

 private:
  sim::Random random_;
};

}  // namespace kb::bench
