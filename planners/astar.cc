// The shortest path, with which other methods are compared, as a method.
#include "planners/methods.h"
#include "planners/shortest.h"

namespace kb::planners {

Result run_astar(const Problem& problem, const RunOptions& run) {
  Watch watch(run);
  Astar search(*problem.grid);
  const std::vector<Cell> path = search.search(problem.start_cell(), problem.goal_cell(), &watch);
  Result result = path.empty() ? ended_without_path(watch) : reached(*problem.grid, path);
  result.statistics.cells = search.expanded();
  return result;
}

}  // namespace kb::planners
