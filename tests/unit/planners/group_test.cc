// Groups planned robot by robot: no conflicts by a map of who is where, whatever plans.
#include "planners/group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "planners/dice.h"
#include "planners/movers.h"
#include "planners/space_time.h"
#include "tests/unit/planners/meetings.h"
#include "tests/unit/planners/patrols.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

constexpr std::array kPlanners = {GroupPlanner::kGenetic, GroupPlanner::kNeural, GroupPlanner::kSpaceTime};

std::vector<Cell> different_cells(const Grid& grid, const std::vector<std::uint32_t>& labels, std::size_t count, Dice& dice) {
  std::vector<Cell> cells;
  while (cells.size() < count) {
    const Cell cell = grid.cell(dice.below(grid.size()));
    if (grid.free(cell) && labels[grid.index(cell)] == 1 && std::find(cells.begin(), cells.end(), cell) == cells.end()) {
      cells.push_back(cell);
    }
  }
  return cells;
}

TEST(Group, has_no_conflicts_whatever_plans) {
  const auto& arena = testing::benchmarks()[0];
  const auto labels = label_components(arena.grid);
  for (const GroupPlanner planner : kPlanners) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      Dice dice(seed);
      GroupProblem problem;
      problem.grid = &arena.grid;
      problem.starts = different_cells(arena.grid, labels, 12, dice);
      problem.goals = different_cells(arena.grid, labels, 12, dice);
      GroupOptions options;
      options.planner = planner;
      const GroupResult result = plan_group(problem, {}, options);
      ASSERT_EQ(result.outcome, Outcome::kReached) << "planner " << static_cast<int>(planner) << " seed " << seed;
      EXPECT_EQ(testing::count_conflicts(arena.grid, result.walks), 0u);
      for (std::size_t i = 0; i < 12; ++i) {
        EXPECT_FALSE(check_walk(arena.grid, nullptr, result.walks[i]));
        EXPECT_EQ(result.walks[i].front(), problem.starts[i]);
        EXPECT_EQ(result.walks[i].back(), problem.goals[i]);
      }
    }
  }
}

TEST(Group, is_planned_again_in_another_order_where_the_first_fails) {
  // The first robot parks at the end of the corridor's mouth, before the second has gone in.
  const std::vector<std::string_view> rows = {"#.#####",
                                              "......."};
  const Grid grid = testing::draw(rows);
  GroupProblem problem;
  problem.grid = &grid;
  problem.starts = {{1, 0}, {0, 0}};
  problem.goals = {{3, 0}, {6, 0}};
  GroupOptions options;
  for (const GroupPlanner planner : {GroupPlanner::kNeural, GroupPlanner::kSpaceTime}) {
    options.planner = planner;
    const GroupResult result = plan_group(problem, {}, options);
    ASSERT_EQ(result.outcome, Outcome::kReached);
    EXPECT_EQ(result.orders, 2u);
    EXPECT_EQ(testing::count_conflicts(grid, result.walks), 0u);
  }
}

TEST(Group, says_so_when_no_order_helps) {
  const Grid grid(5, 1);
  GroupProblem problem;
  problem.grid = &grid;
  problem.starts = {{0, 0}, {4, 0}};
  problem.goals = {{4, 0}, {0, 0}};
  for (const GroupPlanner planner : kPlanners) {
    GroupOptions options;
    options.planner = planner;
    const GroupResult result = plan_group(problem, {}, options);
    EXPECT_EQ(result.outcome, Outcome::kConflict);
    EXPECT_EQ(std::count(result.robots.begin(), result.robots.end(), Outcome::kReached), 1);
  }
}

TEST(Group, does_not_blame_the_others_for_a_goal_that_a_robot_alone_cannot_come_to) {
  const std::vector<std::string_view> rows = {"..#..",
                                              "..#.."};
  const Grid grid = testing::draw(rows);
  GroupProblem problem;
  problem.grid = &grid;
  problem.starts = {{0, 0}, {0, 1}};
  problem.goals = {{4, 0}, {1, 1}};
  for (const GroupPlanner planner : kPlanners) {
    GroupOptions options;
    options.planner = planner;
    const GroupResult result = plan_group(problem, {}, options);
    EXPECT_EQ(result.outcome, Outcome::kUnreachable);
    EXPECT_EQ(result.robots, (std::vector<Outcome>{Outcome::kUnreachable, Outcome::kReached}));
  }
}

