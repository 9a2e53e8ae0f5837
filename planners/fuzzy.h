// The fuzzy planner on a grid: one cell a step, chosen from eight sensors and a compass to the goal (fuzzy_rules.h).
//
// Without memory the state is the cell, so a cell that is entered again proves an endless loop. `kVisits`, which is ours, prefers the
// direction with the least 8 * (visits of its cell) + (its rank in the rules).
#pragma once

#include "planners/fuzzy_rules.h"
#include "planners/problem.h"

namespace kb::planners {

enum class FuzzyMemory : std::uint8_t { kNone, kVisits };

/// The most steps; each is remembered, in some hundred bytes.
inline constexpr std::uint64_t kMostFuzzySteps = 4'000'000;

struct FuzzyParameters {
  FuzzyMemory memory = FuzzyMemory::kNone;
  std::uint64_t max_steps = 0;   ///< 0: 200 times the free cells, at most kMostFuzzySteps
};

[[nodiscard]] Result plan_fuzzy(const Problem& problem, const FuzzyParameters& parameters, const RunOptions& run);

}  // namespace kb::planners
