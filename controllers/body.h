// The robot's body and the floor that it was built for: the lengths and limits that both the simulator and the controllers
// need. One robot, so one set of defaults; a program with another robot gives its own `Body` to the controllers it starts.
#pragma once

#include <cstddef>

#include "senses.h"

namespace mts {

/// Lengths in metres. Each value must be above 0; none is checked.
struct Body {
  // The robot: a disc on two wheels; its centre is the middle of their axle.
  float radius_m = 0.12f;
  float wheel_base_m = 0.20f;             ///< from wheel to wheel
  float top_speed_m_s = 0.6f;             ///< of a wheel
  float top_acceleration_m_s2 = 1.5f;     ///< of a wheel
  float line_ahead_m = 0.09f;             ///< from the centre to the row of line sensors
  float line_span_m = 0.08f;              ///< from the first to the last of them

  // The floor.
  float paint_width_m = 0.03f;            ///< the painted line of a road
  float stop_line_width_m = 0.05f;        ///< along the road; it reaches from side to side
  float road_width_m = 0.6f;              ///< between the walls of a road that has walls
  float crossing_m = 0.7f;                ///< from the middle of a stop line to that of the one opposite
  float hall_door_m = 0.5f;               ///< from the middle of a stop line to the hall behind it

  /// Where line sensor i looks: to the left of the robot's axis.
  [[nodiscard]] constexpr float line_sensor_left_m(std::size_t i) const noexcept {
    return line_span_m * (0.5f - static_cast<float>(i) / static_cast<float>(kLineSensors - 1));
  }
  /// The fastest that it turns on the spot.
  [[nodiscard]] constexpr float top_turn_rad_s() const noexcept { return 2.0f * top_speed_m_s / wheel_base_m; }
};

/// Direction of range finder i in the robot's frame, in [0, 2 pi): i times 45 degrees.
[[nodiscard]] constexpr float range_finder_rad(std::size_t i) noexcept { return 0.785398163f * static_cast<float>(i); }

}  // namespace mts
