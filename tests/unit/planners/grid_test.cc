#include "planners/grid.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

using testing::draw;

TEST(Grid, is_empty_if_its_size_makes_no_sense) {
  EXPECT_TRUE(Grid().empty());
  EXPECT_TRUE(Grid(0, 5).empty());
  EXPECT_TRUE(Grid(5, -1).empty());
  EXPECT_TRUE(Grid(Grid::kMaxSide + 1, 1).empty());
  EXPECT_TRUE(Grid(Grid::kMaxSide, Grid::kMaxSide).empty());
  EXPECT_TRUE(Grid(5, 5, 0.0).empty());
  EXPECT_TRUE(Grid(5, 5, std::numeric_limits<double>::quiet_NaN()).empty());
  EXPECT_FALSE(Grid(1, 1).empty());
}

TEST(Grid, is_blocked_outside) {
  const Grid grid(3, 2);
  EXPECT_TRUE(grid.blocked({-1, 0}));
  EXPECT_TRUE(grid.blocked({3, 0}));
  EXPECT_TRUE(grid.blocked({0, 2}));
  EXPECT_TRUE(grid.free({2, 1}));
  EXPECT_EQ(grid.free_cells(), 6u);
}

TEST(Grid, lets_no_diagonal_move_cut_a_corner) {
  const Grid grid = draw({"...",
                          "#..",
                          "..."});
  const Cell middle{1, 1};
  EXPECT_EQ(grid.moves(middle), 0b11000111) << "left is blocked, and so are both diagonals beside it";
  EXPECT_EQ(grid.moves({0, 1}), 0) << "nothing moves out of a blocked cell";
}

TEST(Grid, mends_its_moves_when_a_cell_changes) {
  Grid changed = draw({"....", "....", "...."});
  changed.set_blocked({1, 1}, true);
  changed.set_blocked({2, 2}, true);
  changed.set_blocked({2, 2}, false);
  const Grid drawn = draw({"....", ".#..", "...."});
  for (std::int32_t y = 0; y < 3; ++y) {
    for (std::int32_t x = 0; x < 4; ++x) EXPECT_EQ(changed.moves({x, y}), drawn.moves({x, y})) << x << ", " << y;
  }
  EXPECT_EQ(changed.free_cells(), 11u);
}

TEST(Grid, finds_the_cell_of_a_point) {
  const Grid grid(4, 3, 0.5, {-1.0, 2.0});
  EXPECT_EQ(grid.centre({0, 0}), (Point{-0.75, 2.25}));
  EXPECT_EQ(grid.cell_at({-0.75, 2.25}), (Cell{0, 0}));
  EXPECT_EQ(grid.cell_at({0.99, 3.49}), (Cell{3, 2}));
  EXPECT_FALSE(grid.contains(Point{1.01, 2.5}));
  EXPECT_FALSE(grid.contains(Point{1e300, -1e300}));
  EXPECT_FALSE(grid.contains(Point{std::numeric_limits<double>::quiet_NaN(), 2.5}));
}

TEST(Grid, knows_which_cells_can_be_reached_from_each_other) {
  const Grid grid = draw({"..#.",
                          "..#.",
                          "##..",   // the free corners touch diagonally only
                          "...."});
  const auto labels = label_components(grid);
  EXPECT_EQ(labels[grid.index({0, 3})], labels[grid.index({1, 2})]);
  EXPECT_NE(labels[grid.index({0, 3})], labels[grid.index({0, 0})]);
  EXPECT_EQ(labels[grid.index({0, 0})], labels[grid.index({3, 3})]);
  EXPECT_EQ(labels[grid.index({2, 3})], 0u);
}

TEST(Directions, turn_counter_clockwise_by_45_degrees) {
  for (int k = 0; k < 8; ++k) {
    const Cell step = kDirections[static_cast<std::size_t>(k)];
    EXPECT_NEAR(wrap_angle(std::atan2(step.y, step.x) - k * kPi / 4), 0.0, 1e-12);
    EXPECT_EQ(testing::direction_between({3, 3}, Cell{3, 3} + step), k);
  }
  EXPECT_EQ(testing::direction_between({0, 0}, {2, 0}), -1);
}

}  // namespace
}  // namespace kb::planners
