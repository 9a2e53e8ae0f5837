#include "planners/discretise.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

TEST(GridStep, is_eta_times_the_smallest_dimension) {
  EXPECT_DOUBLE_EQ(grid_step(0.4)->cell_m, 0.5);
  EXPECT_FALSE(grid_step(0.4)->eta_unusual);
  EXPECT_TRUE(grid_step(0.4, 1.05)->eta_unusual);
  EXPECT_TRUE(grid_step(0.4, 1.6)->eta_unusual);
  EXPECT_FALSE(grid_step(0.4, 0.99));
  EXPECT_FALSE(grid_step(0.0));
  EXPECT_FALSE(grid_step(std::numeric_limits<double>::infinity()));
  EXPECT_FALSE(grid_step(0.4, std::nan("")));
}

TEST(Inflation, is_none_for_a_robot_that_fits_into_a_cell) {
  EXPECT_EQ(inflation_cells(0.5, 1.0), 0);
  EXPECT_EQ(inflation_cells(0.51, 1.0), 1);
  EXPECT_EQ(inflation_cells(1.6, 1.0), 2);
}

// In the centre of every cell that is left free, a disc of the robot's radius overlaps no obstacle.
TEST(Inflation, leaves_room_for_the_robot_in_every_free_cell) {
  const Grid grid = testing::random_grid(30, 30, 0.03, 4);
  for (const double radius : {0.6, 0.9, 1.4, 2.2}) {
    const Grid square = inflate(grid, radius, InflationShape::kSquare), round = inflate(grid, radius);
    EXPECT_LE(square.free_cells(), round.free_cells());
    EXPECT_GT(round.free_cells(), 0u);
    for (std::int32_t y = 0; y < 30; ++y) {
      for (std::int32_t x = 0; x < 30; ++x) {
        if (round.blocked({x, y})) continue;
        for (std::int32_t b = -1; b <= 30; ++b) {
          for (std::int32_t a = -1; a <= 30; ++a) {
            if (grid.free({a, b})) continue;
            const double dx = std::max(0.0, std::abs(a - x) - 0.5), dy = std::max(0.0, std::abs(b - y) - 0.5);
            ASSERT_GE(std::hypot(dx, dy), radius - 1e-12) << x << "," << y << " and " << a << "," << b;
          }
        }
      }
    }
  }
}

// What a planner needs that leaves the centres of cells: no point of a free cell is nearer than the radius, and none is lost that is not.
TEST(Inflation, of_whole_cells_keeps_the_radius_wherever_in_a_free_cell) {
  const double side = 0.05;
  Grid grid(30, 24, side);
  const Grid drawn = testing::random_grid(30, 24, 0.02, 7);
  for (std::int32_t y = 0; y < 24; ++y) {
    for (std::int32_t x = 0; x < 30; ++x) grid.set_blocked({x, y}, drawn.blocked({x, y}));
  }
  for (const double radius : {0.0, 0.01, 0.05, 0.1, 0.17}) {
    const Grid grown = inflate(grid, radius, InflationShape::kWhole);
    EXPECT_GT(grown.free_cells(), 0u);
    for (std::int32_t y = 0; y < 24; ++y) {
      for (std::int32_t x = 0; x < 30; ++x) {
        double least = 1e9;
        for (std::int32_t b = -1; b <= 24; ++b) {
          for (std::int32_t a = -1; a <= 30; ++a) {
            if (grid.free({a, b})) continue;
            least = std::min(least, side * std::hypot(std::max(0, std::abs(a - x) - 1), std::max(0, std::abs(b - y) - 1)));
          }
        }
        if (grid.blocked({x, y})) least = -1.0;
        ASSERT_EQ(grown.free({x, y}), least >= radius - 1e-9) << x << "," << y << " radius " << radius;
      }
    }
  }
}

TEST(Rasterisation, blocks_every_cell_that_is_covered_in_part) {
  Grid grid(6, 6);
  const std::vector<Point> triangle = {{1.2, 1.2}, {3.8, 1.2}, {1.2, 3.8}};
  block_polygon(grid, triangle);
  EXPECT_TRUE(grid.blocked({1, 1}));
  EXPECT_TRUE(grid.blocked({3, 1}));
  EXPECT_TRUE(grid.blocked({2, 2})) << "the slanted side cuts its corner";
  EXPECT_TRUE(grid.free({3, 3}));
  EXPECT_TRUE(grid.free({3, 2}));
  EXPECT_TRUE(grid.free({0, 1}));
}

TEST(Rasterisation, does_not_block_what_is_only_touched) {
  Grid grid(4, 4);
  block_polygon(grid, std::vector<Point>{{1, 1}, {2, 1}, {2, 2}, {1, 2}});
  EXPECT_EQ(grid.free_cells(), 15u);
}

TEST(Rasterisation, of_a_speck_blocks_its_cell) {
  Grid grid(4, 4, 0.5);
  block_disc(grid, {0.8, 0.3}, 0.01);
  EXPECT_EQ(grid.free_cells(), 15u);
  EXPECT_TRUE(grid.blocked({1, 0}));
}

TEST(DistanceToBlocked, is_exact) {
  const Grid grid = testing::random_grid(25, 18, 0.05, 9);
  const auto distance = distance_to_blocked(grid);
  for (std::int32_t y = 0; y < 18; ++y) {
    for (std::int32_t x = 0; x < 25; ++x) {
      double nearest = 1e9;
      for (std::int32_t b = -1; b <= 18; ++b) {
        for (std::int32_t a = -1; a <= 25; ++a) {
          if (grid.blocked({a, b})) nearest = std::min(nearest, std::hypot(a - x, b - y));
        }
      }
      ASSERT_NEAR(distance[grid.index({x, y})], nearest, 1e-5);
    }
  }
}

}  // namespace
}  // namespace kb::planners
