// Drives along a painted line.
//
//   y      how far to the left the line lies under the row of sensors, m: the weighted mean of line_sight.h
//   omega  = kp y + ki integral(y) + kd y'            PID (filter.h), y' filtered by tau
//   v      = speed / (1 + |y| / y_half + |omega| / omega_half), at least a quarter of `speed`: slow in bends
//
// The row lies L ahead of the wheels, so y' = -L omega - v psi and psi' = omega. With kp alone, s^2 + kp L s + kp v = 0: the damping is
// L sqrt(kp / v) / 2 = 0.62 at the defaults and 0.4 m/s; with kd it is (L kp + v kd) / (2 sqrt(v kp (1 + L kd))) = 0.64.
//
// If the line is gone, what happens depends on where it was last. If it was last seen at a side, or had an arm to a side within the last
// 8 cm (a corner), the robot turns to that side while it creeps ahead, until it sees the line or has turned by `search_angle`. If it was
// last seen in the middle, the robot goes straight on. After a distance of `search` it stops, and goes on as soon as it sees a line.
// It drives straight over paint across the road (a stop line). If the line sensors are silent, it stops.
#pragma once

#include "filter.h"
#include "gain.h"
#include "heard.h"
#include "line_sight.h"

namespace mts {

struct FollowLineGains {
  float speed_m_s = 0.4f;
  float kp = 75.0f;                ///< rad/s per m
  float ki = 15.0f;                ///< rad/s per m s
  float kd = 3.0f;                 ///< rad per m
  float tau_s = 0.03f;
  float slow_at_m = 0.03f;         ///< y_half
  float turn_rad_s = 170.0f * kRadPerDeg;         ///< the fastest turn
  float search_m = 0.12f;
  float search_rad = 120.0f * kRadPerDeg;
};

inline constexpr Gain<FollowLineGains> kFollowLineGains[] = {
    gain("speed", "m/s", &FollowLineGains::speed_m_s, 0.05f, 0.6f, "on straight lines"),
    gain("kp", "1/(m s)", &FollowLineGains::kp, 5.0f, 200.0f, "turn per metre that the line lies aside"),
    gain("ki", "1/(m s2)", &FollowLineGains::ki, 0.0f, 100.0f, "turn per metre and second"),
    gain("kd", "1/m", &FollowLineGains::kd, 0.0f, 10.0f, "turn per metre a second"),
    gain("filter", "s", &FollowLineGains::tau_s, 0.0f, 0.5f, "time constant of the derivative's low-pass"),
    gain("slow_at", "m", &FollowLineGains::slow_at_m, 0.005f, 1.0f, "half speed when the line lies so far aside"),
    angle_gain("turn_speed", "deg/s", &FollowLineGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    gain("search", "m", &FollowLineGains::search_m, 0.0f, 1.0f, "how far it goes on without a line"),
    angle_gain("search_angle", "deg", &FollowLineGains::search_rad, 0.0f, 360.0f, "how far it turns for a line lost at a side"),
};

class FollowLine {
 public:
  FollowLineGains gains;
  Body body;

  void start(const Task&, const Senses&) noexcept {
    pid_ = Pid{gains.kp, gains.ki, gains.kd, gains.tau_s, gains.turn_rad_s};
    last_m_ = arm_m_ = 0.0f;
    lost_m_ = lost_rad_ = 0.0f;
    searches_ = false;
    since_arm_m_ = kForgets_m;
    since_across_m_ = kFar_m;
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = heard(raw, body);
    if (!senses.line_known) {
      pid_.reset();
      return {};
    }
    const float dt = sane_period(dt_s);
    const LineSight line = look_at_line(senses, body);
    searches_ = !line.seen;
    if (searches_) return search(senses, dt);
    lost_m_ = lost_rad_ = 0.0f;
    const float way = dt * magnitude(senses.odometry_known ? senses.speed_m_s : gains.speed_m_s);
    since_arm_m_ += way;
    since_across_m_ += way;
    if (line.across) {
      pid_.reset();
      last_m_ = since_across_m_ = 0.0f;
      since_arm_m_ = kForgets_m;
      return braked({0.75f * gains.speed_m_s, 0.0f}, senses, body);
    }
    // The edge of paint across the road, left at an angle, shows neither an arm nor the line's place.
    const bool edge = since_across_m_ < greatest(kEdge_m, kEdge * body.line_span_m);
    if (line.strength >= 1.0f && !edge) last_m_ = line.left_m;   // a fading edge says little about the line's place
    if (line.left_arm != line.right_arm && !edge) {
      arm_m_ = body.line_sensor_left_m(line.left_arm ? 0 : kLineSensors - 1);
      since_arm_m_ = 0.0f;
    }
    const float turn = pid_.step(line.left_m, dt);
    const float slow = 1.0f + magnitude(line.left_m) / gains.slow_at_m + magnitude(turn) / gains.turn_rad_s;
    return braked({greatest(gains.speed_m_s / slow, 0.25f * gains.speed_m_s), turn}, senses, body);
  }

  /// Always false: a line follower does not know where a road ends.
  [[nodiscard]] bool done() const noexcept { return false; }
  /// Whether the search for the line has ended without success; the robot then stands.
  [[nodiscard]] bool lost() const noexcept { return searches_ && (lost_m_ >= gains.search_m || (at_side_ && lost_rad_ >= gains.search_rad)); }

 private:
  [[nodiscard]] Motion search(const Senses& senses, float dt) noexcept {
    pid_.reset();
    const float side = since_arm_m_ < kForgets_m ? arm_m_ : last_m_;
    at_side_ = magnitude(side) > greatest(kMiddle_m, kMiddle * body.line_span_m);
    if (lost()) return {};
    Motion motion{0.5f * gains.speed_m_s, 0.0f};
    if (at_side_) motion = {0.02f, sign_of(side) * least(2.5f, gains.turn_rad_s)};
    lost_m_ += dt * (senses.odometry_known && !at_side_ ? searched_m_s(senses, motion.speed_m_s) : motion.speed_m_s);
    lost_rad_ += dt * magnitude(motion.turn_rad_s);
    return braked(motion, senses, body);
  }

  static constexpr float kForgets_m = 0.08f, kEdge_m = 0.03f, kMiddle_m = 0.012f, kFar_m = 1.0f;
  static constexpr float kEdge = 0.25f, kMiddle = 0.1f;   ///< the same as shares of the row's width, for rows wider than 12 cm
  Pid pid_{};
  float last_m_ = 0.0f;                       ///< where the line was seen last
  float arm_m_ = 0.0f, since_arm_m_ = kForgets_m;   ///< side to which an arm led, and distance driven since
  float since_across_m_ = kFar_m;             ///< distance driven since paint lay across
  float lost_m_ = 0.0f, lost_rad_ = 0.0f;     ///< distance and angle of the search
  bool searches_ = false;                     ///< there was no line on the last step
  bool at_side_ = false;                      ///< the line was lost at a side: the robot turns to it
};

}  // namespace mts
