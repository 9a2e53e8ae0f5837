#include "planners/bug.h"
#include "planners/bug_run.h"
#include "planners/methods.h"

namespace kb::planners {

// Proof that the goal is unreachable if, after a loop, the way from the nearest point is not free: let L be the point of the
// wall nearest to the goal, and let the line from L to the goal begin inside the obstacle. Walked back from the goal, that
// line ends by leaving free space into this obstacle; so it meets the obstacle's rim at a point nearer than L. If goal and
// robot were on the same side, that point would belong to the same wall, which is one closed curve, and L would not be the
// nearest. Corners where obstacles are joined are passed more than once, with different ways ahead; that is why
// `NearestNode` prefers a free one among equally near points.
//
// Only nodes need to be compared: the goal is the centre of a cell, so the point of an edge that is nearest to it is a
// corner or the middle.
Result bug1(const Problem& problem, const RunOptions& run_settings, const BugOptions& options) {
  BugRun run(problem, run_settings, options);
  Node from = centre_node(problem.start_cell());
  while (const auto hit = run.go_straight(from)) {
    const Hand hand = run.take_hit(*hit);
    WallWalk walk(run.grid(), hit->at, edge_after_hit(run.grid(), *hit, hand), hand);
    PassedLoop loop{hit->at, {}};
    NearestNode nearest(run.goal_node());
    while (walk.next()) {
      if (run.exhausted()) return run.finish(Outcome::kLimit);
      nearest.offer(loop.nodes.size(), walk.node(), way_is_free(walk, run.goal()));
      loop.nodes.push_back(walk.node());
      run.go_to(place(walk.node()));
    }
    run.go_to(hit->at);
    run.count_loop();
    run.count_followed(loop.length());
    run.grant(1.5 * loop.length());
    // The hit itself may be the nearest point of all; its way is blocked.
    const bool leaves = nearest.way_free() && !is_nearer(hit->at, place(nearest.node()), run.goal_node());
    if (!leaves) return run.finish(Outcome::kUnreachable);
    loop.return_to(*nearest.index(), run);
    from = nearest.node();
  }
  return run.finish(Outcome::kReached);
}

Result run_bug1(const Problem& problem, const RunOptions& run) { return bug1(problem, run); }

}  // namespace kb::planners
