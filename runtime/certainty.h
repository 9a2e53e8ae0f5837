// From a reading to a certainty: how surely a measured value fits a prototype.
//
//   1 |     __  P                The prototype P says which values the word stands for. The datum D says which values the
//     |   .'  `.   . D           sensor may have meant: a Gaussian round what was read, as wide as its noise and its age.
//   0 |__/      `-' `.___
//
//   possibility  Pi = sup min(P(x), D(x))        can the two be the same?
//   necessity    N  = inf max(P(x), 1 - D(x))    must they be?
//   certainty    cf = Pi + N - 1                 +1: it must be so, -1: it cannot be so, 0: nothing is known
//
// Possibility and necessity: Zadeh, "Fuzzy sets as a basis for a theory of possibility", 1978; Dubois and Prade,
// "Possibility Theory", 1988. cf = MB - MD: Shortliffe and Buchanan, "A model of inexact reasoning in medicine", 1975, with
// MB = N and MD = 1 - Pi.
//
// note [the curve of levels]
//   Let g(y) = sqrt(-2 ln y): so far, in spreads, a Gaussian has fallen to y. On the right of P's core, which ends at c, P has
//   fallen to y at c + g(y) / fall, and 1 - D has risen to y at d + g(1 - y) s, with d and s the datum's value and spread.
//   The least maximum is where the two meet: N is the y with
//       u(y) - b v(y) = a,    u(y) = g(y), v(y) = g(1 - y), a = (d - c) fall, b = s fall.
//   For a straight flank u(y) = 1 - y. The left side is its mirror image, and N is the smaller of the two. u and v do not
//   depend on prototype or datum: they are a table, made at compile time, of 257 levels y. The left side falls with y, so the
//   pair of levels between which it passes a is found by counting, among 16 and again among 16; between them N is taken on a straight line.
//
// note [the error of N]
//   F(y) = u(y) - b v(y) is replaced by a straight line between two levels that are h apart. The line is nowhere further from F
//   than h^2/8 sup|F''|, so its root is nowhere further from that of F than
//       h^2/8 sup|F''| / inf|F'|  <=  h^2/8 max(sup|u''| / inf|u'|, sup|v''| / inf|v'|),
//   because u' and -b v' have one sign, and (p + q) / (r + t) <= max(p/r, q/t). The bound does not depend on a and b. It is
//   computed for each pair of levels while the table is made, and `static_assert` compares the largest with kNecessityError. (At
//   both ends h itself is smaller than the bound.) Rounding to float adds at most 1e-6.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math.h"
#include "shape.h"

