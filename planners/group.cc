#include "planners/group.h"

#include <algorithm>
#include <numeric>

#include "planners/movers.h"
#include "planners/space_time.h"

namespace kb::planners {
namespace {

class GroupPlan {
 public:
  GroupPlan(const GroupProblem& problem, const RunOptions& run, const GroupOptions& options)
      : problem_(problem), run_(run), options_(options), watch_(run), horizon_(options.horizon) {
    std::uint32_t longest = 0;
    for (std::size_t robot = 0; robot < problem.goals.size() && !watch_.stopped_now(); ++robot) {
      to_goals_.push_back(steps_to(*problem.grid, problem.goals[robot]));
      if (alone(robot) != kNoWay) longest = std::max(longest, alone(robot));
    }
    if (horizon_ == 0) horizon_ = longest + 4 * static_cast<std::uint32_t>(problem.grid->width() + problem.grid->height());
  }

  GroupResult go() {
    const std::size_t n = problem_.starts.size();
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    GroupResult best;
    for (std::uint32_t tried = 1; tried <= std::max(options_.orders, 1u); ++tried) {
      GroupResult result = plan_in(order);
      result.orders = tried;
      const auto planned = [](const GroupResult& r) { return std::count(r.robots.begin(), r.robots.end(), Outcome::kReached); };
      const Outcome outcome = result.outcome;
      if (tried == 1 || planned(result) > planned(best)) best = std::move(result);
      best.orders = tried;
      if (outcome == Outcome::kLimit && best.outcome == Outcome::kConflict) best.outcome = Outcome::kLimit;
      if (outcome != Outcome::kConflict) break;
      // The robots that found no plan go first.
      std::stable_partition(order.begin(), order.end(), [this](std::size_t i) { return failed_[i]; });
    }
    return best;
  }

 private:
  GroupResult plan_in(const std::vector<std::size_t>& order) {
    const std::size_t n = order.size();
    GroupResult result;
    result.robots.assign(n, Outcome::kLimit);
    result.walks.resize(n);
    failed_.assign(n, false);
    Movers reserved(*problem_.grid, horizon_ + 1);
    result.outcome = Outcome::kReached;
    for (const std::size_t robot : order) {
      if (watch_.stopped_now()) {
        result.outcome = Outcome::kLimit;
        break;
      }
      std::vector<Cell> walk = plan_one(robot, reserved);
      if (walk.empty()) {
        failed_[robot] = true;
        const Outcome why = why_not(robot);
        result.robots[robot] = why;
        const bool worse = why == Outcome::kUnreachable || (why == Outcome::kLimit && result.outcome != Outcome::kUnreachable);
        if (worse || result.outcome == Outcome::kReached) result.outcome = why;
        continue;
      }
      result.robots[robot] = Outcome::kReached;
      const auto arrival = static_cast<std::uint32_t>(walk.size() - 1);
      result.makespan = std::max(result.makespan, arrival);
      result.flowtime += arrival;
      std::vector<Cell> until_the_end = walk;
      until_the_end.resize(horizon_ + 1, walk.back());
      reserved.add(until_the_end);
      result.walks[robot] = std::move(walk);
    }
    return result;
  }

  // How many steps the robot would take to its goal if no other were there.
  [[nodiscard]] std::uint32_t alone(std::size_t robot) const { return to_goals_[robot][problem_.grid->index(problem_.starts[robot])]; }

  // Why no plan was found for the robot: the others are in its way, unless even without them it has no way, or not enough time.
  Outcome why_not(std::size_t robot) {
    if (watch_.stopped_now()) return Outcome::kLimit;
    return alone(robot) == kNoWay ? Outcome::kUnreachable : alone(robot) > horizon_ ? Outcome::kLimit : Outcome::kConflict;
  }

  std::vector<Cell> plan_one(std::size_t robot, const Movers& reserved) {
    TimedQuestion question;
    question.from = problem_.starts[robot];
    question.to = problem_.goals[robot];
    question.horizon = horizon_;
    for (std::uint32_t t = 0; t <= horizon_; ++t) {
      if (reserved.taken(question.to, t)) question.earliest_arrival = t + 1;
    }
    if (question.earliest_arrival > horizon_ || reserved.taken(question.from, 0)) return {};
    switch (options_.planner) {
      case GroupPlanner::kNeural: return plan_timed_field(*problem_.grid, reserved, question, to_goals_[robot]);
      case GroupPlanner::kGenetic: return evolve_one(robot, reserved, question);
      case GroupPlanner::kSpaceTime: break;
    }
    return search_space_time(*problem_.grid, reserved, question, to_goals_[robot]);
  }

  std::vector<Cell> evolve_one(std::size_t robot, const Movers& reserved, const TimedQuestion& question) {
    Problem problem;
    problem.grid = problem_.grid;
    problem.start = problem_.grid->centre(question.from);
    problem.goal = problem_.grid->centre(question.to);
    problem.movers = &reserved;
    GeneticOptions options = options_.genetic;
    options.horizon = horizon_;
    options.earliest_arrival = question.earliest_arrival;
    RunOptions run;
    run.seed = run_.seed * 1'000'003 + robot;
    run.cancel = run_.cancel;
    run.budget = watch_.left();
    const GeneticReport report = evolve(problem, run, options);
    if (report.result.outcome != Outcome::kReached) return {};
    std::vector<Cell> cells;
    for (const Point p : report.result.path) cells.push_back(problem_.grid->cell_at(p));
    return cells;
  }

  const GroupProblem& problem_;
  const RunOptions& run_;
  const GroupOptions& options_;
  Watch watch_;
  std::uint32_t horizon_;
  std::vector<std::vector<std::uint32_t>> to_goals_;   // of each robot: see `steps_to`; fewer if the time was up before all were computed
  std::vector<bool> failed_;
};

bool all_free(const Grid& grid, const std::vector<Cell>& cells) {
  return std::none_of(cells.begin(), cells.end(), [&](Cell cell) { return grid.blocked(cell); });
}

bool all_different(const Grid& grid, const std::vector<Cell>& cells) {
  std::vector<CellIndex> places;
  for (const Cell cell : cells) places.push_back(grid.index(cell));
  std::sort(places.begin(), places.end());
  return std::adjacent_find(places.begin(), places.end()) == places.end();
}

}  // namespace

GroupResult plan_group(const GroupProblem& problem, const RunOptions& run, const GroupOptions& options) {
  GroupResult result;
  if (problem.grid == nullptr || problem.grid->empty()) {
    result.fault = Fault::kEmptyMap;
  } else if (problem.starts.size() != problem.goals.size()) {
    result.fault = Fault::kBadParameter;
  } else if (!all_free(*problem.grid, problem.starts)) {
    result.fault = Fault::kStartBlocked;
  } else if (!all_different(*problem.grid, problem.starts)) {
    result.fault = Fault::kSharedStart;
  } else if (!all_free(*problem.grid, problem.goals) || !all_different(*problem.grid, problem.goals)) {
    result.fault = Fault::kGoalBlocked;
  } else {
    return GroupPlan(problem, run, options).go();
  }
  return result;
}

}  // namespace kb::planners
