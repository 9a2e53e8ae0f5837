// What docs/fleets.md promises of a fleet, on a small knowledge base.
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <new>
#include <thread>
#include <vector>

#include "bumper.kb.fleet.h"

namespace {

using bumper::Fact;
using bumper::Fleet;
using bumper::Rule;
using bumper::Satellite;
using bumper::Strategy;

constexpr mts::Duration kTick = mts::milliseconds(100);

/// A fleet whose robots stand and have seen nothing.
Fleet standing(std::size_t robots, mts::FleetOptions options = {}) {
  Fleet fleet(robots, options);
  fleet.tick(kTick);
  return fleet;
}

TEST(Fleet, StandsUntilARobotIsToldToGo) {
  Fleet fleet = standing(1'000);
  fleet.set(700, Fact::Button, 0.9f);
  fleet.tick(kTick);
  EXPECT_TRUE(fleet.drives(700));
  EXPECT_EQ(fleet.strategy(700), Strategy::Drive_ahead);
  EXPECT_EQ(fleet.status(700), mts::Status::kOk);
  EXPECT_FALSE(fleet.drives(699));
  EXPECT_EQ(fleet.status(699), mts::Status::kNoStrategy);
}

TEST(Fleet, TakesFactsForAWordAndGivesStrategiesAsOne) {
  Fleet fleet = standing(1'000);
  fleet.set_word(3, Fact::Button, 0xF0u, 0.9f);
  fleet.tick(kTick);
  EXPECT_EQ(fleet.running(Strategy::Drive_ahead, 3), 0xF0u);
  EXPECT_EQ(fleet.running(Strategy::Drive_ahead, 2), 0u);
}

/// On which tick of 10 ms after meeting a wall, as the `wall`th, a robot goes on ahead.
int goes_on_after(int wall, mts::FleetOptions options) {
  Fleet fleet(1'000, options);
  constexpr mts::Duration kShortTick = mts::milliseconds(10);
  fleet.tick(kShortTick);
  fleet.set(5, Fact::Button, 0.9f);
  for (int tick = 0; tick < wall; ++tick) fleet.tick(kShortTick);
  fleet.set(5, Fact::Wall, 0.9f);
  fleet.tick(kShortTick);
  fleet.set(5, Fact::Wall, -1.0f);
  for (int tick = 1; tick < 300; ++tick) {
    fleet.tick(kShortTick);
    if (fleet.strategy(5) == Strategy::Drive_ahead) return tick;
  }
  return 0;
}

TEST(Fleet, WaitsAsLongWhereItsStampsAreNumberedAnew) {
  const int usual = goes_on_after(150, {});
  EXPECT_EQ(usual, 101);
  for (const std::uint32_t before : {20u, 120u, 151u, 152u, 160u, 200u, 250u, 253u}) {
    EXPECT_EQ(goes_on_after(150, {.first_stamp = 0xC000'0000u - before}), usual) << before;
    EXPECT_EQ(goes_on_after(150, {.most_bits = 64, .first_stamp = 0xC000'0000u - before}), usual) << before;
  }
}

TEST(Fleet, PassesOverBlocksInWhichNothingHappensButNotOverTimers) {
  Fleet fleet = standing(2'000);
  fleet.set(5, Fact::Button, 0.9f);
  fleet.tick(kTick);
  fleet.set(5, Fact::Wall, 0.9f);
  fleet.tick(kTick);
  fleet.set(5, Fact::Wall, -1.0f);
  for (int i = 0; i < 5; ++i) fleet.tick(kTick);
  EXPECT_EQ(fleet.strategy(5), Strategy::Drive_back);
  EXPECT_EQ(fleet.passed_over(), 4u);
  for (int i = 0; i < 8; ++i) fleet.tick(kTick);
  EXPECT_EQ(fleet.strategy(5), Strategy::Drive_ahead);
}

TEST(Fleet, LeavesRobotsWhoseRulesContradictEachOtherToTheEngineAndTakesThemBack) {
  Fleet fleet = standing(600, {.traced = true});
  fleet.set(70, Fact::Wall, 0.8f);
  fleet.set(70, Fact::Button, 0.6f);
  fleet.tick(kTick);
  EXPECT_EQ(fleet.alone(), 1u);
  EXPECT_EQ(fleet.status(70), mts::Status::kConflict);
  EXPECT_EQ(fleet.read(70).conflicts.size(), 1u);
  EXPECT_NEAR(fleet.value(70, Satellite::Warm), (0.8f - 0.6f) / 1.4f, 1e-6f);
  fleet.set(70, Fact::Button, 0.0f);
  fleet.tick(kTick);
  EXPECT_EQ(fleet.value(70, Satellite::Warm), 1.0f);
  fleet.tick(kTick);
  EXPECT_EQ(fleet.alone(), 0u);
}

/// The kernel keeps no plane for a rule that waits for what is seen: it is disarmed where that is seen, unless it was contradicted.
TEST(Fleet, KeepsARuleArmedThatWasContradictedOnTheFirstTick) {
  Fleet fleet(600, {.traced = true});
  bumper::Mind mind;
  bumper::Facts facts;
  fleet.set(70, Fact::Noise, 0.8f);
  facts.Noise = 0.8f;
  for (int tick = 1; tick <= 3; ++tick) {
    fleet.tick(kTick);
    const auto alone = mind.tick(facts, kTick);
    const auto robot = fleet.read(70);
    EXPECT_EQ(robot.fired, std::vector(alone.fired().begin(), alone.fired().end())) << "tick " << tick;
    EXPECT_EQ(robot.conflicts.size(), alone.conflicts().size());
    EXPECT_EQ(robot.status, mts::Status::kConflict);
  }
}

TEST(Fleet, SaysOfATickWhatItHasKept) {
  for (const bool traced : {false, true}) {
    Fleet fleet = standing(130, {.traced = traced});
    for (const std::size_t robot : {0u, 64u, 129u}) fleet.set(robot, Fact::Button, 0.9f);
    fleet.tick(kTick);
    for (const std::size_t robot : {0u, 64u, 129u}) {
      const auto tick = fleet.read(robot);
      EXPECT_EQ(tick.tick, 2u);
      EXPECT_EQ(tick.strategy, Strategy::Drive_ahead);
      EXPECT_EQ(tick.active, std::vector{Strategy::Drive_ahead});
      EXPECT_EQ(tick.status, mts::Status::kOk);
      EXPECT_EQ(tick.events, traced ? std::vector{Fact::Button} : std::vector<Fact>{});
      EXPECT_EQ(tick.fired, traced ? (std::vector{Rule::start, Rule::cool, Rule::run_Drive_ahead}) : std::vector<Rule>{});
      EXPECT_EQ(tick.changed.size(), traced ? 1u : 0u);
      EXPECT_TRUE(tick.lost.empty());
      EXPECT_EQ(tick.bad_facts, 0u);
    }
  }
}

TEST(Fleet, CountsTheMemoryOfItsClock) {
  Fleet fleet = standing(10);
  const std::size_t before = fleet.bytes();
  for (int i = 0; i < 50; ++i) fleet.tick(mts::milliseconds(1));
  EXPECT_GE(fleet.bytes(), before + 50 * sizeof(std::int64_t)) << "`for 1 s` keeps the ticks of a second";
}

TEST(Fleet, CountsFactsThatAreNoCertainty) {
  Fleet fleet = standing(10, {.traced = true});
  fleet.set(3, Fact::Wall, std::numeric_limits<float>::quiet_NaN());
  fleet.set(3, Fact::Button, 7.0f);
  fleet.tick(kTick);
  EXPECT_EQ(fleet.read(3).bad_facts, 2u);
  EXPECT_EQ(fleet.status(3), mts::Status::kBadFact);
  EXPECT_EQ(fleet.strategy(3), Strategy::Drive_ahead) << "7 is clamped to 1";
}

// Rules contradict each other about robot 3, so that the engine has it; the kernel has robot 4. Who asks cannot tell them apart.
TEST(Fleet, CountsBadFactsOfTheLastTickForAllRobotsAlike) {
  Fleet fleet = standing(10, {.traced = true});
  fleet.set(3, Fact::Wall, 0.8f);
  fleet.set(3, Fact::Button, 0.6f);
  fleet.tick(kTick);
  ASSERT_EQ(fleet.alone(), 1u);
  fleet.set(3, Fact::Button, 0.0f);
  const auto tell = [&](float noise, std::uint32_t bad_now, std::uint32_t bad_then) {
    for (const std::size_t robot : {3u, 4u}) fleet.set(robot, Fact::Noise, noise);
    for (const std::size_t robot : {3u, 4u}) EXPECT_EQ(fleet.read(robot).bad_facts, bad_now) << robot;
    EXPECT_EQ(fleet.status(4), bad_now != 0 ? mts::Status::kBadFact : mts::Status::kNoStrategy);
    fleet.tick(kTick);
    for (const std::size_t robot : {3u, 4u}) {
      EXPECT_EQ(fleet.read(robot).bad_facts, bad_then) << robot;
      EXPECT_EQ(fleet.status(robot) == mts::Status::kBadFact, bad_then != 0) << robot;
    }
  };
  tell(std::numeric_limits<float>::quiet_NaN(), 0, 1);
  tell(0.0f, 1, 0);
}

TEST(Fleet, DecidesTheSameOnSeveralThreads) {
  Fleet one = standing(5'000), many = standing(5'000);
  mts::Crew crew(3);
  for (std::size_t tick = 0; tick < 20; ++tick) {
    for (std::size_t robot = tick; robot < 5'000; robot += 7) {
      one.set(robot, tick % 2 == 0 ? Fact::Button : Fact::Wall, 0.9f);
      many.set(robot, tick % 2 == 0 ? Fact::Button : Fact::Wall, 0.9f);
    }
    one.tick(kTick);
    many.tick(kTick, crew);
    for (std::size_t word = 0; word < one.words(); ++word) {
      ASSERT_EQ(one.running(Strategy::Drive_ahead, word), many.running(Strategy::Drive_ahead, word));
    }
  }
}

TEST(Crew, WorksAgainWhenItsThreadsHaveGoneToSleep) {
  mts::Crew crew(3);
  std::atomic<int> worked = 0;
  int round = 0;
  for (const int wait_us : {2'000, 2'000, 500, 500, 2'000, 2'000}) {   // they look for work for 200 us, or 1,000 after one that came soon
    crew.run([&](unsigned) { ++worked; });
    EXPECT_EQ(worked, 3 * ++round);
    std::this_thread::sleep_for(std::chrono::microseconds(wait_us));
  }
}

TEST(Crew, EndsTheProgramWhereWorkThrows) {
  EXPECT_DEATH(
      {
        mts::Crew crew(2);
        crew.run([](unsigned part) {
          if (part == 0) throw std::bad_alloc();   // while the other one is still at work
        });
      },
      "bad_alloc");
}

TEST(Fleet, OfMoreRobotsThanHaveNumbersHasNoMemory) {
  EXPECT_THROW(Fleet{std::numeric_limits<std::size_t>::max()}, std::bad_alloc);
  EXPECT_THROW(Fleet{std::size_t{mts::kBlockRobots} << 32}, std::bad_alloc);
}

TEST(Fleet, OfNoRobotsTicks) {
  Fleet fleet(0);
  fleet.tick(kTick);
  EXPECT_EQ(fleet.ticks(), 1u);
}

}  // namespace
