// What holds for every method of methods.def.
#include "planners/method.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

using testing::problem_between;

class EveryMethod : public ::testing::TestWithParam<const Method*> {
 protected:
  const Method& method() const { return *GetParam(); }
};

std::vector<const Method*> all() {
  std::vector<const Method*> out;
  for (const Method& method : methods()) out.push_back(&method);
  return out;
}

std::string test_name(const ::testing::TestParamInfo<const Method*>& info) {
  std::string name(info.param->name);
  for (char& c : name) c = c == '-' ? '_' : c;
  return name;
}
INSTANTIATE_TEST_SUITE_P(Planners, EveryMethod, ::testing::ValuesIn(all()), test_name);

TEST_P(EveryMethod, says_which_of_its_inputs_is_wrong) {
  Grid grid(5, 5);
  grid.set_blocked({2, 2}, true);
  const auto fault = [&](Problem problem) {
    const Result result = plan(method(), problem);
    EXPECT_EQ(result.outcome, Outcome::kInvalid);
    EXPECT_TRUE(result.path.empty());
    return result.fault;
  };
  const Problem good = problem_between(grid, {0, 0}, {4, 4});
  Problem problem = good;
  problem.grid = nullptr;
  EXPECT_EQ(fault(problem), Fault::kEmptyMap);
  const Grid nothing;
  problem.grid = &nothing;
  EXPECT_EQ(fault(problem), Fault::kEmptyMap);
  problem = good;
  problem.goal.x = std::nan("");
  EXPECT_EQ(fault(problem), Fault::kNotFinite);
  problem.goal.x = std::numeric_limits<double>::infinity();
  EXPECT_EQ(fault(problem), Fault::kNotFinite);
  problem = good;
  problem.start = {-1.0, 2.0};
  EXPECT_EQ(fault(problem), Fault::kStartOutside);
  problem = good;
  problem.goal = {2.0, 5.5};
  EXPECT_EQ(fault(problem), Fault::kGoalOutside);
  EXPECT_EQ(fault(problem_between(grid, {2, 2}, {4, 4})), Fault::kStartBlocked);
  EXPECT_EQ(fault(problem_between(grid, {4, 4}, {2, 2})), Fault::kGoalBlocked);
  problem = good;
  problem.goal_tolerance_cells = 0.0;
  EXPECT_EQ(fault(problem), Fault::kBadParameter);
  const Movers movers(grid, 3);
  problem = good;
  problem.movers = &movers;
  if (!method().moving) {
    EXPECT_EQ(fault(problem), Fault::kMoversUnknown);
  }
}

TEST_P(EveryMethod, has_arrived_where_it_starts) {
  const Grid grid(5, 5);
  const Result result = plan(method(), problem_between(grid, {2, 2}, {2, 2}));
  EXPECT_EQ(result.outcome, Outcome::kReached);
  EXPECT_EQ(result.length_m, 0.0);
}

TEST_P(EveryMethod, crosses_an_empty_room) {
  const Grid grid(12, 9, 0.5, {3.0, -2.0});
  const Result result = plan(method(), problem_between(grid, {1, 1}, {10, 7}));
  EXPECT_EQ(result.outcome, Outcome::kReached) << name(result.outcome) << " " << result.refused;
  EXPECT_GE(result.length_m, 0.5 * std::hypot(9, 6) - 0.5);
  EXPECT_NEAR(result.length_m, length(result.path), 1e-9);
}

