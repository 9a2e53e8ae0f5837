// Fleets that were compiled with a profile; see note [resting blocks] in fleet/kernel.h. That they decide the same is tested with random fleets.
#include <gtest/gtest.h>

#include <waymark/fleet/fleet.h>
#include <waymark/runtime/status.h>

#include "calm_bumper.kb/bumper.kb.fleet.h"

namespace calm {
namespace {

void tick(Fleet& fleet, int ticks) {
  for (int i = 0; i < ticks; ++i) fleet.tick(mts::milliseconds(100));
}

/// All robots have been told to go, as in the profile.
Fleet going(std::size_t robots, mts::FleetOptions options) {
  Fleet fleet(robots, options);
  tick(fleet, 1);
  for (std::size_t robot = 0; robot < robots; ++robot) fleet.set(robot, Fact::Button, 0.9f);
  tick(fleet, 1);
  for (std::size_t robot = 0; robot < robots; ++robot) fleet.set(robot, Fact::Button, 0.0f);
  tick(fleet, 20);
  return fleet;
}

TEST(FleetRest, ABlockRestsUntilARobotDoesWhatTheProfileDoesNotShow) {
  for (const std::uint32_t bits : {64u, 512u}) {
    Fleet fleet = going(1'000, {.most_bits = bits});
    EXPECT_EQ(fleet.resting(), 2u) << "also the second block, which is not full";
    fleet.set(5, Fact::Button, 0.9f);
    tick(fleet, 1);
    fleet.set(5, Fact::Button, 0.0f);
    tick(fleet, 1);
    EXPECT_EQ(fleet.resting(), 2u) << "buttons are pressed in the profile";
    fleet.set(5, Fact::Wall, 0.9f);
    EXPECT_EQ(fleet.resting(), 1u);
    tick(fleet, 1);
    EXPECT_EQ(fleet.strategy(5), Strategy::Drive_back);
    EXPECT_EQ(fleet.status(5), mts::Status::kOk);
    EXPECT_EQ(fleet.strategy(6), Strategy::Drive_ahead);
    fleet.set(5, Fact::Wall, 0.0f);
    tick(fleet, 12);
    EXPECT_EQ(fleet.strategy(5), Strategy::Drive_ahead) << "after a second";
    EXPECT_EQ(fleet.resting(), 1u) << "it is still warm";
    fleet.set(5, Fact::Button, 0.9f);
    tick(fleet, 1);
    fleet.set(5, Fact::Button, 0.0f);
    tick(fleet, 16);
    EXPECT_EQ(fleet.resting(), 2u);
  }
}

TEST(FleetRest, RobotsThatAFleetHasNotKeepNoBlockBusy) {
  Fleet fleet = going(1'000, {});
  fleet.set(600, Fact::Button, 0.9f);
  tick(fleet, 1);
  EXPECT_EQ(fleet.passed_over(), 1u);
  tick(fleet, 3);
  EXPECT_EQ(fleet.passed_over(), 2u);
  EXPECT_EQ(fleet.resting(), 2u);
}

TEST(FleetRest, ABlockDoesNotRestWhereAFactIsGivenAlthoughNothingFollowsYet) {
  Fleet fleet = going(1'000, {});
  fleet.set(5, Fact::Dust, 0.6f);   // enough for attention, and not for an event
  for (int i = 0; i < 40; ++i) {
    fleet.set(7, Fact::Button, i % 2 == 0 ? 0.9f : 0.0f);
    tick(fleet, 1);
    EXPECT_EQ(fleet.resting(), 1u);
  }
}

TEST(FleetRest, ABlockDoesNotRestWhereARobotIsAlone) {
  Fleet fleet = going(1'000, {});
  fleet.set(5, Fact::Noise, 0.8f);   // as in the profile: rules contradict each other
  tick(fleet, 1);
  EXPECT_EQ(fleet.alone(), 1u);
  EXPECT_EQ(fleet.resting(), 1u);
}

TEST(FleetRest, TracedFleetsNeverRest) {
  Fleet fleet(1'000, {.traced = true});
  tick(fleet, 20);
  EXPECT_EQ(fleet.resting(), 0u);
}

}  // namespace
}  // namespace calm