namespace mts {

/// |N computed - N| is at most this, for every prototype and every datum on a line. See note [the error of N], and for a circle `fit`.
inline constexpr float kNecessityError = 1.2e-4f;

namespace detail {

inline constexpr std::uint32_t kLevels = 256;   ///< intervals; a power of two

/// See note [the curve of levels]. 4 KB, read-only.
struct Levels {
  float y[kLevels + 1] = {};
  float u[kLevels + 1] = {};   ///< g(y), falling
  float v[kLevels + 1] = {};   ///< g(1 - y), rising
  float t[kLevels + 1] = {};   ///< 1 - y, falling
  double error = 0.0;          ///< the proved bound
};

// Plain double, for the compiler only.
constexpr double table_log(double x) {
  int k = 0;
  for (; x > 1.5; ++k) x *= 0.5;
  for (; x < 0.75; --k) x *= 2.0;
  const double s = (x - 1.0) / (x + 1.0);
  double power = s, sum = 0.0;
  for (int n = 1; n < 40; n += 2, power *= s * s) sum += power / n;
  return 2.0 * sum + k * 0.693147180559945309417;
}
constexpr double table_sqrt(double x) {
  double root = x > 1.0 ? x : 1.0;
  for (int i = 0; i < 60; ++i) root = 0.5 * (root + x / root);
  return root;
}
/// g(y); `rest` is 1 - y, which is more exact near 1.
constexpr double table_g(double y, double rest) {
  double log = 0.0;
  if (rest > 1e-3) {
    log = table_log(y);
  } else {
    double power = rest;
    for (int n = 1; n < 12; ++n, power *= rest) log -= power / n;
  }
  return table_sqrt(-2.0 * log);
}
/// sin^2 of a part of the quarter circle: levels that lie close together near 0 and near 1, where the curve is steep.
constexpr double table_level(std::uint32_t i) {
  const double angle = 1.57079632679489661923 * static_cast<double>(i) / static_cast<double>(kLevels);
  double term = angle, sine = 0.0;
  for (int n = 1; n < 40; n += 2) {
    sine += term;
    term *= -angle * angle / ((n + 1.0) * (n + 2.0));
  }
  return sine * sine;
}

// g' = -1 / (y g), |g''| = |1 - 1/g^2| / (y^2 g). Between two levels y < z: sup|g''| / inf|g'|, each bounded from its ends.
constexpr double table_bend(double y, double g_y, double z, double g_z) {
  const double per_square = 1.0 / (g_z * g_z) > 1.0 ? 1.0 / (g_z * g_z) : 1.0;
  const double largest_second = per_square / (y * y * g_z);
  const double least_first = 1.0 / (z * g_y);
  return largest_second / least_first;
}

constexpr Levels make_levels() {
  constexpr double kEnd = 1e-7;
  Levels made;
  double y = 0.0, rest = 1.0, g = 0.0, g_rest = 0.0;
  for (std::uint32_t i = 0; i <= kLevels; ++i) {
    const double last_y = y, last_rest = rest, last_g = g, last_g_rest = g_rest;
    y = i == 0 ? kEnd : i == kLevels ? 1.0 - kEnd : table_level(i);
    rest = i == 0 ? 1.0 - kEnd : i == kLevels ? kEnd : table_level(kLevels - i);
    g = table_g(y, rest);
    g_rest = table_g(rest, y);
    made.y[i] = static_cast<float>(y);
    made.t[i] = static_cast<float>(rest);
    made.u[i] = static_cast<float>(g);
    made.v[i] = static_cast<float>(g_rest);
    if (i == 0) continue;
    const double h = y - last_y;
    const double left = table_bend(last_y, last_g, y, g), right = table_bend(rest, g_rest, last_rest, last_g_rest);
    const double secant = h * h / 8.0 * (left > right ? left : right);
    const double bound = secant < h ? secant : h;
    if (bound > made.error) made.error = bound;
  }
  return made;
}

inline constexpr Levels kLevelTable = make_levels();
static_assert(kLevelTable.error + 1e-6 < static_cast<double>(kNecessityError));

/// Every sixteenth level again, side by side, so that the first look at the curve is at neighbours in memory.
struct CoarseLevels {
  float u[16] = {}, v[16] = {}, t[16] = {};
};
constexpr CoarseLevels make_coarse_levels() {
  CoarseLevels made;
  for (std::uint32_t i = 0; i < 16; ++i) {
    made.u[i] = kLevelTable.u[16 * i];
    made.v[i] = kLevelTable.v[16 * i];
    made.t[i] = kLevelTable.t[16 * i];
  }
  return made;
}
inline constexpr CoarseLevels kCoarseLevels = make_coarse_levels();

/// How many of 16 levels have falling + slope * rising >= a. No jumps: a compiler makes a few vector operations of it.
[[nodiscard]] constexpr std::uint32_t levels_above(const float* falling, float slope, const float* rising, float a) noexcept {
#if defined(__SSE__)
  if (!std::is_constant_evaluated()) {   // what -O3 makes of the loop, at every level
    using Four = float __attribute__((vector_size(16)));
    using FourCounts = std::int32_t __attribute__((vector_size(16)));
    const Four slopes = {slope, slope, slope, slope}, as = {a, a, a, a};
    FourCounts counts = {0, 0, 0, 0};
    for (std::uint32_t i = 0; i < 16; i += 4) {
      Four f, r;
      __builtin_memcpy(&f, falling + i, sizeof f);
      __builtin_memcpy(&r, rising + i, sizeof r);
      counts -= f + slopes * r >= as;   // a lane that holds is -1
    }
    return static_cast<std::uint32_t>(counts[0] + counts[1] + counts[2] + counts[3]);
  }
#endif
  std::uint32_t count = 0;
  for (std::uint32_t i = 0; i < 16; ++i) count += falling[i] + slope * rising[i] >= a ? 1u : 0u;
  return count;
}

/// The level y at which falling(y) + slope * rising(y) passes a, on a straight line between two levels; 0 or 1 beyond the
/// ends. The sum must fall; rounding keeps that so, as each of its operations is monotone.
template <class Falling, class Rising>
[[nodiscard]] constexpr float level_at(Falling falling, float slope, Rising rising, float a) noexcept {
  const float* f = falling(kLevelTable);
  const float* r = rising(kLevelTable);
  const auto at = [&](std::uint32_t i) { return f[i] + slope * r[i]; };
  if (!(a <= at(0))) return 0.0f;
  if (a <= at(kLevels)) return 1.0f;
  const std::uint32_t block = 16 * (levels_above(falling(kCoarseLevels), slope, rising(kCoarseLevels), a) - 1);
  const std::uint32_t i = block + levels_above(f + block, slope, r + block, a) - 1;
  const float above = at(i), below = at(i + 1);
  const float part = (above - a) / (above - below);
  const float y = kLevelTable.y[i] + (kLevelTable.y[i + 1] - kLevelTable.y[i]) * part;
  return part >= 0.0f && part <= 1.0f ? y : kLevelTable.y[i];
}

/// N of one flank: `a` how far the datum lies beyond the core's end, `b` its spread, both in widths of the flank.
[[nodiscard]] constexpr float flank_necessity(Profile profile, float a, float b) noexcept {
  const auto v = [](const auto& levels) { return levels.v; };
  if (profile == Profile::kLinear) return level_at([](const auto& levels) { return levels.t; }, -b, v, a);
  return level_at([](const auto& levels) { return levels.u; }, -b, v, a);
}

/// Pi of one flank; 1 for a <= 0. Two Gaussians meet where the distance in their joint spread is the same: a / (1 + b) of each.
/// A straight flank meets a Gaussian at the level y with 1 - y + b g(y) = a.
[[nodiscard]] constexpr float flank_possibility(Profile profile, float a, float b) noexcept {
  if (profile == Profile::kLinear) {
    if (!(a > 0.0f)) return 1.0f;
    return level_at([](const auto& levels) { return levels.t; }, b, [](const auto& levels) { return levels.u; }, a);
  }
  const float spreads = greatest(a, 0.0f) / (1.0f + b);
  return exp_of_nonpositive(-0.5f * spreads * spreads);
}

/// square_root(x) by the processor's own instruction where it is known to have one: the same bits, sooner.
[[nodiscard]] constexpr float quick_root(float x) noexcept {
#if defined(__SSE__)
  if (x > 0.0f && !std::is_constant_evaluated()) {   // of all else it is 0
#if __has_builtin(__builtin_elementwise_sqrt)   // of later clangs, which no longer have the other
    return __builtin_elementwise_sqrt(x);
#else
    using Four = float __attribute__((vector_size(16)));
    const Four root = __builtin_ia32_sqrtss(Four{x, 0.0f, 0.0f, 0.0f});
    return root[0];
#endif
  }
#endif
  return square_root(x);
}

}  // namespace detail

/// Whether a membership function may be a prototype: it has a core, and flanks with a level curve.
[[nodiscard]] constexpr bool can_be_prototype(const Membership& m) noexcept {
  return m.profile == Profile::kLinear || m.profile == Profile::kGaussian;
}

/// How possible, and how necessary it is that a datum fits; both in [0, 1].
struct Fit {
  float possibility = 1.0f, necessity = 0.0f;
};

namespace detail {

/// As `fit`, of a datum that lies so far from the prototype's centre, on a line. `spread` above 0.
[[nodiscard]] constexpr Fit straight_fit(const Membership& prototype, float d, float spread) noexcept {
  // Beyond the end of the core, in widths of the flank. A straight flank is kept by its foot, which is one width further.
  const float shift = prototype.profile == Profile::kLinear ? 1.0f : 0.0f;
  const bool left = prototype.rise > 0.0f && prototype.low > -kInfinity;
  const bool right = prototype.fall > 0.0f && prototype.high < kInfinity;
  const float a_left = left ? (prototype.low - d) * prototype.rise + shift : -kInfinity;
  const float a_right = right ? (d - prototype.high) * prototype.fall + shift : -kInfinity;
  const float b_left = spread * prototype.rise, b_right = spread * prototype.fall;
  // A datum lies beyond one end of the core at most, and N falls with a and with b: as a rule one flank decides both.
  const bool right_decides = right && (!left || (a_right >= a_left && b_right >= b_left));
  const bool left_decides = left && (!right || (a_left >= a_right && b_left >= b_right));
  const float a = right_decides ? a_right : a_left;
  const float b = right_decides ? b_right : b_left;
  Fit fit{1.0f, 1.0f};
  if (right_decides || left_decides) {
    fit.necessity = detail::flank_necessity(prototype.profile, a, b);
    fit.possibility = detail::flank_possibility(prototype.profile, a, b);
  } else if (left && right) {
    fit.necessity = least(detail::flank_necessity(prototype.profile, a_left, b_left),
                          detail::flank_necessity(prototype.profile, a_right, b_right));
    fit.possibility = least(detail::flank_possibility(prototype.profile, a_left, b_left),
                            detail::flank_possibility(prototype.profile, a_right, b_right));
  }
  return fit;
}

}  // namespace detail

/// `value`: what was read, finite, on a circle inside of the range that the prototype's centre lies in. `spread`: of the datum, in the
/// same unit, >= 0; 0 is an exact datum, for which both are mu(value). Pi is at most 3e-7 wrong for Gaussians and
/// kNecessityError for straight flanks, N at most kNecessityError.
///
/// On a circle the prototype may be met either way round; it counts as straight that way, so of one that is so broad that its flanks meet
/// N is told without what they add up to there. With p = mu where they meet, N is too small by at most p + kNecessityError: a crossing at
/// p or above lies before that place and is found; below it, N is at most p. p is 1e-6 for a Gaussian of 34 deg, 1e-2 for one of 60 deg and
/// 0.14 for one of 90 deg on 360 deg.
/// Cost: 40 ns at most, 5 ns for a datum that is far off or well inside; on a circle as much again.
[[nodiscard]] constexpr Fit fit(const Membership& prototype, float value, float spread) noexcept {
  if (!(spread > 0.0f)) {
    const float exact = mu(prototype, value);
    return {exact, exact};
  }
  if (!(prototype.period > 0.0f)) return detail::straight_fit(prototype, value - prototype.centre, spread);
  const float d = shortest_difference(value, prototype.centre, prototype.period);
  const Fit one = detail::straight_fit(prototype, d, spread);
  const Fit other = detail::straight_fit(prototype, d > 0.0f ? d - prototype.period : d + prototype.period, spread);
  return {greatest(one.possibility, other.possibility), greatest(one.necessity, other.necessity)};
}

/// cf = Pi + N - 1, in [-1, 1].
[[nodiscard]] constexpr float certainty(const Membership& prototype, float value, float spread) noexcept {
  const Fit f = fit(prototype, value, spread);
  return clamped(f.possibility + f.necessity - 1.0f, -1.0f, 1.0f);
}

/// The spread of a datum of this age: s^2 = s_0^2 + q age (a random walk). `noise` s_0 >= 0, `growth` q >= 0 in squares of the
/// unit a second, `age_s` >= 0 in seconds.
[[nodiscard]] constexpr float aged_spread(float noise, float growth, float age_s) noexcept {
  if (!(growth > 0.0f) || !(age_s > 0.0f)) return noise;
  return detail::quick_root(noise * noise + growth * age_s);
}

}  // namespace mts
