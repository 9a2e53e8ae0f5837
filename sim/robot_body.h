// The one robot that the simulator has, and the floor it was built for; controllers are started with the same lengths.
#pragma once

#include <waymark/controllers/body.h>

namespace kb::sim {

inline constexpr mts::Body kRobot{
    .radius_m = 0.12f,
    .wheel_base_m = 0.20f,
    .top_speed_m_s = 0.6f,
    .top_acceleration_m_s2 = 1.5f,
    .line_ahead_m = 0.09f,
    .line_span_m = 0.10f,
    .paint_width_m = 0.03f,
    .stop_line_width_m = 0.10f,   // thrice the paint: see note [a stop line is broad] in sim/mind/stop_line.h
    .road_width_m = 0.6f,
    .crossing_m = 0.9f,
};

}  // namespace kb::sim
