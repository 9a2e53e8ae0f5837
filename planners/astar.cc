// The shortest path, with which other methods are compared, as a method.
#include "planners/methods.h"
#include "planners/shortest.h"

namespace kb::planners {

Result run_astar(const Problem& problem, const RunOptions&) {
  Astar search(*problem.grid);
  const std::vector<Cell> path = search.search(problem.start_cell(), problem.goal_cell());
  Result result = path.empty() ? ended(Outcome::kUnreachable) : reached(*problem.grid, path);
  result.statistics.cells = search.expanded();
  return result;
}

}  // namespace kb::planners
