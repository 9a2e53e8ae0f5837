// The sign rule of Filimonov and Filimonov: our form of it against the printed one, and what it brings.
#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "planners/bug.h"
#include "planners/bug_run.h"
#include "planners/report/rows.h"
#include "tests/unit/planners/planning.h"
#include "tests/unit/planners/separate_obstacles.h"
#include "tests/unit/stride.h"

namespace kb::planners {
namespace {

std::int64_t sign(std::int64_t value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

// On which side of the directed line from a to b a node lies: 1 left, -1 right.
std::int64_t side_of(const Place& a, const Place& b, Node p) {
  const std::int64_t ux = b.x * a.w - a.x * b.w, uy = b.y * a.w - a.y * b.w;
  return sign(ux * (p.y * a.w - a.y) - uy * (p.x * a.w - a.x));
}
std::int64_t side_of(Node a, Node b, const Place& p) {
  return sign((b.x - a.x) * (p.y - a.y * p.w) - (b.y - a.y) * (p.x - a.x * p.w));
}

// As printed: forbidden if the segment PG enters the oriented path from its right side. Nothing where a point of the path
// lies on the line itself, of which the paper does not speak.
std::optional<bool> forbidden_as_printed(const std::vector<Place>& path, Node p, Node goal) {
  bool forbidden = false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Place &a = path[i - 1], &b = path[i];
    const std::int64_t of_a = side_of(p, goal, a), of_b = side_of(p, goal, b);
    const std::int64_t of_p = side_of(a, b, p), of_goal = side_of(a, b, goal);
    const bool apart = !(b == place(p)) && !(a == place(p)) && !(b == place(goal));
    if (apart && (of_a == 0 || of_b == 0)) return std::nullopt;
    if (of_a * of_b < 0 && of_p * of_goal < 0 && of_p < 0) forbidden = true;
  }
  return forbidden;
}

// Robots that run towards the goal, follow the wall for a random while with the obstacle on the left, and leave wherever
// the way is free: longer and wilder paths than any method makes.
TEST(SignRule, is_the_question_whether_the_line_runs_into_a_followed_wall) {
  std::mt19937_64 dice(11);
  int forbidden = 0, permitted = 0;
  for (std::uint64_t seed = 1; seed <= 800; ++seed) {
    const Grid grid = testing::random_grid(14, 12, 0.1 + 0.03 * static_cast<double>(seed % 8), seed);
    const Cell start{static_cast<std::int32_t>(dice() % 14), static_cast<std::int32_t>(dice() % 12)};
    const Cell goal{static_cast<std::int32_t>(dice() % 14), static_cast<std::int32_t>(dice() % 12)};
    if (grid.blocked(start) || grid.blocked(goal)) continue;
    FollowedWalls followed(grid);
    std::vector<Place> path = {place(centre_node(start))};
    Node from = centre_node(start);
    for (int phase = 0; phase < 6; ++phase) {
      LineWalk line(from, goal);
      auto hit = line.next();
      while (hit && !is_hit(grid, *hit)) hit = line.next();
      if (!hit) break;
      path.push_back(hit->at);
      WallWalk walk(grid, hit->at, edge_after_hit(grid, *hit, Hand::kLeft), Hand::kLeft);
      auto left = dice() % 30;
      bool leaves = false;
      while (!leaves && walk.next()) {
        followed.add(walk.edge(), path.back(), place(walk.node()));
        path.push_back(place(walk.node()));
        if (!way_is_free(walk, goal)) continue;
        if (const auto printed = forbidden_as_printed(path, walk.node(), centre_node(goal))) {
          ++(*printed ? forbidden : permitted);
          EXPECT_EQ(runs_into_followed_wall(grid, followed, walk.node(), goal), *printed)
              << "seed " << seed << " at " << walk.node().x << "," << walk.node().y;
        }
        leaves = left-- == 0;
        from = walk.node();
      }
      if (!leaves) break;
    }
  }
  EXPECT_GT(forbidden, 200);
  EXPECT_GT(permitted, 2000);
}

void expect_shorter_than_bug2(const testing::SeparateObstacles& kind, double printed_at_most, double chosen_at_most) {
  std::vector<double> printed, chosen;
  for (std::uint64_t seed = 1; seed <= 1000; seed += kb::testing::stride()) {
    const testing::ObstacleWorld world = testing::make_separate_obstacles(kind, seed);
    ASSERT_EQ(world.placed, kind.count) << "seed " << seed;
    const Problem problem = testing::problem_between(world.grid, world.start, world.goal);
    const double bug2_m = bug2(problem, {}).length_m;
    const Result literal = modified_bug(problem, {}, {.leave = LeaveRule::kLiteral});
    const Result guarded = modified_bug(problem, {}, {.hand = HandRule::kSmallerTurn});
    ASSERT_EQ(literal.outcome, Outcome::kReached) << "seed " << seed;
    ASSERT_EQ(guarded.outcome, Outcome::kReached) << "seed " << seed;
    printed.push_back(literal.length_m / bug2_m);
    chosen.push_back(guarded.length_m / bug2_m);
  }
  EXPECT_LE(percentile(printed, 50), printed_at_most);
  EXPECT_LE(percentile(chosen, 50), chosen_at_most);
}

// The medians over these 1,000 worlds: as printed (left hand) 0.860 and 0.841, with the hand chosen 0.775 and 0.711.
TEST(SignRule, makes_paths_shorter_than_bug2_among_40_separate_obstacles) {
  expect_shorter_than_bug2({100, 40, 4, 14}, 0.89, 0.80);
}
TEST(SignRule, makes_paths_shorter_than_bug2_among_150_separate_obstacles) {
  expect_shorter_than_bug2({100, 150, 2, 10}, 0.86, 0.75);
}

}  // namespace
}  // namespace kb::planners
