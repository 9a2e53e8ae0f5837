// The genetic planner: legal walks after every operator, a fitness that never falls, good paths, moving obstacles.
#include "planners/genetic.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planners/check.h"
#include "planners/genetic_walks.h"
#include "planners/method.h"
#include "planners/space_time.h"
#include "tests/unit/planners/patrols.h"
#include "tests/unit/planners/planning.h"
#include "tests/unit/stride.h"

namespace kb::planners {
namespace {

using testing::problem_between;

// ---- operators

class Operators : public ::testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Genetic, Operators, ::testing::Bool(), [](const auto& param) {
  return param.param ? "with_waits" : "without_waits";
});

bool is_legal(const Grid& grid, const Walk& walk, bool waits) {
  for (std::size_t i = 0; i + 1 < walk.size(); ++i) {
    const int direction = testing::direction_between(grid.cell(walk[i]), grid.cell(walk[i + 1]));
    if (direction < 0 ? !waits || walk[i] != walk[i + 1] : !grid.can_move(grid.cell(walk[i]), direction)) return false;
  }
  return !walk.empty();
}

TEST_P(Operators, give_legal_walks_between_the_same_ends) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Grid grid = testing::random_grid(24, 17, 0.02 * static_cast<double>(seed % 16), seed);
    const auto labels = label_components(grid);
    Dice dice(seed);
    CellIndex from = 0, to = 0;
    while (from == to || labels[from] == 0 || labels[from] != labels[to]) {
      from = dice.below(grid.size());
      to = dice.below(grid.size());
    }
    WalkOperators operators(grid, GetParam());
    Walk a, b, child;
    ASSERT_TRUE(operators.walk(from, to, 0.1, 60'000, dice, a));
    ASSERT_TRUE(operators.walk(from, to, 0.4, 60'000, dice, b));
    const auto holds = [&](const Walk& walk, const char* after) {
      ASSERT_TRUE(is_legal(grid, walk, GetParam())) << "after " << after << ", seed " << seed;
      ASSERT_EQ(walk.front(), from) << after;
      ASSERT_EQ(walk.back(), to) << after;
    };
    for (int round = 0; round < 200; ++round) {
      operators.cross(a, b, dice, child);
      holds(child, "crossing");
      operators.mutate(child, dice);
      holds(child, "mutation");
      const std::size_t before = child.size();
      operators.straighten(child, dice);
      holds(child, "straightening");
      EXPECT_LE(child.size(), before);
      if (round % 3 == 0) {
        operators.erase_loops(child);
        holds(child, "smoothing");
      }
      (dice.below(2) == 0 ? a : b) = child;
    }
  }
}

TEST(Operators, smoothing_cuts_an_ell_into_a_diagonal) {
  const Grid grid(5, 5);
  WalkOperators operators(grid, false);
  Walk walk = {grid.index({1, 1}), grid.index({2, 1}), grid.index({2, 2}), grid.index({3, 2})};
  EXPECT_TRUE(operators.erase_loops(walk));
  EXPECT_EQ(walk, (Walk{grid.index({1, 1}), grid.index({2, 2}), grid.index({3, 2})}));
}

TEST(Operators, directions_are_those_of_moves) {
  const Grid grid(4, 4);
  const WalkOperators operators(grid, true);
  for (int k = 0; k < 8; ++k) {
    EXPECT_EQ(operators.direction(grid.index({1, 1}), grid.index(Cell{1, 1} + kDirections[static_cast<std::size_t>(k)])), k);
  }
  EXPECT_EQ(operators.direction(grid.index({1, 1}), grid.index({1, 1})), 8);
}

// ---- the planner

TEST(Genetic, finds_short_paths_on_the_benchmarks) {
  for (const auto& benchmark : testing::benchmarks()) {
    double sum = 0.0;
    int rows = 0;
    for (std::size_t i = 0; i < benchmark.scenarios.size(); i += 9 * kb::testing::stride()) {
      const Scenario& row = benchmark.scenarios[i];
      const GeneticReport report = evolve(problem_between(benchmark.grid, row.start, row.goal), {});
      ASSERT_EQ(report.result.outcome, Outcome::kReached) << benchmark.name << " line " << row.line;
      EXPECT_TRUE(std::is_sorted(report.best_fitness.begin(), report.best_fitness.end()));
      if (row.optimum == 0.0) continue;
      sum += report.result.length_m / row.optimum;
      ++rows;
    }
    EXPECT_LE(sum / rows, 1.002) << benchmark.name;
  }
}

TEST(Genetic, gives_the_same_path_for_the_same_seed_only) {
  const auto& den = testing::benchmarks()[1];
  const Scenario& row = den.scenarios[250];
  const Problem problem = problem_between(den.grid, row.start, row.goal);
  RunOptions run;
  const GeneticReport one = evolve(problem, run), same = evolve(problem, run);
  EXPECT_EQ(one.result.path, same.result.path);
  EXPECT_EQ(one.best_fitness, same.best_fitness);
  run.seed = 2;
  EXPECT_NE(evolve(problem, run).best_fitness, one.best_fitness);
}

// Darintsev and Migranov, figures 1b and 1c: the genetic path may take a few steps more than the neural map's, for it looks
// for smoothness as well.
TEST(Genetic, trades_length_for_smoothness_if_it_is_told_to) {
  double plain = 0.0, balanced = 0.0;
  const auto& den = testing::benchmarks()[1];
  for (std::size_t i = 0; i < den.scenarios.size(); i += 15) {
    const Scenario& row = den.scenarios[i];
    if (row.optimum < 1.0) continue;
    const Problem problem = problem_between(den.grid, row.start, row.goal);
    plain += evolve(problem, {}).result.length_m / row.optimum;
    balanced += evolve(problem, {}, {.weights = kBalancedWeights}).result.length_m / row.optimum;
  }
  EXPECT_GT(balanced, plain);
  EXPECT_LT(balanced, 1.1 * plain);
}

TEST(Genetic, measures_turns_against_a_wanted_course_if_there_is_one) {
  const Grid grid(30, 9);
  const Problem problem = problem_between(grid, {2, 4}, {26, 4});
  const auto best = [&](double course_rad) {
    return evolve(problem, {}, {.weights = {0.5, 0.4, 0.0, 0.0, 0.1}, .course_rad = course_rad}).best_fitness.back();
  };
  EXPECT_DOUBLE_EQ(best(0.0), 1.0);                  // straight along the course
  EXPECT_LT(best(kPi / 4.0), 0.8);
  EXPECT_LT(best(kPi), best(kPi / 4.0));             // against it
}

TEST(Genetic, refuses_weights_that_do_not_add_up) {
  const Grid grid(5, 5);
  const Problem problem = problem_between(grid, {0, 0}, {4, 4});
  EXPECT_EQ(evolve(problem, {}, {.weights = {0.5, 0.0, 0.0, 0.0, 0.0}}).result.fault, Fault::kBadParameter);
  EXPECT_EQ(evolve(problem, {}, {.population = 1}).result.fault, Fault::kBadParameter);
  EXPECT_EQ(evolve(problem, {}, {.mutation_chance = std::nan("")}).result.fault, Fault::kBadParameter);
}

TEST(Genetic, stops_when_it_is_told_to_and_keeps_the_best_so_far) {
  const auto& den = testing::benchmarks()[1];
  const Scenario& row = den.scenarios.back();
  const Problem problem = problem_between(den.grid, row.start, row.goal);
  RunOptions run;
  run.budget = std::chrono::milliseconds(1);
  const GeneticReport report = evolve(problem, run, {.population = 2000});
  EXPECT_EQ(report.result.outcome, Outcome::kLimit);
  EXPECT_EQ(report.result.statistics.stop, Stop::kTime);
}

TEST(Genetic, ends_with_a_fitness_that_is_good_enough_or_after_generations_without_a_better_one) {
  const Grid corridor(6, 1);   // there is one walk only
  const Problem problem = problem_between(corridor, {0, 0}, {5, 0});
  EXPECT_EQ(evolve(problem, {}, {.stagnation = 3, .target = 0.1}).best_fitness.size(), 1u);
  EXPECT_EQ(evolve(problem, {}, {.stagnation = 3, .target = 2.0}).best_fitness.size(), 1u + 3u);
}

// ---- moving obstacles

TEST(SpaceTimeSearch, arrives_as_early_as_an_exhaustive_search) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const Grid grid = testing::random_grid(9, 8, 0.15, seed);
    const Cell from{0, 0}, to{8, 7};
    if (grid.blocked(from) || grid.blocked(to)) continue;
    const auto labels = label_components(grid);
    if (labels[grid.index(from)] != labels[grid.index(to)]) continue;
    const Movers movers = testing::make_patrols(grid, 6, 16, from, seed);
    // Which cells can be held at each step.
    std::vector<std::uint8_t> now(grid.size(), 0);
    now[grid.index(from)] = 1;
    std::size_t steps = 0;
    for (; steps <= 200 && now[grid.index(to)] == 0; ++steps) {
      std::vector<std::uint8_t> next(grid.size(), 0);
      for (CellIndex i = 0; i < grid.size(); ++i) {
        if (now[i] == 0) continue;
        const Cell here = grid.cell(i);
        if (!movers.taken(here, steps + 1)) next[i] = 1;
        for (int k = 0; k < 8; ++k) {
          const Cell there = here + kDirections[static_cast<std::size_t>(k)];
          if (grid.can_move(here, k) && !movers.taken(there, steps + 1) && !movers.swaps(here, there, steps)) {
            next[grid.index(there)] = 1;
          }
        }
      }
      now = next;
    }
    const auto walk = search_space_time(grid, movers, {.from = from, .to = to}, steps_to(grid, to));
    if (steps > 200) {
      EXPECT_TRUE(walk.empty());
      continue;
    }
    ASSERT_EQ(walk.size(), steps + 1) << "seed " << seed;
    EXPECT_FALSE(check_walk(grid, &movers, walk));
  }
}

TEST(SpaceTimeSearch, waits_until_the_goal_is_free_for_good) {
  const Grid grid(6, 1);
  const Movers nobody(grid, 1);
  const auto walk = search_space_time(grid, nobody, {.from = {0, 0}, .to = {5, 0}, .earliest_arrival = 9},
                                      steps_to(grid, {5, 0}));
  ASSERT_EQ(walk.size(), 10u);
  EXPECT_EQ(walk.back(), (Cell{5, 0}));
}

TEST(Genetic, waits_until_the_goal_is_free_for_good) {
  const Grid grid(6, 1);
  const Movers nobody(grid, 1);
  Problem problem = problem_between(grid, {0, 0}, {5, 0});
  problem.movers = &nobody;
  const GeneticReport report = evolve(problem, {}, {.earliest_arrival = 9});
  ASSERT_EQ(report.result.outcome, Outcome::kReached);
  EXPECT_GE(report.result.path.size(), 10u);
}

// On arena with 40 patrols: arrival within 5 % of space-time A* in the median, 98 % feasible, never a collision.
TEST(Genetic, gets_through_moving_obstacles) {
  const auto& arena = testing::benchmarks()[0];
  std::vector<double> ratios;
  int asked = 0;
  for (std::size_t i = 20; i < arena.scenarios.size(); i += 3) {
    const Scenario& row = arena.scenarios[i];
    const Movers movers = testing::make_patrols(arena.grid, 40, 120, row.start, i);
    Problem problem = problem_between(arena.grid, row.start, row.goal);
    problem.movers = &movers;
    const auto reference =
        search_space_time(arena.grid, movers, {.from = row.start, .to = row.goal}, steps_to(arena.grid, row.goal));
    ASSERT_FALSE(reference.empty());
    ++asked;
    const Result result = plan(*find_method("genetic"), problem);
    ASSERT_EQ(result.refused, "");
    if (result.outcome != Outcome::kReached) continue;
    ASSERT_FALSE(check_walk(arena.grid, &movers, testing::cells_of(arena.grid, result)));
    ratios.push_back(static_cast<double>(result.path.size() - 1) / static_cast<double>(reference.size() - 1));
  }
  EXPECT_GE(static_cast<double>(ratios.size()), 0.98 * asked);
  std::sort(ratios.begin(), ratios.end());
  EXPECT_LE(ratios[ratios.size() / 2], 1.05);
  EXPECT_GE(ratios.front(), 1.0);
}

// In a corridor there is one walk of 5 steps, which is as fit as can be but for the mover that it goes through.
TEST(Genetic, is_not_content_with_a_fit_walk_through_somebody) {
  const Grid corridor(6, 1);
  Movers movers(corridor, 20);
  std::vector<Cell> route(8, {3, 0});
  route.resize(20, {-1, -1});   // gone
  movers.add(route);
  Problem problem = problem_between(corridor, {0, 0}, {5, 0});
  problem.movers = &movers;
  const GeneticReport report = evolve(problem, {}, {.target = 0.9});
  ASSERT_EQ(report.result.outcome, Outcome::kReached) << name(report.result.outcome);
  EXPECT_FALSE(check_walk(corridor, &movers, testing::cells_of(corridor, report.result)));
  EXPECT_GT(report.result.statistics.steps, 0u);
}

// A mover goes to and fro in the only corridor; the robot has to stand aside in the bay.
TEST(Genetic, waits_in_a_bay_for_somebody_to_pass) {
  const std::vector<std::string_view> rows = {"####.####",
                                              "........."};
  const Grid grid = testing::draw(rows);
  Movers movers(grid, 18);
  std::vector<Cell> route;
  for (int t = 0; t < 9; ++t) route.push_back({8 - t, 0});
  for (int t = 0; t < 9; ++t) route.push_back({-1, -1});  // gone
  movers.add(route);
  Problem problem = problem_between(grid, {1, 0}, {7, 0});
  problem.movers = &movers;
  const GeneticReport report = evolve(problem, {});
  ASSERT_EQ(report.result.outcome, Outcome::kReached);
  const auto cells = testing::cells_of(grid, report.result);
  EXPECT_FALSE(check_walk(grid, &movers, cells));
  EXPECT_TRUE(std::find(cells.begin(), cells.end(), Cell{4, 1}) != cells.end());
}

}  // namespace
}  // namespace kb::planners
