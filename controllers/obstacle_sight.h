// Which readings of the range finders are obstacles for a robot on its way.
//
// note [held up]
// A controller stands before a thing that it would graze, even if that is too far aside, or a little too far away, to count as an obstacle
// ahead: in a crossing, for instance, where walls may stand beside the exits. So a robot that should drive but stands before something
// near has an obstacle before it, until it moves.
#pragma once

#include "angles.h"
#include "senses.h"

namespace mts {

/// Where the robot is, as far as it matters for what stands ahead.
struct Surroundings {
  bool crosses = false;       ///< it is in a crossing
  bool walls_bend = false;    ///< it is between walls near a bend
  bool leaves = false;        ///< it has just come out of a crossing
  bool ends = false;          ///< it comes to the crossing at the end of its road
};

/// Senses, ways and body are those of a robot of size 1.
class ObstacleSight {
 public:
  /// One control period. The senses must have been `heard`. `runs`: the robot is to drive.
  constexpr void step(const Senses& senses, bool runs, float way_m, float turned_rad, float dt_s) noexcept {
    ahead_m_ = senses.range_known ? ahead_m_ + 0.5f * (senses.range_m[0] - ahead_m_) : kOutOfRange;   // smoothed: a single near reading is no obstacle
    aside_m_ = least(senses.range_m[1], senses.range_m[7]);
    known_ = senses.range_known;
    const bool still = way_m < kStillDrives_m_s * dt_s && magnitude(turned_rad) < kStillTurns_rad_s * dt_s + 0.002f;
    if (!still || !known_ || least(senses.range_m[0], aside_m_) > kHolds_m) held_s_ = 0.0f;
    else if (runs) held_s_ += dt_s;
  }
  constexpr void rest() noexcept { held_s_ = 0.0f; }
  /// See note [held up].
  [[nodiscard]] constexpr bool held_up() const noexcept { return held_s_ > kHeldUp_s; }
  /// How near something ahead must be to be an obstacle. Where walls regularly stand ahead, in crossings and near bends, it must be nearer.
  [[nodiscard]] static constexpr float reach_m(const Surroundings& where) noexcept { return where.crosses || where.walls_bend ? kCrossing_m : kNear_m; }
  /// Whether something stands ahead: a certainty between -0.9 and 0.9; 0 if the range finders are silent.
  [[nodiscard]] constexpr float ahead(const Surroundings& where) const noexcept {
    if (!known_) return 0.0f;
    const bool between = where.leaves || reach_m(where) < kNear_m;
    const float least_m = between ? kAsideBend_m : where.ends ? kAsideCorner_m : kAside_m;
    if (!where.crosses && aside_m_ < least_m) return kSure;
    return clamped(kSure - 2.0f * kSure * (ahead_m_ - reach_m(where)) / kFlank_m, -kSure, kSure);
  }

  static constexpr float kTrackHalf_m = 0.20f, kTrackHalfWalled_m = 0.16f;   ///< of a track beside which nothing may stand: the robot's radius, and room; walls are at 0.3
  static constexpr float kBehind_m = 0.08f;            ///< a thing that is passed by so much stands on the track no longer

 private:
  static constexpr float kSure = 0.9f, kFlank_m = 0.08f;
  static constexpr float kNear_m = 0.40f, kCrossing_m = 0.22f;
  static constexpr float kAside_m = 0.20f, kAsideBend_m = 0.15f, kAsideCorner_m = 0.17f;   // at 45 degrees
  static constexpr float kHolds_m = 0.24f;             // a controller stands rather than graze something that is nearer
  static constexpr float kHeldUp_s = 1.0f, kStillTurns_rad_s = 0.05f, kStillDrives_m_s = 0.02f;

  float ahead_m_ = kOutOfRange, aside_m_ = kOutOfRange, held_s_ = 0.0f;
  bool known_ = false;
};

}  // namespace mts
