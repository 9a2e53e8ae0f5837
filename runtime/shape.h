// Fuzzy numbers: how well a number fits a word.
//
//   mu                                    "warm", as a triangle, a trapezoid, a Gaussian with two spreads
//   1 |        /\            ____           __
//     |       /  \          /    \        .'  `-.
//   0 |______/    \________/      \______/       `-.__
//            a  b  c       a  b  c  d     l   m   r        x
//
// A membership function gives each x a degree mu(x) in [0, 1]: 1 says that x fits the word completely, 0 not at all. All
// kinds of the language are kept as one row of constants: a core, on which mu is 1, and on each side of it a flank that
// falls as one of four profiles. Below, d is x itself, or on a circle the signed shortest way from `centre` to x.
//
//   kLinear    min(1, (d - low) * rise, (high - d) * fall), not below 0.   triangle, trapezoid, ramp, singleton
//   kGaussian  exp(-u^2 / 2)     u = (low - d) * rise left of the core,    gaussian, with one mean or a range of them
//   kBell      1 / (1 + u^2b)    u = (d - high) * fall right of it         bell; b is `slope`
//   kSigmoid   1 / (1 + exp(-(d - low) * slope))                           sigmoid
//
// LR fuzzy numbers: Dubois and Prade, "Operations on fuzzy numbers", 1978. The bell: Jang, "ANFIS", 1993.
#pragma once

#include <cstdint>

#include "math.h"

namespace mts {

enum class Profile : std::uint8_t { kLinear, kGaussian, kBell, kSigmoid };

/// One membership function, ready to be evaluated. The functions below make rows from what a person would write; the
/// compiler emits rows as constants. All numbers are finite but where the text says otherwise, and in the unit of x.
struct Membership {
  Profile profile = Profile::kLinear;
  float centre = 0.0f;   ///< on a circle: where d is 0, in the range of x. Elsewhere 0
  float period = 0.0f;   ///< on a circle: its length (360 for degrees), above 0. Elsewhere 0
  float low = 0.0f;      ///< kLinear: the foot of the left flank (-infinity: there is none); kGaussian, kBell: the core's left end
  float high = 0.0f;     ///< the same on the right; kSigmoid does not use it
  float rise = 0.0f;     ///< 1 / the left spread; 0: no flank (kGaussian, kBell), mu stays 1 for ever
  float fall = 0.0f;     ///< 1 / the right spread
  float slope = 0.0f;    ///< kBell: b; kSigmoid: 4 times the steepest slope, below 0 if it falls