TEST(Group, does_not_blame_the_others_for_a_way_that_is_longer_than_the_horizon) {
  const Grid grid(9, 2);
  GroupProblem problem;
  problem.grid = &grid;
  problem.starts = {{0, 0}, {0, 1}};
  problem.goals = {{8, 0}, {1, 1}};
  for (const GroupPlanner planner : kPlanners) {
    GroupOptions options;
    options.planner = planner;
    options.horizon = 7;
    const GroupResult result = plan_group(problem, {}, options);
    EXPECT_EQ(result.outcome, Outcome::kLimit);
    EXPECT_EQ(result.robots, (std::vector<Outcome>{Outcome::kLimit, Outcome::kReached}));
    options.horizon = 8;
    EXPECT_EQ(plan_group(problem, {}, options).outcome, Outcome::kReached);
  }
}

// A way to and fro through all of a maze is longer than four times its sides.
TEST(Group, has_time_for_the_longest_way_of_a_maze) {
  Grid grid(21, 21);
  for (std::int32_t y = 1; y < 21; y += 2) {
    for (std::int32_t x = 0; x < 21; ++x) grid.set_blocked({x, y}, x != (y % 4 == 1 ? 20 : 0));
  }
  GroupProblem problem;
  problem.grid = &grid;
  problem.starts = {{0, 0}, {1, 0}};
  problem.goals = {{19, 20}, {20, 20}};
  ASSERT_GT(steps_to(grid, {19, 20})[grid.index({0, 0})], 4u * (21 + 21));
  for (const GroupPlanner planner : kPlanners) {
    GroupOptions options;
    options.planner = planner;
    const GroupResult result = plan_group(problem, {}, options);
    EXPECT_EQ(result.outcome, Outcome::kReached) << "planner " << static_cast<int>(planner) << ": " << name(result.outcome);
  }
}

// An evolution that ends by the clock alone: neither the fitness nor the number of generations ends it.
TEST(Group, that_is_stopped_while_a_robot_evolves_says_so) {
  const Grid grid(12, 12);
  GroupProblem problem;
  problem.grid = &grid;
  problem.starts = {{0, 0}, {11, 0}};
  problem.goals = {{11, 11}, {0, 11}};
  GroupOptions options;
  options.planner = GroupPlanner::kGenetic;
  options.genetic.target = 2.0;
  options.genetic.stagnation = options.genetic.max_generations = std::numeric_limits<std::uint32_t>::max();
  RunOptions run;
  run.budget = std::chrono::milliseconds(50);
  const GroupResult result = plan_group(problem, run, options);
  EXPECT_EQ(result.outcome, Outcome::kLimit) << name(result.outcome);   // not kConflict: nobody was in its way
  EXPECT_EQ(result.robots, std::vector<Outcome>(2, Outcome::kLimit));
  EXPECT_EQ(result.orders, 1u);
}

TEST(Group, refuses_two_robots_in_one_cell) {
  const Grid grid(5, 5);
  GroupProblem problem;
  problem.grid = &grid;
  problem.starts = {{0, 0}, {0, 0}};
  problem.goals = {{4, 0}, {1, 0}};
  EXPECT_EQ(plan_group(problem, {}).fault, Fault::kSharedStart);
  problem.starts = {{0, 0}, {1, 1}};
  problem.goals = {{3, 0}, {3, 0}};
  EXPECT_EQ(plan_group(problem, {}).fault, Fault::kGoalBlocked);
}

TEST(CountConflicts, sees_meetings_exchanges_and_crossings) {
  const Grid grid(3, 3);
  EXPECT_EQ(testing::count_conflicts(grid, {{{0, 0}, {1, 0}}, {{2, 0}, {1, 0}}}), 1u);
  EXPECT_EQ(testing::count_conflicts(grid, {{{0, 0}, {1, 0}}, {{1, 0}, {0, 0}}}), 2u);   // seen from both
  EXPECT_EQ(testing::count_conflicts(grid, {{{0, 0}, {1, 1}}, {{1, 0}, {0, 1}}}), 2u);
  EXPECT_EQ(testing::count_conflicts(grid, {{{0, 0}, {1, 0}}, {{1, 0}, {2, 0}}}), 0u);   // following is none
  EXPECT_EQ(testing::count_conflicts(grid, {{{0, 0}}, {{2, 0}, {1, 0}, {0, 0}}}), 1u);   // robots stay at their goals
}

