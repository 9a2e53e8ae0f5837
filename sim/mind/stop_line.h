// Detects a stop line under the line sensors.
#pragma once

#include <cmath>

#include <waymark/controllers/angles.h>
#include <waymark/controllers/body.h>
#include <waymark/controllers/senses.h>

namespace kb::sim {

// note [a stop line is broad]
// In the middle of a crossing a line lies across the robot's way as a stop line does, but it is less than half as broad. So a line
// counts as a stop line when it has been under the sensors for more than half of a stop line's breadth, or for a while at
// standstill. A robot that comes to the end of a road from the side, on the way round an obstacle, turns while the line is under
// the sensors: then the distance moved by the sensor row counts, and a quarter of the breadth is enough, as no other line lies
// across a road.
class StopLine {
 public:
  explicit StopLine(const mts::Body& body) : body_(body) {}

  /// One control period. `aslant`: see the note.
  void hear(const mts::Senses& senses, float dt_s, bool aslant) {
    int dark = 0;
    for (const float darkness : senses.line) dark += darkness > kDarkFrom ? 1 : 0;
    const float speed = senses.odometry_known ? std::abs(senses.speed_m_s) : kSpeedUnknown;
    const float turned_m = std::abs(std::remainder(senses.turned_rad - last_rad_, 2.0f * mts::kPi)) * body_.line_ahead_m;
    last_rad_ = senses.turned_rad;
    if (!senses.line_known || dark + 1 < static_cast<int>(mts::kLineSensors)) {
      dark_m_ = dark_s_ = 0.0f;
      now_ = false;
      return;
    }
    dark_m_ += aslant && senses.turned_known ? std::hypot(speed * dt_s, turned_m) : speed * dt_s;
    dark_s_ = speed < kStanding ? dark_s_ + dt_s : 0.0f;
    now_ = now_ || dark_m_ >= (aslant ? kPartAslant : kPart) * body_.stop_line_width_m || dark_s_ >= kBroadStanding;   // see note [a stop line is broad]
  }
  [[nodiscard]] bool now() const { return now_; }

  static constexpr float kDarkFrom = 0.5f;
  static constexpr float kPart = 0.5f, kPartAslant = 0.25f;   ///< of its breadth
  static constexpr float kBroadStanding = 0.4f;     ///< s
  static constexpr float kStanding = 0.02f;         ///< m/s
  static constexpr float kSpeedUnknown = 0.25f;     ///< m/s, assumed if the speed is unknown

 private:
  mts::Body body_;
  float dark_m_ = 0.0f, dark_s_ = 0.0f, last_rad_ = 0.0f;
  bool now_ = false;
};

}  // namespace kb::sim
