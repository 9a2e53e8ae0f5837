// Angles without libm: sine, cosine, arctangent, and angles reduced to one turn. constexpr, freestanding, and the same bits from every
// compiler, for the reasons that runtime/math.h gives.
#pragma once

#include "../runtime/math.h"

namespace mts {

inline constexpr float kPi = 3.14159265f;
inline constexpr float kRadPerDeg = kPi / 180.0f;

[[nodiscard]] constexpr float magnitude(float x) noexcept { return x < 0.0f ? -x : x; }
/// -1 for x < 0, else 1.
[[nodiscard]] constexpr float sign_of(float x) noexcept { return x < 0.0f ? -1.0f : 1.0f; }

/// The angle in (-pi, pi] that differs from x by whole turns; 0 for NaN and for x farther than 1e6 rad from 0.
/// Error: at most 5e-7 per turn taken off.
[[nodiscard]] constexpr float wrapped_angle(float x) noexcept {
  if (!(magnitude(x) < 1e6f)) return 0.0f;
  const float turns = x * (0.5f / kPi);
  const float whole = static_cast<float>(static_cast<int>(turns + (turns < 0.0f ? -0.5f : 0.5f)));
  const float left = x - whole * (2.0f * kPi);
  if (left > kPi) return left - 2.0f * kPi;
  return left <= -kPi ? left + 2.0f * kPi : left;
}

/// sin x; at most 3e-7 wrong for |x| <= 10, and 6e-6 for |x| <= 100.
/// Reduces x to [-pi/2, pi/2], then takes the power series up to x^11 (the terms left out are below 6e-8).
[[nodiscard]] constexpr float sine(float x) noexcept {
  float a = wrapped_angle(x);
  if (a > 0.5f * kPi) a = kPi - a;
  if (a < -0.5f * kPi) a = -kPi - a;
  const float q = a * a;
  float series = -1.0f / 39916800.0f;
  series = series * q + 1.0f / 362880.0f;
  series = series * q - 1.0f / 5040.0f;
  series = series * q + 1.0f / 120.0f;
  series = series * q - 1.0f / 6.0f;
  return a + a * q * series;
}
/// cos x; at most 3e-7 wrong for |x| <= 10, and 6e-6 for |x| <= 100.
[[nodiscard]] constexpr float cosine(float x) noexcept { return sine(wrapped_angle(x) + 0.5f * kPi); }

/// The angle of the point (x, y), in (-pi, pi]; 0 for (0, 0). At most 1e-6 wrong.
/// Takes the power series of arctan t up to t^13 for t <= tan(pi/8); for larger t, arctan t = pi/4 + arctan((t - 1)/(t + 1)).
[[nodiscard]] constexpr float angle_of(float x, float y) noexcept {
  const float ax = magnitude(x), ay = magnitude(y);
  const float big = greatest(ax, ay);
  if (!(big > 0.0f)) return 0.0f;
  float t = least(ax, ay) / big, base = 0.0f;
  if (t > 0.41421356f) {
    base = 0.25f * kPi;
    t = (t - 1.0f) / (t + 1.0f);
  }
  const float q = t * t;
  float series = 1.0f / 13.0f;
  series = series * q - 1.0f / 11.0f;
  series = series * q + 1.0f / 9.0f;
  series = series * q - 1.0f / 7.0f;
  series = series * q + 1.0f / 5.0f;
  series = series * q - 1.0f / 3.0f;
  float angle = base + (t + t * q * series);
  if (ay > ax) angle = 0.5f * kPi - angle;
  if (x < 0.0f) angle = kPi - angle;
  return y < 0.0f ? -angle : angle;
}

}  // namespace mts
