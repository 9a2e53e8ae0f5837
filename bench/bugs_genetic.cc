// Times of the bug methods, the genetic planner, and groups. Lengths and counts are measured by measure_bugs.cc.
//
//   Genetic/den312d            one query: the row is another one at each iteration, so the mean is over rows
//   Groups/genetic/n           a plan for n robots at once on arena; 100 ms is 10 Hz
//   SwarmStep/threads          one tick of a million robots by the 72 rules on 2048 x 2048 cells
#include <benchmark/benchmark.h>

#include "planners/bug.h"
#include "planners/dice.h"
#include "planners/fuzzy_rules.h"
#include "planners/genetic.h"
#include "planners/group.h"
#include "planners/movers.h"
#include "planners/space_time.h"
#include "planners/swarm.h"
#include "tests/unit/planners/meetings.h"
#include "tests/unit/planners/patrols.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

Problem row_of(const testing::Benchmark& map, std::size_t i) {
  const Scenario& row = map.scenarios[i * 7 % map.scenarios.size()];
  return testing::problem_between(map.grid, row.start, row.goal);
}

template <typename Solve>
void over_rows(benchmark::State& state, std::size_t map_number, const Solve& solve) {
  const testing::Benchmark& map = testing::benchmarks()[map_number];
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(solve(row_of(map, i++)));
}

void genetic(benchmark::State& state, std::size_t map) {
  over_rows(state, map, [](const Problem& problem) { return evolve(problem, {}).result.length_m; });
}
BENCHMARK_CAPTURE(genetic, arena, 0u)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(genetic, den312d, 1u)->Unit(benchmark::kMillisecond);

void genetic_among_patrols(benchmark::State& state) {
  const testing::Benchmark& arena = testing::benchmarks()[0];
  const Movers movers = testing::make_patrols(arena.grid, 40, 120, {-1, -1}, 1);
  over_rows(state, 0, [&](Problem problem) {
    problem.movers = &movers;
    return evolve(problem, {}).result.length_m;
  });
}
BENCHMARK(genetic_among_patrols)->Unit(benchmark::kMillisecond);

void bug(benchmark::State& state, Result (*method)(const Problem&, const RunOptions&, const BugOptions&), std::size_t map) {
  over_rows(state, map, [method](const Problem& problem) { return method(problem, {}, {}).length_m; });
}
BENCHMARK_CAPTURE(bug, bug1_den312d, &bug1, 1u)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bug, bug2_den312d, &bug2, 1u)->Unit(benchmark::kMicrosecond);
BENCHMARK_CAPTURE(bug, modified_den312d, &modified_bug, 1u)->Unit(benchmark::kMicrosecond);

// Distinct free cells of the largest part of the map.
std::vector<Cell> draw_cells(const Grid& grid, std::size_t count, Dice& dice) {
  const auto labels = label_components(grid);
  std::vector<bool> used(grid.size(), false);
  std::vector<Cell> cells;
  while (cells.size() < count) {
    const CellIndex at = dice.below(grid.size());
    if (labels[at] != 1 || used[at]) continue;
    used[at] = true;
    cells.push_back(grid.cell(at));
  }
  return cells;
}

void groups(benchmark::State& state, GroupPlanner planner) {
  const Grid& grid = testing::benchmarks()[0].grid;
  const auto robots = static_cast<std::size_t>(state.range(0));
  GroupOptions options;
  options.planner = planner;
  // On the way, not for ever: quick plans instead of the best.
  options.genetic.population = 20;
  options.genetic.stagnation = 5;
  std::uint64_t seed = 0, solved = 0, conflicts = 0;
  for (auto _ : state) {
    Dice dice(++seed);
    GroupProblem problem;
    problem.grid = &grid;
    problem.starts = draw_cells(grid, robots, dice);
    problem.goals = draw_cells(grid, robots, dice);
    const GroupResult result = plan_group(problem, {}, options);
    solved += result.outcome == Outcome::kReached ? 1 : 0;
    conflicts += testing::count_conflicts(grid, result.walks);
  }
  state.counters["solved"] = static_cast<double>(solved) / static_cast<double>(seed);
  state.counters["conflicts"] = static_cast<double>(conflicts);
}
BENCHMARK_CAPTURE(groups, genetic, GroupPlanner::kGenetic)->Arg(10)->Arg(50)->Arg(60)->Arg(70)->Arg(80)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(groups, neural, GroupPlanner::kNeural)->Arg(10)->Arg(100)->Arg(125)->Arg(150)->Arg(175)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(groups, space_time, GroupPlanner::kSpaceTime)->Arg(100)->Arg(200)->Arg(400)->Unit(benchmark::kMillisecond);

void swarm_step(benchmark::State& state) {
  constexpr std::int32_t kSide = 2048;
  Grid grid(kSide, kSide);
  Dice dice(3);
  const auto draw = [&] { return Cell{static_cast<std::int32_t>(dice.below(kSide)), static_cast<std::int32_t>(dice.below(kSide))}; };
  for (int i = 0; i < kSide * kSide / 100; ++i) grid.set_blocked(draw(), true);
  std::vector<bool> used(grid.size(), false);
  std::vector<Swarm::Robot> robots;
  const auto count = static_cast<std::size_t>(state.range(0));
  while (robots.size() < count) {
    const Cell at = draw(), goal = draw();
    if (grid.blocked(at) || grid.blocked(goal) || used[grid.index(at)]) continue;
    used[grid.index(at)] = true;
    robots.push_back({at, goal});
  }
  Swarm swarm(grid, kFuzzyTable, robots);
  std::size_t moved = 0;
  for (auto _ : state) moved += swarm.step(static_cast<unsigned>(state.range(1)));
  state.counters["moved"] = static_cast<double>(moved) / (static_cast<double>(count) * static_cast<double>(state.iterations()));
  state.counters["robots/s"] = benchmark::Counter(static_cast<double>(count), benchmark::Counter::kIsIterationInvariantRate);
}
BENCHMARK(swarm_step)->Args({1'000, 1})->Args({100'000, 1})->Args({1'000'000, 1})->Args({3'000'000, 1})->Unit(benchmark::kMillisecond);
BENCHMARK(swarm_step)->Args({1'000'000, 2})->UseRealTime()->MeasureProcessCPUTime()->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace kb::planners

BENCHMARK_MAIN();
