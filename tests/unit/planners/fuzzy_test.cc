#include "planners/fuzzy.h"

#include <gtest/gtest.h>

#include <random>

#include "planners/fuzzy_crowd.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

// The 72 rules one by one, as they are written in fuzzy_rules.h. Returns how many of the nine of group g hold.
int rules_that_hold(int g, int s, unsigned blocked, int& direction) {
  const int offsets[8] = {0, s, -s, 2 * s, -2 * s, 3 * s, -3 * s, 4};
  const auto is_blocked = [&](int k) { return (blocked >> ((g + offsets[k] + 16) % 8) & 1u) != 0; };
  int holding = 0;
  for (int m = 1; m <= 9; ++m) {
    bool holds = true;
    for (int k = 0; k < std::min(m - 1, 8); ++k) holds = holds && is_blocked(k);
    if (m < 9) holds = holds && !is_blocked(m - 1);
    if (!holds) continue;
    ++holding;
    direction = m < 9 ? (g + offsets[m - 1] + 16) % 8 : kStandStill;
  }
  return holding;
}

TEST(FuzzyTable, is_the_72_rules_on_all_inputs) {
  for (int g = 0; g < 8; ++g) {
    for (unsigned blocked = 0; blocked < 256; ++blocked) {
      for (const int s : {1, -1}) {
        int direction = -1;
        ASSERT_EQ(rules_that_hold(g, s, blocked, direction), 1) << "exactly one of the nine";
        EXPECT_EQ(kFuzzyTable[static_cast<std::size_t>(g + (s > 0 ? 0 : 8))][blocked], direction);
      }
    }
  }
}

