// What a robot does on the spot: stand, turn round, look round.
#pragma once

#include "gain.h"
#include "heard.h"
#include "reckoning.h"

namespace mts {

/// Stands still. Needs no senses.
class Stand {
 public:
  void start(const Task&, const Senses&) noexcept {}
  [[nodiscard]] Motion step(const Senses&, float) noexcept { return {}; }
  [[nodiscard]] bool done() const noexcept { return false; }
};

struct TurnRoundGains {
  float angle_rad = kPi;              ///< counter-clockwise
  float turn_rad_s = 85.0f * kRadPerDeg;
  float k_1_s = 4.0f;
  float tolerance_rad = 2.0f * kRadPerDeg;
};

inline constexpr Gain<TurnRoundGains> kTurnRoundGains[] = {
    angle_gain("angle", "deg", &TurnRoundGains::angle_rad, -360.0f, 360.0f, "counter-clockwise"),
    angle_gain("speed", "deg/s", &TurnRoundGains::turn_rad_s, 10.0f, 240.0f, "the fastest turn"),
    gain("k", "1/s", &TurnRoundGains::k_1_s, 0.5f, 10.0f, "turn per angle that is left"),
    angle_gain("tolerance", "deg", &TurnRoundGains::tolerance_rad, 0.5f, 10.0f, "done within it"),
};

/// Turns on the spot: omega = k * remaining angle, within +-speed. The remaining angle counts down by the changes of the reckoned heading,
/// so that 180 and 360 degrees have a direction. If the task has a piece, it turns to that piece's heading, by the angle within half a
/// turn of `angle`, since a robot that looked round before may not face along its road. With neither compass nor `turned_rad`, it stops.
class TurnRound {
 public:
  TurnRoundGains gains;
  Body body;

  void start(const Task& task, const Senses& raw) noexcept {
    reckoning_.start_along(heard(raw, body), task, -gains.angle_rad);
    last_rad_ = reckoning_.at.heading_rad;
    left_rad_ = gains.angle_rad;
    if (task.pieces > 0) left_rad_ += wrapped_angle(task.course[0].heading_rad - last_rad_ - gains.angle_rad);
    calm_s_ = 0.0f;
  }
  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const float dt = sane_period(dt_s);
    reckoning_.step(heard(raw, body), dt);
    if (!reckoning_.heading_known()) return {};
    left_rad_ -= wrapped_angle(reckoning_.at.heading_rad - last_rad_);
    last_rad_ = reckoning_.at.heading_rad;
    calm_s_ = magnitude(left_rad_) < gains.tolerance_rad ? calm_s_ + dt : 0.0f;
    if (done()) return {};
    return {0.0f, clamped(gains.k_1_s * left_rad_, -gains.turn_rad_s, gains.turn_rad_s)};
  }
  /// Whether it has been within the tolerance for a tenth of a second.
  [[nodiscard]] bool done() const noexcept { return calm_s_ >= 0.1f; }

 private:
  Reckoning reckoning_{};
  float last_rad_ = 0.0f, left_rad_ = 0.0f, calm_s_ = 0.0f;
};

struct LookRoundGains {
  float turn_rad_s = 40.0f * kRadPerDeg;
  float angle_rad = 60.0f * kRadPerDeg;
};

inline constexpr Gain<LookRoundGains> kLookRoundGains[] = {
    angle_gain("speed", "deg/s", &LookRoundGains::turn_rad_s, 5.0f, 180.0f, "of turning"),
    angle_gain("angle", "deg", &LookRoundGains::angle_rad, 5.0f, 170.0f, "how far to each side of the heading at the start"),
};

/// Turns left and right in turn about the heading at the start, so that a sign may come into view. It does not leave the line it stands
/// on. With neither compass nor `turned_rad`, it stops.
class LookRound {
 public:
  LookRoundGains gains;
  Body body;

  void start(const Task&, const Senses& raw) noexcept {
    reckoning_.start_relative(heard(raw, body));
    last_rad_ = reckoning_.at.heading_rad;
    off_rad_ = 0.0f;
    to_left_ = true;
  }
  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    reckoning_.step(heard(raw, body), sane_period(dt_s));
    if (!reckoning_.heading_known()) return {};
    off_rad_ += wrapped_angle(reckoning_.at.heading_rad - last_rad_);
    last_rad_ = reckoning_.at.heading_rad;
    if (off_rad_ > gains.angle_rad) to_left_ = false;
    if (off_rad_ < -gains.angle_rad) to_left_ = true;
    return {0.0f, to_left_ ? gains.turn_rad_s : -gains.turn_rad_s};
  }
  [[nodiscard]] bool done() const noexcept { return false; }

 private:
  Reckoning reckoning_{};
  float last_rad_ = 0.0f;
  float off_rad_ = 0.0f;   ///< from the heading at the start; past half a turn if it cannot brake before
  bool to_left_ = true;
};

}  // namespace mts
