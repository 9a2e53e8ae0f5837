// Random numbers that are the same on every machine: they use nothing of <random> or of the maths library.
#pragma once

#include <bit>
#include <cstdint>

namespace kb::sim {

/// A stream of random numbers: xoshiro256++ (Blackman and Vigna, 2019), seeded through splitmix64. Streams of one seed and
/// different `stream` are independent: each sensor has its own, so that a dead one does not change the readings of the others.
class Random {
 public:
  explicit constexpr Random(std::uint64_t seed, std::uint64_t stream = 0) {
    std::uint64_t x = seed * 0x9E3779B97F4A7C15ull + stream * 0xD1B54A32D192ED03ull + 1;
    for (std::uint64_t& word : state_) {
      x += 0x9E3779B97F4A7C15ull;
      std::uint64_t z = x;
      z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9ull;
      z = (z ^ z >> 27) * 0x94D049BB133111EBull;
      word = z ^ z >> 31;
    }
  }

  constexpr std::uint64_t next() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// Uniform in [0, 1), in steps of 2^-24.
  constexpr float unit() { return static_cast<float>(next() >> 40) * 0x1.0p-24f; }
  /// Uniform in [-1, 1).
  constexpr float signed_unit() { return 2.0f * unit() - 1.0f; }
  constexpr bool chance(float probability) { return unit() < probability; }

  /// Mean 0, variance 1, bell-shaped, and never beyond 3.47: the sum of four uniform numbers of 16 bits. One draw.
  constexpr float bell() {
    const std::uint64_t bits = next();
    const auto sum = static_cast<float>((bits & 0xFFFF) + (bits >> 16 & 0xFFFF) + (bits >> 32 & 0xFFFF) + (bits >> 48));
    return (sum - 131070.0f) * (1.7320508f / 65536.0f);   // one of them has the variance 65536^2 / 12
  }

 private:
  std::uint64_t state_[4] = {};
};

}  // namespace kb::sim
