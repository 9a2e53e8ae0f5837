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
#include <algorithm>
#include <cmath>
#include <utility>

#include "planners/check.h"
#include "planners/methods.h"
#include "planners/potential.h"
#include "planners/shortest.h"
#include "planners/trap.h"

namespace kb::planners {
namespace {

constexpr double kStepCells = 0.1;
constexpr std::uint64_t kMostStepsEach = 100000;   ///< for each clearance

enum class End : std::uint8_t { kReached, kClosed, kSteps, kStopped, kStuck };

Point left_of(Point v) { return {-v.y, v.x}; }

// A drive with bypasses at one clearance.
class TwoMaps {
 public:
  // Begins where `path` ends, and continues it.
  TwoMaps(const Problem& problem, const PotentialField& field, double clearance_m, Watch& watch, std::vector<Point>& path)
      : grid_(*problem.grid), field_(field), watch_(watch), goal_(problem.goal), clearance_m_(clearance_m),
        step_m_(kStepCells * grid_.cell_m()), tolerance_m_(problem.goal_tolerance_cells * grid_.cell_m()),
        trap_(grid_.cell_m()), at_(path.back()), path_(path) {}

  End run() {
    while (distance(at_, goal_) >= tolerance_m_) {
      if (++steps > kMostStepsEach) return End::kSteps;
      if (watch_.stopped()) return End::kStopped;
      if (const auto end = bypassing_ ? bypass() : route()) return *end;
    }
    return End::kReached;
  }

  std::uint64_t steps = 0, bypasses = 0;

 private:
  // Makes a step in the direction of `way`, a shorter one where there is little room. False if there is no room at all.
  bool advance(Point way) {
    const double size = norm(way);
    if (!(size > 0.0)) return false;
    Point next = at_ + (step_m_ / size) * way;
    for (int halvings = 0; check_path(grid_, {at_, next}, Touch::kApart); ++halvings) {
      if (halvings == 12) return false;
      next = at_ + 0.5 * (next - at_);
    }
    way_m_ += distance(at_, next);
    at_ = next;
    path_.push_back(at_);
    return true;
  }

  bool sees_goal() const {
    const double reach = 2.0 * clearance_m_ + 2.0 * grid_.cell_m();
    return distance(at_, goal_) <= reach && !check_path(grid_, {at_, goal_}, Touch::kApart);
  }

  std::optional<End> route() {
    const Nearest nearest = field_.nearest(at_);
    // The goal may lie nearer to a wall than the clearance, so the robot goes straight to a goal that it sees near by.
    if (sees_goal()) return advance(goal_ - at_) ? std::nullopt : std::optional(End::kStuck);
    if (nearest.distance_m < clearance_m_ && dot(field_.attracting_force(at_), nearest.at - at_) > 0.0) {
      begin_bypass(nearest);
      return std::nullopt;
    }
    const Point force = field_.force(at_);
    const double pull = norm(field_.attracting_force(at_)), time_s = static_cast<double>(steps) * step_m_;
    if (!advance(force) || trap_.add(at_, norm(force), pull, time_s)) begin_bypass(nearest);
    return std::nullopt;
  }

  void begin_bypass(const Nearest& nearest) {
    trap_.reset();
    bypassing_ = true;
    ++bypasses;
    entry_ = at_;
    entry_way_m_ = way_m_;
    entry_distance_m_ = distance(at_, goal_);
    reversed_ = anchored_ = false;
    const double p = nearest.distance_m;
    isoline_m_ = std::clamp(std::isfinite(p) ? p : clearance_m_, 0.2 * grid_.cell_m(), clearance_m_);
    // n points to higher repulsion, that is, to the obstacle; `side_` is the side to which the attraction leans.
    const Point n = nearest.at - at_;
    side_ = dot(left_of(n), field_.attracting_force(at_)) >= 0.0 ? 1.0 : -1.0;
  }

