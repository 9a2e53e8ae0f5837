// A sensor that measures where a line lies, instead of the darkness of the floor: a magnetic guide sensor, a camera, a reader of strips.
#pragma once

#include <optional>

#include <waymark/controllers/body.h>

namespace kb::wire {

/// What it says: where the line is, if there is one, and whether paint lies across.
struct Guide {
  std::optional<float> left_m;     ///< the middle of the line, to the left of the robot's axis; beyond the row's end it counts as at its end
  bool across = false;             ///< a stop line, or another one that lies across the way
};

/// Sets the darknesses of which controllers and perception (controllers/line_sight.h) read just that: the sensor next to the line is on
/// paint, and its neighbour towards the line so far that their mean is the line's place. All of them are, if paint lies across.
void set_line(const Guide& guide, const mts::Body& body, mts::Senses& senses);

}  // namespace kb::wire
