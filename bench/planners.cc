// What the planners cost: a field, a question, a step.
//
//   build/bench/bench/bench_planners
#include <benchmark/benchmark.h>

#include <array>

#include "planners/fairway.h"
#include "planners/fuzzy_rules.h"
#include "planners/neural.h"
#include "planners/potential.h"
#include "planners/shortest.h"
#include "tests/unit/planners/planning.h"

namespace {

using namespace kb::planners;
using kb::planners::testing::Benchmark;

const Benchmark& map_of(const benchmark::State& state) {
  return kb::planners::testing::benchmarks()[static_cast<std::size_t>(state.range(0))];
}

// An F4 field of the whole map; the counter is the time of one reached cell.
void neural_field(benchmark::State& state) {
  const Benchmark& map = map_of(state);
  const RunOptions run;
  std::size_t row = 0, cells = 0;
  for (auto _ : state) {
    Watch watch(run);
    const NeuralMap field = relax(map.grid, map.scenarios[row++ % map.scenarios.size()].goal, {}, watch);
    benchmark::DoNotOptimize(field.level.data());
    cells += field.updates;
  }
  state.SetLabel(map.name);
  state.counters["per_cell"] = benchmark::Counter(static_cast<double>(cells), benchmark::Counter::kIsRate |
                                                                                   benchmark::Counter::kInvert);
}
BENCHMARK(neural_field)->DenseRange(0, 3);

// All rows of a map in turn.
template <class Ask>
void ask_rows(benchmark::State& state, const Ask& ask) {
  const Benchmark& map = map_of(state);
  std::size_t row = 0;
  for (auto _ : state) benchmark::DoNotOptimize(ask(map.scenarios[row++ % map.scenarios.size()]));
  state.SetLabel(map.name);
}
void astar_query(benchmark::State& state) {
  Astar search(map_of(state).grid);
  ask_rows(state, [&](const Scenario& row) { return search.search(row.start, row.goal); });
}
void neural_query(benchmark::State& state) {
  NeuralQuery query(map_of(state).grid);
  ask_rows(state, [&](const Scenario& row) { return query.path(row.start, row.goal); });
}
void fairway_query(benchmark::State& state) {
  const Grid& grid = map_of(state).grid;
  ask_rows(state, [&](const Scenario& row) { return find_fairway(grid, row.start, row.goal); });
}
BENCHMARK(astar_query)->DenseRange(0, 3);
BENCHMARK(neural_query)->DenseRange(0, 3);
BENCHMARK(fairway_query)->DenseRange(0, 3);

// One decision of the 72 rules, of goals and sensor words in no order.
void fuzzy_decision(benchmark::State& state) {
  std::array<std::array<std::int32_t, 3>, 1024> inputs{};
  std::uint32_t dice = 1;
  for (auto& input : inputs) {
    for (std::int32_t& value : input) {
      dice = dice * 1664525u + 1013904223u;
      value = static_cast<std::int32_t>(dice >> 20) - 2048;
    }
  }
  std::size_t i = 0;
  for (auto _ : state) {
    const auto& [dx, dy, moves] = inputs[i++ % inputs.size()];
    benchmark::DoNotOptimize(fuzzy_move(dx, dy, static_cast<std::uint8_t>(moves & 0xFF)));
  }
}
BENCHMARK(fuzzy_decision);

// The force at a place between obstacles.
void potential_force(benchmark::State& state) {
  const Grid grid = kb::planners::testing::random_grid(64, 64, 0.1, 3);
  const GridClearance clearance(grid, 3.0);
  const PotentialField field(clearance, {60.0, 60.0}, 1.0, {});
  std::uint32_t dice = 1;
  for (auto _ : state) {
    dice = dice * 1664525u + 1013904223u;
    benchmark::DoNotOptimize(field.force({(dice >> 16 & 0xFFF) / 64.0, (dice >> 4 & 0xFFF) / 64.0}));
  }
}
BENCHMARK(potential_force);

}  // namespace

BENCHMARK_MAIN();
