// Halls: what is built, what is known of them, and who gets across.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sim/mind/hall_planner.h"
#include "sim/world/geometry.h"
#include "tests/unit/sim/laboratory.h"
#include "tests/unit/stride.h"

namespace kb::sim::testing {
namespace {

using Box = HallBuild::Box;

std::string house(std::string_view control) {
  std::string text =
      "import std.navigation\nimport std.retreat\nimport std.hall\nimport std.go_to_goal\n"
      "map House {\n landmark Porch at (-2.5, 0)\n landmark Door at (0, 0)\n landmark Kitchen at (7, 0)\n landmark Yard at (9.5, 0)\n"
      " landmark Attic at (0, 3)\n landmark Bath at (7, 3)\n road Porch.E -- Door.W\n road Door.E -- Kitchen.W by open\n"
      " road Kitchen.E -- Yard.W\n road Door.N -- Attic.S\n road Attic.E -- Bath.W\n road Kitchen.N -- Bath.S\n}\n"
      "command Go\nroute Errand on House by Go: Door -> Kitchen -> Yard\ndetours on Errand when Closed[exit]\n";
  return text + "control Move.open = " + std::string(control) + "\n";
}

std::unique_ptr<Laboratory> hall(std::string_view control, const std::vector<Box>& boxes, bool pillars = false) {
  HallBuild build;
  build.road = "Door.E";
  build.width_m = 3.0;
  build.pillars = pillars;
  build.boxes = boxes;
  LayoutOptions layout;
  layout.build.halls.push_back(build);
  return Laboratory::of_text(house(control), layout);
}

const std::vector<Box> kFurniture{{1.6, -0.4, 2.0, 0.3}, {2.6, 0.6, 3.1, 1.5}, {3.7, -0.7, 4.4, 0.1}};
const std::vector<Box> kAisle{{1.6, 0.2, 1.9, 0.8}, {2.8, -0.9, 3.2, -0.2}, {4.0, 0.2, 4.4, 0.8}};
const std::vector<Box> kBay{{3.4, -0.7, 3.5, 0.7}, {2.5, 0.7, 3.5, 0.8}, {2.5, -0.8, 3.5, -0.7}};
const std::vector<Box> kSealed{{3.0, -1.5, 3.1, 1.5}};

bool runs(const Recording& recording, std::string_view strategy) {
  return std::any_of(recording.frames.begin(), recording.frames.end(), [&](const Frame& frame) {
    return frame.strategy >= 0 && recording.names.cells[static_cast<std::size_t>(frame.strategy)].name == strategy;
  });
}
bool sees(const Recording& recording, std::string_view fact) {
  return std::any_of(recording.frames.begin(), recording.frames.end(), [&](const Frame& frame) {
    return std::any_of(frame.events.begin(), frame.events.end(), [&](std::uint32_t cell) { return recording.names.cells[cell].name == fact; });
  });
}

/// Drives with some seeds; all must arrive without touching anything. Says of how many something is true.
template <class Is>
double arrive(Laboratory& laboratory, std::uint64_t seeds, const Is& is) {
  int count = 0, tried = 0;
  for (std::uint64_t seed = 1; seed <= seeds; seed += kb::testing::stride()) {
    Scenario scenario = laboratory.plain();
    scenario.seed = seed;
    Recording recording;
    const Summary summary = laboratory.drive(scenario, &recording);
    EXPECT_EQ(describe(summary), "arrived at Yard") << "seed " << seed;
    EXPECT_TRUE(summary.collisions.empty()) << "seed " << seed;
    EXPECT_FALSE(summary.lost_unaware()) << "seed " << seed;
    count += is(recording) ? 1 : 0;
    ++tried;
  }
  return static_cast<double>(count) / tried;
}

class Control : public ::testing::TestWithParam<const char*> {};

// Seeds of runs in which it came back to its nearest point, did not see the way free just there, and said that there is none (10
// and 12); and in which, sent back the other way, it had the wall at the wrong hand and ran into a chest (173).
TEST(BugOne, LeavesWhereTheWayWasFreeOnceThoughItIsSeenSoAStepLater) {
  const auto made = hall("bug(kind: bug1)", kFurniture);
  for (const std::uint64_t seed : {10u, 12u, 173u}) {
    Scenario scenario = made->plain();
    scenario.seed = seed;
    Recording recording;
    const Summary summary = made->drive(scenario, &recording);
    EXPECT_EQ(describe(summary), "arrived at Yard") << "seed " << seed;
    EXPECT_FALSE(sees(recording, "NoWay")) << "seed " << seed;
    EXPECT_TRUE(summary.collisions.empty()) << "seed " << seed;
  }
}

TEST_P(Control, GetsThroughAFurnishedHall) {
  const auto made = hall(GetParam(), kFurniture);
  EXPECT_EQ(arrive(*made, 4, [](const Recording& r) { return sees(r, "NoWay"); }), 0.0);
}
INSTANTIATE_TEST_SUITE_P(OpenRoads, Control,
                         ::testing::Values("bug(kind: bug2)", "bug(kind: modified)", "bug(side: right)", "potential(kind: parabolic)", "potential(kind: conic)",
                                           "potential(kind: combined)", "neural_map()", "genetic(seed: 3)", "GoToGoal()"));

TEST(Halls, RulesGetPastPillarsAndFieldsThroughAnAisleWithoutHelp) {
  const auto trapped = [](const Recording& r) { return sees(r, "Trapped"); };
  EXPECT_EQ(arrive(*hall("GoToGoal()", {}, true), 8, trapped), 0.0);
  EXPECT_LE(arrive(*hall("potential()", kAisle), 8, trapped), 0.125);   // 11 drives of 1,800
  EXPECT_EQ(arrive(*hall("GoToGoal()", kAisle), 8, trapped), 0.0);
}

TEST(Halls, ABayTrapsTheFieldWhichSaysSoAndTheMindEscapes) {
  const auto made = hall("potential(kind: conic)", kBay);
  EXPECT_EQ(arrive(*made, 8, [](const Recording& r) { return sees(r, "Trapped") && runs(r, "Escape"); }), 1.0);
  const auto planned = hall("neural_map()", kBay);
  EXPECT_EQ(arrive(*planned, 4, [](const Recording& r) { return sees(r, "Trapped"); }), 0.0);
}

TEST(Halls, ASealedHallIsFoundOutAndTheDetourTaken) {
  for (const char* control : {"bug(kind: bug1)", "bug(kind: bug2)", "bug(kind: modified)", "neural_map()", "genetic()"}) {
    const auto made = hall(control, kSealed);
    EXPECT_EQ(arrive(*made, 3, [](const Recording& r) { return sees(r, "NoWay") && runs(r, "Round"); }), 1.0) << control;
  }
}

TEST(Halls, WithoutADetourItStandsAndSaysSoAndTriesAgain) {
  const auto made = Laboratory::of_text(
      "import std.navigation\nimport std.hall\nmap M {\n landmark A at (0, 0)\n landmark B at (6, 0)\n landmark C at (-2.5, 0)\n"
      " road A.E -- B.W by open\n road C.E -- A.W\n}\ncommand Go\nroute R on M by Go: A -> B\n",
      {std::nullopt, nullptr, {1.0, {}, {{"B.W", 2.4, false, {{2.0, -1.2, 2.1, 1.2}}, {}}}}});
  Recording recording;
  const Summary summary = made->drive(made->scenario("limit = 80"), &recording);
  EXPECT_TRUE(sees(recording, "NoWay"));
  EXPECT_EQ(describe(summary), "stopped: Help.blocked");
  EXPECT_EQ(describe(made->drive(made->scenario("limit = 100"))), "still driving when the time was up") << "it tries again after 30 s";
}

TEST(Halls, CratesThatAppearWhileItDrivesAreGoneRound) {
  for (const char* control : {"neural_map()", "genetic()"}) {
    const auto made = hall(control, {});
    const Summary summary = made->drive(made->scenario(
        "[[event]]\nwhen = { road = \"Door.E\", metres = 1.0 }\nobstacle = \"crate\"\nroad = \"Door.E\"\nmetres = 2.6\nradius = 0.25\n"
        "[[event]]\nwhen = { time = 1 }\npress = \"Go\"\n"));
    EXPECT_EQ(describe(summary), "arrived at Yard") << control;
    EXPECT_TRUE(summary.collisions.empty()) << control;
  }
}

TEST(HallMap, ItsGridIsBlockedWhereTheRobotHasNoRoom) {
  const auto made = hall("bug()", kFurniture, true);
  const auto map = maps_of_halls(*made->labyrinth)[at(made->labyrinth->end("Door.E")->arm->road)];
  ASSERT_NE(map, nullptr);
  const planners::Grid grid = map->grid(0.1, 0.2);
  std::size_t free = 0;
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      const planners::Point centre = grid.centre({x, y});
      if (grid.blocked({x, y})) continue;
      ++free;
      EXPECT_GE(map->clearance({centre.x, centre.y}), 0.2);
    }
  }
  EXPECT_GT(free, 200u);
  EXPECT_LT(free, 1200u);
  EXPECT_EQ(maps_of_halls(*made->labyrinth)[at(made->labyrinth->end("Door.N")->arm->road)], nullptr);
}

