// Bug1, Bug2 and the modified bug: right answers, lengths within what theory grants.
#include "planners/bug.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "planners/method.h"
#include "tests/unit/planners/planning.h"
#include "tests/unit/stride.h"

namespace kb::planners {
namespace {

using testing::draw;
using testing::find;
using testing::problem_between;

double more(const Result& result, std::string_view name) {
  for (const auto& [key, value] : result.statistics.more) {
    if (key == name) return value;
  }
  ADD_FAILURE() << "no figure " << name;
  return 0.0;
}

struct Variant {
  std::string name;
  std::function<Result(const Problem&)> run;
};
std::vector<Variant> complete_variants() {
  std::vector<Variant> out;
  for (const HandRule hand : {HandRule::kLeft, HandRule::kRight, HandRule::kSmallerTurn, HandRule::kAlternate}) {
    const std::string h = " hand " + std::to_string(static_cast<int>(hand));
    out.push_back({"bug1" + h, [=](const Problem& p) { return bug1(p, {}, {.hand = hand}); }});
    out.push_back({"bug2" + h, [=](const Problem& p) { return bug2(p, {}, {.hand = hand}); }});
    for (const LeaveRule leave : {LeaveRule::kGuarded, LeaveRule::kNearer}) {
      out.push_back({"modified " + std::to_string(static_cast<int>(leave)) + h,
                     [=](const Problem& p) { return modified_bug(p, {}, {.leave = leave, .hand = hand}); }});
    }
  }
  return out;
}

// The oracle is the flood fill: a point robot that does not slip between joined corners gets exactly where legal moves get.
void expect_right(const Grid& grid, const std::vector<std::uint32_t>& labels, Cell start, Cell goal, const Variant& variant) {
  const Problem problem = problem_between(grid, start, goal);
  const Result result = variant.run(problem);
  const bool way = labels[grid.index(start)] == labels[grid.index(goal)];
  ASSERT_EQ(result.outcome, way ? Outcome::kReached : Outcome::kUnreachable)
      << variant.name << " from " << start.x << "," << start.y << " to " << goal.x << "," << goal.y << " " << result.refused;
  ASSERT_LE(result.length_m, more(result, "length bound") * (1.0 + 1e-9)) << variant.name;
  const auto objection = check_path(grid, result.path, Touch::kContact);
  ASSERT_FALSE(objection) << variant.name << ": " << objection->what;
  if (way) {
    ASSERT_FALSE(check_path(grid, result.path, Touch::kContact, problem.start, problem.goal, 1e-9)) << variant.name;
  }
}

void expect_right_both_ways(const Grid& grid, Cell one, Cell other) {
  const auto labels = label_components(grid);
  for (const Variant& variant : complete_variants()) {
    expect_right(grid, labels, one, other, variant);
    expect_right(grid, labels, other, one, variant);
  }
}

// Dense random worlds are full of obstacles that touch at corners, of pockets, and of sealed rooms.
TEST(BugMethods, answer_right_on_random_worlds_reachable_or_sealed) {
  const std::vector<Variant> variants = complete_variants();
  std::size_t sealed = 0, open = 0;
  for (std::uint64_t seed = 1; seed <= 1000; seed += kb::testing::stride()) {
    const auto width = static_cast<std::int32_t>(4 + seed % 17), height = static_cast<std::int32_t>(3 + seed % 13);
    const Grid grid = testing::random_grid(width, height, 0.1 + 0.05 * static_cast<double>(seed % 10), seed);
    const auto labels = label_components(grid);
    for (int pair = 0; pair < 12; ++pair) {
      const std::uint64_t draw_of = seed * 7919 + static_cast<std::uint64_t>(pair) * 104729;
      const Cell start{static_cast<std::int32_t>(draw_of % static_cast<std::uint64_t>(width)),
                       static_cast<std::int32_t>(draw_of / 31 % static_cast<std::uint64_t>(height))};
      const Cell goal{static_cast<std::int32_t>(draw_of / 977 % static_cast<std::uint64_t>(width)),
                      static_cast<std::int32_t>(draw_of / 30011 % static_cast<std::uint64_t>(height))};
      if (grid.blocked(start) || grid.blocked(goal)) continue;
      ++(labels[grid.index(start)] == labels[grid.index(goal)] ? open : sealed);
      for (const Variant& variant : variants) expect_right(grid, labels, start, goal, variant);
      if (HasFatalFailure()) FAIL() << "seed " << seed;
    }
  }
  EXPECT_GE(sealed * kb::testing::stride(), 1000U);
  EXPECT_GE(open * kb::testing::stride(), 1000U);
}

TEST(BugMethods, answer_right_on_every_row_of_the_benchmarks) {
  const std::size_t step = kb::testing::stride();
  for (const auto& benchmark : testing::benchmarks()) {
    const auto labels = label_components(benchmark.grid);
    for (std::size_t i = 0; i < benchmark.scenarios.size(); i += step) {
      const Scenario& row = benchmark.scenarios[i];
      for (const Variant& variant : complete_variants()) {
        if (!variant.name.ends_with("hand 0") && !variant.name.ends_with("hand 2")) continue;
        expect_right(benchmark.grid, labels, row.start, row.goal, variant);
        if (HasFatalFailure()) FAIL() << benchmark.name;
      }
    }
  }
}

TEST(BugMethods, find_out_that_a_ring_is_closed) {
  const std::vector<std::string_view> rows = {"..........",
                                              "..#####...",
                                              "..#...#...",
                                              "S.#.G.#...",
                                              "..#...#...",
                                              "..#####...",
                                              ".........."};
  expect_right_both_ways(draw(rows), find(rows, 'S'), find(rows, 'G'));
}

TEST(BugMethods, get_out_of_a_spiral) {
  const std::vector<std::string_view> rows = {"...........",
                                              ".#########.",
                                              ".#.......#.",
                                              ".#.#####.#.",
                                              ".#.#...#.#.",
                                              ".#.#.S.#.#.",
                                              ".#.###.#.#.",
                                              ".#.....#.#G",
                                              ".#######.#.",
                                              "...........",
                                              "..........."};
  expect_right_both_ways(draw(rows), find(rows, 'S'), find(rows, 'G'));
}

// The line goes exactly through the corner at which the two obstacles touch.
TEST(BugMethods, take_obstacles_that_touch_at_a_corner_for_one) {
  Grid grid(7, 6);
  for (const Cell cell : {Cell{2, 3}, {3, 3}, {2, 2}, {3, 2}, {4, 1}, {5, 1}, {4, 0}, {5, 0}}) grid.set_blocked(cell, true);
  expect_right_both_ways(grid, {2, 0}, {5, 3});
}

TEST(Bug1, goes_all_the_way_round_before_it_leaves) {
  Grid grid(9, 9);
  for (std::int32_t y = 3; y <= 5; ++y) grid.set_blocked({4, y}, true);
  const Result result = bug1(problem_between(grid, {1, 4}, {7, 4}), {});
  EXPECT_EQ(result.outcome, Outcome::kReached);
  // To the wall 2.5, round it 8, to its far side 4, to the goal 2.5.
  EXPECT_DOUBLE_EQ(result.length_m, 17.0);
  EXPECT_EQ(more(result, "loops"), 1.0);
}

TEST(Bug2, leaves_where_the_line_comes_out) {
  Grid grid(9, 9);
  for (std::int32_t y = 3; y <= 5; ++y) grid.set_blocked({4, y}, true);
  const Result result = bug2(problem_between(grid, {1, 4}, {7, 4}), {});
  EXPECT_EQ(result.outcome, Outcome::kReached);
  EXPECT_DOUBLE_EQ(result.length_m, 9.0);  // 2.5 + 4 + 2.5
}

TEST(ModifiedBug, leaves_at_the_first_corner_that_sees_past_the_obstacle) {
  Grid grid(9, 9);
  for (std::int32_t y = 3; y <= 5; ++y) grid.set_blocked({4, y}, true);
  const Result result = modified_bug(problem_between(grid, {1, 4}, {7, 4}), {});
  EXPECT_EQ(result.outcome, Outcome::kReached);
  // Down to the corner (4, 3), over to (5, 3), then straight.
  EXPECT_DOUBLE_EQ(result.length_m, 2.5 + 1.5 + 1.0 + std::hypot(2.5, 1.5));
}

TEST(ModifiedBug, turns_to_the_nearer_end_of_a_wall_if_it_may_choose) {
  Grid grid(20, 20);
  for (std::int32_t y = 2; y <= 18; ++y) grid.set_blocked({10, y}, true);
  const Problem problem = problem_between(grid, {1, 12}, {18, 18});
  const double left = modified_bug(problem, {}).length_m;
  const double chosen = modified_bug(problem, {}, {.hand = HandRule::kSmallerTurn}).length_m;
  EXPECT_LT(chosen, 0.7 * left);
}

// As printed the modified bug never crosses its path, but in a room it goes round again and again, a little farther in.
TEST(ModifiedBug, spirals_in_rooms_as_printed_and_not_if_guarded) {
  const auto& den = testing::benchmarks()[1];
  const std::size_t step = kb::testing::stride();
  std::vector<double> literal, guarded;
  for (std::size_t i = 0; i < den.scenarios.size(); i += step) {
    const Scenario& row = den.scenarios[i];
    const Problem problem = problem_between(den.grid, row.start, row.goal);
    const Result as_printed = modified_bug(problem, {}, {.leave = LeaveRule::kLiteral});
    EXPECT_EQ(as_printed.outcome, Outcome::kReached);
    literal.push_back(as_printed.length_m / row.optimum);
    guarded.push_back(modified_bug(problem, {}).length_m / row.optimum);
  }
  std::sort(literal.begin(), literal.end());
  std::sort(guarded.begin(), guarded.end());
  EXPECT_GT(literal[literal.size() / 2], 10.0);
  EXPECT_GT(literal[literal.size() * 95 / 100], 500.0);
  EXPECT_LT(guarded[guarded.size() / 2], 5.0);
}

// As printed it still ends: a departure point is used once, for its line leads to a hit from which the wall is followed,
// and so enters a followed wall ever after. What it says of sealed goals is right; it may give up on others.
TEST(ModifiedBug, ends_as_printed_and_never_lies) {
  for (std::uint64_t seed = 1; seed <= 600; ++seed) {
    const Grid grid = testing::random_grid(16, 16, 0.3, seed);
    const auto labels = label_components(grid);
    const Cell start{static_cast<std::int32_t>(seed % 16), static_cast<std::int32_t>(seed / 16 % 16)};
    const Cell goal{static_cast<std::int32_t>(seed / 3 % 16), static_cast<std::int32_t>(seed / 5 % 16)};
    if (grid.blocked(start) || grid.blocked(goal)) continue;
    const Result result = modified_bug(problem_between(grid, start, goal), {}, {.leave = LeaveRule::kLiteral});
    const bool way = labels[grid.index(start)] == labels[grid.index(goal)];
    EXPECT_NE(result.outcome, Outcome::kLimit) << "seed " << seed;
    if (result.outcome == Outcome::kReached) {
      EXPECT_TRUE(way) << "seed " << seed;
    } else if (result.outcome == Outcome::kUnreachable) {
      EXPECT_FALSE(way) << "seed " << seed;
    }
  }
}

TEST(BugMethods, stop_when_they_are_told_to) {
  const auto& den = testing::benchmarks()[1];
  const Scenario& row = den.scenarios.back();
  const Problem problem = problem_between(den.grid, row.start, row.goal);
  std::atomic<bool> cancel = true;
  RunOptions run;
  run.cancel = &cancel;
  const Result cancelled = bug1(problem, run);
  EXPECT_EQ(cancelled.outcome, Outcome::kLimit);
  EXPECT_EQ(cancelled.statistics.stop, Stop::kCancelled);
  EXPECT_FALSE(cancelled.path.empty());
  const Result out_of_steps = bug2(problem, {}, {.max_halves = 10});
  EXPECT_EQ(out_of_steps.outcome, Outcome::kLimit);
  EXPECT_EQ(out_of_steps.statistics.stop, Stop::kSteps);
}

}  // namespace
}  // namespace kb::planners
