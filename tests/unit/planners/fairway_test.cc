#include "planners/fairway.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "planners/method.h"
#include "planners/shortest.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

TEST(Basin, leads_to_the_goal_from_every_cell_and_holds_every_cell_that_does) {
  const auto& arena = testing::benchmarks()[0];
  const Cell goal = arena.scenarios[100].goal;
  const Basin basin = find_basin(arena.grid, goal, cell_potential(arena.grid, goal));
  std::size_t inside = 0;
  for (CellIndex at = 0; at < arena.grid.size(); ++at) {
    if (arena.grid.all_moves()[at] == 0) continue;
    CellIndex end = at;
    for (std::size_t steps = 0; basin.pointer[end] != Basin::kNoPointer && steps < arena.grid.size(); ++steps) {
      end = static_cast<CellIndex>(static_cast<std::int32_t>(end) + arena.grid.steps()[basin.pointer[end]]);
    }
    if (basin.has(at)) {
      EXPECT_EQ(end, arena.grid.index(goal));
      ++inside;
    } else {
      EXPECT_NE(end, arena.grid.index(goal));
    }
  }
  EXPECT_EQ(inside, basin.cells);
  EXPECT_GT(inside, 100u);
}

TEST(Fairway, is_found_wherever_there_is_a_way_and_only_there) {
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const Grid grid = testing::random_grid(20, 20, 0.35, seed);
    const Cell from{static_cast<std::int32_t>(seed % 20), 3}, to{16, static_cast<std::int32_t>(seed * 3 % 20)};
    if (grid.blocked(from) || grid.blocked(to)) continue;
    const bool way = distance_field(grid, {to}).distance[grid.index(from)] != kUnreached;
    const Result result = plan(*find_method("fairway"), testing::problem_between(grid, from, to));
    EXPECT_EQ(result.outcome, way ? Outcome::kReached : Outcome::kUnreachable) << "seed " << seed;
    apart += way ? 0 : 1;
  }
  EXPECT_GT(apart, 10);
}

// The nearest cell of the basin may be one from which the pointers lead a long way round.
TEST(Fairway, is_hardly_longer_than_the_shortest_path) {
  std::vector<double> ratios;
  for (std::uint64_t seed = 1; seed <= 150; ++seed) {
    const Grid grid = testing::random_grid(40, 40, 0.2, seed);
    const Cell from{static_cast<std::int32_t>(seed % 20), 3}, to{36, static_cast<std::int32_t>(seed * 3 % 40)};
    if (grid.blocked(from) || grid.blocked(to)) continue;
    const Problem problem = testing::problem_between(grid, from, to);
    const Result result = plan(*find_method("fairway"), problem), shortest = plan(*find_method("astar"), problem);
    if (shortest.outcome == Outcome::kReached) ratios.push_back(result.length_m / shortest.length_m);
  }
  std::sort(ratios.begin(), ratios.end());
  ASSERT_GT(ratios.size(), 60u);
  EXPECT_GE(ratios.front(), 1.0 - 1e-9);
  EXPECT_LE(ratios[ratios.size() / 2], 1.03);
  EXPECT_LE(ratios[ratios.size() * 95 / 100], 1.2);
}

TEST(Fairway, needs_no_approach_from_inside_of_the_basin) {
  const Grid grid(30, 30);
  const Fairway fairway = find_fairway(grid, {3, 4}, {25, 20});
  EXPECT_EQ(fairway.approach, 0u);
  EXPECT_EQ(fairway.cells.back(), (Cell{25, 20}));
}

}  // namespace
}  // namespace kb::planners
