// The fuzzy planner on a grid: one cell a step, chosen from eight sensors and a compass to the goal (fuzzy_rules.h).
//
// Without memory the state is the cell, so a cell that is entered again proves an endless loop. `kVisits`, which is ours, prefers the
// direction with the least 8 * (visits of its cell) + (its rank in the rules).
#pragma once

#include "planners/fuzzy_rules.h"
#include "planners/problem.h"

namespace kb::planners {

enum class FuzzyMemory : std::uint8_t { kNone, kVisits };

/// Ends after 200 steps for each free cell at the latest, and never takes more than four million.
[[nodiscard]] Result plan_fuzzy(const Problem& problem, FuzzyMemory memory, const RunOptions& run);

}  // namespace kb::planners
