#include "planners/neural.h"

#include <gtest/gtest.h>

#include <atomic>

#include "planners/shortest.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

using testing::draw;

NeuralMap relaxed(const Grid& grid, Cell goal, NeuralParameters parameters, const NeuralMap* old = nullptr) {
  const RunOptions run;
  Watch watch(run);
  return relax(grid, goal, parameters, watch, {}, old);
}

NeuralParameters form(NeuralForm which, double gamma = 0.5) {
  NeuralParameters parameters;
  parameters.form = which;
  parameters.gamma = gamma;
  return parameters;
}

// The ascent ends at the goal from every active cell.
void expect_no_false_peak(const Grid& grid, const NeuralMap& map, Cell goal, const std::string& what) {
  const auto peak = find_false_peak(grid, map, goal);
  EXPECT_FALSE(peak) << what << ": a false peak at " << peak->x << ", " << peak->y;
}

TEST(NeuralMap, of_the_maximum_rule_solves_every_published_row_exactly) {
  for (const auto& benchmark : testing::benchmarks()) {
    for (const Scenario& row : benchmark.scenarios) {
      Astar astar(benchmark.grid);
      static_cast<void>(astar.search(row.start, row.goal));
      for (const StopWhen stop : {StopWhen::kConverged, StopWhen::kStartActive}) {
        NeuralParameters parameters;
        parameters.stop = stop;
        const Result result = plan_neural(testing::problem_between(benchmark.grid, row.start, row.goal), parameters, {});
        ASSERT_EQ(result.outcome, Outcome::kReached);
        ASSERT_NEAR(result.length_m, astar.length(), 1e-9 * astar.length()) << benchmark.name << " line " << row.line;
      }
    }
  }
}

TEST(NeuralMap, of_the_maximum_rule_has_the_activity_that_its_gain_promises) {
  // F4's gain: a straight link costs 1 and a diagonal one sqrt(2) exactly.
  constexpr double kNeuralMaxGain = 0.43313636839134273;
  EXPECT_NEAR(kNeuralMaxGain, std::pow(2.0, -1.0 / (2.0 * (kSqrt2 - 1.0))), 1e-8);
  EXPECT_NEAR(kNeuralMaxGain / kSqrt2, std::pow(kNeuralMaxGain, kSqrt2), 1e-8);
  // y_i = max_j gamma w_ij y_j iterated to its fixed point is gamma^d.
  const Grid grid = testing::random_grid(9, 9, 0.2, 3);
  const Cell goal{0, 0};
  const NeuralMap map = relaxed(grid, goal, {});
  std::vector<double> y(grid.size(), 0.0);
  y[grid.index(goal)] = 1.0;
  const double gain = std::pow(2.0, -1.0 / (2.0 * (kSqrt2 - 1.0)));
  for (int sweep = 0; sweep < 81; ++sweep) {
    for (CellIndex at = 0; at < grid.size(); ++at) {
      for (std::size_t k = 0; k < 8; ++k) {
        if ((grid.all_moves()[at] >> k & 1) == 0) continue;
        const auto to = static_cast<CellIndex>(static_cast<std::int32_t>(at) + grid.steps()[k]);
        y[at] = std::max(y[at], gain / kMoveLengths[k] * y[to]);
      }
    }
  }
  for (CellIndex at = 0; at < grid.size(); ++at) EXPECT_NEAR(y[at], std::pow(gain, -map.level[at]), 1e-12);
}

TEST(NeuralMap, has_no_false_peak_for_any_gain_order_and_squash) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Grid grid = testing::random_grid(16, 12, 0.3, seed);
    const Cell goal{static_cast<std::int32_t>(seed % 16), 5};
    if (grid.blocked(goal)) continue;
    for (const NeuralForm which : {NeuralForm::kFixedGain, NeuralForm::kLogSum}) {
      for (const double gamma : {0.05, 0.5, 0.99}) {
        for (const UpdateOrder order : {UpdateOrder::kJacobi, UpdateOrder::kSweeps, UpdateOrder::kByDistance}) {
          NeuralParameters parameters = form(which, gamma);
          parameters.order = order;
          parameters.squash = seed % 2 == 0 ? Squash::kTanh : Squash::kLinear;
          parameters.self_weight = seed % 3 == 0 ? 0.0 : 1.0;
          expect_no_false_peak(grid, relaxed(grid, goal, parameters), goal, "seed " + std::to_string(seed));
        }
      }
    }
  }
}

