#include "planners/check.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

using testing::draw;

const Grid& corner() {
  static const Grid grid = draw({"...",
                                 ".#.",
                                 "..."});
  return grid;
}

TEST(PathChecker, lets_a_path_through_free_cells_pass) {
  EXPECT_FALSE(check_path(corner(), {{0.5, 0.5}, {0.5, 2.5}, {2.5, 2.5}}, Touch::kApart));
  EXPECT_FALSE(check_path(corner(), {{0.5, 0.5}}, Touch::kApart));
}

TEST(PathChecker, sees_each_way_to_be_wrong) {
  const auto objection = [](const std::vector<Point>& path, Touch touch = Touch::kApart) {
    const auto found = check_path(corner(), path, touch);
    return found ? std::string(found->what) : std::string("none");
  };
  EXPECT_EQ(objection({}), "it has no points");
  EXPECT_EQ(objection({{0.5, 0.5}, {2.5, 2.5}}), "it cuts a corner");
  EXPECT_EQ(objection({{0.5, 1.5}, {2.5, 1.5}}), "it touches a blocked cell") << "the left edge is met first";
  EXPECT_EQ(objection({{0.5, 1.5}, {2.5, 1.5}}, Touch::kContact), "it crosses a blocked cell");
  EXPECT_EQ(objection({{0.5, 1.5}, {1.5, 2.5}}), "it cuts a corner");
  EXPECT_EQ(objection({{0.5, 0.5}, {0.5, -0.5}}), "it leaves the map");
  EXPECT_EQ(objection({{0.5, 0.5}, {0.5, std::nan("")}}), "a coordinate is no finite number");
  EXPECT_EQ(objection({{1.0, 0.5}, {1.0, 2.5}}), "it cuts a corner") << "along its edge";
}

TEST(PathChecker, lets_a_robot_stand_where_four_free_cells_meet) {
  const Grid open = draw({"...",
                          "...",
                          "..."});
  EXPECT_FALSE(check_path(open, {{1.0, 1.0}}, Touch::kApart));
  EXPECT_FALSE(check_path(open, {{0.5, 0.5}, {1.0, 1.0}, {1.0, 1.0}, {1.5, 1.5}}, Touch::kApart));
  EXPECT_EQ(check_path(corner(), {{1.0, 1.0}}, Touch::kApart)->what, "it cuts a corner") << "one of the four is blocked";
}

TEST(PathChecker, says_where) {
  const auto found = check_path(corner(), {{0.5, 0.5}, {0.5, 1.5}, {1.5, 1.5}, {2.5, 1.5}}, Touch::kApart);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->point, 1u);
}

TEST(PathChecker, lets_those_who_feel_their_way_run_along_boundaries) {
  EXPECT_FALSE(check_path(corner(), {{1.0, 0.5}, {1.0, 2.0}, {2.0, 2.0}}, Touch::kContact));
  EXPECT_FALSE(check_path(corner(), {{0.5, 1.5}, {1.5, 2.5}}, Touch::kContact)) << "round a corner";
}

TEST(PathChecker, lets_nobody_through_between_cells_that_touch_at_a_corner) {
  const Grid grid = draw({"#.",
                          ".#"});
  EXPECT_TRUE(check_path(grid, {{0.5, 0.5}, {1.5, 1.5}}, Touch::kContact));
  EXPECT_TRUE(check_path(grid, {{0.5, 0.5}, {1.0, 1.0}, {1.5, 1.5}}, Touch::kContact)) << "with a point at the corner";
  EXPECT_FALSE(check_path(grid, {{0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}}, Touch::kContact)) << "round the inside of it";
  EXPECT_TRUE(check_path(grid, {{0.0, 1.0}, {1.0, 1.0}, {1.0, 2.0}}, Touch::kContact)) << "from one side to the other";
}

TEST(PathChecker, holds_the_ends_against_start_and_goal) {
  const std::vector<Point> path = {{0.5, 0.5}, {0.5, 2.5}};
  EXPECT_FALSE(check_path(corner(), path, Touch::kApart, {0.5, 0.5}, {0.5, 2.5}, 0.1));
  EXPECT_EQ(check_path(corner(), path, Touch::kApart, {0.5, 0.5}, {2.5, 2.5}, 0.5)->what, "it does not end at the goal");
  EXPECT_EQ(check_path(corner(), path, Touch::kApart, {1.5, 0.5}, {0.5, 2.5}, 0.5)->what,
            "it does not begin at the start");
}

// Points along a random segment: if one of them lies inside of a blocked cell, the checker must object.
TEST(PathChecker, agrees_with_a_dense_sample_of_random_segments) {
  std::mt19937_64 dice(7);
  const Grid grid = testing::random_grid(12, 12, 0.2, 11);
  const auto random = [&] { return 12.0 * static_cast<double>(dice() >> 11) * 0x1p-53; };
  int clear = 0;
  for (int i = 0; i < 20000; ++i) {
    const Point a{random(), random()}, b{random(), random()};
    bool hit = false;
    for (int n = 0; n <= 400 && !hit; ++n) hit = grid.blocked(grid.cell_at(a + (n / 400.0) * (b - a)));
    const bool objects = check_path(grid, {a, b}, Touch::kApart).has_value();
    EXPECT_TRUE(objects || !hit) << a.x << "," << a.y << " to " << b.x << "," << b.y;
    clear += objects ? 0 : 1;
  }
  EXPECT_GT(clear, 500) << "a checker that objects to everything is none";
}

TEST(WalkChecker, sees_moving_obstacles_and_exchanges) {
  const Grid grid = draw({"....", "...."});
  Movers movers(grid, 4);
  movers.add({{3, 0}, {2, 0}, {1, 0}, {2, 0}});
  EXPECT_FALSE(check_walk(grid, &movers, {{0, 1}, {1, 1}, {2, 1}, {3, 1}}));
  EXPECT_EQ(check_walk(grid, &movers, {{2, 1}, {2, 0}})->what, "it meets a moving obstacle");
  EXPECT_EQ(check_walk(grid, &movers, {{2, 0}, {3, 0}})->what, "it changes places with a moving obstacle");
  EXPECT_EQ(check_walk(grid, nullptr, {{0, 0}, {2, 0}})->what, "it jumps");
  EXPECT_FALSE(check_walk(grid, nullptr, {{0, 0}, {0, 0}, {1, 1}})) << "waiting is a move";
}

TEST(Movers, repeat_after_their_period) {
  const Grid grid(4, 4);
  Movers movers(grid, 6);
  movers.add({{0, 0}, {1, 0}});
  for (std::uint64_t t = 0; t < 20; ++t) {
    EXPECT_EQ(movers.taken({0, 0}, t), t % 2 == 0);
    EXPECT_EQ(movers.taken({1, 0}, t), t % 2 == 1);
  }
  EXPECT_TRUE(movers.swaps({1, 0}, {0, 0}, 0));
  EXPECT_FALSE(movers.swaps({1, 0}, {0, 0}, 1));
  EXPECT_FALSE(movers.taken({9, 9}, 0));
}

TEST(Movers, cross_the_diagonal_of_a_move) {
  const Grid grid(2, 2);
  Movers movers(grid, 2);
  movers.add({{1, 0}, {0, 1}});
  EXPECT_TRUE(movers.swaps({0, 0}, {1, 1}, 0));
  EXPECT_FALSE(movers.swaps({0, 0}, {0, 1}, 0));
}

}  // namespace
}  // namespace kb::planners
