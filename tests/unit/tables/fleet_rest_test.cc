// Which planes recorded missions leave at rest: see note [planes at rest] in compiler/tables/fleet_rest.h.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "compiler/tables/fleet_rest.h"
#include "compiler/tables/tables.h"
#include "tests/unit/program/program_builder.h"

namespace kb::tables {
namespace {

using namespace program::testing;
using PlaneKind = FleetPlane::Kind;

/// Whoever sees the light goes; whoever meets a wall for two seconds goes back.
class FleetRestTest : public testing::Test {
 protected:
  static constexpr std::uint32_t kLight = 0, kWall = 1;              // facts, each with a satellite of its own
  static constexpr std::uint32_t kLit = 2, kStuck = 3;              // satellites after those

  FleetRestTest() {
    ProgramBuilder b({"think", "control"});
    b.fact("Light").fact("Wall").satellite("Lit").satellite("Stuck").strategy("Go");
    b.when("go", "think", seen("Light"), {raise("Lit"), raise("sat Go")});
    b.when("stuck", "think", held(seen("Wall"), 2'000'000), {raise("Stuck")});
    program_ = b.build();
    tables_ = build(program_);
    form_ = build_fleet(program_, tables_);
  }

  /// Ten ticks a second.
  static void add(FleetMission& mission, std::size_t ticks, float light, float wall) {
    for (std::size_t i = 0; i < ticks; ++i) {
      mission.dt_us.push_back(100'000);
      mission.facts.insert(mission.facts.end(), {light, wall});
    }
  }
  [[nodiscard]] FleetRest rest(std::initializer_list<FleetMission> missions) const { return planes_at_rest(form_, tables_, missions); }

  program::Program program_;
  Tables tables_;
  FleetForm form_;
};

TEST_F(FleetRestTest, WhatNobodySeesRestsAndWhatFollowsFromIt) {
  FleetMission mission;
  add(mission, 10, 0.9f, 0.0f);
  add(mission, 10, 0.0f, 0.0f);
  const FleetRest at_rest = rest({mission});
  EXPECT_EQ(at_rest.at({PlaneKind::kSeen, kWall, 0}), false);
  EXPECT_EQ(at_rest.at({PlaneKind::kTimerOver, 0, 0}), false);
  EXPECT_EQ(at_rest.at({PlaneKind::kCode, kStuck, 0}), false);
  EXPECT_TRUE(at_rest.contains({PlaneKind::kPlain, kWall, 0}));
  EXPECT_FALSE(at_rest.contains({PlaneKind::kSeen, kLight, 0}));
  EXPECT_FALSE(at_rest.contains({PlaneKind::kPlain, kLight, 0}));
}

TEST_F(FleetRestTest, WhatOnlyTheFirstRoundChangesRestsAsItIsThen) {
  FleetMission mission;
  add(mission, 10, 0.0f, 0.0f);
  add(mission, 10, 0.9f, 0.0f);
  EXPECT_EQ(rest({mission}).at({PlaneKind::kCode, kLit, 0}), true) << "nothing lowers Lit";
}

TEST_F(FleetRestTest, ATimerWakesIfItsTimeComes) {
  FleetMission shortly, long_enough;
  for (FleetMission* mission : {&shortly, &long_enough}) add(*mission, 5, 0.0f, 0.0f);
  add(shortly, 15, 0.0f, 0.9f);
  add(long_enough, 25, 0.0f, 0.9f);
  EXPECT_TRUE(rest({shortly}).contains({PlaneKind::kTimerOver, 0, 0}));
  EXPECT_FALSE(rest({long_enough}).contains({PlaneKind::kTimerOver, 0, 0}));
  EXPECT_FALSE(rest({shortly, long_enough}).contains({PlaneKind::kTimerOver, 0, 0})) << "all missions must leave it at rest";
}

TEST_F(FleetRestTest, PlanesOfTheHostRestWhereNothingIsGiven) {
  FleetMission always;
  add(always, 20, 0.9f, std::numeric_limits<float>::quiet_NaN());
  const FleetRest at_rest = rest({always});
  EXPECT_FALSE(at_rest.contains({PlaneKind::kPlain, kLight, 0})) << "it never changes, but has a bit in each robot";
  EXPECT_TRUE(at_rest.contains({PlaneKind::kPlain, kWall, 0})) << "no number counts as 0";
}

TEST_F(FleetRestTest, WithoutATickNothingRests) {
  EXPECT_TRUE(rest({}).empty());
  EXPECT_TRUE(rest({FleetMission{}}).empty());
}

/// How often the resting kernel asks whether a plane wakes.
std::size_t count_wakes(const FleetForm& form) {
  return static_cast<std::size_t>(std::ranges::count(form.resting, FleetStep::Kind::kWake, &FleetStep::kind));
}

TEST_F(FleetRestTest, PlanesThatRestComeLastAndTheRestingKernelLeavesThemAlone) {
  FleetMission mission;
  add(mission, 10, 0.9f, 0.0f);
  add(mission, 10, 0.0f, 0.0f);
  const FleetForm form = build_fleet(program_, tables_, rest({mission}));
  EXPECT_LT(form.busy_given, form.read_given);
  EXPECT_LT(form.busy_planes, form.plain_planes);
  EXPECT_EQ(form.rest.size(), form.plain_planes - form.busy_planes);
  const auto rests = [&](const FleetStep& step) {
    if (step.kind != FleetStep::Kind::kLoad && step.kind != FleetStep::Kind::kPut) return false;
    return step.what >= (step.what < form.given ? form.busy_given : form.busy_planes);
  };
  EXPECT_TRUE(std::ranges::any_of(form.steps, rests));
  EXPECT_TRUE(std::ranges::none_of(form.resting, rests));
  EXPECT_EQ(count_wakes(form), 0u) << "a wall wakes the block before the tick";
  EXPECT_TRUE(build_fleet(program_, tables_).resting.empty());
}

TEST_F(FleetRestTest, ATimerAtRestWakesItsWord) {
  FleetMission mission;
  add(mission, 5, 0.9f, 0.0f);
  add(mission, 15, 0.0f, 0.9f);
  EXPECT_EQ(count_wakes(build_fleet(program_, tables_, rest({mission}))), 1u);
}

}  // namespace
}  // namespace kb::tables
