#include "planners/room.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

// No point of a free cell is nearer than the radius, and none is lost that is not.
TEST(Inflation, keeps_the_radius_wherever_in_a_free_cell) {
  const double side = 0.05;
  Grid grid(30, 24, side);
  const Grid drawn = testing::random_grid(30, 24, 0.02, 7);
  for (std::int32_t y = 0; y < 24; ++y) {
    for (std::int32_t x = 0; x < 30; ++x) grid.set_blocked({x, y}, drawn.blocked({x, y}));
  }
  for (const double radius : {0.0, 0.01, 0.05, 0.1, 0.17}) {
    const Grid grown = inflate(grid, radius);
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
