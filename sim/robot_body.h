// The robot that the simulator has if no scenario says otherwise, and the floor it was built for. It is the robot of the controllers'
// defaults but for what stands here. World, sensors, perception and controllers are given a body; this one is only their default.
#pragma once

#include <waymark/controllers/body.h>

namespace kb::sim {

inline constexpr mts::Body kRobot{
    .line_span_m = 0.10f,         // sensors 25 mm apart: a line 30 mm wide is never between two
    .stop_line_width_m = 0.10f,   // thrice the paint: see note [a stop line is broad] in sim/mind/stop_line.h
    .crossing_m = 0.9f,           // with stop lines as broad as that, at least so far apart; where roads meet at a narrow angle farther
};

}  // namespace kb::sim
