// Fairway and bug: what the map does not show is gone round.
#include "planners/fairway_bug.h"

#include <gtest/gtest.h>

#include "planners/check.h"
#include "planners/dice.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

using testing::problem_between;

double more(const Result& result, std::size_t i) { return result.statistics.more.at(i).second; }

TEST(FairwayBug, follows_the_fairway_where_nothing_stands_on_it) {
  const auto& arena = testing::benchmarks()[0];
  const Scenario& row = arena.scenarios[100];
  const Result result = fairway_bug(problem_between(arena.grid, row.start, row.goal), arena.grid, {});
  EXPECT_EQ(result.outcome, Outcome::kReached);
  EXPECT_EQ(more(result, 0), 0.0);
}

TEST(FairwayBug, goes_round_a_box_and_takes_up_the_fairway_behind_it) {
  const Grid map(30, 11);
  Grid actual = map;
  for (std::int32_t y = 3; y <= 6; ++y) {
    for (std::int32_t x = 14; x <= 16; ++x) actual.set_blocked({x, y}, true);
  }
  const Problem problem = problem_between(map, {2, 5}, {27, 5});
  const Result result = fairway_bug(problem, actual, {});
  ASSERT_EQ(result.outcome, Outcome::kReached);
  EXPECT_FALSE(check_path(actual, result.path, Touch::kContact, problem.start, problem.goal, 1e-9));
  EXPECT_EQ(more(result, 0), 1.0);
  EXPECT_EQ(more(result, 1), 0.0);
  EXPECT_LT(result.length_m, 25.0 + 4.0);
}

// A door is shut that the map shows open: the robot finds out, and takes another.
TEST(FairwayBug, computes_the_fairway_anew_where_there_is_no_way_round) {
  const std::vector<std::string_view> rows = {"..........",
                                              ".########.",
                                              ".#......#.",
                                              ".#......#.",
                                              "...G....#S",
                                              ".#......#.",
                                              ".########.",
                                              ".........."};
  Grid actual = testing::draw(rows), map = actual;
  map.set_blocked({8, 3}, false);   // there was a door here
  const Problem problem = problem_between(map, testing::find(rows, 'S'), testing::find(rows, 'G'));
  const Result result = fairway_bug(problem, actual, {});
  ASSERT_EQ(result.outcome, Outcome::kReached);
  EXPECT_FALSE(check_path(actual, result.path, Touch::kContact, problem.start, problem.goal, 1e-9));
  actual.set_blocked({1, 3}, true);
  EXPECT_EQ(fairway_bug(problem, actual, {}).outcome, Outcome::kUnreachable);
}

TEST(FairwayBug, answers_right_whatever_stands_about) {
  int blocked = 0, open = 0;
  double loops = 0.0;
  for (std::uint64_t seed = 1; seed <= 1500; ++seed) {
    const Grid map = testing::random_grid(20, 15, 0.15, seed);
    Grid actual = map;
    Dice dice(seed);
    for (int i = 0; i < 60; ++i) {
      actual.set_blocked({static_cast<std::int32_t>(dice.below(20)), static_cast<std::int32_t>(dice.below(15))}, true);
    }
    const Cell start{static_cast<std::int32_t>(dice.below(20)), static_cast<std::int32_t>(dice.below(15))};
    const Cell goal{static_cast<std::int32_t>(dice.below(20)), static_cast<std::int32_t>(dice.below(15))};
    if (actual.blocked(start) || actual.blocked(goal)) continue;
    const auto labels = label_components(actual);
    const bool way = labels[actual.index(start)] == labels[actual.index(goal)];
    ++(way ? open : blocked);
    const Problem problem = problem_between(map, start, goal);
    const Result result = fairway_bug(problem, actual, {});
    ASSERT_EQ(result.outcome, way ? Outcome::kReached : Outcome::kUnreachable) << "seed " << seed;
    const auto objection = check_path(actual, result.path, Touch::kContact);
    ASSERT_FALSE(objection) << "seed " << seed << ": " << objection->what;
    loops += more(result, 1);
  }
  EXPECT_GT(open, 300);
  EXPECT_GT(blocked, 100);
  EXPECT_GT(loops, 50.0);
}

TEST(FairwayBug, refuses_a_world_of_another_size_or_a_goal_that_is_taken) {
  const Grid map(8, 8);
  const Problem problem = problem_between(map, {0, 0}, {7, 7});
  EXPECT_EQ(fairway_bug(problem, Grid(8, 9), {}).fault, Fault::kBadParameter);
  Grid actual = map;
  actual.set_blocked({7, 7}, true);
  EXPECT_EQ(fairway_bug(problem, actual, {}).fault, Fault::kGoalBlocked);
}

}  // namespace
}  // namespace kb::planners
