#include "planners/fuzzy.h"

#include <algorithm>

#include "planners/methods.h"

namespace kb::planners {
namespace {

// Each step is remembered, in some hundred bytes.
constexpr std::uint64_t kMostFuzzySteps = 4'000'000;

// One robot that goes from cell to cell.
class FuzzyWalker {
 public:
  FuzzyWalker(const Grid& grid, Cell goal, FuzzyMemory memory) : grid_(grid), goal_(goal), memory_(memory), visits_(grid.size(), 0) {}

  // The next cell, or the same if there is none.
  Cell next(Cell at) {
    const std::uint8_t direction = memory_ == FuzzyMemory::kNone
                                       ? fuzzy_move(goal_.x - at.x, goal_.y - at.y, grid_.moves(at))
                                       : least_visited(at);
    return direction == kStandStill ? at : at + kDirections[direction];
  }
  // Counts a visit of the robot to a cell; true if it was there before.
  bool enter(Cell at) { return visits_[grid_.index(at)]++ > 0; }

 private:
  std::uint8_t least_visited(Cell at) const {
    const std::uint32_t row = fuzzy_row(goal_.x - at.x, goal_.y - at.y);
    std::uint8_t best = kStandStill;
    std::uint64_t least = ~std::uint64_t{0};
    for (int rank = 0; rank < 8; ++rank) {
      const int direction = (static_cast<int>(row % 8) + fuzzy_offset(rank, row < 8 ? 1 : -1)) % 8;
      if (!grid_.can_move(at, direction)) continue;
      const CellIndex to = grid_.index(at + kDirections[static_cast<std::size_t>(direction)]);
      const std::uint64_t cost = 8 * static_cast<std::uint64_t>(visits_[to]) + static_cast<std::uint64_t>(rank);
      if (cost >= least) continue;
      least = cost;
      best = static_cast<std::uint8_t>(direction);
    }
    return best;
  }
  const Grid& grid_;
  Cell goal_;
  FuzzyMemory memory_;
  std::vector<std::uint32_t> visits_;
};

}  // namespace

FuzzySteering steer(double b, std::uint8_t blocked) {
  struct Vote {
    double strength = 0.0;
    int direction = kStandStill;
  };
  std::array<Vote, 2> votes;   // the stronger first
  for (int g = 0; g < 8; ++g) {
    const double strength = fuzzy_membership(b, g);
    if (strength <= 0.0) continue;
    const bool past = wrap_angle(b - g * (kPi / 4.0)) >= 0.0;
    const Vote vote{strength, kFuzzyTable[static_cast<std::size_t>(g + (past ? 0 : 8))][blocked]};
    if (strength > votes[0].strength) {
      votes[1] = votes[0];
      votes[0] = vote;
    } else {
      votes[1] = vote;
    }
  }
  FuzzySteering out;
  out.stop = votes[0].direction == kStandStill;
  if (out.stop) return out;
  out.turn_rad = wrap_angle(votes[0].direction * (kPi / 4.0));
  if (votes[1].strength > 0.0) {
    const double between = wrap_angle((votes[1].direction - votes[0].direction) * (kPi / 4.0));
    if (std::abs(between) <= kPi / 4.0 + 1e-9) out.turn_rad = wrap_angle(out.turn_rad + votes[1].strength * between);
  }
  out.ahead = std::abs(out.turn_rad) < 2.0 * kPi / 180.0;
  return out;
}

Result plan_fuzzy(const Problem& problem, FuzzyMemory memory, const RunOptions& run) {
  const Grid& grid = *problem.grid;
  const Cell goal = problem.goal_cell();
  const std::uint64_t limit = std::min<std::uint64_t>(200 * grid.free_cells(), kMostFuzzySteps);
  FuzzyWalker walker(grid, goal, memory);
  Watch watch(run);
  std::vector<Cell> path = {problem.start_cell()};
  Outcome outcome = Outcome::kReached;
  Trap trap;
  Stop stop = Stop::kNone;
  while (path.back() != goal) {
    const bool again = walker.enter(path.back());
    if (again && memory == FuzzyMemory::kNone) {
      trap.kind = Trap::Kind::kCycle;
    } else if (path.size() > limit) {
      stop = Stop::kSteps;
    } else if (watch.stopped()) {
      stop = watch.why();
    } else {
      const Cell next = walker.next(path.back());
      if (next == path.back()) trap.kind = Trap::Kind::kRest;
      else path.push_back(next);
    }
    if (trap.kind != Trap::Kind::kNone || stop != Stop::kNone) {
      outcome = stop == Stop::kNone ? Outcome::kTrapped : Outcome::kLimit;
      break;
    }
  }
  Result result = reached(grid, path);
  result.outcome = outcome;
  trap.at = result.path.back();
  if (outcome == Outcome::kTrapped) result.trap = trap;
  result.statistics.steps = path.size() - 1;
  result.statistics.stop = stop;
  return result;
}

// ---- the methods
Result run_fuzzy(const Problem& problem, const RunOptions& run) { return plan_fuzzy(problem, FuzzyMemory::kNone, run); }
Result run_fuzzy_visits(const Problem& problem, const RunOptions& run) { return plan_fuzzy(problem, FuzzyMemory::kVisits, run); }
}  // namespace kb::planners
