// What line sensors and range finders tell of a road: whether it can be followed, and how far beside its middle the robot is.
#pragma once

#include "line_sight.h"
#include "text.h"

namespace mts {

inline constexpr float kWallNear_m = 0.5f;   ///< a wall of the road is no farther away
inline constexpr float kBendNear_m = 0.7f;   ///< nearer than this to a bend its walls are seen otherwise

/// Whether there are walls to both sides: a certainty. At a bend one is enough, as the outer wall recedes. 0 if the range finders are silent.
[[nodiscard]] constexpr float walls_beside(const Senses& senses, bool near_bend) noexcept {
  if (!senses.range_known) return 0.0f;
  const int walls = (senses.range_m[2] < kWallNear_m ? 1 : 0) + (senses.range_m[6] < kWallNear_m ? 1 : 0);
  const bool enough = walls == 2 || (walls == 1 && near_bend);
  return enough ? 0.9f : walls == 1 ? 0.3f : -0.9f;
}

/// Writes into `left_m` how far the robot is to the left of the middle of a road driven by `by`: "mark", "dist". False: nothing shows it.
/// `turned_rad`: its heading against that of the road. Senses and body must be of size 1.
[[nodiscard]] constexpr bool see_middle(const Senses& senses, const Body& body, const char* by, float turned_rad, float& left_m) noexcept {
  constexpr float kWidthFits_m = 0.06f;
  if (same_text(by, "mark")) {
    const LineSight line = look_at_line(senses, body);
    left_m = -line.left_m - body.line_ahead_m * turned_rad;
    return line.narrow();
  }
  const float left = senses.range_m[2], right = senses.range_m[6];
  const bool both = magnitude((left + right) * cosine(turned_rad) - body.road_width_m) < kWidthFits_m;   // otherwise something stands beside the robot
  left_m = 0.5f * (right - left);
  return same_text(by, "dist") && senses.range_known && both;
}

}  // namespace mts
