// What a robot perceives of a road by itself: obstacles ahead, walls, the middle, and that it was lifted.
#include <waymark/controllers/lifted.h>
#include <waymark/controllers/obstacle_sight.h>
#include <waymark/controllers/road_sight.h>

#include <gtest/gtest.h>

namespace mts {
namespace {

constexpr float kTick = 0.02f;

Senses clear() {
  Senses senses;
  for (float& range_m : senses.range_m) range_m = kOutOfRange;
  senses.range_known = true;
  return senses;
}

/// What it says after a second before something at `ahead_m`, and at `aside_m` to the left of that.
float seen(float ahead_m, float aside_m, const Surroundings& where) {
  Senses senses = clear();
  senses.range_m[0] = ahead_m;
  senses.range_m[1] = aside_m;
  ObstacleSight sight;
  for (int i = 0; i < 50; ++i) sight.step(senses, false, 0.0f, 0.0f, kTick);
  return sight.ahead(where);
}

TEST(ObstacleSight, WhatStandsAheadMustBeNearerWhereWallsRegularlyDo) {
  EXPECT_EQ(seen(0.35f, kOutOfRange, {}), 0.9f);
  EXPECT_EQ(seen(0.6f, kOutOfRange, {}), -0.9f);
  EXPECT_NEAR(seen(0.44f, kOutOfRange, {}), 0.0f, 0.01f) << "it may be one";
  EXPECT_EQ(seen(0.35f, kOutOfRange, {.crosses = true}), -0.9f);
  EXPECT_EQ(seen(0.2f, kOutOfRange, {.crosses = true}), 0.9f);
  EXPECT_EQ(seen(0.35f, kOutOfRange, {.walls_bend = true}), -0.9f);
}

TEST(ObstacleSight, WhatItWouldGrazeCountsButNotTheWallsOfCrossings) {
  EXPECT_EQ(seen(kOutOfRange, 0.18f, {}), 0.9f);
  EXPECT_EQ(seen(kOutOfRange, 0.18f, {.leaves = true}), -0.9f);
  EXPECT_EQ(seen(kOutOfRange, 0.18f, {.ends = true}), -0.9f);
  EXPECT_EQ(seen(kOutOfRange, 0.1f, {.crosses = true}), -0.9f);
}

TEST(ObstacleSight, ASingleNearReadingIsNoObstacleAndSilenceSaysNothing) {
  ObstacleSight sight;
  Senses senses = clear();
  sight.step(senses, true, 0.008f, 0.0f, kTick);
  senses.range_m[0] = 0.3f;
  sight.step(senses, true, 0.008f, 0.0f, kTick);
  EXPECT_EQ(sight.ahead({}), -0.9f);
  senses.range_known = false;
  sight.step(senses, true, 0.008f, 0.0f, kTick);
  EXPECT_EQ(sight.ahead({}), 0.0f);
}

TEST(ObstacleSight, ARobotThatStandsThoughItIsToDriveIsHeldUp) {
  Senses senses = clear();
  senses.range_m[7] = 0.23f;
  ObstacleSight sight;
  for (int i = 0; i < 100; ++i) sight.step(senses, false, 0.0f, 0.0f, kTick);
  EXPECT_FALSE(sight.held_up()) << "it is to stand";
  for (int i = 0; i < 100; ++i) sight.step(senses, true, 0.0f, 0.0f, kTick);
  EXPECT_TRUE(sight.held_up());
  sight.step(senses, true, 0.004f, 0.0f, kTick);
  EXPECT_FALSE(sight.held_up()) << "it moves";
}

TEST(RoadSight, AtABendOneWallIsEnough) {
  Senses senses = clear();
  EXPECT_EQ(walls_beside(senses, true), -0.9f);
  senses.range_m[2] = 0.3f;
  EXPECT_EQ(walls_beside(senses, true), 0.9f);
  EXPECT_EQ(walls_beside(senses, false), 0.3f);
  senses.range_m[6] = 0.3f;
  EXPECT_EQ(walls_beside(senses, false), 0.9f);
  senses.range_known = false;
  EXPECT_EQ(walls_beside(senses, false), 0.0f);
}

TEST(RoadSight, LineOrWallsShowTheMiddle) {
  constexpr Body body;
  Senses senses = clear();
  float left_m = 0.0f;
  EXPECT_FALSE(see_middle(senses, body, "mark", 0.0f, left_m));
  senses.line[1] = 1.0f;   // 2 cm to the left of the axis
  senses.line_known = true;
  EXPECT_TRUE(see_middle(senses, body, "mark", 0.0f, left_m));
  EXPECT_NEAR(left_m, -0.02f, 1e-6f);
  EXPECT_FALSE(see_middle(senses, body, "dist", 0.0f, left_m));
  senses.range_m[2] = 0.35f;
  senses.range_m[6] = 0.25f;
  EXPECT_TRUE(see_middle(senses, body, "dist", 0.0f, left_m));
  EXPECT_NEAR(left_m, -0.05f, 1e-6f);
  senses.range_m[6] = 0.15f;
  EXPECT_FALSE(see_middle(senses, body, "dist", 0.0f, left_m)) << "something stands beside the robot";
}

/// Turns compass and wheels by so much, one after the other or together.
void turn(Lifted& lifted, Senses& senses, float compass_rad, float wheels_rad) {
  senses.heading_rad = wrapped_angle(senses.heading_rad + compass_rad);
  senses.turned_rad += wheels_rad;
  for (int i = 0; i < 15; ++i) lifted.step(senses, false, kTick);
}

TEST(Lifted, ACompassThatTurnsWithoutTheWheelsSaysSo) {
  Lifted lifted;
  Senses senses;
  senses.heading_known = senses.turned_known = true;
  turn(lifted, senses, 3.0f, 3.0f);
  EXPECT_FALSE(lifted.suspected());
  turn(lifted, senses, 1.0f, 0.0f);
  EXPECT_TRUE(lifted.now());
  EXPECT_NEAR(lifted.facing_rad(), wrapped_angle(4.0f), 1e-5f);
  lifted.forget();
  turn(lifted, senses, 0.0f, 0.0f);
  EXPECT_FALSE(lifted.suspected()) << "it is here now";
}

TEST(Lifted, DriftIsFollowedAndSilenceSaysNothing) {
  Lifted lifted;
  Senses senses;
  senses.heading_known = senses.turned_known = true;
  for (int i = 0; i < 500; ++i) {
    turn(lifted, senses, 0.01f, 0.0f);
    ASSERT_FALSE(lifted.suspected()) << i;
  }
  senses.heading_known = false;
  turn(lifted, senses, 2.0f, 0.0f);
  EXPECT_FALSE(lifted.suspected());
}

TEST(Lifted, ARoadThatRunsOtherwiseSaysSoAfterAWhile) {
  Lifted lifted;
  Senses senses;
  senses.heading_known = senses.turned_known = true;
  for (int i = 0; i < 5; ++i) lifted.step(senses, true, kTick);
  EXPECT_TRUE(lifted.suspected());
  EXPECT_FALSE(lifted.now());
  for (int i = 0; i < 10; ++i) lifted.step(senses, true, kTick);
  EXPECT_TRUE(lifted.now());
}

}  // namespace
}  // namespace mts