// In metres of a survey (UTM) cells of 5 cm are rounded by some 1e-8 of their side.
TEST_P(EveryMethod, answers_far_from_the_origin_of_the_world_as_near_it) {
  const Grid near = testing::random_grid(20, 16, 0.2, 5);
  Grid here(20, 16, 0.05), far(20, 16, 0.05, {500'000.3, 4'649'776.7});
  for (CellIndex at = 0; at < near.size(); ++at) {
    here.set_blocked(near.cell(at), near.all_blocked()[at] != 0);
    far.set_blocked(near.cell(at), near.all_blocked()[at] != 0);
  }
  std::uint64_t next = 0;
  const auto dice = [&next] { return next += 1'000'003; };
  for (int i = 0; i < 20; ++i) {
    const Cell start = testing::random_free_cell(here, dice), goal = testing::random_free_cell(here, dice);
    const Result one = plan(method(), problem_between(here, start, goal)), other = plan(method(), problem_between(far, start, goal));
    EXPECT_EQ(one.outcome, other.outcome) << name(other.outcome) << " " << other.refused;
    if (method().touch == Touch::kContact || method().knowledge == Knowledge::kFullMap) {
      EXPECT_NEAR(one.length_m, other.length_m, 1e-6);
    }
  }
}

TEST_P(EveryMethod, never_says_reached_where_there_is_no_way) {
  const std::vector<std::string_view> rows = {"........",
                                              ".####...",
                                              ".#.G#...",
                                              ".####..S",
                                              "........"};
  const Grid grid = testing::draw(rows);
  const Result result = plan(method(), problem_between(grid, testing::find(rows, 'S'), testing::find(rows, 'G')));
  EXPECT_TRUE(result.outcome == Outcome::kUnreachable || result.outcome == Outcome::kTrapped ||
              result.outcome == Outcome::kLimit)
      << name(result.outcome);
  EXPECT_EQ(result.outcome == Outcome::kLimit, !name(result.statistics.stop).empty()) << name(result.statistics.stop);
}

// Methods look every now and then, so the way is long: straight for those that a wall would trap, round one for those that follow it.
TEST_P(EveryMethod, that_is_cancelled_says_so) {
  const Grid lane(1500, 5);
  Grid wall(700, 9);
  for (std::int32_t x = 20; x < 680; ++x) wall.set_blocked({x, 4}, true);
  const Problem problem = method().touch == Touch::kContact ? problem_between(wall, {350, 1}, {350, 7})
                                                            : problem_between(lane, {2, 2}, {1497, 2});
  const std::atomic<bool> cancel = true;
  RunOptions run;
  run.cancel = &cancel;
  const Result result = plan(method(), problem, run);
  EXPECT_EQ(result.outcome, Outcome::kLimit) << name(result.outcome);
  EXPECT_EQ(result.statistics.stop, Stop::kCancelled) << name(result.statistics.stop);
}

TEST_P(EveryMethod, says_reached_or_unreachable_only_where_the_map_allows_it) {
  int with_way = 0, without = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Grid grid = testing::random_grid(14, 11, 0.25 + 0.005 * static_cast<double>(seed), seed);
    const auto labels = label_components(grid);
    std::uint64_t next = seed;
    const auto dice = [&next] { return next += 1'000'003; };
    const Cell start = testing::random_free_cell(grid, dice), goal = testing::random_free_cell(grid, dice);
    const bool has_way = labels[grid.index(start)] == labels[grid.index(goal)];
    ++(has_way ? with_way : without);
    const Result result = plan(method(), problem_between(grid, start, goal));
    EXPECT_NE(result.outcome, has_way ? Outcome::kUnreachable : Outcome::kReached) << "seed " << seed;
  }
  EXPECT_GT(with_way, 8);
  EXPECT_GT(without, 8);
}

// Whatever a method answers on random worlds: its path holds as far as it goes, and `plan` had nothing to refuse.
TEST_P(EveryMethod, makes_no_path_that_the_checker_refuses) {
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    const Grid grid = testing::random_grid(18, 14, 0.25, seed);
    const Cell from{static_cast<std::int32_t>(seed % 18), static_cast<std::int32_t>(seed % 14)};
    const Cell to{static_cast<std::int32_t>(seed * 7 % 18), static_cast<std::int32_t>(seed * 5 % 14)};
    if (grid.blocked(from) || grid.blocked(to)) continue;
    RunOptions run;
    run.seed = seed;
    const Result result = plan(method(), problem_between(grid, from, to), run);
    EXPECT_EQ(result.refused, "") << "seed " << seed;
    if (!result.path.empty()) {
      const auto objection = check_path(grid, result.path, method().touch);
      EXPECT_FALSE(objection) << "seed " << seed << ": " << objection->what << " at point " << objection->point;
    }
  }
}

TEST_P(EveryMethod, gives_the_same_path_again) {
  const auto& benchmark = testing::benchmarks()[0];
  const Scenario& row = benchmark.scenarios[70];
  const Problem problem = problem_between(benchmark.grid, row.start, row.goal);
  RunOptions run;
  run.seed = 42;
  const Result once = plan(method(), problem, run);
  const Result again = plan(method(), problem, run);
  EXPECT_EQ(once.outcome, again.outcome);
  EXPECT_EQ(once.path, again.path);
  EXPECT_EQ(once.statistics.steps, again.statistics.steps);
}

TEST(Methods, have_names_of_their_own_and_a_summary) {
  std::set<std::string_view> names;
  for (const Method& method : methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    EXPECT_EQ(find_method(method.name), &method);
    EXPECT_FALSE(method.summary.empty());
    EXPECT_NE(method.summary.back(), '.');
  }
  EXPECT_EQ(find_method("teleport"), nullptr);
}

Result run_through_the_wall(const Problem& problem, const RunOptions&) {
  Result result = ended(Outcome::kReached);
  result.path = {problem.start, problem.goal};
  return result;
}

TEST(Plan, takes_nobody_at_his_word) {
  const Grid grid = testing::draw({".#."});
  const Method liar{"liar", Knowledge::kFullMap, Touch::kApart, false, false, run_through_the_wall, nullptr, "lies"};
  const Result result = plan(liar, problem_between(grid, {0, 0}, {2, 0}));
  EXPECT_EQ(result.outcome, Outcome::kNumeric);
  EXPECT_FALSE(result.refused.empty());
}

TEST(Watch, stops_when_it_is_told_to_or_time_is_up) {
  std::atomic<bool> cancel = false;
  RunOptions run;
  run.cancel = &cancel;
  Watch told(run);
  EXPECT_FALSE(told.stopped_now());
  cancel = true;
  EXPECT_TRUE(told.stopped_now());
  EXPECT_EQ(told.why(), Stop::kCancelled);
  RunOptions brief;
  brief.budget = std::chrono::nanoseconds(1);
  Watch late(brief);
  int calls = 0;
  while (!late.stopped() && calls < 100000) ++calls;
  EXPECT_EQ(late.why(), Stop::kTime);
  EXPECT_LT(calls, 1000);
}

TEST(Watch, tells_what_is_left_for_a_part_of_the_computation) {
  EXPECT_EQ(Watch(RunOptions{}).left().count(), 0);
  RunOptions run;
  run.budget = std::chrono::hours(1);
  const Watch long_one(run);
  while (long_one.left() == run.budget) {}
  EXPECT_LT(long_one.left(), run.budget);
  EXPECT_GT(long_one.left(), std::chrono::minutes(1));
  run.budget = std::chrono::nanoseconds(1);
  const Watch late(run);
  while (!Watch(late).stopped_now()) {}
  EXPECT_EQ(late.left().count(), 1);   // 0 would be no limit
}

}  // namespace
}  // namespace kb::planners
