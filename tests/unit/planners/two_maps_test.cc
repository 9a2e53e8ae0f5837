#include "planners/two_maps.h"

#include <gtest/gtest.h>

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

TEST(TwoMaps, says_unreachable_only_where_the_map_does) {
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