/// The headings of the first way between two rows of pillars, by a genetic planner that has no time to find the best one.
std::vector<float> way_by(float seed) {
  auto map = std::make_shared<HallMap>();
  map->along = {{0.0, 0.0}, {6.0, 0.0}};
  map->width_m = 3.0;
  for (const double y_m : {-0.8, 0.0, 0.8}) map->pillars.insert(map->pillars.end(), {{{2.0, y_m}, 0.1}, {{4.0, y_m}, 0.1}});
  const mts::Senses senses;
  mts::PlanGains gains;
  gains.population = 4.0f;
  gains.generations = 1.0f;
  gains.seed = seed;
  mts::WayQuestion question;
  question.at.x_m = 1.0f;
  question.gate.x_m = 5.0f;
  question.senses = &senses;
  question.gains = &gains;
  question.first = true;
  HallPlanner planner(HallPlanner::Method::kGenetic);
  planner.enter(map, {});
  mts::Way way;
  EXPECT_EQ(planner.look(question, way), mts::WayNews::kNew);
  std::vector<float> headings;
  for (std::size_t i = 0; i < way.count; ++i) headings.push_back(way.pieces[i].heading_rad);
  return headings;
}

TEST(HallPlanner, AnotherSeedGivesAnotherWayAndTheSameSeedTheSame) {
  EXPECT_EQ(way_by(1.0f), way_by(1.0f));
  EXPECT_NE(way_by(1.0f), way_by(2.0f));
}

