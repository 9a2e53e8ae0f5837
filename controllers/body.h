// The robot's body and the floor it was built for: the lengths and limits that both the simulator and the controllers need. The defaults
// describe the robot of the controllers' tests. For another robot, give your own `Body` to the controllers you start, as the simulator
// does (sim/robot_body.h lists how its robot and its floor differ).
#pragma once

#include <cstddef>

#include "senses.h"

namespace mts {

/// Lengths are in metres. Each value must be above 0; none is checked. If your robot or floor is outside 0.5 to 2 times the defaults,
/// convert it with a `Similarity`: see similarity.h.
/// Stopping in time rests on `top_acceleration_m_s2`, `range_latency_s` and `radius_m` (see fastest_that_stops in heard.h). Measure them
/// with full load on the worst floor; do not take them from a data sheet.
struct Body {
  /// How many times as large as the defaults robot and floor are: make your `Similarity` from it. Controllers do not read it.
  float size = 1.0f;

  // The robot: a disc on two wheels; its centre is the middle of their axle.
  float radius_m = 0.12f;
  float wheel_base_m = 0.20f;             ///< from wheel to wheel
  float top_speed_m_s = 0.6f;             ///< of a wheel; also the fastest that a control line may ask for
  float top_acceleration_m_s2 = 1.5f;     ///< of a wheel, also when it brakes; below 1 the robot is driven more slowly: see similarity.h
  float top_turn_rad_s = 3.0f;            ///< of the body; the same below 1
  float line_ahead_m = 0.09f;             ///< from the centre to the row of line sensors
  float line_span_m = 0.08f;              ///< from the first to the last of them
  bool has_range_finders = true;          ///< false: only its bumper stops it. A robot that has them does not drive while all are silent
  /// The greatest age of a range by the time the wheels respond to it: period of the range finders + their latency + control period.
  /// The simulator has 50 + 20 + 20 ms. Add the lag of your motors.
  float range_latency_s = 0.09f;
  float longest_silence_s = 0.5f;         ///< older senses count as silent: see Ages
  float crawl_m_s = 0.08f;                ///< slow enough to touch something: the speed while a range finder ahead is silent

  // The floor.
  float paint_width_m = 0.03f;            ///< the painted line of a road
  float stop_line_width_m = 0.05f;        ///< measured along the road; the line reaches from side to side
  float road_width_m = 0.6f;              ///< between the walls of a road that has walls
  float crossing_m = 0.7f;                ///< from the middle of a stop line to the middle of the opposite one
  float hall_door_m = 0.5f;               ///< from the middle of a stop line to the hall behind it

  /// Position of line sensor i, in m to the left of the robot's axis.
  [[nodiscard]] constexpr float line_sensor_left_m(std::size_t i) const noexcept {
    return line_span_m * (0.5f - static_cast<float>(i) / static_cast<float>(kLineSensors - 1));
  }
};

/// What a range finder of this robot reads if nothing is in range, in m: see Senses::range_m.
[[nodiscard]] constexpr float out_of_range_m(const Body& body) noexcept { return body.size * kOutOfRange; }

/// Direction of range finder i in the robot's frame, in [0, 2 pi): i times 45 degrees.
[[nodiscard]] constexpr float range_finder_rad(std::size_t i) noexcept { return 0.785398163f * static_cast<float>(i); }

}  // namespace mts
