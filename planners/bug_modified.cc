#include "planners/bug.h"
#include "planners/bug_run.h"
#include "planners/methods.h"

namespace kb::planners {

// note [the sign rule]
// Filimonov and Filimonov: from P the robot may leave for the goal G if the segment PG enters the passed path, wherever it
// meets that path, from its left side; for the obstacle is on the left, so the robot can run into its own path from the
// right only. The passed path consists of straight pieces, which all point at G and so are not crossed, and of pieces of
// walls. To enter a piece of wall from the right, with the obstacle on the left, is to go from a free cell into a blocked
// one. So the rule says: leave, unless the line to the goal runs into a wall that has been followed already. In this form
// the rule does not depend on the hand, holds when hands change, and costs a walk along the line instead of a look at the
// whole path. tests/unit/planners/sign_rule_test.cc compares both forms.
bool runs_into_followed_wall(const Grid& grid, const FollowedWalls& followed, Node from, Cell goal) {
  LineWalk line(from, goal);
  while (const auto crossing = line.next()) {
    if (grid.blocked(crossing->before) || !is_hit(grid, *crossing)) continue;
    // At a corner two edges of the wall meet that the robot could have followed; on a side of a cell there is only one.
    const auto is_followed = [&](Hand hand) {
      return followed.contains(edge_after_hit(grid, *crossing, hand).at(1), crossing->at);
    };
    if (is_followed(Hand::kLeft) || (crossing->through_corner() && is_followed(Hand::kRight))) return true;
  }
  return false;
}

namespace {

class ModifiedBug {
 public:
  ModifiedBug(const Problem& problem, const RunOptions& settings, const BugOptions& options)
      : run_(problem, settings, options), options_(options), followed_(*problem.grid),
        from_(centre_node(problem.start_cell())) {
    if (options.leave == LeaveRule::kLiteral) run_.grant(BugRun::kNoBound);
  }

  Result go() {
    while (const auto hit = run_.go_straight(from_)) {
      nearest_hit_ = hit->at;  // each hit is nearer than all before, except in the literal mode, which does not compare them
      const Outcome outcome = follow(*hit);
      if (outcome != Outcome::kReached) return run_.finish(outcome);
    }
    return run_.finish(Outcome::kReached);
  }

 private:
  // Follows the wall of a hit. kReached: the robot leaves it, from `from_`.
  Outcome follow(const LineCrossing& hit) {
    const Hand hand = run_.take_hit(hit);
    const WallEdge first = edge_after_hit(run_.grid(), hit, hand);
    WallWalk walk(run_.grid(), hit.at, first, hand);
    PassedLoop loop{hit.at, {}};
    NearestNode nearest(run_.goal_node());
    while (walk.next()) {
      if (run_.exhausted()) return Outcome::kLimit;
      remember(walk, loop);
      const bool way_free = way_is_free(walk, run_.goal());
      nearest.offer(loop.nodes.size(), walk.node(), way_free);
      loop.nodes.push_back(walk.node());
      run_.go_to(place(walk.node()));
      if (way_free && may_leave(walk.node())) {
        from_ = walk.node();
        run_.count_followed(0.5 * static_cast<double>(loop.nodes.size()));
        if (options_.leave != LeaveRule::kLiteral) {
          run_.grant(1.5 * static_cast<double>(wall_length(run_.grid(), first, hand)));
        }
        return Outcome::kReached;
      }
    }
    run_.go_to(hit.at);
    followed_.add(walk.edge(), place(walk.node()), hit.at);
    return after_closed_loop(hit, loop, nearest);
  }

  Outcome after_closed_loop(const LineCrossing& hit, const PassedLoop& loop, const NearestNode& nearest) {
    run_.count_loop();
    run_.count_followed(loop.length());
    run_.grant(1.5 * loop.length());
    // As in Bug1: see there.
    const bool leaves = nearest.way_free() && !is_nearer(hit.at, place(nearest.node()), run_.goal_node());
    if (!leaves) return Outcome::kUnreachable;
    if (options_.leave == LeaveRule::kLiteral) return Outcome::kTrapped;
    loop.return_to(*nearest.index(), run_);
    from_ = nearest.node();
    return Outcome::kReached;
  }

  [[nodiscard]] bool may_leave(Node node) const {
    if (options_.leave != LeaveRule::kLiteral && !is_nearer(place(node), nearest_hit_, run_.goal_node())) return false;
    return options_.leave == LeaveRule::kNearer || !runs_into_followed_wall(run_.grid(), followed_, node, run_.goal());
  }

  void remember(const WallWalk& walk, const PassedLoop& loop) {
    const bool whole = walk.node() == walk.edge().at(2) && (loop.nodes.size() >= 2 || loop.hit == place(walk.edge().from));
    if (whole) {
      followed_.add_whole(walk.edge());
    } else {
      followed_.add(walk.edge(), loop.nodes.empty() ? loop.hit : place(loop.nodes.back()), place(walk.node()));
    }
  }

  BugRun run_;
  const BugOptions& options_;
  FollowedWalls followed_;
  Place nearest_hit_;
  Node from_;
};

}  // namespace

Result modified_bug(const Problem& problem, const RunOptions& run, const BugOptions& options) {
  return ModifiedBug(problem, run, options).go();
}

Result run_modified_bug(const Problem& problem, const RunOptions& run) {
  return modified_bug(problem, run, {.hand = HandRule::kSmallerTurn});
}

Result run_nearer_bug(const Problem& problem, const RunOptions& run) {
  return modified_bug(problem, run, {.leave = LeaveRule::kNearer, .hand = HandRule::kSmallerTurn});
}

Result run_literal_bug(const Problem& problem, const RunOptions& run) {
  return modified_bug(problem, run, {.leave = LeaveRule::kLiteral});
}

}  // namespace kb::planners
