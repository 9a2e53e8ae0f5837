#include <gtest/gtest.h>

#include <algorithm>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

TEST(TwoMaps, goes_round_a_wall_that_traps_the_field_alone) {
  Grid grid(30, 21);
  for (std::int32_t y = 3; y < 18; ++y) grid.set_blocked({15, y}, true);
  const Problem problem = testing::problem_between(grid, {4, 10}, {26, 10});
  EXPECT_EQ(plan(*find_method("potential"), problem).outcome, Outcome::kTrapped);
  const Result result = plan(*find_method("two-maps"), problem);
  EXPECT_EQ(result.outcome, Outcome::kReached) << name(result.outcome) << result.refused;
  EXPECT_LT(result.length_m, 60.0);
}

// A robot that sees only what is near cannot begin anew without driving there: its path is one, from drive to drive.
TEST(TwoMaps, tells_all_that_was_driven) {
  const auto& maze = testing::benchmarks()[2];
  std::size_t many = 0;
  for (std::size_t i = 0; i < maze.scenarios.size(); i += 20) {
    const Scenario& row = maze.scenarios[i];
    const Problem problem = testing::problem_between(maze.grid, row.start, row.goal);
    const Result result = plan(*find_method("two-maps"), problem);
    ASSERT_EQ(result.statistics.more[1].first, "drives");
    many += result.statistics.more[1].second > 1.0 ? 1 : 0;
    EXPECT_EQ(result.path.front(), problem.start);
    double longest = 0.0;
    for (std::size_t k = 1; k < result.path.size(); ++k) longest = std::max(longest, distance(result.path[k - 1], result.path[k]));
    EXPECT_LE(longest, 0.1 + 1e-9) << "row " << i;   // a step of the method
    EXPECT_DOUBLE_EQ(result.length_m, length(result.path));
  }
  EXPECT_GT(many, 5u);
}

TEST(TwoMaps, says_that_a_goal_that_is_walled_in_is_unreachable) {
  const std::vector<std::string_view> rows = {"............", "............", "...#####....", "...#...#....",
                                              "...#.G.#..S.", "...#...#....", "...#####....", "............",
                                              "............"};
  const Grid grid = testing::draw(rows);
  const Result result =
      plan(*find_method("two-maps"), testing::problem_between(grid, testing::find(rows, 'S'), testing::find(rows, 'G')));
  EXPECT_EQ(result.outcome, Outcome::kUnreachable) << name(result.outcome);
}

}  // namespace
}  // namespace kb::planners