// See note [an ascent that cannot be trapped]: also before it has converged.
TEST(NeuralMap, has_no_false_peak_after_any_number_of_sweeps) {
  const Grid grid = testing::random_grid(20, 20, 0.25, 2);
  const Cell goal{1, 1};
  for (std::uint32_t sweeps = 1; sweeps < 60; sweeps += 3) {
    for (const UpdateOrder order : {UpdateOrder::kJacobi, UpdateOrder::kSweeps}) {
      NeuralParameters parameters = form(NeuralForm::kFixedGain);
      parameters.order = order;
      parameters.max_sweeps = sweeps;
      expect_no_false_peak(grid, relaxed(grid, goal, parameters), goal, std::to_string(sweeps) + " sweeps");
    }
  }
}

TEST(NeuralMap, converges_to_one_equilibrium_whatever_the_order) {
  const Grid grid = testing::random_grid(14, 14, 0.2, 8);
  const Cell goal{3, 3};
  NeuralParameters parameters = form(NeuralForm::kFixedGain, 0.7);
  parameters.tolerance = 1e-12;
  parameters.max_sweeps = 2000;
  const NeuralMap by_distance = relaxed(grid, goal, parameters);
  parameters.order = UpdateOrder::kJacobi;
  const NeuralMap jacobi = relaxed(grid, goal, parameters);
  parameters.form = NeuralForm::kLogSum;
  const NeuralMap log = relaxed(grid, goal, parameters);
  for (CellIndex at = 0; at < grid.size(); ++at) {
    EXPECT_NEAR(by_distance.level[at], jacobi.level[at], 1e-10);
    if (jacobi.active(at)) {
      EXPECT_NEAR(log.level[at], std::log(jacobi.level[at]), 1e-8);
    }
  }
  EXPECT_LT(by_distance.sweeps, jacobi.sweeps);
}

// E = -1/2 sum w'_ij y_i y_j + sum y_i^2/2 falls with every single update (Glasius et al. 1995; linear g). Without a link to itself an
// update gives y_i the value at which E is least. So E falls with every sweep that updates one neuron after the other.
TEST(NeuralMap, never_gains_energy_when_neurons_are_updated_one_by_one) {
  const Grid grid = testing::random_grid(12, 9, 0.2, 4);
  const Cell goal{3, 3};
  NeuralParameters parameters = form(NeuralForm::kFixedGain, 0.9);
  parameters.self_weight = 0.0;
  parameters.tolerance = 0.0;
  const double gain = parameters.gamma / (4.0 + 4.0 / kSqrt2);
  const auto energy = [&](const std::vector<double>& y) {
    double e = 0.0;
    for (CellIndex at = 0; at < grid.size(); ++at) {
      double input = 0.0;
      for (std::size_t k = 0; k < 8; ++k) {
        if ((grid.all_moves()[at] >> k & 1) != 0) input += gain / kMoveLengths[k] * y[grid.neighbour(at, k)];
      }
      e += 0.5 * y[at] * y[at] - 0.5 * y[at] * input;
    }
    return e;
  };
  for (const UpdateOrder order : {UpdateOrder::kSweeps, UpdateOrder::kByDistance}) {
    parameters.order = order;
    double before = 0.5;   // of the goal alone
    for (std::uint32_t sweeps = 1; sweeps <= 12; ++sweeps) {
      parameters.max_sweeps = sweeps;
      const double after = energy(relaxed(grid, goal, parameters).level);
      EXPECT_LT(after, before) << sweeps << " sweeps";
      before = after;
    }
  }
}

const std::vector<std::string_view> kCorridorAndRoom = {"########...",
                                                        "G..........",
                                                        "########..S"};

