// Checks control lines against the controllers that Waymark brings.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/program/program.h"
#include "sim/mind/knowledge.h"
#include "sim/robot_body.h"
#include "sim/world/labyrinth.h"

namespace kb::sim {

/// The range of a parameter for such a robot: `0.15 to 1 m`. The registry holds it for robots of size 1. A speed may be as large as the
/// default motors allow a robot of that size, even if the robot's own motors do less, and as large as its own motors do.
[[nodiscard]] std::string range_text(const mts::Parameter& parameter, const mts::Body& body);

/// `0.4 m/s`, `left`: what an argument sets.
[[nodiscard]] std::string value_text(const program::Control::Argument& argument);

/// Whether a robot of some size can have that number.
[[nodiscard]] bool fits_some_robot(const mts::Parameter& parameter, float value);

/// Reports (KB1313) values in control lines that the controllers of such a robot cannot take.
[[nodiscard]] bool check_settings(const Knowledge& knowledge, const mts::Body& body, diagnostics::Diagnostics& diagnostics);

/// The arguments of the controllers that Waymark brings, by controller.
[[nodiscard]] std::map<std::string_view, std::vector<std::string_view>> controller_arguments();

/// Warns of controllers for halls that drive something else (KB1396), and of those that look for a line in one (KB1511): the robot would stand
/// without any message.
void check_halls(const Knowledge& knowledge, const Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);

/// Warns (KB1364 to KB1366) of what `kbc sim` would refuse and what is plainly a mistake in a user's own program too: a name one letter
/// away from that of a controller, an argument that the controller of that name does not have, a number that it accepts for no size of robot, and
/// a number of the wrong quantity. Any other name may belong to a controller in the user's program and is not reported.
void check_controls(const program::Program& program, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::sim
