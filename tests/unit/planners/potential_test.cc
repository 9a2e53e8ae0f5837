#include "planners/potential.h"

#include <gtest/gtest.h>

#include <random>

#include "planners/trap.h"
#include "planners/well.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

constexpr double kPerMille = 1e-3;   // what is allowed against a closed form, as a share

PotentialParameters parameters_of(Attraction attraction, double gain = 1.0) {
  PotentialParameters parameters;
  parameters.attraction = attraction;
  parameters.gain = gain;
  return parameters;
}

// Free space round the origin, in cells of a metre; the goal is its middle.
const Grid& space() {
  static const Grid grid(4000, 9, 1.0, {-10.0, -4.5});
  return grid;
}

double arrival_s(const PotentialParameters& parameters, double from_m, double tolerance_m, DriveParameters how) {
  const ShapeClearance nothing;
  Problem problem;
  problem.grid = &space();
  problem.start = {from_m, 0.0};
  problem.goal = {0.0, 0.0};
  problem.goal_tolerance_cells = tolerance_m;
  const PotentialField field(nothing, problem.goal, 1.0, parameters);
  const Result result = drive_by_potential(field, problem, how, {});
  EXPECT_EQ(result.outcome, Outcome::kReached);
  // To the instant at which the tolerance is crossed.
  const std::size_t n = result.path.size();
  const double before = norm(result.path[n - 2]), after = norm(result.path[n - 1]);
  const double share = (before - tolerance_m) / (before - after);
  return result.times_s[n - 2] + share * (result.times_s[n - 1] - result.times_s[n - 2]);
}

DriveParameters fine() {
  DriveParameters how;
  how.step_s = 1e-3;
  how.step_cells = 1.0;
  how.max_steps = 10'000'000;
  how.diagnose = false;
  return how;
}

TEST(Potential, takes_a_kinematic_robot_home_in_the_time_of_the_closed_form) {
  for (const double d : {10.0, 100.0}) {
    const double e = 0.1;
    EXPECT_NEAR(arrival_s(parameters_of(Attraction::kParabolic), d, e, fine()) / std::log(d / e), 1.0, kPerMille);
    EXPECT_NEAR(arrival_s(parameters_of(Attraction::kConic), d, e, fine()) / (d - e), 1.0, kPerMille);
    EXPECT_NEAR(arrival_s(parameters_of(Attraction::kCombined), d, e, fine()) / ((d - 1.0) + std::log(1.0 / e)), 1.0,
                kPerMille);
  }
}

TEST(Potential, of_the_parabola_slows_down_at_the_end_of_the_route) {
  // Equal top speed k_c = k_a D: the parabolic robot takes ln(D/e)/(1 - e/D) times as long; 4.65 for D/e = 100.
  const double d = 100.0, e = 1.0;
  const double parabolic = arrival_s(parameters_of(Attraction::kParabolic, 1.0), d, e, fine());
  const double conic = arrival_s(parameters_of(Attraction::kConic, d), d, e, fine());
  EXPECT_NEAR(parabolic / conic, std::log(d / e) / (1.0 - e / d), 4.65 * kPerMille);
}

TEST(Potential, takes_a_mass_without_friction_home_in_the_time_of_the_closed_form) {
  DriveParameters how = fine();
  how.drive = Drive::kDynamic;
  how.damping = 0.0;
  how.step_s = 1e-4;   // at 100 m/s a longer step would pass over the goal
  for (const double d : {10.0, 100.0}) {
    // First arrival at the goal itself; the tolerance is crossed a little before: at cos(t) = e/d, at v^2/2 = k (d - e).
    const double e = 0.05;
    EXPECT_NEAR(arrival_s(parameters_of(Attraction::kParabolic), d, e, how) / std::acos(e / d), 1.0, kPerMille);
    EXPECT_NEAR(arrival_s(parameters_of(Attraction::kConic), d, e, how) / std::sqrt(2.0 * (d - e)), 1.0, kPerMille);
  }
}

// Head-on against a long wall the robot stops where attraction and repulsion balance.
double balance_m(Attraction attraction, double goal_m) {
  ShapeClearance wall;
  wall.add_segment({0.0, -1e6}, {0.0, 1e6});
  const PotentialField field(wall, {goal_m, 0.0}, 1.0, parameters_of(attraction));
  double low = 0.051, high = 2.999;   // force towards the wall at `high`, away from it at `low`
  for (int i = 0; i < 200; ++i) {
    const double middle = 0.5 * (low + high);
    (field.force({-middle, 0.0}).x > 0.0 ? high : low) = middle;
  }
  return low;
}

TEST(Potential, of_the_cone_balances_at_one_distance_from_a_wall) {
  for (const double d : {10.0, 100.0, 1000.0}) EXPECT_NEAR(balance_m(Attraction::kConic, d), 0.5, 0.005);
}

