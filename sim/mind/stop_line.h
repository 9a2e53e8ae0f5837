// When a stop line lies under the line sensors.
#pragma once

#include <cmath>

#include "controllers/senses.h"

namespace kb::sim {

// note [a stop line is broad]
// In the middle of a crossing a line lies across the robot's way as a stop line does, but it is a third as broad. So a line
// counts as a stop line when it has been under the sensors for more than half of a stop line's breadth, or for a while at
// standstill.
class StopLine {
 public:
  /// One control period.
  void hear(const mts::Senses& senses, float dt_s) {
    int dark = 0;
    for (const float darkness : senses.line) dark += darkness > kDarkFrom ? 1 : 0;
    const float speed = senses.odometry_known ? std::abs(senses.speed_m_s) : kSpeedUnknown;
    if (!senses.line_known || dark + 1 < static_cast<int>(mts::kLineSensors)) {
      dark_m_ = dark_s_ = 0.0f;
      now_ = false;
      return;
    }
    dark_m_ += speed * dt_s;
    dark_s_ = speed < kStanding ? dark_s_ + dt_s : 0.0f;
    now_ = now_ || dark_m_ >= kBroad || dark_s_ >= kBroadStanding;   // see note [a stop line is broad]
  }
  [[nodiscard]] bool now() const { return now_; }

  static constexpr float kDarkFrom = 0.5f;
  static constexpr float kBroad = 0.05f;            ///< m
  static constexpr float kBroadStanding = 0.4f;     ///< s
  static constexpr float kStanding = 0.02f;         ///< m/s
  static constexpr float kSpeedUnknown = 0.25f;     ///< m/s, taken for it

 private:
  float dark_m_ = 0.0f, dark_s_ = 0.0f;
  bool now_ = false;
};

}  // namespace kb::sim
