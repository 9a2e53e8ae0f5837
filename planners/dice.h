// Random numbers that are the same on every machine and cost next to nothing. A stream belongs to a seed and a place, such as the
// generation and the child, so threads may share the work in any way.
#pragma once

#include <cstdint>

namespace kb::planners {

/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014).
class Dice {
 public:
  explicit Dice(std::uint64_t seed, std::uint64_t stream = 0, std::uint64_t place = 0)
      : state_(mix(mix(mix(seed) ^ stream) ^ place)) {}
  [[nodiscard]] std::uint64_t next() { return mix(state_ += kStep); }
  /// A number from 0 to n - 1, for 0 < n < 2^32.
  [[nodiscard]] std::uint32_t below(std::size_t n) { return static_cast<std::uint32_t>(((next() >> 32) * n) >> 32); }
  [[nodiscard]] bool chance(double p) { return static_cast<double>(next() >> 11) * 0x1p-53 < p; }

 private:
  static constexpr std::uint64_t kStep = 0x9E3779B97F4A7C15u;
  static constexpr std::uint64_t mix(std::uint64_t z) {
    z += kStep;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
  }
  std::uint64_t state_;
};

}  // namespace kb::planners
