// What the range finders tell of a wall at one side.
//
// Two range finders 45 degrees apart see the points P = (0, b) and Q = (a / sqrt 2, a / sqrt 2) of a wall at the left (b: range to the
// side, a: range 45 degrees ahead of that). The wall runs along Q - P, so the robot's heading against it is
//   psi = -atan2(Qy - Py, Qx - Px),  and its distance from it is  d = b cos(psi)
// (F1TENTH course, lab "Wall following"). The same holds for the range finder behind, and mirrored for the right.
#pragma once

#include "angles.h"
#include "body.h"

namespace mts {

struct WallSight {
  bool beside = false;         ///< the range finder to the side sees a wall within reach
  bool angle_known = false;    ///< and a second one sees the same wall
  bool straight = false;       ///< and a third one, on the other side, does too
  float distance_m = 0.0f;     ///< from the robot's centre, at a right angle to the wall; if `beside`
  float angle_rad = 0.0f;      ///< the robot's heading against the wall's direction, counter-clockwise; if `angle_known`
};

/// The range finder at `eighths` times 45 degrees from ahead, to the left or mirrored to the right.
[[nodiscard]] constexpr float range_at(const Senses& senses, bool left, std::size_t eighths) noexcept {
  return senses.range_m[left || eighths == 0 ? eighths : kRangeFinders - eighths];
}

/// The wall at one side; nothing if the range finders are silent or the side is open within `reach_m`. If the two neighbours of the range
/// finder to the side disagree, the wall ends or bends there: then the angle counts by which the robot is turned more towards the wall. A
/// point by which the wall would recede by more than 22 degrees, or come nearer by more than 40, is taken for one of another wall.
[[nodiscard]] constexpr WallSight look_at_wall(const Senses& senses, bool left, float reach_m) noexcept {
  constexpr float kHalf = 0.707106781f, kRecedes = 22.0f * kRadPerDeg, kNears = 40.0f * kRadPerDeg;
  WallSight sight;
  if (!senses.range_known) return sight;
  const float side = range_at(senses, left, 2);
  if (side > reach_m) return sight;
  sight.beside = true;
  sight.distance_m = side;
  // Positive: the robot is turned towards the wall.
  const float ahead = range_at(senses, left, 1) * kHalf, behind = range_at(senses, left, 3) * kHalf;
  const float by_ahead = -angle_of(ahead, ahead - side), by_behind = -angle_of(behind, side - behind);
  const bool ahead_fits = by_ahead > -kRecedes && by_ahead < kNears;
  const bool behind_fits = by_behind < kRecedes && by_behind > -kNears;
  if (!ahead_fits && !behind_fits) return sight;
  sight.angle_known = true;
  float angle = ahead_fits ? by_ahead : by_behind;
  if (ahead_fits && behind_fits) {
    sight.straight = magnitude(by_ahead - by_behind) < 0.26f;
    angle = sight.straight ? 0.5f * (by_ahead + by_behind) : greatest(by_ahead, by_behind);
  }
  sight.distance_m = side * cosine(angle);
  sight.angle_rad = left ? angle : -angle;
  return sight;
}

}  // namespace mts
