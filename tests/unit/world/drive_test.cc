#include "tests/world/drive.h"

#include <gtest/gtest.h>

namespace kb::world {
namespace {

constexpr Action kMove{Action::Kind::kMove, Turn::kForward, Method::kMark};
constexpr Action kRight{Action::Kind::kCross, Turn::kRight, Method::kMark};

/// A -E-> B, and roads from B to the north and south; every road two metres long.
World junction() {
  World world;
  Map& map = world.map;
  const LandmarkId a = map.add_landmark("A"), b = map.add_landmark("B"), c = map.add_landmark("C"),
                   d = map.add_landmark("D");
  map.add_road(a, Direction::kE, b, Direction::kW, false, Method::kMark, 2.0);
  map.add_road(b, Direction::kN, c, Direction::kS, false, Method::kDist, 2.0);
  map.add_road(b, Direction::kS, d, Direction::kN, true, Method::kMark, 2.0);
  world.put(map.edge("A.E"), 1.0);
  return world;
}

void drive_for(World& world, Action action, int ticks) {
  for (int i = 0; i < ticks; ++i) drive(world, action, 100);
}

TEST(ActionOf, ReadsTheStrategiesOfTheLibrary) {
  EXPECT_EQ(action_of("Move.azimuth").method, Method::kAzimuth);
  const Action cross = action_of("Cross[left,dist]");
  EXPECT_EQ(cross.kind, Action::Kind::kCross);
  EXPECT_EQ(cross.turn, Turn::kLeft);
  EXPECT_EQ(cross.method, Method::kDist);
  EXPECT_EQ(action_of("Search").kind, Action::Kind::kStand);
  EXPECT_EQ(action_of("Move.wings").kind, Action::Kind::kStand);
}

TEST(Drive, StandsWithoutAStrategy) {
  World world = junction();
  drive_for(world, action_of(""), 10);
  EXPECT_EQ(world.where(), "A.E@1.00");
  EXPECT_EQ(world.time_ms, 1000);
}

TEST(Drive, CoversHalfAMetreASecond) {
  World world = junction();
  drive_for(world, kMove, 10);
  EXPECT_EQ(world.where(), "A.E@1.50");
}

TEST(Drive, CrossesFromTheLineToTheRoadOfExit) {
  World world = junction();
  drive_for(world, kMove, 19);
  ASSERT_TRUE(world.on_entry_line());
  drive_for(world, kRight, 17);
  EXPECT_EQ(world.way_text(), "B.S");
  EXPECT_TRUE(world.on("B.S"));
  EXPECT_TRUE(world.faults.empty());
}

TEST(Drive, NotesEveryAccidentOnce) {
  World world = junction();
  drive_for(world, kMove, 40);
  ASSERT_EQ(world.faults.size(), 1u);
  EXPECT_EQ(world.faults[0].what, "over the stop line of B without a manoeuvre");
}

TEST(Drive, NotesACrossingToWhereThereIsNoRoad) {
  World world = junction();
  drive_for(world, kMove, 19);
  drive(world, {Action::Kind::kCross, Turn::kForward, Method::kMark}, 100);
  ASSERT_EQ(world.faults.size(), 1u);
  EXPECT_EQ(world.faults[0].what, "crossed B to E, where there is no road");
}

TEST(Drive, NotesAClosedRoadAnUnsafeCrossingAndAWrongMethod) {
  World world = junction();
  world.map[world.map.landmark("B")].safe = false;
  world.map.road(world.map.edge("B.S")).closed = true;
  drive_for(world, kMove, 19);
  drive(world, {Action::Kind::kCross, Turn::kRight, Method::kAzimuth}, 100);
  EXPECT_EQ(world.faults.size(), 3u);
}

TEST(Drive, NotesAMethodThatCannotBeFollowedAfterASecond) {
  World world = junction();
  world.put(world.map.edge("B.N"), 0.3);
  drive_for(world, kMove, 10);
  EXPECT_TRUE(world.faults.empty());
  drive_for(world, kMove, 1);
  EXPECT_EQ(world.faults.size(), 1u);
}

TEST(Drive, GetsRoundAnObstacleByAvoidingOnly) {
  World world = junction();
  world.map.road(world.map.edge("A.E")).obstacles.push_back({1.2, world.map.edge("A.E"), true});
  drive_for(world, kMove, 10);
  ASSERT_EQ(world.faults.size(), 1u);
  EXPECT_EQ(world.faults[0].what, "drove into an obstacle");
  drive_for(world, {Action::Kind::kAvoid}, 25);
  EXPECT_GT(world.position_m(), 1.5);
  EXPECT_EQ(world.faults.size(), 1u);
}

TEST(Drive, StandsBeforeAnObstacleThatCannotBePassed) {
  World world = junction();
  world.map.road(world.map.edge("A.E")).obstacles.push_back({1.2, world.map.edge("A.E"), false});
  drive_for(world, {Action::Kind::kAvoid}, 100);
  EXPECT_LT(world.position_m(), 1.2);
  EXPECT_TRUE(world.faults.empty());
}

TEST(Drive, TurnsRoundOnARoadBothWays) {
  World world = junction();
  drive_for(world, {Action::Kind::kRound}, 30);
  EXPECT_TRUE(world.turned);
  EXPECT_EQ(world.where(), "B.W@1.00");
  drive(world, {}, 100);
  EXPECT_FALSE(world.turned);
}

TEST(Drive, CannotTurnRoundOnAOneWayRoad) {
  World world = junction();
  world.put(world.map.edge("B.S"), 1.0);
  drive_for(world, {Action::Kind::kRound}, 30);
  ASSERT_EQ(world.faults.size(), 1u);
  EXPECT_EQ(world.faults[0].what, "turned round where it cannot");
}

}  // namespace
}  // namespace kb::world
