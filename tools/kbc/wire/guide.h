// A sensor that measures where a line lies, instead of the darkness of the floor: a magnetic guide sensor, a camera, a reader of strips.
#pragma once

#include <optional>

#include <waymark/controllers/body.h>

namespace kb::wire {

/// Its reading: where the line is, if there is one, and whether paint lies across.
struct Guide {
  std::optional<float> left_m;     ///< the middle of the line, to the left of the robot's axis; past the row's end it counts as at its end
  bool across = false;             ///< a stop line, or another line across the way
};

/// Sets darknesses from which controllers and perception (controllers/line_sight.h) read that: the sensor next to the line is on paint, and
/// its neighbour towards the line just so dark that their mean is the line's place. If paint lies across, all sensors are on paint.
void set_line(const Guide& guide, const mts::Body& body, mts::Senses& senses);

}  // namespace kb::wire
