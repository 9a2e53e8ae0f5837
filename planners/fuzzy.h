// The fuzzy planner on a grid: a cell a step, by what eight sensors and a compass to the goal say (fuzzy_rules.h).
//
// Without memory the state is the cell: a cell that is entered again proves a loop without end. `visits` is ours: prefer the
// direction with the least 8 * (visits of its cell) + (its rank in the rules).
#pragma once

#include "planners/fuzzy_rules.h"
#include "planners/problem.h"

namespace kb::planners {

enum class FuzzyMemory : std::uint8_t { kNone, kVisits };

/// Each is remembered: some hundred bytes.
inline constexpr std::uint64_t kMostFuzzySteps = 4'000'000;

struct FuzzyParameters {
  FuzzyMemory memory = FuzzyMemory::kNone;
  std::uint64_t max_steps = 0;   ///< 0: 200 times the free cells, at most kMostFuzzySteps
};

[[nodiscard]] Result plan_fuzzy(const Problem& problem, const FuzzyParameters& parameters, const RunOptions& run);

}  // namespace kb::planners