TEST(HallMap, RaysEndWhereTheyMeetSomething) {
  HallMap map;
  map.walls.push_back({{2.0, -1.0}, {2.0, 1.0}});
  map.pillars.push_back({{0.0, 3.0}, 0.5});
  EXPECT_NEAR(map.ray({0.0, 0.0}, {1.0, 0.0}, 4.0), 2.0, 1e-12);
  EXPECT_NEAR(map.ray({0.0, 0.0}, {0.0, 1.0}, 4.0), 2.5, 1e-12);
  EXPECT_NEAR(map.ray({0.0, 0.0}, {-1.0, 0.0}, 4.0), 4.0, 1e-12);
  EXPECT_NEAR(map.clearance({0.0, 2.0}), 0.5, 1e-12);
}

TEST(Layout, AHallSeenFromItsOtherEndIsTheSame) {
  const auto build = [](std::string road, Box box) {
    HallBuild one;
    one.road = std::move(road);
    one.pillars = false;
    one.boxes = {box};
    LayoutOptions layout;
    layout.build.halls = {one};
    return Laboratory::of_text(house("bug()"), layout);
  };
  const auto one = build("Door.E", {1.0, 0.2, 1.5, 0.6});
  const double long_m = 7.0 - 2.0 * kLeastStop;
  const auto other = build("Kitchen.W", {long_m - 1.5, -0.6, long_m - 1.0, -0.2});
  ASSERT_EQ(one->labyrinth->boxes.size(), 1u);
  ASSERT_EQ(other->labyrinth->boxes.size(), 1u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(distance(one->labyrinth->boxes[0][i], other->labyrinth->boxes[0][i]), 1e-9);
}

}  // namespace
}  // namespace kb::sim::testing