TEST(Potential, of_the_parabola_presses_the_robot_against_the_wall_from_afar) {
  EXPECT_LT(balance_m(Attraction::kParabolic, 100.0), 0.6 * balance_m(Attraction::kParabolic, 10.0));
}

TEST(Potential, has_the_force_as_its_gradient) {
  ShapeClearance shapes;
  shapes.add_disc({4.0, 1.0}, 1.0);
  shapes.add_polygon({{-3.0, -3.0}, {-1.0, -3.0}, {-2.0, -1.5}});
  std::mt19937_64 dice(5);
  const auto random = [&] { return -6.0 + 12.0 * static_cast<double>(dice() >> 11) * 0x1p-53; };
  for (const Attraction attraction : {Attraction::kParabolic, Attraction::kConic, Attraction::kCombined}) {
    for (const bool scaled : {false, true}) {
      PotentialParameters parameters = parameters_of(attraction);
      parameters.goal_scaled = scaled;
      const PotentialField field(shapes, {0.5, 0.5}, 1.0, parameters);
      for (int i = 0; i < 400; ++i) {
        const Point q{random(), random()};
        if (field.nearest(q).distance_m < 0.2 || distance(q, {0.5, 0.5}) < 0.1) continue;
        const double h = 1e-6;
        const Point slope{(field.potential(q + Point{h, 0}) - field.potential(q - Point{h, 0})) / (2 * h),
                          (field.potential(q + Point{0, h}) - field.potential(q - Point{0, h})) / (2 * h)};
        const Point force = field.force(q);
        EXPECT_LT(norm(slope + force), 1e-4 * (1.0 + norm(force))) << q.x << ", " << q.y;
      }
    }
  }
}

TEST(Potential, of_both_kinds_is_joined_without_a_jump) {
  const ShapeClearance nothing;
  const PotentialField ours(nothing, {}, 1.0, [] {
    PotentialParameters parameters = parameters_of(Attraction::kCombined);
    parameters.near_m = 2.0;
    return parameters;
  }());
  EXPECT_NEAR(ours.potential({2.0 - 1e-9, 0.0}), ours.potential({2.0 + 1e-9, 0.0}), 1e-7);
  EXPECT_NEAR(norm(ours.force({2.0 - 1e-9, 0.0})), norm(ours.force({2.0 + 1e-9, 0.0})), 1e-7);
  const PotentialField printed(nothing, {}, 1.0, [] {
    PotentialParameters parameters = parameters_of(Attraction::kCombinedLiteral);
    parameters.near_m = 2.0;
    return parameters;
  }());
  EXPECT_GT(std::abs(printed.potential({2.0 - 1e-9, 0.0}) - printed.potential({2.0 + 1e-9, 0.0})), 0.9) << "as printed";
}

// v^2/2 + U at every step, past a disc that pushes the mass off its straight way.
TEST(Potential, without_friction_keeps_its_energy) {
  ShapeClearance disc;
  disc.add_disc({1.5, 0.0}, 0.3);
  Problem problem;
  problem.grid = &space();
  problem.start = {3.0, 1.0};
  problem.goal_tolerance_cells = 0.05;
  const PotentialField field(disc, problem.goal, 1.0, parameters_of(Attraction::kParabolic));
  DriveParameters how = fine();
  how.drive = Drive::kDynamic;
  how.damping = 0.0;
  how.max_steps = 10'000;
  const Result result = drive_by_potential(field, problem, how, {});
  ASSERT_GT(result.path.size(), 1000u);
  const double before = field.potential(problem.start);
  for (std::size_t i = 1; i < result.path.size(); ++i) {
    const Point &from = result.path[i - 1], &to = result.path[i];
    const double speed = distance(from, to) / (result.times_s[i] - result.times_s[i - 1]);   // in the middle of the step
    ASSERT_NEAR((0.5 * speed * speed + 0.5 * (field.potential(from) + field.potential(to))) / before, 1.0, 1e-3) << "step " << i;
  }
}

TEST(GridClearance, is_the_distance_to_the_nearest_square) {
  const Grid grid = testing::random_grid(14, 11, 0.15, 6);
  const GridClearance clearance(grid, 3.0);
  std::mt19937_64 dice(5);
  for (int i = 0; i < 4000; ++i) {
    const Point q{14.0 * static_cast<double>(dice() >> 11) * 0x1p-53, 11.0 * static_cast<double>(dice() >> 11) * 0x1p-53};
    double least = 1e9;
    for (std::int32_t y = -1; y <= 11; ++y) {
      for (std::int32_t x = -1; x <= 14; ++x) {
        if (grid.free({x, y})) continue;
        least = std::min(least, std::hypot(q.x - std::clamp(q.x, x * 1.0, x + 1.0), q.y - std::clamp(q.y, y * 1.0, y + 1.0)));
      }
    }
    const double seen = clearance.nearest(q).distance_m;
    if (least <= 3.0) {
      EXPECT_NEAR(seen, least, 1e-12);
    } else {
      EXPECT_TRUE(std::isinf(seen));
    }
  }
}

