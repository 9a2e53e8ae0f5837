#include "tests/world/sense.h"

#include <gtest/gtest.h>

namespace kb::world {
namespace {

/// A -E-> B -E-> C, by the marking and by the walls; every road two metres long.
World row_of_three() {
  World world;
  Map& map = world.map;
  const LandmarkId a = map.add_landmark("A"), b = map.add_landmark("B"), c = map.add_landmark("C");
  map.add_road(a, Direction::kE, b, Direction::kW, false, Method::kMark, 2.0);
  map.add_road(b, Direction::kE, c, Direction::kW, false, Method::kDist, 2.0);
  world.put(map.edge("A.E"), 1.0);
  return world;
}

TEST(Sense, SeesNoSignOnTheOpenRoad) {
  const Readings now = sense(row_of_three());
  EXPECT_EQ(now.landmark, (std::vector<float>{-1.0f, -1.0f, -1.0f}));
  EXPECT_EQ(now.line, -1.0f);
  EXPECT_EQ(now.safe, 0.0f) << "no memory can be read here";
  EXPECT_EQ(now.track[index(Method::kMark)], kSure);
  EXPECT_EQ(now.track[index(Method::kAzimuth)], kSure);
  EXPECT_EQ(now.track[index(Method::kDist)], kSureNot);
}

TEST(Sense, SeesTheSignAndTheRoadOfArrivalBeforeTheLine) {
  World world = row_of_three();
  world.put(world.map.edge("A.E"), 1.3);
  const Readings now = sense(world);
  EXPECT_EQ(now.landmark[1], kSure);
  EXPECT_EQ(now.in[index(Direction::kW)], kSure);
  EXPECT_EQ(now.safe, 0.0f);
}

TEST(Sense, ReadsTheMemoryOnTheLineUnlessItReachesToTheSign) {
  World world = row_of_three();
  world.map.road(world.map.edge("B.E")).closed = true;
  world.put(world.map.edge("A.E"), 1.95);
  const Readings on_line = sense(world);
  EXPECT_EQ(on_line.line, kSure);
  EXPECT_EQ(on_line.safe, kSure);
  EXPECT_EQ(on_line.closed[index(Direction::kE)], kSure);
  EXPECT_EQ(on_line.closed[index(Direction::kW)], kSureNot);
  EXPECT_EQ(on_line.closed[index(Direction::kN)], 0.0f) << "there is no road";
  world.put(world.map.edge("A.E"), 1.3);
  world.memory_read = MemoryRead::kFromSign;
  EXPECT_EQ(sense(world).closed[index(Direction::kE)], kSure);
}

TEST(Sense, SeesTheRoadOfArrivalWhereTheModeSaysSo) {
  World world = row_of_three();
  const auto seen_at = [&](ArrivalSeen mode, double s_m) {
    world.arrival_seen = mode;
    world.put(world.map.edge("A.E"), s_m);
    return sense(world).in[index(Direction::kW)] > 0.0f;
  };
  EXPECT_TRUE(seen_at(ArrivalSeen::kAtSign, 1.3));
  EXPECT_FALSE(seen_at(ArrivalSeen::kAtSign, 1.95));
  EXPECT_FALSE(seen_at(ArrivalSeen::kOnLine, 1.3));
  EXPECT_TRUE(seen_at(ArrivalSeen::kOnLine, 1.95));
}

TEST(Sense, IsToldHowToDriveOnTheExitLine) {
  World world = row_of_three();
  world.put_in_crossing(world.map.landmark("B"), Direction::kW, Turn::kForward, 0.7);
  EXPECT_EQ(sense(world).move_by[index(Method::kDist)], kSure);
  world.put(world.map.edge("B.E"), 0.05);
  const Readings behind = sense(world);
  EXPECT_EQ(behind.line, kSure);
  EXPECT_EQ(behind.move_by[index(Method::kDist)], kSure);
  EXPECT_EQ(behind.landmark[1], kSure) << "the sign is still in view";
}

TEST(Sense, SeesAnObstacleAheadOnly) {
  World world = row_of_three();
  world.map.road(world.map.edge("A.E")).obstacles.push_back({1.3, world.map.edge("A.E"), true});
  EXPECT_EQ(sense(world).obstacle, kSure);
  world.put(world.map.edge("A.E"), 1.4);
  EXPECT_EQ(sense(world).obstacle, -1.0f);
  world.put(world.map.edge("B.W"), 0.5);
  EXPECT_EQ(sense(world).obstacle, kSure) << "the same obstacle from the other side, at 0.7 m";
}

}  // namespace
}  // namespace kb::world
