// Crosses a hall by a fuzzy controller with the inputs and outputs of std.go_to_goal: step by step, as its rules were meant.
//
//   bearing    from ahead to the goal, degrees
//   free[i]    in the direction of range finder i, in a lane as broad as the robot: 0 where something was seen lately nearer than
//              10 cm before its edge, 1 where nothing was within 55 cm of its centre, or before the goal
//   turn       the robot turns on the spot by this angle,
//   speed      then goes straight ahead for 10 cm, or until something is ahead; then the rules are asked again. It steers
//              while driving if the answer is less than 20 degrees at full speed.
//
// The rules have no memory, so they can go to and fro for ever where obstacles are concave towards the goal. After 3 m or 10 s without
// getting nearer to the goal than before, the robot is trapped: `plight()` says so, and it stands. So it does if no rule fires, or if the
// answer is no number.
// Without range finders, odometry, any heading or a hall, it stops.
#pragma once

#include "hall.h"
#include "host.h"
#include "near_points.h"

namespace mts {

class FollowRules : public HallController {
 public:
  Body body;
  Host host;

  void start(const Task& task, const Senses& raw) noexcept {
    hall_.start(task, raw, body, Shut::kIn);
    points_.forget();
    plight_ = host.decide == nullptr ? Plight::kNoWay : Plight::kNone;
    turning_ = false;
    ahead_to_m_ = 0.0f;
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = hall_.hear(raw, dt_s);
    if (hall_.blind() || !senses.range_known || plight_ != Plight::kNone) return {};
    if (hall_.missed_door()) plight_ = Plight::kTrapped;
    if (!hall_.crosses()) return hall_.through_door(senses, kGains);
    if (hall_.vain_m() > kPatience_m || hall_.vain_s() > kPatience_s) {
      plight_ = Plight::kTrapped;
      return {};
    }
    const float off = wrapped_angle(heading_rad_ - hall_.at().heading_rad);
    if (turning_ && magnitude(off) > kTurned_rad) return {0.0f, clamped(4.0f * off, -kGains.turn_rad_s, kGains.turn_rad_s)};
    if (turning_) ahead_to_m_ = hall_.travelled_m() + kStride_m;
    turning_ = false;
    points_.step_all(senses, hall_.at(), kSees_m, sane_period(dt_s));
    const bool room = free_at(0) > 0.5f;
    if (room && hall_.travelled_m() < ahead_to_m_) return braked({kGains.speed_m_s, 2.0f * off}, senses, body);
    return decide(senses);
  }

 private:
  [[nodiscard]] float free_at(std::size_t i) const noexcept {
    const float touching = body.radius_m + kNear_m;
    const float step = greatest(least(kStep_m, hall_.to_gate() + touching), touching + 0.05f);
    return clamped((points_.room(hall_.at(), range_finder_rad(i), body.radius_m + kBeside_m, kSees_m) - touching) / (step - touching), 0.0f, 1.0f);
  }

  [[nodiscard]] Motion decide(const Senses& senses) noexcept {
    RulesInput in;
    in.bearing_deg = hall_.bearing(hall_.gate()) / kRadPerDeg;
    for (std::size_t i = 0; i < kRangeFinders; ++i) in.free[i] = free_at(i);
    const RulesOutput out = host.decide(host.self, in);
    if (!out.found || !is_finite(out.turn_deg) || !is_finite(out.speed)) {
      plight_ = Plight::kTrapped;
      return {};
    }
    const float turn = out.turn_deg * kRadPerDeg;
    if (magnitude(turn) < kSteered_rad && out.speed > 0.5f) {
      return braked({kGains.speed_m_s * out.speed, clamped(3.0f * turn, -kGains.turn_rad_s, kGains.turn_rad_s)}, senses, body);
    }
    turning_ = true;
    heading_rad_ = wrapped_angle(hall_.at().heading_rad + turn);
    return {};
  }

  static constexpr HallGains kGains{0.25f, 115.0f * kRadPerDeg};
  static constexpr float kNear_m = 0.1f, kBeside_m = 0.04f, kStep_m = 0.55f, kSees_m = 0.8f, kStride_m = 0.1f;
  static constexpr float kTurned_rad = 4.0f * kRadPerDeg, kSteered_rad = 20.0f * kRadPerDeg;
  static constexpr float kPatience_m = 3.0f, kPatience_s = 10.0f;
  NearPoints points_{};
  float heading_rad_ = 0.0f;   ///< to which it turns, and then drives
  float ahead_to_m_ = 0.0f;    ///< straight on until so much has been driven
  bool turning_ = false;
};

}  // namespace mts