// The side is a power of two, so that not even rounding tells one scale from the other.
TEST(Potential, drives_over_small_cells_as_over_cells_of_a_metre) {
  constexpr double kSide = 1.0 / 32.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Grid grid = testing::random_grid(24, 20, 0.12, seed);
    Grid small(24, 20, kSide);
    for (std::int32_t y = 0; y < 20; ++y) {
      for (std::int32_t x = 0; x < 24; ++x) small.set_blocked({x, y}, grid.blocked({x, y}));
    }
    std::mt19937_64 dice(seed);
    const Cell from = testing::random_free_cell(grid, dice), to = testing::random_free_cell(grid, dice);
    for (const std::string_view name : {"potential", "potential-parabolic", "potential-combined", "potential-dynamic", "two-maps"}) {
      const Result one = plan(*find_method(name), testing::problem_between(grid, from, to));
      const Result other = plan(*find_method(name), testing::problem_between(small, from, to));
      ASSERT_EQ(one.outcome, other.outcome) << name << " seed " << seed;
      ASSERT_EQ(one.path.size(), other.path.size()) << name << " seed " << seed;
      EXPECT_EQ(one.length_m, 32.0 * other.length_m) << name << " seed " << seed;
      EXPECT_EQ(one.trap.kind, other.trap.kind) << name << " seed " << seed;
      EXPECT_EQ(one.times_s.empty() ? 0.0 : one.times_s.back(), other.times_s.empty() ? 0.0 : 32.0 * other.times_s.back());
    }
  }
}

TEST(Trap, is_no_slow_corridor) {
  for (const int width : {1, 2, 3}) {
    for (const std::int32_t cells : {50, 300, 1000}) {
      Grid grid(cells + 10, 7);
      for (std::int32_t x = 8; x < cells; ++x) {
        for (std::int32_t y = 0; y < 7; ++y) grid.set_blocked({x, y}, y < 3 || y >= 3 + width);
      }
      for (const std::string_view name : {"potential", "potential-parabolic", "potential-combined", "potential-dynamic"}) {
        for (const Cell to : {Cell{cells - 2, 3 + width / 2}, Cell{cells + 7, 3}}) {   // in the corridor, and behind it
          const Result result = plan(*find_method(name), testing::problem_between(grid, {2, 3}, to));
          EXPECT_EQ(result.outcome, Outcome::kReached) << name << " width " << width << " to " << to.x << ": " << kb::planners::name(result.outcome)
                                                       << " " << kb::planners::name(result.trap.kind);
        }
      }
    }
  }
}

// Also where a robot creeps: a goal just behind the corridor's end, and a goal so far away that the parabolic pull is weak.
TEST(Well, is_no_corridor_no_slope_and_not_the_goal_s) {
  for (const int width : {1, 2, 3}) {
    Grid grid(60, 7);
    for (std::int32_t x = 8; x < 52; ++x) {
      for (std::int32_t y = 0; y < 7; ++y) grid.set_blocked({x, y}, y < 3 || y >= 3 + width);
    }
    const GridClearance clearance(grid, 3.0);
    const Problem problem = testing::problem_between(grid, {2, 3}, {57, 3});
    for (const Attraction attraction : {Attraction::kConic, Attraction::kCombined}) {
      const PotentialField field(clearance, problem.goal, 1.0, parameters_for(problem, attraction));
      const WellProbe probe(field, 1.0, 0.5);
      for (double x = 9.0; x < 57.4; x += 0.25) {
        const Point q{x, 3.0 + 0.5 * width};
        EXPECT_FALSE(probe.is_closed(q, field.potential(q))) << width << ", " << x;
      }
    }
  }
}

// Before a wall lies one; a mass that is fast enough leaves it.
TEST(Well, holds_a_robot_by_its_energy) {
  Grid grid(30, 21);
  grid.set_blocked({15, 10}, true);
  grid.set_blocked({15, 11}, true);
  const GridClearance clearance(grid, 3.0);
  const Problem problem = testing::problem_between(grid, {4, 10}, {26, 10});
  const PotentialField field(clearance, problem.goal, 1.0, {});
  const WellProbe probe(field, 1.0, 0.5);
  const Point rest{14.5, 10.5};
  EXPECT_TRUE(probe.is_closed(rest, field.potential(rest)));
  EXPECT_FALSE(probe.is_closed(rest, field.potential(rest) + 1.0));
  const Result result = plan(*find_method("potential-dynamic"), problem);
  ASSERT_EQ(result.outcome, Outcome::kTrapped);
  // Two windows of 12 s after it came to the wall at the latest.
  std::size_t since = result.path.size() - 1;
  while (since > 0 && distance(result.path[since], result.trap.at) < 1.5) --since;
  EXPECT_LT(result.trap.time_s - result.times_s[since], 24.0);
}

