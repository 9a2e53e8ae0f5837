// The genetic planner of Darintsev and Migranov (2012), on a grid and on a grid with time.
//
// An individual is a walk from start to goal: one cell for each time step. Neighbouring cells are joined by a legal move or, if obstacles
// move, by a wait. The paper gives the five stages, two of the five terms of the fitness, and the names of four operators. The rest is
// ours, and the comments say so.
//
// The planner knows the whole map. It cannot prove that there is no path, so a flood fill comes first. A diagonal step takes as much time
// as a straight one and is sqrt(2) times as long.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "planners/problem.h"

namespace kb::planners {

/// The constant weights of the fitness S = sum w_k S_k (Darintsev and Migranov 2012). Each term lies in [0, 1], and 1 is ideal. S_1 and S_2
/// are the paper's, normalised; the paper does not define S_3 to S_5.
struct GeneticWeights {
  double length = 0.80;      ///< S_1 = octile distance / length of the walk
  double smoothness = 0.02;  ///< S_2 = n / sum exp(theta_i) over the n interior nodes, theta_i = turn at the node, rad
  double time = 0.07;        ///< S_3 = least possible number of steps / steps
  double clearance = 0.01;   ///< S_4 = mean over nodes of min(c, 2) / 2, c = distance to the nearest blocked cell
  double conflicts = 0.10;   ///< S_5 = 1 / (1 + conflicts with moving obstacles)
};
/// Weights that trade length for smoothness and clearance. Paths are 0.1 to 0.6 % longer in the mean.
inline constexpr GeneticWeights kBalancedWeights = {0.45, 0.15, 0.15, 0.10, 0.15};

struct GeneticOptions {
  GeneticWeights weights = {};         ///< not negative, sum 1
  /// Wanted course, rad. If given, turns in S_2 are measured against it instead of against the segment before. (As printed, theta_i minus a
  /// constant, it would be a constant factor and change nothing.)
  std::optional<double> course_rad = std::nullopt;
  std::uint32_t population = 60;       ///< at least 2; the best tenth survives unchanged
  double mutation_chance = 0.4;
  std::uint32_t max_generations = 300;
  std::uint32_t stagnation = 25;       ///< ends after this many generations without a better individual
  double target = 1.0;                 ///< a fitness that is good enough to end with, of a walk without conflicts
  std::uint32_t earliest_arrival = 0;  ///< steps; before, the goal is not free for good
  std::uint32_t horizon = 0;           ///< the most steps of a walk, the depth of planning; 0: no limit
};

struct GeneticReport {
  Result result;
  std::vector<double> best_fitness;    ///< of the best individual, by generation; never falls among feasible ones
  std::vector<CellIndex> shortest;     ///< the shortest feasible walk found, which need not be the fittest
};

/// Plans. kReached with the fittest walk if it is free of conflicts; kUnreachable by the flood fill; kLimit if no individual is feasible in
/// the end or the run was stopped. With moving obstacles the path has one point for each step. Statistics: steps = generations, cells =
/// individuals made, and in `more` "fitness", "shortest" (m), "conflicts".
[[nodiscard]] GeneticReport evolve(const Problem& problem, const RunOptions& run, const GeneticOptions& options = {});

}  // namespace kb::planners
