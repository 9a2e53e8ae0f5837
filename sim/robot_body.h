// The simulator's robot if no scenario says otherwise, and the floor it was built for. It has the controllers' default body, except for
// the values given here. World, sensors, perception and controllers are passed a body; this one is only their default.
#pragma once

#include <waymark/controllers/body.h>
#include <waymark/controllers/similarity.h>

namespace kb::sim {

inline constexpr mts::Body kRobot{
    .line_span_m = 0.10f,         // sensors 25 mm apart: a line 30 mm wide is never between two
    .stop_line_width_m = 0.10f,   // thrice the paint: see note [a stop line is broad] in controllers/stop_line.h
    .crossing_m = 0.9f,           // least distance between stop lines of that breadth; more where roads meet at a narrow angle
};

/// The sizes that robots may have.
inline constexpr float kLeastSize = 0.5f, kMostSize = 6.0f;
/// The usual robot in another size, and its floor. Paint does not scale with them: no tape is broader than 5 cm, and the breadth of stop
/// lines and of the row of line sensors follows from that of the line.
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
