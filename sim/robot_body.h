// The robot that the simulator has if no scenario says otherwise, and the floor it was built for. It is the robot of the controllers'
// defaults but for what stands here. World, sensors, perception and controllers are given a body; this one is only their default.
#pragma once

#include <waymark/controllers/body.h>
#include <waymark/controllers/similarity.h>

namespace kb::sim {

inline constexpr mts::Body kRobot{
    .line_span_m = 0.10f,         // sensors 25 mm apart: a line 30 mm wide is never between two
    .stop_line_width_m = 0.10f,   // thrice the paint: see note [a stop line is broad] in sim/mind/stop_line.h
    .crossing_m = 0.9f,           // with stop lines as broad as that, at least so far apart; where roads meet at a narrow angle farther
};

/// What sizes robots may have.
inline constexpr float kLeastSize = 0.5f, kMostSize = 6.0f;
/// The usual robot of another size, and its floor. Paint does not grow as they do: no tape is broader than 5 cm, and stop lines and
/// the row of line sensors are as broad as fits the line.
[[nodiscard]] constexpr mts::Body robot_of(float size) {
  constexpr float kBroadestTape = 0.05f;   // m
  mts::Body body = mts::Similarity(size).out(kRobot);
  body.paint_width_m = mts::least(body.paint_width_m, kBroadestTape);
  const float lines = body.paint_width_m / kRobot.paint_width_m;
  body.line_span_m = lines * kRobot.line_span_m;
  body.stop_line_width_m = lines * kRobot.stop_line_width_m;
  return body;
}

}  // namespace kb::sim
