// Lines and walls as the bug methods see them.
#include "planners/boundary.h"

#include <gtest/gtest.h>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

using testing::draw;

TEST(LineWalk, passes_the_sides_of_cells_in_order_and_exactly) {
  LineWalk walk(centre_node({0, 0}), {3, 1});  // from (1, 1) to (7, 3) in half cells
  const auto first = walk.next();
  ASSERT_TRUE(first);
  EXPECT_EQ(first->at, (Place{12, 8, 6}));     // (2, 4/3)
  EXPECT_EQ(first->before, (Cell{0, 0}));
  EXPECT_EQ(first->after, (Cell{1, 0}));
  EXPECT_EQ(first->where, (Node{2, 1}));
  const auto second = walk.next();
  ASSERT_TRUE(second);
  EXPECT_EQ(second->at, place(Node{4, 2}));
  EXPECT_TRUE(second->through_corner());
  EXPECT_EQ(second->after, (Cell{2, 1}));
  EXPECT_TRUE(walk.next());
  EXPECT_FALSE(walk.next());
  EXPECT_EQ(walk.cell(), (Cell{3, 1}));
}

TEST(LineWalk, begins_in_the_cell_that_it_enters) {
  EXPECT_EQ(LineWalk({4, 4}, {5, 5}).cell(), (Cell{2, 2}));
  EXPECT_EQ(LineWalk({4, 4}, {0, 5}).cell(), (Cell{1, 2}));
  EXPECT_EQ(LineWalk({5, 4}, {2, 0}).cell(), (Cell{2, 1}));  // straight down from the middle of a side
}

// Every crossing lies on the line, and each line ends in the cell of the goal.
TEST(LineWalk, stays_on_the_line_in_every_direction) {
  for (std::int32_t x = 0; x <= 12; ++x) {
    for (std::int32_t y = 0; y <= 12; ++y) {
      if (x % 2 == 0 && y % 2 != 0) continue;
      const Node from{x, y};
      const Cell goal{3, 2};
      const Node to = centre_node(goal);
      LineWalk walk(from, goal);
      Cell cell = walk.cell();
      while (const auto crossing = walk.next()) {
        EXPECT_EQ(crossing->before, cell);
        cell = crossing->after;
        const Place& p = crossing->at;
        EXPECT_EQ((p.x - from.x * p.w) * (to.y - from.y), (p.y - from.y * p.w) * (to.x - from.x));
      }
      EXPECT_EQ(cell, goal);
    }
  }
}

TEST(WallWalk, goes_once_round_an_obstacle_with_either_hand) {
  const Grid grid = draw({".....",
                          ".##..",
                          ".#...",
                          "....."});
  LineWalk line(centre_node({0, 2}), {4, 2});
  const auto hit = line.next();
  ASSERT_TRUE(hit && is_hit(grid, *hit));
  EXPECT_EQ(edge_after_hit(grid, *hit, Hand::kLeft).heading, 3);   // down, the obstacle on the left
  EXPECT_EQ(edge_after_hit(grid, *hit, Hand::kRight).heading, 1);
  for (const Hand hand : {Hand::kLeft, Hand::kRight}) {
    const WallEdge first = edge_after_hit(grid, *hit, hand);
    EXPECT_EQ(wall_length(grid, first, hand), 8);
    WallWalk walk(grid, hit->at, first, hand);
    int nodes = 0;
    while (walk.next()) {
      ++nodes;
      EXPECT_TRUE(grid.free(walk.free_cell()));
      EXPECT_TRUE(grid.blocked(hand == Hand::kLeft ? walk.edge().left() : walk.edge().right()));
    }
    EXPECT_EQ(nodes, 15);  // of 16; the hit is a node itself
  }
}

TEST(WallWalk, does_not_slip_between_obstacles_that_touch_at_a_corner) {
  const Grid grid = draw({"....",
                          ".#..",
                          "..#.",
                          "...."});
  const WallEdge first{{2, 6}, 3};  // the left side of the upper cell, downwards, with the obstacle on the left
  ASSERT_EQ(first.left(), (Cell{1, 2}));
  EXPECT_EQ(wall_length(grid, first, Hand::kLeft), 8);
  WallWalk walk(grid, place(first.from), first, Hand::kLeft);
  int at_joint = 0;
  while (walk.next()) {
    if (walk.node() != Node{4, 4}) continue;
    ++at_joint;
    EXPECT_EQ(walk.can_enter({1, 1}), walk.free_cell() == (Cell{1, 1}));
    EXPECT_EQ(walk.can_enter({2, 2}), walk.free_cell() == (Cell{2, 2}));
  }
  EXPECT_EQ(at_joint, 2);
}

TEST(WallWalk, follows_the_border_of_the_world_from_within) {
  const Grid grid = draw({"...", "...", "..."});
  LineWalk out(centre_node({1, 1}), {5, 1});
  ASSERT_FALSE(is_hit(grid, *out.next()));
  const auto hit = out.next();
  ASSERT_TRUE(hit && is_hit(grid, *hit));
  EXPECT_EQ(wall_length(grid, edge_after_hit(grid, *hit, Hand::kLeft), Hand::kLeft), 12);
}

// The length of all walls together is the number of sides between free and blocked cells.
TEST(WallWalk, visits_every_side_of_every_wall_once) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Grid grid = testing::random_grid(15, 11, 0.4, seed);
    std::size_t sides = 0, walked = 0;
    std::vector<std::array<bool, 4>> seen(grid.size());
    for (CellIndex i = 0; i < grid.size(); ++i) {
      const Cell cell = grid.cell(i);
      if (grid.blocked(cell)) continue;
      for (int heading = 0; heading < 4; ++heading) {
        // The side of the free cell on whose right it lies.
        const std::array<Node, 4> corners = {{{0, 2}, {0, 0}, {2, 0}, {2, 2}}};
        const Node from = corners[static_cast<std::size_t>(heading)];
        const WallEdge edge{{2 * cell.x + from.x, 2 * cell.y + from.y}, heading};
        ASSERT_EQ(edge.right(), cell);
        if (grid.free(edge.left())) continue;
        ++sides;
        if (seen[i][static_cast<std::size_t>(heading)]) continue;
        seen[i][static_cast<std::size_t>(heading)] = true;
        ++walked;
        WallWalk walk(grid, place(edge.from), edge, Hand::kLeft);
        while (walk.next()) {
          if (!walk.entered_edge() || walk.edge() == edge) continue;
          auto& mark = seen[grid.index(walk.free_cell())][static_cast<std::size_t>(walk.edge().heading)];
          EXPECT_FALSE(mark);
          mark = true;
          ++walked;
        }
      }
    }
    EXPECT_EQ(walked, sides) << "seed " << seed;
  }
}

}  // namespace
}  // namespace kb::planners
