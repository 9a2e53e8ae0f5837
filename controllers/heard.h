// What every controller does with its senses first, and with its answer last: nothing that is not a number gets in or out, and
// nothing drives into what the range finder ahead sees.
#pragma once

#include "angles.h"
#include "body.h"

namespace mts {

/// Whether a robot can have measured that, in whatever unit: no NaN, no infinity, and nothing so large that sums of it over a
/// drive, or their squares, would become one.
[[nodiscard]] constexpr bool can_be_measured(float x) noexcept { return is_finite(x) && magnitude(x) <= 1e6f; }

/// The senses with each group that holds something else marked as silent. Cost: 19 looks at bits.
[[nodiscard]] constexpr Senses heard(Senses senses) noexcept {
  for (const float dark : senses.line) senses.line_known = senses.line_known && can_be_measured(dark);
  for (const float range : senses.range_m) senses.range_known = senses.range_known && can_be_measured(range);
  senses.heading_known = senses.heading_known && can_be_measured(senses.heading_rad);
  senses.turned_known = senses.turned_known && can_be_measured(senses.turned_rad);
  senses.odometry_known = senses.odometry_known && can_be_measured(senses.speed_m_s);
  return senses;
}

/// The motion, slowed so that it can stop `margin_m` before what the range finder ahead sees:
/// v <= sqrt(2 a (r - radius - margin)) with half of the acceleration that the body can do. The turn keeps its rate.
/// What a range finder at 45 degrees sees may lie 12 degrees farther to its side (the finders are that broad), r sin(57 degrees)
/// aside. Where that is hardly more than the radius, the robot bears away from it (between two such things it goes straight on), and
/// it does not turn towards what is so near abeam; where straight on would meet it, it turns away on the spot, or stands.
/// Unchanged if the range finders are silent.
[[nodiscard]] constexpr Motion braked(Motion motion, const Senses& senses, const Body& body, float margin_m = 0.06f) noexcept {
  constexpr float kSine57 = 0.838670568f, kAway_rad_s = 1.0f, kMeets_m = 0.01f, kNear_m = 0.03f, kAbeam_m = 0.03f, kBears_1_s_m = 50.0f, kBears_rad_s = 2.0f;
  if (!senses.range_known) return motion;
  const float room = senses.range_m[0] - body.radius_m - margin_m;
  motion.speed_m_s = least(motion.speed_m_s, square_root(body.top_acceleration_m_s2 * greatest(room, 0.0f)));
  if (!(motion.speed_m_s > 0.0f)) return motion;
  const auto aside = [&](std::size_t eighths) { return senses.range_m[eighths] * kSine57 - body.radius_m; };
  const float left = aside(1), right = aside(7);
  const bool left_near = left < kNear_m || senses.range_m[2] < body.radius_m + kAbeam_m;
  const bool right_near = right < kNear_m || senses.range_m[6] < body.radius_m + kAbeam_m;
  const float bears = clamped(kBears_1_s_m * (greatest(kNear_m - right, 0.0f) - greatest(kNear_m - left, 0.0f)), -kBears_rad_s, kBears_rad_s);   // to the left
  if (left_near) motion.turn_rad_s = least(motion.turn_rad_s, 0.0f);
  if (right_near) motion.turn_rad_s = greatest(motion.turn_rad_s, 0.0f);
  if (left_near != right_near) motion.turn_rad_s = right_near ? greatest(motion.turn_rad_s, bears) : least(motion.turn_rad_s, bears);
  if (left >= kMeets_m && right >= kMeets_m) return motion;
  if (left < kMeets_m && right < kMeets_m) return {};
  return {0.0f, left < kMeets_m ? least(motion.turn_rad_s, -kAway_rad_s) : greatest(motion.turn_rad_s, kAway_rad_s)};
}

}  // namespace mts