  std::optional<End> bypass() {
    if (sees_goal()) {
      bypassing_ = false;
      return std::nullopt;
    }
    const Nearest nearest = field_.nearest(at_);
    if (!std::isfinite(nearest.distance_m)) {
      bypassing_ = false;
      return std::nullopt;
    }
    const Point n = (1.0 / nearest.distance_m) * (nearest.at - at_);
    const bool nearer = distance(at_, goal_) < entry_distance_m_ - 0.5 * grid_.cell_m();
    if (nearer && dot(field_.attracting_force(at_), n) < 0.0) {
      bypassing_ = false;
      return std::nullopt;
    }
    // The robot drives along the isoline; a second term only corrects its drift from it, to first order.
    const double drift = std::clamp((isoline_m_ - nearest.distance_m) / (0.25 * grid_.cell_m()), -1.0, 1.0);
    if (!anchored_ && std::abs(drift) < 0.2) {   // on the isoline now: the round begins here
      anchored_ = true;
      entry_ = at_;
      entry_way_m_ = way_m_;
    }
    if (anchored_ && way_m_ - entry_way_m_ > 2.0 * grid_.cell_m() && distance(at_, entry_) < 0.25 * grid_.cell_m()) {
      if (reversed_) return End::kClosed;
      reversed_ = true;
      side_ = -side_;
      entry_way_m_ = way_m_;
    }
    if (!advance(side_ * left_of(n) - drift * n)) return End::kStuck;
    return std::nullopt;
  }

  const Grid& grid_;
  const PotentialField& field_;
  Watch& watch_;
  Point goal_;
  double clearance_m_, step_m_, tolerance_m_;
  TrapDetector trap_;
  Point at_, entry_;
  std::vector<Point>& path_;
  bool bypassing_ = false, reversed_ = false, anchored_ = false;
  double side_ = 1.0, isoline_m_ = 0.0, entry_distance_m_ = 0.0, way_m_ = 0.0, entry_way_m_ = 0.0;
};

}  // namespace

Result run_two_maps(const Problem& problem, const RunOptions& run) {
  if (auto refused = refuse_start_on_rim(problem)) return *std::move(refused);
  const Grid& grid = *problem.grid;
  const PotentialParameters parameters;
  const GridClearance clearance(grid, parameters.zone_cells * grid.cell_m());
  const PotentialField field(clearance, problem.goal, grid.cell_m(), parameters);
  Watch watch(run);
  Result result = ended(Outcome::kLimit);
  result.path.push_back(problem.start);
  End end = End::kSteps;
  double bypasses = 0.0, used = 0.0, drives = 0.0;
  for (const double cells : {1.0, 0.5, 0.3}) {
    TwoMaps attempt(problem, field, cells * grid.cell_m(), watch, result.path);
    end = attempt.run();
    result.statistics.steps += attempt.steps;
    bypasses += static_cast<double>(attempt.bypasses);
    used = cells;
    ++drives;
    if (end == End::kReached || end == End::kStopped) break;
  }
  if (end == End::kReached) result.outcome = Outcome::kReached;
  if (end == End::kSteps) result.statistics.stop = Stop::kSteps;
  if (end == End::kStopped) result.statistics.stop = watch.why();
  if (end == End::kStuck) result.statistics.stop = Stop::kRoom;
  if (end == End::kClosed) {
    // A closed isoline proves only that there is no way at this clearance; the map says whether there is one at all.
    if (is_connected(grid, problem.start_cell(), problem.goal_cell())) result.statistics.stop = Stop::kIsolines;
    else result.outcome = Outcome::kUnreachable;
  }
  result.length_m = length(result.path);
  result.statistics.more.emplace_back("clearance cells", used);
  result.statistics.more.emplace_back("drives", drives);
  result.statistics.more.emplace_back("bypasses", bypasses);
  result.statistics.more.emplace_back("closed isoline", end == End::kClosed ? 1.0 : 0.0);
  result.statistics.more.emplace_back("no room", end == End::kStuck ? 1.0 : 0.0);
  return result;
}

}  // namespace kb::planners
