// Random numbers that are the same on every machine: the engine is fixed by the C++ standard, its mapping to ranges is
// ours (the distributions of the standard library differ from one implementation to the next).
#pragma once

#include <cstdint>
#include <random>
#include <vector>

namespace kb::world {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [0, n); n > 0.
  std::uint64_t below(std::uint64_t n) {
    const std::uint64_t even = UINT64_MAX - UINT64_MAX % n;  // above it the last, incomplete round begins
    std::uint64_t drawn = engine_();
    while (drawn >= even) drawn = engine_();
    return drawn % n;
  }
  /// Uniform in [low, high].
  int between(int low, int high) { return low + static_cast<int>(below(static_cast<std::uint64_t>(high - low) + 1)); }
  /// Uniform in [0, 1), in steps of 2^-53.
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1.0p-53; }
  bool chance(double probability) { return unit() < probability; }
  template <class T>
  const T& pick(const std::vector<T>& from) { return from[below(from.size())]; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace kb::world