TEST(LiteralNeuralMap, shines_brightest_in_a_room_far_from_the_goal) {
  const Grid grid = draw(kCorridorAndRoom);
  const Cell goal = testing::find(kCorridorAndRoom, 'G'), start = testing::find(kCorridorAndRoom, 'S');
  const NeuralMap map = relaxed(grid, goal, form(NeuralForm::kLiteral));
  ASSERT_TRUE(map.converged);
  EXPECT_LT(map.total, largest_row_sum(grid, 1.0));
  const auto peak = find_false_peak(grid, map, goal);
  ASSERT_TRUE(peak);
  EXPECT_EQ(*peak, (Cell{9, 1})) << "the middle of the room";
  EXPECT_EQ(ascend(grid, map, start).back(), *peak) << "the ascent is trapped there";
}

TEST(LiteralNeuralMap, is_replaced_and_told_where_it_would_trap) {
  for (const int side : {3, 5, 7}) {
    Grid grid(8 + side, side);
    for (std::int32_t x = 0; x < 8; ++x) {
      for (std::int32_t y = 0; y < side; ++y) grid.set_blocked({x, y}, y != side / 2);
    }
    const Result result =
        plan_neural(testing::problem_between(grid, {7 + side, 0}, {0, side / 2}), form(NeuralForm::kLiteral), {});
    EXPECT_EQ(result.outcome, Outcome::kReached) << "room " << side;
    const auto said = [&](std::string_view what) {
      for (const auto& [name, value] : result.statistics.more) {
        if (name == what) return value;
      }
      return -1.0;
    };
    EXPECT_EQ(said("switched to fixed gain"), 1.0);
    EXPECT_EQ(said("false peak"), 1.0);
    EXPECT_EQ(said("literal form trapped"), 1.0);
  }
}

TEST(LiteralNeuralMap, is_not_replaced_once_the_time_is_over) {
  const Grid grid(20, 20);
  const std::atomic<bool> cancel = true;
  RunOptions run;
  run.cancel = &cancel;
  const Result result = plan_neural(testing::problem_between(grid, {0, 0}, {19, 19}), form(NeuralForm::kLiteral), run);
  EXPECT_EQ(result.outcome, Outcome::kLimit);
  EXPECT_EQ(result.statistics.stop, Stop::kCancelled);
  EXPECT_EQ(result.statistics.more.size(), 1u) << "the residual, and nothing of another form";
}

TEST(LiteralNeuralMap, is_kept_in_open_space_where_its_sum_is_large_enough) {
  const Grid grid(20, 20);
  const NeuralMap map = relaxed(grid, {10, 10}, form(NeuralForm::kLiteral));
  EXPECT_TRUE(map.converged);
  EXPECT_GT(map.total, largest_row_sum(grid, 1.0));
  EXPECT_LT(map.total, 9.0);
  EXPECT_FALSE(find_false_peak(grid, map, {10, 10}));
}

TEST(LiteralNeuralMap, is_replaced_where_its_sum_is_just_the_largest_row_sum) {
  // Two cells: both neurons are equally active, and nothing leads from one to the other.
  const Grid grid(2, 1);
  const Problem problem = testing::problem_between(grid, {0, 0}, {1, 0});
  EXPECT_EQ(plan_neural(problem, form(NeuralForm::kLiteral), {}).outcome, Outcome::kReached);
}

TEST(FixedGainNeuralMap, says_numeric_where_its_activity_dies_and_never_goes_astray) {
  const Grid corridor(600, 1);
  const Problem problem = testing::problem_between(corridor, {599, 0}, {0, 0});
  EXPECT_EQ(plan_neural(problem, form(NeuralForm::kFixedGain), {}).outcome, Outcome::kNumeric);
  EXPECT_EQ(plan_neural(problem, form(NeuralForm::kLogSum), {}).outcome, Outcome::kReached);
  EXPECT_EQ(plan_neural(problem, {}, {}).outcome, Outcome::kReached);
  // 0.0694 a cell: the small root of l^2 - (W0/gamma - self) l + 1.
  const NeuralMap map = relaxed(corridor, {0, 0}, form(NeuralForm::kFixedGain));
  EXPECT_NEAR(map.level[corridor.index({51, 0})] / map.level[corridor.index({50, 0})], 0.0694, 1e-3);
}

