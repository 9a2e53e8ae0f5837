// The robot's body and the floor that it was built for: the lengths and limits that both the simulator and the controllers
// need. The defaults are those of one robot, that of the controllers' tests; a program with another robot gives its own `Body` to
// the controllers it starts, as the simulator does (sim/robot_body.h says in what its robot and its floor differ).
#pragma once

#include <cstddef>

#include "senses.h"

namespace mts {

/// Lengths in metres. Each value must be above 0; none is checked. A robot or a floor beyond 0.5 to 2 times the defaults is to be told
/// through a `Similarity`: see similarity.h.
/// `top_acceleration_m_s2`, `range_latency_s` and `radius_m` are what stopping in time rests on (see fastest_that_stops in heard.h):
/// they are to be measured with full load on the worst floor, not taken from a data sheet.
struct Body {
  float size = 1.0f;                      ///< how many times as large as the defaults robot and floor are: for whom makes a `Similarity` of it. Controllers do not read it

  // The robot: a disc on two wheels; its centre is the middle of their axle.
  float radius_m = 0.12f;
  float wheel_base_m = 0.20f;             ///< from wheel to wheel
  float top_speed_m_s = 0.6f;             ///< of a wheel; also the fastest that a control line may ask for
  float top_acceleration_m_s2 = 1.5f;     ///< of a wheel, and what it brakes with
  float top_turn_rad_s = 3.0f;            ///< on the spot; its wheels alone would do 2 top_speed / wheel_base
  float line_ahead_m = 0.09f;             ///< from the centre to the row of line sensors
  float line_span_m = 0.08f;              ///< from the first to the last of them
  bool has_range_finders = true;          ///< false: nothing brakes it but its bumper. One that has them and hears none stands
  /// The oldest that a range can be when the wheels answer to it: the period of the range finders, their latency, and the control
  /// period. 50 + 20 + 20 ms are those of the simulator; a lag of the motors is to be added.
  float range_latency_s = 0.09f;
  float longest_silence_s = 0.5f;         ///< senses that are older are silent: see Ages
  float crawl_m_s = 0.08f;                ///< so slowly that it may touch something: where a range finder ahead says nothing

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
};

/// What a range finder of such a robot says of nothing: see Senses::range_m.
[[nodiscard]] constexpr float out_of_range_m(const Body& body) noexcept { return body.size * kOutOfRange; }

/// Direction of range finder i in the robot's frame, in [0, 2 pi): i times 45 degrees.
[[nodiscard]] constexpr float range_finder_rad(std::size_t i) noexcept { return 0.785398163f * static_cast<float>(i); }

}  // namespace mts
