// Whether a sensor still sees, or gives the same reading for ever.
//
// note [a sense that is stuck]
// A sensor that gives the same bits while the wheels turn is stuck. That holds only for sensors known to have noise: those whose values
// kept changing while the robot stood. A sensor without noise may see the same for metres, such as a floor without paint. Odometry has no
// noise; but if its speed says that the robot moves, its place must change.
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

/// The compass and the odometry of a robot. One that is stuck counts as silent.
class LiveGuides {
 public:
  /// Each period, before the senses are used: those that are stuck become unknown. What the wheels have turned belongs to the odometry.
  constexpr void step(Senses& senses, float dt_s) noexcept {
    const float way_m = senses.odometry_known ? magnitude(senses.speed_m_s) * dt_s : 0.0f;
    const bool may_turn = !senses.turned_known || !turned_known_ || stuck_ || senses.turned_rad != turned_rad_;
    judge_odometry(senses, way_m, dt_s);
    const float heading[1] = {senses.heading_rad};
    compass_.step(senses.heading_known, heading, true, may_turn ? kMayTurn_m : way_m, dt_s);
    senses.heading_known = compass_.sees();
    senses.odometry_known = senses.odometry_known && !stuck_;
    senses.turned_known = senses.turned_known && !stuck_;
  }

 private:
  constexpr void judge_odometry(const Senses& senses, float way_m, float dt_s) noexcept {
    const bool same_place = senses.x_m == x_m_ && senses.y_m == y_m_;   // false for NaN
    const bool same = same_place && senses.speed_m_s == speed_m_s_ && (!senses.turned_known || senses.turned_rad == turned_rad_);
    moves_ = moves_ || (known_ && senses.odometry_known && !same_place && x_m_ == x_m_ && y_m_ == y_m_);
    same_m_ = same && senses.odometry_known ? same_m_ + way_m : 0.0f;
    same_s_ = same && senses.odometry_known ? same_s_ + dt_s : 0.0f;
    stuck_ = moves_ && same_m_ > kStuck_m && same_s_ > kStuck_s;
    x_m_ = senses.x_m;
    y_m_ = senses.y_m;
    speed_m_s_ = senses.speed_m_s;
    turned_rad_ = senses.turned_rad;
    known_ = senses.odometry_known;
    turned_known_ = senses.turned_known;
  }

  static constexpr float kMayTurn_m = 1.0f;                   // as much as a way on which a compass must change: a robot that turns does not stand
  static constexpr float kStuck_m = 0.08f, kStuck_s = 0.3f;   // a host may give its place ten times a second only
  Liveness<1> compass_;
  float x_m_ = 0.0f, y_m_ = 0.0f, speed_m_s_ = 0.0f, turned_rad_ = 0.0f;
  float same_m_ = 0.0f, same_s_ = 0.0f;                       // what odometry says that it drove, since it said anything else
  bool known_ = false, turned_known_ = false, stuck_ = false;
  bool moves_ = false;                                        // its place has changed: not every host gives one
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
