#include "tests/world/random_map.h"

#include <gtest/gtest.h>

#include <set>

namespace kb::world {
namespace {

TEST(Dice, FallTheSameOnEveryMachine) {
  Dice dice(1);
  EXPECT_EQ(dice.below(1000), 528u);
  EXPECT_EQ(dice.between(-3, 3), -1);
  EXPECT_DOUBLE_EQ(dice.unit(), 0.45121490384453811);
}

TEST(RandomMap, IsTheSameForTheSameSeed) {
  Dice a(7), b(7), c(8);
  const std::string text = map_text(random_map(a));
  EXPECT_EQ(text, map_text(random_map(b)));
  EXPECT_NE(text, map_text(random_map(c)));
}

TEST(RandomMap, UsesEachExitOfALandmarkOnce) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Dice dice(seed);
    const Map map = random_map(dice);
    std::set<std::pair<std::size_t, std::size_t>> exits;
    for (const Edge& edge : map.edges) {
      EXPECT_TRUE(exits.insert({index(edge.from), index(edge.exit)}).second) << "seed " << seed;
    }
  }
}

TEST(RandomMap, HasOneWayRoadsLoopsParallelRoadsAndDeadEnds) {
  int one_way = 0, loops = 0, parallel = 0, dead_ends = 0;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Dice dice(seed);
    const Map map = random_map(dice);
    std::vector<int> exits(map.landmarks.size());
    std::set<std::pair<std::size_t, std::size_t>> pairs;
    for (const Edge& edge : map.edges) {
      ++exits[index(edge.from)];
      one_way += !edge.back;
      loops += edge.from == edge.to;
      parallel += !pairs.insert({index(edge.from), index(edge.to)}).second;
    }
    for (const int n : exits) dead_ends += n == 1;
  }
  for (const int kind : {one_way, loops, parallel, dead_ends}) EXPECT_GT(kind, 0);
}

TEST(RandomRoute, GoesFromEachLandmarkToTheNext) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    Dice dice(seed);
    const Map map = random_map(dice);
    const RandomRoute route = random_route(dice, map);
    LandmarkId at = map[route.start].to;
    for (const EdgeId edge : route.edges) {
      EXPECT_EQ(map[edge].from, at) << "seed " << seed;
      at = map[edge].to;
    }
  }
}

TEST(RouteText, NamesTheExitWhereTwoRoadsLeadToTheNextStop) {
  Map map;
  const LandmarkId a = map.add_landmark("A"), b = map.add_landmark("B");
  const EdgeId north = map.add_road(a, Direction::kN, b, Direction::kN, false, Method::kMark, 2.0);
  map.add_road(a, Direction::kE, b, Direction::kW, true, Method::kDist, 2.0);
  EXPECT_EQ(map_text(map),
            "map M {\n  landmark A\n  landmark B\n  road A.N -- B.N by mark\n  road A.E -> B.W by dist\n}\n");
  EXPECT_EQ(route_text(map, {*map[north].back, {north, *map[north].back}}, 1),
            "command Go1\nroute R1 on M by Go1: A.N -> B -> A\n");
}

}  // namespace
}  // namespace kb::world