  friend constexpr bool operator==(const Membership&, const Membership&) = default;
};

/// x moved into [low, low + period) by whole turns. x must be finite; |x - low| below 2^24 periods, else the result is only
/// some number of the range. At most one rounding wrong near the ends. Cost: 2 comparisons for an x in the range.
[[nodiscard]] constexpr float wrapped(float x, float low, float period) noexcept {
  if (x >= low && x - low < period) return x;
  const float turns = (x - low) / period;
  if (!(turns > -16'777'216.0f && turns < 16'777'216.0f)) return low;
  auto whole = static_cast<float>(static_cast<std::int32_t>(turns));
  if (whole > turns) whole -= 1.0f;
  const float inside = x - whole * period;
  return inside < low || inside - low >= period ? low : inside;
}

/// The signed shortest way from `from` to `to` on a circle, in [-period/2, period/2]; both lie in one range of that length.
[[nodiscard]] constexpr float shortest_difference(float to, float from, float period) noexcept {
  const float d = to - from;
  const float half = 0.5f * period;
  return d - (d > half ? period : 0.0f) + (d < -half ? period : 0.0f);   // no jump
}

/// `mu` as a function of d, for a row whose profile is kLinear. It is small, so that it is inlined where kbc writes rules out.
[[nodiscard]] constexpr float linear_mu(const Membership& m, float d) noexcept {
  return greatest(least(least((d - m.low) * m.rise, (m.high - d) * m.fall), 1.0f), 0.0f);
}

/// The same for a row with only one flank and finite d: the same bits with fewer operations.
[[nodiscard]] constexpr float rising_mu(float d, float low, float rise) noexcept { return clamped((d - low) * rise, 0.0f, 1.0f); }
[[nodiscard]] constexpr float falling_mu(float d, float high, float fall) noexcept { return clamped((high - d) * fall, 0.0f, 1.0f); }

/// The degree to which x fits, in [0, 1]. x must be finite; on a circle it must lie in the range that `centre` lies in.
///
/// Accuracy against exact arithmetic on the same row and the same d: 2e-7 in itself (kLinear: 1.2e-7; kBell, whose exponent
/// magnifies: 3e-7 + 1e-7 * slope); at the core's ends the result is exactly 1, at the feet of kLinear exactly 0. On a
/// circle d itself is rounded once. The same bits at every optimisation level. Cost: about 5 operations for kLinear, 30 for the others; no loop, one
/// jump by the profile.
[[nodiscard]] constexpr float mu(const Membership& m, float x) noexcept {
  float d = x - m.centre;
  if (m.period > 0.0f) d = shortest_difference(x, m.centre, m.period);
  if (m.profile == Profile::kLinear) return linear_mu(m, d);
  if (m.profile == Profile::kSigmoid) return logistic((d - m.low) * m.slope);
  const float u = greatest(greatest((m.low - d) * m.rise, (d - m.high) * m.fall), 0.0f);
  if (m.profile == Profile::kGaussian) return exp_of_nonpositive(-0.5f * (u * u));
  if (u < detail::power_of_two(-126)) return 1.0f;
  return u < kInfinity ? logistic(-2.0f * m.slope * log_of_positive(u)) : 0.0f;
}

namespace detail {

// note [feet and cores are exact]
//   A flank from a foot a to a core at b is (d - a) * rise with rise = 1 / (b - a): exactly 0 at the foot. But (b - a) * rise
//   may be rounded to just below 1, so rise is taken one step larger where that happens; the minimum with 1 cuts off what
//   is too much. So two neighbours that share a corner never both miss it, and a condition whose degree should be 0 is 0.

/// The slope of a flank of this width, which is above 0.
[[nodiscard]] constexpr float flank(float width) noexcept {
  float slope = 1.0f / width;
  if (!is_finite(slope)) return (std::numeric_limits<float>::max)();
  while (width * slope < 1.0f) slope = std::bit_cast<float>(std::bit_cast<std::uint32_t>(slope) + 1u);
  return slope;
}

/// The next float below x, but at least 1e-36 away.
[[nodiscard]] constexpr float just_below(float x) noexcept {
  if (x > -1e-36f && x < 1e-36f) return -2e-36f;
  const std::uint32_t bits = std::bit_cast<std::uint32_t>(x);
  return std::bit_cast<float>(x > 0.0f ? bits - 1u : bits + 1u);
}
[[nodiscard]] constexpr float just_above(float x) noexcept { return -just_below(-x); }

// A left flank from the foot a to the core's end b, a <= b; a == b is a vertical edge, and b belongs to the core.
constexpr void set_rise(Membership& m, float a, float b) noexcept {
  m.low = a < b ? a : just_below(b);
  m.rise = flank(b - m.low);
}
constexpr void set_fall(Membership& m, float c, float d) noexcept {
  m.high = c < d ? d : just_above(c);
  m.fall = flank(m.high - c);
}

/// Lays a row on a circle, if there is one: the circle is cut open opposite to `origin`. Returns what d is counted from.
constexpr float lay_out(Membership& m, float origin, float period, float range_low) noexcept {
  if (!(period > 0.0f)) return 0.0f;
  m.centre = wrapped(origin, range_low, period);
  m.period = period;
  return origin;
}

}  // namespace detail

// ---- what a person would write. All arguments finite unless said otherwise; `period` 0: no circle. On a circle the corners
// go upwards as written (`triangle(135, 180, 225)`), over less than one turn; where the range begins does not matter, since
// `centre` is moved into [range_low, range_low + period).

/// Up from a to b, 1 from b to c, down to d; a <= b <= c <= d. Equal corners make a vertical edge that belongs to the core.
[[nodiscard]] constexpr Membership trapezoid(float a, float b, float c, float d, float period = 0.0f,
                                             float range_low = 0.0f) noexcept {
  Membership m;
  const float origin = detail::lay_out(m, a + 0.5f * (d - a), period, range_low);   // both feet as far from the cut
  detail::set_rise(m, a - origin, b - origin);
  detail::set_fall(m, c - origin, d - origin);
  return m;
}

/// 1 at b, down to 0 at a and at c; a <= b <= c.
[[nodiscard]] constexpr Membership triangle(float a, float b, float c, float period = 0.0f, float range_low = 0.0f) noexcept {
  return trapezoid(a, b, b, c, period, range_low);
}

/// 1 at x only.
[[nodiscard]] constexpr Membership singleton(float x, float period = 0.0f, float range_low = 0.0f) noexcept {
  return trapezoid(x, x, x, x, period, range_low);
}

/// 0 before `from`, 1 behind `to`, straight between; from > to falls. Not on a circle, which has no behind.
[[nodiscard]] constexpr Membership ramp(float from, float to) noexcept {
  Membership m;
  m.rise = m.fall = 1.0f;
  if (from <= to) {
    detail::set_rise(m, from, to);
    m.high = kInfinity;
  } else {
    detail::set_fall(m, to, from);
    m.low = -kInfinity;
  }
  return m;
}

/// 1 from `mean` to `mean_to`, falling as a Gaussian with a spread of its own on each side. Spreads are above 0; if one is infinity, that
/// side stays 1. With mean == mean_to this is the LR fuzzy number with which facts are perceived.
[[nodiscard]] constexpr Membership gaussian(float mean, float mean_to, float left, float right, float period = 0.0f,
                                            float range_low = 0.0f) noexcept {
  Membership m;
  m.profile = Profile::kGaussian;
  m.rise = 1.0f / left;
  m.fall = 1.0f / right;
  const float core = mean_to - mean;
  const float aside = m.rise != m.fall ? (m.rise - m.fall) / (m.rise + m.fall) * (period - core) : 0.0f;
  const float origin = detail::lay_out(m, mean + 0.5f * (core + aside), period, range_low);   // as many spreads from the cut on both sides
  m.low = mean - origin;
  m.high = mean_to - origin;
  return m;
}

/// 1 / (1 + |(x - centre) / width|^(2 slope)): 1 at the centre, 1/2 at `width` from it; width and slope above 0.
[[nodiscard]] constexpr Membership bell(float centre, float width, float slope, float period = 0.0f,
                                        float range_low = 0.0f) noexcept {
  Membership m = gaussian(centre, centre, width, width, period, range_low);
  m.profile = Profile::kBell;
  m.slope = slope;
  return m;
}

/// 1 / (1 + exp(-slope (x - inflection))): 1/2 at the inflection; slope in 1 / the unit of x, not 0; below 0 it falls. Not
/// on a circle.
[[nodiscard]] constexpr Membership sigmoid(float inflection, float slope) noexcept {
  Membership m;
  m.profile = Profile::kSigmoid;
  m.low = inflection;
  m.slope = slope;
  return m;
}

}  // namespace mts
