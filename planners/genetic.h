// The genetic planner of Darintsev and Migranov (2012), on a grid and on a grid with time.
//
// An individual is a walk from start to goal: one cell for each step of time, neighbours joined by a legal move or, where
// obstacles move, by a wait. The paper gives the five stages, two of the five terms of the fitness and the names of four
// operators; the rest is ours and said so below.
//
// It knows the whole map. It cannot prove that there is no way, so a flood fill comes first. A diagonal step takes as much
// time as a straight one and is sqrt(2) times as long.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planners/problem.h"

namespace kb::planners {

/// The constant weights of S = sum w_k S_k (Darintsev and Migranov 2012); each term lies in [0, 1], and 1 is ideal. S_1 and S_2 are the paper's,
/// normalised; it does not say what S_3 to S_5 are.
struct GeneticWeights {
  double length = 0.80;      ///< S_1 = octile distance / length of the walk
  double smoothness = 0.02;  ///< S_2 = turning points' share: n / sum exp(theta_i) over the n interior nodes, theta_i = turn, rad
  double time = 0.07;        ///< S_3 = least number of steps / steps
  double clearance = 0.01;   ///< S_4 = mean over nodes of min(c, 2) / 2, c = distance to the nearest blocked cell
  double conflicts = 0.10;   ///< S_5 = 1 / (1 + conflicts with moving obstacles)
};
/// Weights that trade length for smoothness and clearance: 0.45, 0.15, 0.15, 0.10, 0.15. Paths are some per cent longer.
inline constexpr GeneticWeights kBalancedWeights = {0.45, 0.15, 0.15, 0.10, 0.15};

struct GeneticOptions {
  GeneticWeights weights = {};         ///< not negative, sum 1
  /// Wanted course, rad: turns in S_2 are then measured against it instead of the segment before. (As printed, with theta_i
  /// minus a constant, it would be a constant factor and change nothing.)
  std::optional<double> course_rad = std::nullopt;
  std::uint32_t population = 60;       ///< at least 2; the best tenth survives unchanged
  double crossover_chance = 0.7;
  double mutation_chance = 0.4;
  std::uint32_t straightenings = 6;    ///< tries for each child
  std::uint32_t max_generations = 300;
  std::uint32_t stagnation = 25;       ///< generations without a better individual before it ends
  double target = 1.0;                 ///< fitness that is good enough
  std::uint64_t first_step = 0;        ///< of time, at the start
  std::uint32_t earliest_arrival = 0;  ///< steps; the goal is not free for good before
  std::uint32_t horizon = 0;           ///< most steps of a walk: the depth of planning. 0: no limit
};

/// Successes of each operator: how often what it made was legal and shorter, or at all.
struct GeneticCounts {
  std::uint64_t crossovers = 0, joined = 0, mutations = 0, straightened = 0, smoothed = 0, repaired = 0;
};

struct GeneticReport {
  Result result;
  std::vector<double> best_fitness;    ///< of the best individual, by generation; never falls among feasible ones
  std::vector<CellIndex> shortest;     ///< the shortest feasible walk met, which need not be the fittest
  GeneticCounts counts;
};

/// Plans. kReached with the fittest walk if it is free of conflicts; kUnreachable by the flood fill; kLimit if no
/// individual is feasible in the end, or if it was stopped. With moving obstacles the path has one point for each step.
/// Statistics: steps = generations, cells = individuals made, and in `more` "fitness", "shortest" (m), "conflicts".
[[nodiscard]] GeneticReport evolve(const Problem& problem, const RunOptions& run, const GeneticOptions& options = {});

}  // namespace kb::planners
