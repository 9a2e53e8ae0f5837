// The few functions of real numbers that the runtime needs, without libm: constexpr, freestanding, and the same bits from
// every compiler at every optimisation level. Each is written as additions, multiplications and divisions of `float` in one
// fixed order; nothing depends on a rounding mode, a table or `errno`.
//
// That holds as long as the compiler does not fuse `a * b + c` into one operation. The CMake targets and waymark.pc compile all that includes
// these headers with -ffp-contract=off; who compiles by other means should do the same, for each such file: of functions that several
// files hold the linker takes any one. With fusing, results stay within the bounds stated here and may differ in the last bit between targets.
//
// note [a bound in ulp]
//   One ulp of a float y is the distance from |y| to the next larger float. A bound of n ulp says that for every argument
//   in the stated range the result differs from the true value, rounded to a float, by at most n ulp. The bounds were
//   found by trying every float of the range against `double`, and a test tries a part of them each time.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include "cpp20.h"

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__ != 0)
#error "-ffast-math and -ffinite-math-only let the compiler change results and drop the tests for NaN; compile this file without them"
#endif
#if defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__)
#error "-funsafe-math-optimizations, -fassociative-math and -freciprocal-math let the compiler change results; compile this file without them"
#endif
static_assert(0.1 - static_cast<double>(0.1f) < 0.0, "-fsingle-precision-constant changes results; compile this file without it");

namespace mts {

inline constexpr float kInfinity = std::numeric_limits<float>::infinity();

/// Neither NaN nor infinite. Looks at the bits, so no option of a compiler can take it for granted.
[[nodiscard]] constexpr bool is_finite(float x) noexcept {
  return (std::bit_cast<std::uint32_t>(x) & 0x7F80'0000u) != 0x7F80'0000u;
}
/// A NaN of any kind.
[[nodiscard]] constexpr bool is_nan(float x) noexcept { return (std::bit_cast<std::uint32_t>(x) & 0x7FFF'FFFFu) > 0x7F80'0000u; }

/// The smaller, the larger of two numbers that are no NaN.
[[nodiscard]] constexpr float least(float a, float b) noexcept { return b < a ? b : a; }
[[nodiscard]] constexpr float greatest(float a, float b) noexcept { return a < b ? b : a; }
/// x, but not below `low` and not above `high`; low <= high, no NaN.
[[nodiscard]] constexpr float clamped(float x, float low, float high) noexcept { return least(greatest(x, low), high); }

namespace detail {

/// 2^k for -126 <= k <= 127.
[[nodiscard]] constexpr float power_of_two(int k) noexcept {
  return std::bit_cast<float>(static_cast<std::uint32_t>(k + 127) << 23);
}

}  // namespace detail

/// e^x for x <= 0, which is all that membership functions need; in [0, 1]. 0 below -87.3, where e^x would be no normal
/// number any more (an error of less than 1.2e-38). x may be -infinity; for NaN or x > 0 the result has no meaning.
/// At most 1 ulp wrong. Cost: about 20 operations, one comparison.
///
/// e^x = 2^k * e^r with k the integer nearest to x / ln 2, so |r| <= 0.35, and e^r by its power series to r^7 (what is
/// left out is below 6e-9). ln 2 is taken in two parts, of which the first has 10 bits, so that x - k * first is exact.
[[nodiscard]] constexpr float exp_of_nonpositive(float x) noexcept {
  constexpr float kLowest = -87.3f;
  constexpr float kPerLn2 = 1.44269504f;
  constexpr float kLn2First = 0.693359375f, kLn2Rest = -2.12194440e-4f;
  if (!(x >= kLowest)) return 0.0f;
  const int k = static_cast<int>(x * kPerLn2 - 0.5f);
  const float n = static_cast<float>(k);
  const float r = (x - n * kLn2First) - n * kLn2Rest;
  float series = 1.0f / 5040.0f;
  series = series * r + 1.0f / 720.0f;
  series = series * r + 1.0f / 120.0f;
  series = series * r + 1.0f / 24.0f;
  series = series * r + 1.0f / 6.0f;
  series = series * r + 0.5f;
  return (1.0f + (r + r * r * series)) * detail::power_of_two(k);
}

/// The natural logarithm of a normal, finite x > 0. At most 2 ulp wrong, or 1e-7 in itself near x = 1, where the result is
/// near 0. Cost: about 15 operations, one division.
///
/// x = 2^k * m with m between sqrt(1/2) and sqrt(2); ln m = 2 artanh(s), s = (m - 1) / (m + 1), |s| <= 0.172, by its
/// power series to s^9 (what is left out is below 1e-9).
[[nodiscard]] constexpr float log_of_positive(float x) noexcept {
  constexpr float kLn2First = 0.693359375f, kLn2Rest = -2.12194440e-4f;
  constexpr std::uint32_t kSqrtHalf = 0x3F35'04F3u;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t above = bits - kSqrtHalf;
  const int k = static_cast<std::int32_t>(above) >> 23;
  const float m = std::bit_cast<float>((above & 0x007F'FFFFu) + kSqrtHalf);
  const float s = (m - 1.0f) / (m + 1.0f);
  const float q = s * s;
  float series = 1.0f / 9.0f;
  series = series * q + 1.0f / 7.0f;
  series = series * q + 1.0f / 5.0f;
  series = series * q + 1.0f / 3.0f;
  const float twice = s + s;
  const float n = static_cast<float>(k);
  return n * kLn2First + (n * kLn2Rest + (twice + twice * q * series));
}

/// 1 / (1 + e^-t), in [0, 1]; t may be infinite. At most 2e-7 wrong in itself, and at most 3 ulp for t >= -80.
[[nodiscard]] constexpr float logistic(float t) noexcept {
  const float e = exp_of_nonpositive(t < 0.0f ? t : -t);
  return (t < 0.0f ? e : 1.0f) / (1.0f + e);
}

/// The square root of x, correctly rounded. 0 for every x that is not above 0, infinity for infinity.
/// Cost: 25 steps of integers; a processor's own instruction gives the same bits.
[[nodiscard]] constexpr float square_root(float x) noexcept {
  if (!(x > 0.0f)) return 0.0f;
  if (!is_finite(x)) return x;
  int shift = 0;
  if (x < detail::power_of_two(-126)) {
    x *= detail::power_of_two(24);
    shift = -12;
  }
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  int exponent = static_cast<int>(bits >> 23) - 127;
  std::uint64_t mantissa = (bits & 0x007F'FFFFu) | 0x0080'0000u;
  if ((exponent & 1) != 0) {
    mantissa <<= 1;
    --exponent;
  }
  // The root of mantissa * 2^25 has 25 bits, one more than a float: that one says how to round (a tie cannot occur).
  const std::uint64_t square = mantissa << 25;
  std::uint64_t root = 0;
  for (std::uint64_t bit = std::uint64_t{1} << 24; bit != 0; bit >>= 1) {
    if ((root | bit) * (root | bit) <= square) root |= bit;
  }
  const auto rounded = static_cast<float>((root >> 1) + (root & 1u));
  return rounded * detail::power_of_two(exponent / 2 - 23 + shift);
}

}  // namespace mts