// The length of the shortest walk of at most `horizon` steps with each wait counted as 1, by the plainest search: the least cost of being in
// each cell after each step. Infinite if there is none.
double least_cost(const Grid& grid, const Movers& movers, const TimedQuestion& question, std::uint32_t horizon) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  std::vector<double> now(grid.size(), kNever);
  now[grid.index(question.from)] = 0.0;
  double least = kNever;
  for (std::uint32_t t = 0;; ++t) {
    if (t >= question.earliest_arrival) least = std::min(least, now[grid.index(question.to)]);
    if (t == horizon) return least;
    std::vector<double> next(grid.size(), kNever);
    for (CellIndex at = 0; at < grid.size(); ++at) {
      if (now[at] == kNever) continue;
      const Cell here = grid.cell(at);
      const auto come = [&](Cell there, double cost) {
        if (!movers.taken(there, t + 1)) next[grid.index(there)] = std::min(next[grid.index(there)], now[at] + cost);
      };
      come(here, 1.0);
      for (std::size_t k = 0; k < 8; ++k) {
        const Cell there = here + kDirections[k];
        if (grid.can_move(here, static_cast<int>(k)) && !movers.swaps(here, there, t)) come(there, kMoveLengths[k]);
      }
    }
    now = std::move(next);
  }
}

double cost_of(const std::vector<Cell>& walk) {
  double cost = 0.0;
  for (std::size_t i = 1; i < walk.size(); ++i) {
    const int k = testing::direction_between(walk[i - 1], walk[i]);
    cost += k < 0 ? 1.0 : kMoveLengths[static_cast<std::size_t>(k)];
  }
  return cost;
}

// With time to spare, with just enough, and with one step too few.
TEST(TimedField, makes_the_shortest_walk_that_its_horizon_allows) {
  int longer_than_alone = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const Grid grid = testing::random_grid(16, 12, 0.15, seed);
    const Cell from{0, 0}, to{15, 11};
    if (grid.blocked(from) || grid.blocked(to)) continue;
    const auto to_goal = steps_to(grid, to);
    if (to_goal[grid.index(from)] == kNoWay) continue;
    const Movers movers = testing::make_patrols(grid, 24, 24, from, seed);
    TimedQuestion question{.from = from, .to = to, .earliest_arrival = seed % 3 == 0 ? 20u : 0u, .horizon = 200};
    const auto earliest = search_space_time(grid, movers, question, to_goal);
    ASSERT_FALSE(earliest.empty()) << "seed " << seed;
    const auto arrival = static_cast<std::uint32_t>(earliest.size() - 1);
    const std::uint32_t alone = std::max(to_goal[grid.index(from)], question.earliest_arrival);
    longer_than_alone += arrival > alone ? 1 : 0;
    for (const std::uint32_t horizon : {arrival, alone + 8}) {
      if (horizon < arrival) continue;
      question.horizon = horizon;
      const auto walk = plan_timed_field(grid, movers, question, to_goal);
      ASSERT_FALSE(walk.empty()) << "seed " << seed;
      EXPECT_FALSE(check_walk(grid, &movers, walk)) << "seed " << seed;
      EXPECT_EQ(walk.back(), to);
      EXPECT_LE(walk.size(), horizon + 1);
      EXPECT_GE(walk.size(), earliest.size());
      EXPECT_NEAR(cost_of(walk), least_cost(grid, movers, question, horizon), 1e-4) << "seed " << seed << " horizon " << horizon;
    }
    question.horizon = arrival - 1;
    EXPECT_TRUE(plan_timed_field(grid, movers, question, to_goal).empty()) << "seed " << seed;
  }
  EXPECT_GT(longer_than_alone, 5);
}

}  // namespace
}  // namespace kb::planners
