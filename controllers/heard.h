// What every controller does with its senses first, and with its answer last: nothing that is not a number gets in or out, and
// nothing drives into what the range finder ahead sees.
#pragma once

#include "controllers/angles.h"
#include "controllers/body.h"

namespace mts {

/// The senses with each group that holds a NaN or an infinity marked as silent. Cost: 19 looks at bits.
[[nodiscard]] constexpr Senses heard(Senses senses) noexcept {
  for (const float dark : senses.line) senses.line_known = senses.line_known && is_finite(dark);
  for (const float range : senses.range_m) senses.range_known = senses.range_known && is_finite(range);
  senses.heading_known = senses.heading_known && is_finite(senses.heading_rad);
  senses.turned_known = senses.turned_known && is_finite(senses.turned_rad);
  senses.odometry_known = senses.odometry_known && is_finite(senses.speed_m_s);
  return senses;
}

/// The motion, slowed so that it can stop `margin_m` before what the range finder ahead sees:
/// v <= sqrt(2 a (r - radius - margin)) with half of the acceleration that the body can do. The turn keeps its rate.
/// Unchanged if the range finders are silent.
[[nodiscard]] constexpr Motion braked(Motion motion, const Senses& senses, const Body& body, float margin_m = 0.06f) noexcept {
  if (!senses.range_known) return motion;
  const float room = senses.range_m[0] - body.radius_m - margin_m;
  motion.speed_m_s = least(motion.speed_m_s, square_root(body.top_acceleration_m_s2 * greatest(room, 0.0f)));
  return motion;
}

}  // namespace mts