TEST(FuzzyMemberships, sum_to_one_and_are_at_most_two) {
  for (int i = -1800; i <= 1800; ++i) {
    const double b = i * kPi / 1800.0;
    double sum = 0.0;
    int active = 0;
    for (int g = 0; g < 8; ++g) {
      sum += fuzzy_membership(b, g);
      active += fuzzy_membership(b, g) > 1e-12 ? 1 : 0;
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
    EXPECT_LE(active, 2);
  }
}

// The row found by comparisons is the stronger term and the side of its middle, as the angle says.
TEST(FuzzyRow, is_the_stronger_term_and_its_side) {
  for (std::int32_t dx = -40; dx <= 40; ++dx) {
    for (std::int32_t dy = -40; dy <= 40; ++dy) {
      if (dx == 0 && dy == 0) continue;
      const double b = std::atan2(dy, dx);
      int strongest = 0;
      for (int g = 1; g < 8; ++g) {
        if (fuzzy_membership(b, g) > fuzzy_membership(b, strongest)) strongest = g;
      }
      const bool past = wrap_angle(b - strongest * (kPi / 4.0)) >= -1e-12;
      EXPECT_EQ(fuzzy_row(dx, dy), static_cast<std::uint32_t>(strongest + (past ? 0 : 8))) << dx << ", " << dy;
    }
  }
}

// To the ends of a map, in whole numbers: a cell beside the line of 22.5 degrees is on its side of it.
TEST(FuzzyRow, is_exact_far_away) {
  for (std::int32_t high = Grid::kMaxSide - 2000; high <= Grid::kMaxSide; ++high) {
    const auto low = static_cast<std::int32_t>(std::floor(high * (std::sqrt(2.0) - 1.0)));
    EXPECT_EQ(fuzzy_row(high, low), 0u) << high;
    EXPECT_EQ(fuzzy_row(high, low + 1), 9u) << high;
    EXPECT_EQ(fuzzy_row(-high, -high), 5u) << high;
    EXPECT_EQ(fuzzy_row(0, -high), 6u) << high;
  }
}

TEST(FuzzyMove, is_a_look_at_the_table_and_none_at_the_goal) {
  for (std::int32_t dx = -9; dx <= 9; ++dx) {
    for (std::int32_t dy = -9; dy <= 9; ++dy) {
      for (unsigned moves = 0; moves < 256; ++moves) {
        const std::uint8_t chosen = fuzzy_move(dx, dy, static_cast<std::uint8_t>(moves));
        const bool there = dx == 0 && dy == 0;
        ASSERT_EQ(chosen, there ? kStandStill : kFuzzyTable[fuzzy_row(dx, dy)][~moves & 0xFFu]) << dx << ", " << dy;
      }
    }
  }
}

// Robots side by side go as one that is planned for alone, until it loops; none is ever in a blocked cell.
TEST(FuzzyCrowd, goes_as_the_planner_says) {
  const Grid grid = testing::random_grid(70, 50, 0.2, 3);
  std::mt19937_64 dice(9);
  FuzzyCrowd crowd(grid);
  std::vector<std::vector<Cell>> ways;
  std::vector<bool> reached;
  for (int i = 0; i < 600; ++i) {   // more than a block
    const Cell from = testing::random_free_cell(grid, dice), to = testing::random_free_cell(grid, dice);
    crowd.add(from, to);
    const Result alone = plan_fuzzy(testing::problem_between(grid, from, to), FuzzyMemory::kNone, {});
    ways.push_back(testing::cells_of(grid, alone));
    reached.push_back(alone.outcome == Outcome::kReached);
  }
  for (std::size_t tick = 0; tick < 200; ++tick) {
    for (std::size_t i = 0; i < ways.size(); ++i) {
      ASSERT_TRUE(grid.free(crowd.cell(i)));
      if (tick < ways[i].size()) {
        ASSERT_EQ(crowd.cell(i), ways[i][tick]) << i << " at " << tick;
      }
    }
    crowd.step();
  }
  for (std::size_t i = 0; i < ways.size(); ++i) EXPECT_EQ(crowd.arrived(i), reached[i]) << i;
}

// Turning robot, goal and sensors together turns the decision.
TEST(FuzzyMove, is_the_same_in_the_robot_s_frame_and_in_the_world_s) {
  for (int heading = 0; heading < 8; ++heading) {
    for (unsigned moves = 0; moves < 256; ++moves) {
      const auto turned = static_cast<std::uint8_t>((moves << heading | moves >> (8 - heading)) & 0xFFu);
      for (std::uint32_t row = 0; row < 16; ++row) {
        const std::uint8_t body = kFuzzyTable[row][static_cast<std::uint8_t>(~moves)];
        const std::uint32_t world_row = (row % 8 + static_cast<std::uint32_t>(heading)) % 8 + row / 8 * 8;
        const std::uint8_t world = kFuzzyTable[world_row][static_cast<std::uint8_t>(~turned)];
        EXPECT_EQ(world, body == kStandStill ? kStandStill : (body + heading) % 8);
      }
    }
  }
}

// All 256 sensor words, 240 deviations: against the rules and the defuzzification written out.
TEST(FuzzySteering, agrees_with_the_rules_on_all_sensor_words_and_fine_deviations) {
  for (unsigned blocked = 0; blocked < 256; ++blocked) {
    for (int i = 0; i < 240; ++i) {
      const double b = wrap_angle((i + 0.5) * 2.0 * kPi / 240.0);
      int first = -1, second = -1;
      double strong = 0.0, weak = 0.0;
      for (int g = 0; g < 8; ++g) {
        const double mu = fuzzy_membership(b, g);
        if (mu <= 0.0) continue;
        int direction = -1;
        rules_that_hold(g, wrap_angle(b - g * (kPi / 4.0)) >= 0.0 ? 1 : -1, blocked, direction);
        if (mu > strong) {
          second = first;
          weak = strong;
          first = direction;
          strong = mu;
        } else {
          second = direction;
          weak = mu;
        }
      }
      const FuzzySteering steering = steer(b, static_cast<std::uint8_t>(blocked));
      ASSERT_EQ(steering.stop, first == kStandStill);
      if (steering.stop) continue;
      const double between = second < 0 ? 0.0 : wrap_angle((second - first) * (kPi / 4.0));
      const double turn = std::abs(between) < 0.8 ? first * (kPi / 4.0) + weak * between : first * (kPi / 4.0);
      ASSERT_NEAR(wrap_angle(steering.turn_rad - turn), 0.0, 1e-9) << blocked << " " << b;
    }
  }
}

TEST(FuzzyPlanner, reports_a_loop_at_the_first_cell_that_it_enters_again) {
  const std::vector<std::string_view> rows = {"..........",
                                              ".######...",
                                              "......#...",
                                              "..S...#..G",
                                              "......#...",
                                              ".######...",
                                              ".........."};
  const Grid grid = testing::draw(rows);
  const Problem problem = testing::problem_between(grid, testing::find(rows, 'S'), testing::find(rows, 'G'));
  const Result result = plan_fuzzy(problem, FuzzyMemory::kNone, {});
  ASSERT_EQ(result.outcome, Outcome::kTrapped);
  EXPECT_EQ(result.trap.time_s, 0.0);   // the method counts moves and knows no time
  const auto cells = testing::cells_of(grid, result);
  EXPECT_EQ(std::count(cells.begin(), cells.end(), cells.back()), 2) << "the last cell, and no other, was there before";
  for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
    EXPECT_EQ(std::count(cells.begin(), cells.end() - 1, cells[i]), 1);
  }
  EXPECT_EQ(plan_fuzzy(problem, FuzzyMemory::kVisits, {}).outcome, Outcome::kReached);
}

TEST(FuzzyPlanner, with_visits_solves_nearly_every_published_row_of_arena_and_den312d) {
  for (const std::size_t map : {std::size_t{0}, std::size_t{1}}) {
    const auto& benchmark = testing::benchmarks()[map];
    std::size_t solved = 0, plain = 0;
    for (const Scenario& row : benchmark.scenarios) {
      const Problem problem = testing::problem_between(benchmark.grid, row.start, row.goal);
      solved += plan_fuzzy(problem, FuzzyMemory::kVisits, {}).outcome == Outcome::kReached ? 1 : 0;
      plain += plan_fuzzy(problem, FuzzyMemory::kNone, {}).outcome == Outcome::kReached ? 1 : 0;
    }
    EXPECT_GE(solved * 100, benchmark.scenarios.size() * 99) << benchmark.name;
    EXPECT_LT(plain, solved) << benchmark.name;
  }
}

}  // namespace
}  // namespace kb::planners
