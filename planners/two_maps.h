// The method of two maps (Filimonov and Filimonov 2019): lines of force lay the route, isolines of the repulsion lead round
// obstacles, like meridians and parallels. The paper gives the condition of the bypass, without a number,
//
//   < q', grad U_rep(q) > = 0
//
// but not when to switch; the states are ours:
//
//   ROUTE   q' = F(q), until caught or too near to an obstacle (C = U_rep there, and d_h the distance to the goal). Then
//   BYPASS  along the isoline U_rep = C, to the side that the attraction prefers, kept until the end, as bugs do. Until
//   EXIT    the attraction points away from the obstacle, and the goal is nearer than d_h. Exits come ever nearer to the
//           goal, so the number of bypasses is finite.
//   ROUND   back at the entry: the other side is tried once; then the isoline is closed round the robot or the goal.
//
// Isolines of the nearest distance are offset curves p = const. Two walls nearer than 2p merge and close the passage, so
// the method starts with p = 1 cell and, where that comes to nothing, goes on from there with 0.5 and 0.3. The path is all that is
// driven: a robot that knows no more than what is near it cannot try beforehand which p will do.
#pragma once

#include "planners/potential.h"

namespace kb::planners {

struct TwoMapsParameters {
  PotentialParameters field;
  double step_cells = 0.1;
  std::uint64_t max_steps = 100000;   ///< for each clearance
};

[[nodiscard]] Result plan_two_maps(const Problem& problem, const TwoMapsParameters& parameters, const RunOptions& run);

}  // namespace kb::planners
