#include "planners/shortest.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

TEST(DistanceField, is_that_of_the_plainest_dijkstra) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Grid grid = testing::random_grid(23, 17, 0.01 * static_cast<double>(seed), seed);
    const Cell from{static_cast<std::int32_t>(seed % 23), static_cast<std::int32_t>(seed % 17)};
    if (grid.blocked(from)) continue;
    const auto plain = testing::plain_distances(grid, from);
    const auto field = distance_field(grid, {from});
    for (std::size_t i = 0; i < plain.size(); ++i) {
      ASSERT_EQ(field.distance[i] == kUnreached, plain[i] == kUnreached) << "seed " << seed;
      if (plain[i] != kUnreached) {
        EXPECT_NEAR(field.distance[i], plain[i], 1e-9) << "seed " << seed;
      }
    }
  }
}

TEST(DistanceField, that_ends_early_is_exact_where_it_ends) {
  const auto& arena = testing::benchmarks()[0];
  for (const Scenario& row : arena.scenarios) {
    const auto field = distance_field(arena.grid, {row.goal}, row.start);
    EXPECT_NEAR(field.distance[arena.grid.index(row.start)], row.optimum, 1e-6);
    EXPECT_EQ(descend(arena.grid, field.distance, row.start).back(), row.goal);
  }
}

TEST(DistanceField, counts_each_cell_once) {
  const Grid grid = testing::random_grid(60, 60, 0.2, 5);
  const auto field = distance_field(grid, {{0, 0}});
  std::uint64_t reached = 0;
  for (const double d : field.distance) reached += d != kUnreached ? 1 : 0;
  EXPECT_EQ(field.settled, reached);
}

TEST(Astar, finds_the_optimum_of_every_published_scenario) {
  std::size_t rows = 0;
  for (const auto& benchmark : testing::benchmarks()) {
    Astar search(benchmark.grid);
    for (const Scenario& row : benchmark.scenarios) {
      const auto path = search.search(row.start, row.goal);
      ASSERT_FALSE(path.empty()) << benchmark.name << " line " << row.line;
      EXPECT_NEAR(search.length(), row.optimum, 1e-6) << benchmark.name << " line " << row.line;
      EXPECT_NEAR(reached(benchmark.grid, path).length_m, search.length(), 1e-9);
      EXPECT_EQ(path.front(), row.start);
      EXPECT_EQ(path.back(), row.goal);
      EXPECT_FALSE(check_path(benchmark.grid, centres(benchmark.grid, path), Touch::kApart));
      ++rows;
    }
  }
  EXPECT_EQ(rows, 1444u);
}

TEST(Astar, agrees_with_the_field_on_random_grids_reachable_or_not) {
  std::mt19937 dice(3);
  int apart = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const Grid grid = testing::random_grid(20, 20, 0.4, seed);
    Astar search(grid);
    for (int i = 0; i < 5; ++i) {
      const auto cell = [&] {
        return Cell{static_cast<std::int32_t>(dice() % 20u), static_cast<std::int32_t>(dice() % 20u)};
      };
      const Cell from = cell(), to = cell();
      if (grid.blocked(from) || grid.blocked(to)) continue;
      const double exact = testing::plain_distances(grid, to)[grid.index(from)];
      const bool found = !search.search(from, to).empty();
      EXPECT_EQ(found, exact != kUnreached);
      if (found) {
        EXPECT_NEAR(search.length(), exact, 1e-9);
      }
      apart += found ? 0 : 1;
    }
  }
  EXPECT_GT(apart, 20);
}

// A field from three sources is the field from one, bettered by offers from the others, in whatever order they come.
TEST(LevelField, is_bettered_by_offers_and_not_by_worse_ones) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const Grid grid = testing::random_grid(40, 30, 0.25, seed);
    std::vector<Cell> sources;
    for (std::int32_t x = 0; sources.size() < 3; ++x) {
      if (grid.free({x, (x * 7) % 30})) sources.push_back({x, (x * 7) % 30});
    }
    std::vector<double> level;
    const std::uint64_t cells = level_field(grid, sources[0], level);
    EXPECT_EQ(cells, distance_field(grid, {sources[0]}).settled);
    // The second source counts 5 from the beginning, the third is offered twice, and the first once more, farther away than it is.
    spread(grid, level, {{7.0, grid.index(sources[2])}, {5.0, grid.index(sources[1])}, {1.0, grid.index(sources[2])},
                         {3.0, grid.index(sources[0])}});
    const auto a = distance_field(grid, {sources[0]}).distance, b = distance_field(grid, {sources[1]}).distance,
               c = distance_field(grid, {sources[2]}).distance;
    for (CellIndex at = 0; at < grid.size(); ++at) {
      const double expected = std::min({a[at], b[at] + 5.0, c[at] + 1.0});
      if (expected == kUnreached) {
        EXPECT_EQ(level[at], -kUnreached);
      } else {
        EXPECT_NEAR(-level[at], expected, 1e-9) << "seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace kb::planners