TEST(NeuralMap, goes_on_from_an_old_field_when_an_obstacle_is_gone) {
  Grid grid = testing::random_grid(24, 24, 0.3, 6);
  const Cell goal{2, 2};
  grid.set_blocked(goal, false);
  NeuralParameters parameters = form(NeuralForm::kFixedGain);
  parameters.tolerance = 1e-11;
  const NeuralMap old = relaxed(grid, goal, parameters);
  for (std::int32_t x = 8; x < 12; ++x) grid.set_blocked({x, 9}, false);
  const NeuralMap warm = relaxed(grid, goal, parameters, &old), cold = relaxed(grid, goal, parameters);
  for (CellIndex at = 0; at < grid.size(); ++at) EXPECT_NEAR(warm.level[at], cold.level[at], 1e-9);
  EXPECT_LT(warm.sweeps, cold.sweeps);
}

TEST(NeuralMap, that_is_mended_is_the_one_computed_anew) {
  std::uint64_t changed = 0, all = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Grid grid = testing::random_grid(25, 25, 0.3, seed);
    const Cell goal{12, 12};
    grid.set_blocked(goal, false);
    NeuralMap map = relaxed(grid, goal, {});
    for (int i = 0; i < 40; ++i) {
      const Cell cell{static_cast<std::int32_t>((seed * 7 + static_cast<std::uint64_t>(i) * 13) % 25), i * 11 % 25};
      if (cell == goal) continue;
      grid.set_blocked(cell, grid.free(cell));
      changed += mend(grid, map, goal, cell);
      all += grid.free_cells();
      const NeuralMap fresh = relaxed(grid, goal, {});
      for (CellIndex at = 0; at < grid.size(); ++at) {
        ASSERT_EQ(map.active(at), fresh.active(at)) << "seed " << seed << " change " << i;
        if (map.active(at)) {
          ASSERT_NEAR(map.level[at], fresh.level[at], 1e-8);
        }
      }
    }
  }
  EXPECT_LT(changed, all / 4) << "mending is to be local";
}

// Work that does not depend on the size of the map: what is counted is what changes.
TEST(NeuralMap, that_is_mended_touches_only_cells_that_come_nearer) {
  const auto& maze = testing::benchmarks()[2];
  Grid grid = maze.grid;
  const Cell goal = maze.scenarios[0].goal;
  const NeuralMap old = relaxed(grid, goal, {});
  std::size_t mended = 0;
  for (CellIndex at = 0; at < grid.size(); at += 5) {
    const Cell cell = grid.cell(at);
    if (!grid.contains(cell) || grid.free(cell)) continue;
    grid.set_blocked(cell, false);
    NeuralMap map = old;
    const std::uint64_t said = mend(grid, map, goal, cell);
    const NeuralMap fresh = relaxed(grid, goal, {});
    std::uint64_t changed = 0;
    for (CellIndex i = 0; i < grid.size(); ++i) changed += fresh.active(i) && fresh.level[i] > old.level[i] + 1e-9 ? 1 : 0;
    EXPECT_EQ(said, changed) << cell.x << ", " << cell.y;
    grid.set_blocked(cell, true);
    ++mended;
  }
  EXPECT_GT(mended, 30u);
}

TEST(NeuralMap, that_stops_when_the_start_is_active_has_a_path_that_holds) {
  const auto& arena = testing::benchmarks()[0];
  for (std::size_t i = 0; i < arena.scenarios.size(); i += 9) {
    const Scenario& row = arena.scenarios[i];
    NeuralParameters parameters = form(NeuralForm::kFixedGain);
    parameters.stop = StopWhen::kStartActive;
    parameters.order = UpdateOrder::kJacobi;
    const Problem problem = testing::problem_between(arena.grid, row.start, row.goal);
    const Result result = plan_neural(problem, parameters, {});
    ASSERT_EQ(result.outcome, Outcome::kReached);
    EXPECT_FALSE(check_path(arena.grid, result.path, Touch::kApart, problem.start, problem.goal, 0.1));
  }
}

TEST(NeuralMap, refuses_parameters_out_of_range) {
  const Grid grid(3, 3);
  const Problem problem = testing::problem_between(grid, {0, 0}, {2, 2});
  for (const double gamma : {0.0, 1.0, -1.0, std::nan("")}) {
    EXPECT_EQ(plan_neural(problem, form(NeuralForm::kFixedGain, gamma), {}).fault, Fault::kBadParameter);
  }
}

}  // namespace
}  // namespace kb::planners
