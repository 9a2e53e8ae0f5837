#include <algorithm>
#include <utility>

#include "planners/bug.h"
#include "planners/bug_run.h"
#include "planners/methods.h"

namespace kb::planners {
namespace {

// The line from start to goal, as its crossings with the lattice. Walls lie on the lattice, so a wall meets the line only in
// crossings, and of two crossings the later one is nearer to the goal.
class MainLine {
 public:
  MainLine(Cell start, Cell goal) {
    LineWalk walk(centre_node(start), goal);
    while (const auto crossing = walk.next()) crossings_.push_back(*crossing);
    for (std::size_t i = 0; i < crossings_.size(); ++i) places_.emplace_back(key(crossings_[i].where), i);
    std::sort(places_.begin(), places_.end());
  }
  [[nodiscard]] const LineCrossing& operator[](std::size_t i) const { return crossings_[i]; }
  /// The first hit at or after crossing i; the number of crossings if there is none.
  [[nodiscard]] std::size_t hit_from(const Grid& grid, std::size_t i) const {
    while (i < crossings_.size() && !is_hit(grid, crossings_[i])) ++i;
    return i;
  }
  [[nodiscard]] std::size_t size() const { return crossings_.size(); }
  /// The crossing at a corner or on a side of a cell; `size()` if the line does not meet it.
  [[nodiscard]] std::size_t crossing_at(Node where) const {
    const auto found = std::lower_bound(places_.begin(), places_.end(), std::pair(key(where), std::size_t{0}));
    return found != places_.end() && found->first == key(where) ? found->second : size();
  }

 private:
  static std::pair<std::int32_t, std::int32_t> key(Node where) { return {where.x, where.y}; }
  std::vector<LineCrossing> crossings_;
  std::vector<std::pair<std::pair<std::int32_t, std::int32_t>, std::size_t>> places_;
};

// The sum of n p / 2 over the walls that the line meets, n times each, of perimeter p. Half of the n crossings are entries,
// and each entry is a hit. This looks at the whole map, which the robot does not know: it serves only to check the run.
double granted_walls(const Grid& grid, const MainLine& line, Hand hand) {
  double sum = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (grid.blocked(line[i].before) || !is_hit(grid, line[i])) continue;
    const WallEdge edge = edge_after_hit(grid, line[i], hand);
    sum += static_cast<double>(wall_length(grid, edge, hand));
  }
  return sum;
}

class Bug2 {
 public:
  Bug2(const Problem& problem, const RunOptions& settings, const BugOptions& options)
      : run_(problem, settings, options), line_(problem.start_cell(), problem.goal_cell()) {}

  Result go() {
    for (std::size_t at = line_.hit_from(run_.grid(), 0); at < line_.size(); at = line_.hit_from(run_.grid(), at)) {
      const LineCrossing& hit = line_[at];
      run_.go_to(hit.at);
      const Hand hand = run_.take_hit(hit);
      const auto left_at = follow(at, hand);
      if (!left_at) {
        run_.grant(granted_walls(run_.grid(), line_, hand));
        return run_.finish(limit_ ? Outcome::kLimit : Outcome::kUnreachable);
      }
      at = *left_at + 1;
    }
    run_.go_to(place(run_.goal_node()));
    run_.grant(granted_walls(run_.grid(), line_, Hand::kLeft));
    return run_.finish(Outcome::kReached);
  }

 private:
  // Follows the wall of a hit to the crossing where the robot leaves it. Nothing if it is back at the hit, or out of steps.
  std::optional<std::size_t> follow(std::size_t hit, Hand hand) {
    WallWalk walk(run_.grid(), line_[hit].at, edge_after_hit(run_.grid(), line_[hit], hand), hand);
    double halves = 0.0;
    while (walk.next()) {
      if (run_.exhausted()) {
        limit_ = true;
        return std::nullopt;
      }
      if (walk.entered_edge()) {
        // The line may cross the side of a cell anywhere, but the crossing is found by the middle of that side.
        const std::size_t i = line_.crossing_at(walk.edge().at(1));
        if (i > hit && i < line_.size() && line_[i].after == walk.free_cell()) return leave(i, halves);
      }
      run_.go_to(place(walk.node()));
      halves += 1.0;
      const std::size_t i = line_.crossing_at(walk.node());
      // Where obstacles are joined at the hit, the robot can come back to it on the other side of the joint: hence >=.
      const bool corner = i >= hit && i < line_.size() && line_[i].through_corner();
      if (corner && walk.can_enter(line_[i].after)) return leave(i, halves);
    }
    run_.go_to(line_[hit].at);
    run_.count_followed(0.5 * halves);
    run_.count_loop();
    return std::nullopt;
  }

  std::size_t leave(std::size_t i, double halves) {
    run_.count_followed(0.5 * halves);
    run_.go_to(line_[i].at);
    return i;
  }

  BugRun run_;
  MainLine line_;
  bool limit_ = false;
};

}  // namespace

Result bug2(const Problem& problem, const RunOptions& run, const BugOptions& options) { return Bug2(problem, run, options).go(); }

Result run_bug2(const Problem& problem, const RunOptions& run) { return bug2(problem, run); }

}  // namespace kb::planners
