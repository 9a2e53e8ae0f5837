#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/world/floor.h"
#include "sim/world/geometry.h"
#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

const Laboratory& drawn_up() {
  static const auto made = Laboratory::of_file("examples/04_simulator/route1.kb");
  return *made;
}

TEST(Layout, StretchesTheMapUntilTheShortestRoadHasRoom) {
  const Labyrinth& l = *drawn_up().labyrinth;
  EXPECT_DOUBLE_EQ(l.scale, 2.5);
  for (const Road& road : l.roads) EXPECT_GE(road.ends_m - road.begins_m, kLeastRoad - 1e-9) << road.name;
}

TEST(Layout, PutsAStopLineAndATagOnEachArm) {
  const Labyrinth& l = *drawn_up().labyrinth;
  EXPECT_EQ(l.stop_lines.size(), 2 * l.roads.size());
  EXPECT_EQ(l.tags.size(), 2 * l.roads.size());
  for (const Paint& line : l.stop_lines) EXPECT_NEAR(distance(line.from, line.to), kRoadWidth, 1e-9);
}

TEST(Layout, APlaceAtABendOfALineLiesOnTheLine) {
  const Labyrinth& l = *drawn_up().labyrinth;
  std::size_t bends = 0;
  for (const Crossing& crossing : l.crossings) {
    for (const Arm& arm : crossing.arms) {
      const Road& road = l[arm.road];
      if (road.kind != Picture::Kind::kMark) continue;
      bends += road.along.size() - 2;
      for (double along_m = 0.0; along_m < road.ends_m - road.begins_m; along_m += 0.05) {
        const Pose pose = l.place({l.crossing(crossing.name), &arm}, along_m);
        const auto off_m = [&](const Paint& line) { return nearest_on(line.from, line.to, {pose.x_m, pose.y_m}).distance_m; };
        const auto near = std::min_element(l.paint.begin(), l.paint.end(), [&](const Paint& a, const Paint& b) { return off_m(a) < off_m(b); });
        EXPECT_LT(off_m(*near), 1e-6) << road.name << " " << along_m;
      }
    }
  }
  EXPECT_GT(bends, 0u);
}

TEST(Layout, WallsStandBesideRoadsByDistAndNowhereElse) {
  const Labyrinth& l = *drawn_up().labyrinth;
  for (const Road& road : l.roads) {
    const OnChain middle = point_on(road.along, 0.5 * (road.begins_m + road.ends_m));
    double nearest = 1e9;
    for (const Picture::Wall& wall : l.walls) nearest = std::min(nearest, nearest_on(wall.from, wall.to, middle.at).distance_m);
    if (road.kind == Picture::Kind::kDist) {
      EXPECT_NEAR(nearest, 0.5 * kRoadWidth, 1e-6) << road.name;
    } else {
      EXPECT_GT(nearest, 0.6) << road.name;
    }
  }
}

TEST(Layout, AWalledCrossingIsClosedButForItsRoads) {
  const Labyrinth& l = *drawn_up().labyrinth;
  for (const Crossing& crossing : l.crossings) {
    if (!crossing.walled) continue;
    for (int k = 0; k < 360; ++k) {
      const Spot ahead = direction(k * kPi / 180.0);
      bool open = true;
      for (const Picture::Wall& wall : l.walls) open = open && !meet(crossing.at, crossing.at + 1.2 * ahead, wall.from, wall.to);
      bool road = false;
      for (const Arm& arm : crossing.arms) road = road || std::abs(wrap(arm.heading_rad - k * kPi / 180.0)) < std::atan2(0.31, arm.stop_m);
      EXPECT_TRUE(!open || road) << crossing.name << " is open at " << k;
    }
  }
}

TEST(Layout, SlantedRoadsOfEightSidesHaveTheirStopLinesClearOfEachOther) {
  const auto made = Laboratory::of_text(
      "import std.navigation\nimport std.compass8\nmap M {\n landmark A at (0, 0)\n landmark B at (3, 0)\n landmark C at (3, 3)\n landmark D at (-3, 1)\n"
      " road A.E -- B.W\n road A.NE -- C.SW by dist\n road B.N -- C.S by azimuth\n road A.W -- D.E\n}\ncommand Go\nroute R on M by Go: A -> C -> B\n");
  const Labyrinth& l = *made->labyrinth;
  for (std::size_t i = 0; i < l.stop_lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(meet(l.stop_lines[i].from, l.stop_lines[i].to, l.stop_lines[j].from, l.stop_lines[j].to)) << i << " " << j;
    }
  }
  EXPECT_GT(l[l.crossing("A")].arm("E")->stop_m, kLeastStop);
}

TEST(Layout, AHallHasWallsRoundItAndDoorsAtItsEnds) {
  const auto made = Laboratory::of_text(
      "import std.navigation\nnames Method more { open }\nmap M {\n landmark A at (0, 0)\n landmark B at (6, 0)\n landmark C at (0, -3)\n road A.E -- B.W by open\n"
      " road A.S -- C.N\n}\ncommand Go\nroute R on M by Go: A -> C\ncontrol Move.open = hold_heading()\ncontrol Cross[t, open] = turn_on_line(turn: t)\n");
  const Labyrinth& l = *made->labyrinth;
  EXPECT_FALSE(l.pillars.empty());
  EXPECT_EQ(l.roads[0].kind, Picture::Kind::kOpen);
  EXPECT_GE(l.walls.size(), 6u);
}

