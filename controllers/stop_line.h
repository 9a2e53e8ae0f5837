// Detects a stop line under the line sensors.
//
// note [a stop line is broad]
// In the middle of a crossing a line lies across the robot's way as a stop line does, but it is less than half as broad. So a line
// counts as a stop line when it has been under the sensors for more than half of a stop line's breadth, or for a while at
// standstill. A robot that comes to the end of a road from the side, on the way round an obstacle, turns while the line is under
// the sensors: then the distance moved by the sensor row counts, and a quarter of the breadth is enough, as no other line lies
// across a road.
#pragma once

#include "angles.h"
#include "body.h"

namespace mts {

class StopLine {
 public:
  /// `body` must be of size 1, as must be the senses.
  constexpr explicit StopLine(const Body& body = {}) noexcept : width_m_(body.stop_line_width_m), line_ahead_m_(body.line_ahead_m) {}

  /// One control period. The senses must have been `heard`. `aslant`: the robot comes from the side: see the note.
  constexpr void step(const Senses& senses, float dt_s, bool aslant) noexcept {
    std::size_t dark = 0;
    for (const float darkness : senses.line) dark += darkness > kDarkFrom ? 1 : 0;
    const float speed = senses.odometry_known ? magnitude(senses.speed_m_s) : kSpeedUnknown_m_s;
    const float turned_m = wrapped_angle(senses.turned_rad - last_rad_) * line_ahead_m_;
    last_rad_ = senses.turned_rad;
    if (!senses.line_known || dark + 1 < kLineSensors) {
      dark_m_ = dark_s_ = 0.0f;
      now_ = false;
      return;
    }
    const float way_m = speed * dt_s;
    dark_m_ += aslant && senses.turned_known ? square_root(way_m * way_m + turned_m * turned_m) : way_m;
    dark_s_ = speed < kStanding_m_s ? dark_s_ + dt_s : 0.0f;
    now_ = now_ || dark_m_ >= (aslant ? kPartAslant : kPart) * width_m_ || dark_s_ >= kStandingLong_s;
  }
  /// Whether a stop line lies under the row.
  [[nodiscard]] constexpr bool now() const noexcept { return now_; }

  static constexpr float kDarkFrom = 0.5f;                    ///< from this darkness on a sensor sees paint
  static constexpr float kPart = 0.5f, kPartAslant = 0.25f;   ///< of the breadth of a stop line

 private:
  static constexpr float kStandingLong_s = 0.4f, kStanding_m_s = 0.02f;
  static constexpr float kSpeedUnknown_m_s = 0.25f;           ///< assumed if the speed is unknown

  float width_m_, line_ahead_m_;
  float dark_m_ = 0.0f, dark_s_ = 0.0f, last_rad_ = 0.0f;
  bool now_ = false;
};

}  // namespace mts