// Who crosses a saddle slowly is not caught: before a disc, just off the line through its middle. The weaker the pull, the slower.
TEST(Trap, is_no_saddle) {
  const Grid grid(30, 21);
  ShapeClearance disc;
  disc.add_disc({15.0, 10.5}, 1.0);
  for (const double off : {1e-3, 1e-6}) {
    Problem problem = testing::problem_between(grid, {4, 10}, {26, 10});
    problem.start.y += off;
    for (const double gain : {1.0, 0.01}) {
      const PotentialField field(disc, problem.goal, 1.0, parameters_of(Attraction::kConic, gain));
      for (const Drive drive : {Drive::kKinematic, Drive::kDynamic}) {
        DriveParameters how;
        how.drive = drive;
        EXPECT_EQ(drive_by_potential(field, problem, how, {}).outcome, Outcome::kReached) << off << " gain " << gain;
      }
    }
  }
}

TEST(Potential, sets_out_as_fast_parabolic_as_conic) {
  const Grid grid(60, 7);
  const GridClearance clearance(grid, 3.0);
  const Problem problem = testing::problem_between(grid, {5, 3}, {45, 3});
  for (const Attraction attraction : {Attraction::kConic, Attraction::kParabolic, Attraction::kCombined}) {
    const PotentialField field(clearance, problem.goal, 1.0, parameters_for(problem, attraction));
    EXPECT_NEAR(norm(field.attracting_force(problem.start)), 1.0, 1e-12);
  }
}

TEST(Potential, says_of_a_start_on_a_wall_that_it_touches) {
  const Grid grid(6, 6);
  Problem problem = testing::problem_between(grid, {0, 0}, {4, 4});
  problem.start = {0.0, 0.0};   // of the first cell, and on the rim of the map
  for (const char* const method : {"potential", "potential-parabolic", "potential-dynamic", "two-maps"}) {
    const Result result = plan(*find_method(method), problem);
    EXPECT_EQ(result.outcome, Outcome::kNumeric) << method;
    EXPECT_EQ(result.refused, "the start touches an obstacle") << method;
  }
}

TEST(Trap, is_no_motion_that_is_as_fast_as_the_pull) {
  TrapDetector motion(1.0);
  for (double time_s = 0.0, d = 1000.0; d > 0.5; time_s += 0.1, d -= 0.1 * d / 1000.0) {
    ASSERT_FALSE(motion.add({-d, 0.0}, d / 1000.0, d / 1000.0, time_s)) << d << " m before the goal";
  }
}

// The parabola's pull on a robot fades in proportion to what is left of the way: 400 cells away it sets out at 1 m/s, and arrives a
// thousand times slower.
TEST(Trap, is_no_slow_end_of_a_long_way) {
  const Grid grid(500, 21);
  for (const std::string_view name : {"potential", "potential-parabolic", "potential-combined", "potential-dynamic"}) {
    for (const std::int32_t to : {390, 480}) {
      const Result result = plan(*find_method(name), testing::problem_between(grid, {20, 10}, {to, 10}));
      EXPECT_EQ(result.outcome, Outcome::kReached) << name << " to " << to << ": " << kb::planners::name(result.trap.kind);
    }
  }
}

TEST(Trap, near_the_end_of_a_long_way_is_told) {
  Grid grid(500, 21);
  for (std::int32_t y = 3; y < 18; ++y) grid.set_blocked({460, y}, true);
  const Result result = plan(*find_method("potential-parabolic"), testing::problem_between(grid, {20, 10}, {480, 10}));
  EXPECT_EQ(result.outcome, Outcome::kTrapped) << name(result.outcome);
  EXPECT_NEAR(result.trap.at.x, 460.0, 1.5);
}

TEST(Trap, behind_a_wall_is_told) {
  Grid grid(30, 21);
  for (std::int32_t y = 3; y < 18; ++y) grid.set_blocked({15, y}, true);
  for (const std::string_view name : {"potential", "potential-parabolic", "potential-combined", "potential-dynamic"}) {
    const Result result = plan(*find_method(name), testing::problem_between(grid, {4, 10}, {26, 10}));
    EXPECT_EQ(result.outcome, Outcome::kTrapped) << name;
    EXPECT_LT(result.trap.at.x, 15.0);
    EXPECT_NE(result.trap.kind, Trap::Kind::kNone);
  }
}

}  // namespace
}  // namespace kb::planners