TEST(Floor, IsDarkOnPaintBrightBesideAndBetweenThereIsAnEdge) {
  const Labyrinth& l = *drawn_up().labyrinth;
  const Floor floor(l);
  const Road& road = l.roads[0];   // LM1.S--LM5.N, straight to the south
  const Spot on = point_on(road.along, 1.0).at;
  EXPECT_FLOAT_EQ(floor.darkness(on, 0.01), 1.0f);
  EXPECT_FLOAT_EQ(floor.darkness(on + Spot{0.05, 0.0}, 0.01), 0.0f);
  EXPECT_NEAR(floor.darkness(on + Spot{0.5 * l.widths.line_m, 0.0}, 0.01), 0.5f, 1e-5f);
  EXPECT_FLOAT_EQ(floor.darkness({1e6, -1e6}, 0.01), 0.0f);
}

TEST(Floor, IsPaintedAsBroadAsItIsAskedFor) {
  LayoutOptions layout;
  layout.build.widths = {0.05, 0.15};
  const auto town = Laboratory::of_text(R"(import std.navigation
map Town {
    landmark Inn  at (0, 0)
    landmark Mill at (4, 0)
    road Inn.E -- Mill.W
}
command Go
route Errand on Town by Go: Inn -> Mill
)", layout);
  const Floor floor(*town->labyrinth);
  const double stop_m = town->labyrinth->roads[0].begins_m;
  EXPECT_NEAR(floor.darkness({2.0, 0.025}, 0.01), 0.5f, 1e-5f);
  EXPECT_FLOAT_EQ(floor.darkness({2.0, 0.036}, 0.01), 0.0f);
  EXPECT_NEAR(floor.darkness({stop_m + 0.075, 0.2}, 0.01), 0.5f, 1e-5f);
  EXPECT_FLOAT_EQ(floor.darkness({stop_m - 0.064, 0.2}, 0.01), 1.0f);
  EXPECT_EQ(town->plain().body.paint_width_m, 0.05f);
  EXPECT_EQ(town->plain().body.stop_line_width_m, 0.15f);
}

TEST(Floor, AWornStretchCannotBeSeenUntilItIsMended) {
  const Labyrinth& l = *drawn_up().labyrinth;
  Floor floor(l);
  const Road& road = l.roads[0];
  const Spot on = point_on(road.along, road.begins_m + 0.5).at;
  floor.wear_off({RoadId{0}, 0.4, 0.6});
  EXPECT_FLOAT_EQ(floor.darkness(on, 0.01), 0.0f);
  EXPECT_FLOAT_EQ(floor.darkness(point_on(road.along, road.begins_m + 0.7).at, 0.01), 1.0f);
  floor.mend(RoadId{0});
  EXPECT_FLOAT_EQ(floor.darkness(on, 0.01), 1.0f);
}

TEST(Floor, WhoUndoesSomethingUndoesWhatHeDidAndNobodyUndoesAll) {
  const Labyrinth& l = *drawn_up().labyrinth;
  Floor floor(l);
  constexpr RoadId kRoad{0};
  constexpr CrossingId kCrossing{0};
  for (const Floor::Cause cause : {1u, 2u, Floor::kNobody}) {
    floor.set_closed(kRoad, true, cause);
    floor.set_safe(kCrossing, false, cause);
    floor.wear_off({kRoad, 0.1 * cause, 0.1 * cause + 0.2, cause});
  }
  floor.set_closed(kRoad, false, 1);
  floor.set_safe(kCrossing, true, 1);
  floor.mend(kRoad, 1);
  EXPECT_TRUE(floor.closed(kRoad));
  EXPECT_FALSE(floor.safe(kCrossing));
  EXPECT_EQ(floor.worn().size(), 2u);
  floor.set_closed(kRoad, false);
  floor.set_safe(kCrossing, true);
  floor.mend(kRoad);
  EXPECT_FALSE(floor.closed(kRoad));
  EXPECT_TRUE(floor.safe(kCrossing));
  EXPECT_TRUE(floor.worn().empty());
}

TEST(Floor, ATagTellsWhatItsLandmarkIsLikeNow) {
  const Labyrinth& l = *drawn_up().labyrinth;
  Floor floor(l);
  const auto end = *l.end("LM7.N");
  const Pose before = l.place(end, kTagBefore);
  const Floor::Reading* reading = floor.tag_near({before.x_m, before.y_m});
  ASSERT_NE(reading, nullptr);
  const auto first = reading->memory;
  EXPECT_EQ(first->landmark, "LM7");
  EXPECT_EQ(first->exits[reading->arm].name, "N");
  const RoadId closed = l.end("LM7.E")->arm->road;
  floor.set_closed(closed, true);
  const auto says_closed = [](const Memory& memory, std::string_view exit) {
    for (const Memory::Exit& e : memory.exits) {
      if (e.name == exit) return e.closed;
    }
    return false;
  };
  EXPECT_TRUE(says_closed(*floor.tag_near({before.x_m, before.y_m})->memory, "E"));
  EXPECT_FALSE(says_closed(*first, "E")) << "what was read stays as it was read";
  const auto arm = static_cast<std::uint32_t>(end.arm - l[end.crossing].arms.data());
  floor.set_tag(end.crossing, arm, Floor::TagState::kUnreadable);
  EXPECT_EQ(floor.tag_near({before.x_m, before.y_m}), nullptr);
  floor.set_tag(end.crossing, arm, Floor::TagState::kWrong, l.crossing("LM3"));
  EXPECT_EQ(floor.tag_near({before.x_m, before.y_m})->memory->landmark, "LM3");
  floor.set_tag(end.crossing, arm, Floor::TagState::kWell);
  EXPECT_EQ(floor.tag_near({before.x_m, before.y_m})->memory->landmark, "LM7");
}

}  // namespace
}  // namespace kb::sim::testing
