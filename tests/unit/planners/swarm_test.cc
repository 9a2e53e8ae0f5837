// Robots that decide for themselves: never two in a cell, whatever the number of threads.
#include "planners/swarm.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <system_error>
#include <thread>

#include "planners/dice.h"
#include "tests/unit/planners/meetings.h"
#include "tests/unit/planners/patrols.h"
#include "tests/unit/planners/planning.h"

namespace kb::planners {
namespace {

std::vector<Swarm::Robot> random_robots(const Grid& grid, std::size_t count, std::uint64_t seed) {
  Dice dice(seed);
  std::vector<bool> used(grid.size(), false);
  std::vector<Swarm::Robot> robots;
  while (robots.size() < count) {
    const Cell at = testing::free_cell(grid, dice);
    if (used[grid.index(at)]) continue;
    used[grid.index(at)] = true;
    robots.push_back({at, testing::free_cell(grid, dice)});
  }
  return robots;
}

// A second map of who is where, made from scratch at every tick.
TEST(Swarm, never_has_two_robots_in_a_cell_nor_any_that_pass_through_each_other) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Grid grid = testing::random_grid(40, 31, 0.01 * static_cast<double>(seed), seed);
    Swarm swarm(grid, kFuzzyTable, random_robots(grid, 20 * seed * 3, seed));
    ASSERT_TRUE(swarm.ok());
    testing::Meetings meetings(grid);
    std::vector<Cell> before = swarm.cells();
    for (int tick = 0; tick < 150; ++tick) {
      const std::size_t moved = swarm.step();
      const std::vector<Cell> now = swarm.cells();
      ASSERT_EQ(meetings.between(before, now), 0u);
      std::vector<int> left(grid.size(), -1);
      std::size_t changed = 0;
      for (std::size_t i = 0; i < now.size(); ++i) {
        left[grid.index(before[i])] = static_cast<int>(i);
        if (now[i] == before[i]) continue;
        ++changed;
        const int k = testing::direction_between(before[i], now[i]);
        ASSERT_TRUE(k >= 0 && grid.can_move(before[i], k)) << "no legal move";
      }
      ASSERT_EQ(changed, moved);
      for (std::size_t i = 0; i < now.size(); ++i) {
        const int other = left[grid.index(now[i])];
        ASSERT_TRUE(other < 0 || other == static_cast<int>(i)) << "moved into a cell that was taken";
      }
      before = now;
    }
  }
}

TEST(Swarm, moves_the_same_for_any_number_of_threads_and_order_of_robots) {
  const Grid grid(300, 300);
  auto robots = random_robots(grid, 20'000, 4);
  Swarm one(grid, kFuzzyTable, robots), four(grid, kFuzzyTable, robots);
  std::reverse(robots.begin(), robots.end());
  Swarm reversed(grid, kFuzzyTable, robots);
  for (int tick = 0; tick < 100; ++tick) {
    const std::size_t moved = one.step(1);
    ASSERT_EQ(four.step(4), moved);
    ASSERT_EQ(reversed.step(2), moved);
  }
  EXPECT_EQ(one.cells(), four.cells());
  auto cells = reversed.cells();
  std::reverse(cells.begin(), cells.end());
  EXPECT_EQ(one.cells(), cells);
}

// No address space holds the stack that every new thread asks for here.
TEST(Swarm, moves_the_same_when_the_system_starts_no_thread) {
  const Grid grid(300, 300);
  const auto robots = random_robots(grid, 20'000, 4);
  Swarm one(grid, kFuzzyTable, robots), four(grid, kFuzzyTable, robots);
  pthread_attr_t usual, huge;
  ASSERT_EQ(pthread_getattr_default_np(&usual), 0);
  ASSERT_EQ(pthread_getattr_default_np(&huge), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&huge, std::size_t{1} << 48), 0);
  ASSERT_EQ(pthread_setattr_default_np(&huge), 0);
  EXPECT_THROW(std::thread([] {}).join(), std::system_error) << "the test could not fail";
  for (int tick = 0; tick < 10; ++tick) EXPECT_EQ(four.step(4), one.step(1));
  EXPECT_EQ(pthread_setattr_default_np(&usual), 0);
  EXPECT_EQ(one.cells(), four.cells());
}

TEST(Swarm, arrives_and_says_when) {
  const Grid grid(10, 3);
  Swarm swarm(grid, kFuzzyTable, {{{0, 0}, {9, 0}}, {{0, 2}, {3, 2}}, {{5, 1}, {5, 1}}});
  const SwarmResult result = swarm.run({}, 1000);
  EXPECT_EQ(result.outcome, Outcome::kReached);
  EXPECT_EQ(result.makespan, 9u);
  EXPECT_EQ(result.flowtime, 12u);
  EXPECT_EQ(result.ticks, 9u);
}

// Two robots face each other in a corridor; neither can turn round the other, and the rules would rather stand.
TEST(Swarm, tells_who_is_stuck) {
  const Grid grid(6, 1);
  FuzzyTable forward = kFuzzyTable;
  for (auto& row : forward) {
    for (std::size_t blocked = 0; blocked < 256; ++blocked) row[blocked] = (blocked & 0x11) == 0 ? row[blocked] : kStandStill;
  }
  Swarm swarm(grid, forward, {{{1, 0}, {5, 0}}, {{4, 0}, {0, 0}}});
  const SwarmResult result = swarm.run({}, 1000);
  EXPECT_EQ(result.outcome, Outcome::kTrapped);
  EXPECT_EQ(result.stuck, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(result.arrived, 0u);
  EXPECT_LT(result.ticks, 50u);
}

TEST(Swarm, refuses_robots_in_walls_or_in_the_same_cell) {
  Grid grid(4, 4);
  grid.set_blocked({2, 2}, true);
  EXPECT_FALSE(Swarm(grid, kFuzzyTable, {{{2, 2}, {0, 0}}}).ok());
  EXPECT_FALSE(Swarm(grid, kFuzzyTable, {{{0, 0}, {2, 2}}}).ok());
  EXPECT_FALSE(Swarm(grid, kFuzzyTable, {{{0, 0}, {1, 1}}, {{0, 0}, {1, 0}}}).ok());
  EXPECT_EQ(Swarm(grid, kFuzzyTable, {{{2, 2}, {0, 0}}}).run({}, 10).outcome, Outcome::kInvalid);
  EXPECT_EQ(Swarm(grid, kFuzzyTable, {{{2, 2}, {0, 0}}}).run({}, 10).fault, Fault::kStartBlocked);
  EXPECT_EQ(Swarm(grid, kFuzzyTable, {{{0, 0}, {2, 2}}}).fault(), Fault::kGoalBlocked);
  EXPECT_EQ(Swarm(grid, kFuzzyTable, {{{0, 0}, {1, 1}}, {{0, 0}, {1, 0}}}).fault(), Fault::kSharedStart);
}

}  // namespace
}  // namespace kb::planners
