// Whether a sensor still sees, or gives the same reading for ever.
//
// note [a sense that is stuck]
// A sensor that gives the same bits while the wheels turn is stuck. That holds only for sensors known to have noise: those whose values
// kept changing while the robot stood. A sensor without noise may see the same for metres, such as a floor without paint.
//
// A compass and odometry are held against what must change with them, so that they need no noise: a compass of whole degrees may say the same
// along a whole road, but not while the wheels turn the robot by 10 degrees. And if the speed of odometry says that the robot moves, its place
// must change, within the time after which a silent sense counts as silent.
#pragma once

#include <cstddef>

#include "heard.h"
#include "senses.h"
#include "stop_line.h"

namespace mts {

template <std::size_t kElements>
class Liveness {
 public:
  /// One control period. `way_m`: how far the sensor has moved, by driving or turning. `tells`: the values could have been others, as those of
  /// range finders of which some see something.
  constexpr void step(bool known, const float (&elements)[kElements], bool tells, float way_m, float dt_s) noexcept {
    known_ = known;
    if (!known || !tells || !same(elements)) {
      const bool stood = same_m_ + way_m < kStands_m_s * (same_s_ + dt_s), lively = known && same_s_ + dt_s < kLively_s;
      noise_s_ = !lively ? 0.0f : stood ? noise_s_ + same_s_ + dt_s : noise_s_;
      noisy_ = noisy_ || noise_s_ > kNoise_s;
      same_m_ = same_s_ = 0.0f;
      for (std::size_t i = 0; i < kElements; ++i) last_[i] = elements[i];
      return;
    }
    same_m_ += way_m;
    same_s_ += dt_s;
  }
  [[nodiscard]] constexpr bool stuck() const noexcept { return noisy_ && same_m_ > kStuck_m && same_s_ > kStuck_s; }
  [[nodiscard]] constexpr bool sees() const noexcept { return known_ && !stuck(); }

 private:
  [[nodiscard]] constexpr bool same(const float (&elements)[kElements]) const noexcept {
    for (std::size_t i = 0; i < kElements; ++i) {
      if (!(last_[i] == elements[i])) return false;
    }
    return true;
  }

  static constexpr float kStands_m_s = 0.05f, kLively_s = 0.2f, kNoise_s = 0.4f;   // samples come every 0.01 to 0.05 s
  static constexpr float kStuck_m = 0.05f, kStuck_s = 0.2f;
  float last_[kElements] = {};
  bool known_ = false, noisy_ = false;
  float noise_s_ = 0.0f;                       // how long its values have kept changing
  float same_m_ = 0.0f, same_s_ = 0.0f;        // since its values last changed
};

/// The compass and the odometry of a robot: see note [a sense that is stuck]. One that is stuck counts as silent.
class LiveGuides {
 public:
  /// Each period, before the senses are used: those that are stuck become unknown. What the wheels have turned belongs to the odometry.
  /// `silence_s`: see Body::longest_silence_s.
  constexpr void step(Senses& senses, float silence_s, float dt_s) noexcept {
    judge_odometry(senses, silence_s, dt_s);
    judge_compass(senses, dt_s);
    last_ = senses;
    senses.odometry_known = senses.odometry_known && !odometry_stuck_;
    senses.turned_known = senses.turned_known && !odometry_stuck_;
    senses.heading_known = senses.heading_known && magnitude(unmatched_rad_) <= kTurns_rad;
  }

 private:
  constexpr void judge_odometry(const Senses& senses, float silence_s, float dt_s) noexcept {
    const float dx = senses.x_m - last_.x_m, dy = senses.y_m - last_.y_m, square = dx * dx + dy * dy;   // NaN where there is no place
    const bool known = senses.odometry_known && last_.odometry_known, turns = senses.turned_known && senses.turned_rad != last_.turned_rad;
    const bool same = known && square <= 0.0f && senses.speed_m_s == last_.speed_m_s && !turns;
    moves_ = moves_ || (known && square > 0.0f && square < kStep_m * kStep_m);
    same_m_ = same ? same_m_ + magnitude(senses.speed_m_s) * dt_s : 0.0f;
    same_s_ = same ? same_s_ + dt_s : 0.0f;
    odometry_stuck_ = moves_ && same_m_ > kStuck_m && same_s_ > kLate * silence_s;
  }
  constexpr void judge_compass(const Senses& senses, float dt_s) noexcept {
    if (!senses.heading_known || !last_.heading_known || senses.heading_rad != last_.heading_rad) unmatched_rad_ = 0.0f;
    else if (senses.turned_known && last_.turned_known && !odometry_stuck_) {
      const float turned_rad = wrapped_angle(senses.turned_rad - last_.turned_rad);
      if (magnitude(turned_rad) > kDrifts_rad_s * dt_s) unmatched_rad_ = clamped(unmatched_rad_ + turned_rad, -kPi, kPi);
    }
  }

  static constexpr float kStep_m = 0.3f;                       // no robot drives farther in a period: its odometry began anew elsewhere
  static constexpr float kStuck_m = 0.08f, kLate = 1.1f;
  static constexpr float kTurns_rad = 10.0f * kRadPerDeg;
  static constexpr float kDrifts_rad_s = 0.1f;                 // a gyroscope that turns more slowly may only drift
  Senses last_{};
  float same_m_ = 0.0f, same_s_ = 0.0f;                        // what odometry says that it drove, since it said anything else
  float unmatched_rad_ = 0.0f;                                 // by how much the wheels have turned the robot since the compass said anything else
  bool odometry_stuck_ = false;
  bool moves_ = false;                                         // its place has changed: not every host gives one
};

/// The line sensors and range finders of a robot. A sensor that is stuck counts as silent.
class LiveSenses {
 public:
  /// Each period, before the senses are used: those that are stuck become unknown. `measured`: the darknesses were computed from a measured line, and
  /// may stay the same for metres. `moved_m`: by how much the sensors moved, turns included.
  constexpr void step(Senses& senses, bool measured, float moved_m, float dt_s) noexcept {
    bool any_near = false;
    for (const float range_m : senses.range_m) any_near = any_near || range_m < kOutOfRange;
    front_known_ = knows_range(senses, 0) && knows_range(senses, 1) && knows_range(senses, kRangeFinders - 1);
    line_.step(senses.line_known, senses.line, !measured, moved_m, dt_s);
    ranges_.step(senses.range_known, senses.range_m, any_near, moved_m, dt_s);
    senses.line_known = line_.sees();
    senses.range_known = ranges_.sees();
    paint_ = false;
    for (const float darkness : senses.line) paint_ = paint_ || darkness > StopLine::kDarkFrom;
  }
  [[nodiscard]] constexpr bool line_sees() const noexcept { return line_.sees(); }
  /// Without the range finders in front the robot drives blind.
  [[nodiscard]] constexpr bool ranges_see() const noexcept { return ranges_.sees() && front_known_; }
  /// Whether any line sensor is over paint.
  [[nodiscard]] constexpr bool paint() const noexcept { return paint_; }

 private:
  Liveness<kLineSensors> line_;
  Liveness<kRangeFinders> ranges_;
  bool front_known_ = true, paint_ = false;
};

}  // namespace mts
