// The method of two maps (Filimonov and Filimonov 2019): lines of force lay the route, and isolines of the repulsion lead round
// obstacles, like meridians and parallels. The paper gives the condition of the bypass, without a number,
//
//   < q', grad U_rep(q) > = 0
//
// but does not say when to switch. The states are ours:
//
//   ROUTE   q' = F(q), until the robot is caught or too near to an obstacle. There C = U_rep, and d_h is the distance to the goal.
//   BYPASS  along the isoline U_rep = C, on the side that the attraction prefers; like a bug, the robot keeps that side to the end.
//   EXIT    when the attraction points away from the obstacle and the goal is nearer than d_h. Exits come ever nearer to the goal,
//           so the number of bypasses is finite.
//   ROUND   when the robot is back at the entry, it tries the other side once. After that the isoline is known to be closed round
//           the robot or the goal.
//
// Isolines of the nearest distance are offset curves p = const. Two walls nearer than 2p merge and close the passage, so the method
// starts with p = 1 cell and, if that fails, goes on from there with 0.5 and 0.3. The path contains all that is driven, since a robot
// that knows only what is near cannot try beforehand which p will do.
//
// Knowledge: local range, but for one word of the answer. That all isolines are closed proves nothing about passages that are narrower than they,
// so in the end a flood fill of the whole map says whether the answer is kUnreachable or kLimit. The path does not depend on it.
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
