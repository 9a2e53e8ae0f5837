// A program and its ticks in the form of a recording: what pages know of the mind.
#pragma once

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "sim/recording.h"

namespace kb::sim {

/// All cells, rules and conditions. O(program).
[[nodiscard]] MindNames names_of(const program::Program& program);

/// Puts into `frame` what the mind noticed and did at this tick: events, rules, and a note for each conflict. Values and strategy are left alone.
void tell(const program::Tick& tick, const program::Program& program, Frame& frame);

}  // namespace kb::sim
