// Control lines as they were written, beside the controllers that Waymark brings.
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

/// What a number may be for such a robot: `0.15 to 1 m`. The registry has it for robots of size 1. A speed may be as large as for a robot of that size with the
/// default motors, though these do less, and as what these do.
[[nodiscard]] std::string range_text(const mts::Parameter& parameter, const mts::Body& body);

/// `0.4 m/s`, `left`: what an argument sets.
[[nodiscard]] std::string value_text(const program::Control::Argument& argument);

/// Whether a robot of some size can have that number.
[[nodiscard]] bool fits_some_robot(const mts::Parameter& parameter, float value);

/// Reports (KB1313) what control lines set to what the controllers of such a robot do not do.
[[nodiscard]] bool check_settings(const Knowledge& knowledge, const mts::Body& body, diagnostics::Diagnostics& diagnostics);

/// What the controllers that Waymark brings have to set, by their names.
[[nodiscard]] std::map<std::string_view, std::vector<std::string_view>> controller_arguments();

/// Warns (KB1396) of controllers that cross halls where they drive something else: the robot would stand, and nobody would say why.
void check_halls(const Knowledge& knowledge, const Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);

/// Warns (KB1364 to KB1366) of what `kbc sim` would refuse and what is plainly a mistake for a program of one's own as well: a name one letter
/// away from that of a controller or of something it has to set, and a number that a controller has for a robot of no size, or that is no
/// such quantity. Another name may be that of a controller in the user's program: nothing is said of it.
void check_controls(const program::Program& program, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::sim
