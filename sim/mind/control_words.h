// Control lines as they were written, beside the controllers that Waymark brings.
#pragma once

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/program/program.h"

namespace kb::sim {

/// Warns (KB1364 to KB1366) of what `kbc sim` would refuse and what is plainly a mistake for a program of one's own as well: a name one letter
/// away from that of a controller or of something it has to set, and a number out of the range of a controller that there is. Another
/// name may be that of a controller in the user's program: nothing is said of it.
void check_controls(const program::Program& program, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::sim
