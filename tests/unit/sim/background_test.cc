// Walls of a ROS map behind a floor, and halls that bend.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "planners/maps/maps.h"
#include "sim/mind/hall_planner.h"
#include "sim/robot/body.h"
#include "sim/world/geometry.h"
#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

constexpr std::string_view kStraight =
    "import std.navigation\nimport std.hall\nmap M {\n landmark A at (0, 0)\n landmark B at (5, 0)\n landmark C at (-2.5, 0)\n"
    " road A.E -- B.W by open\n road C.E -- A.W\n}\ncommand Go\nroute R on M by Go: A -> B\n";

/// 12 by 8 cells of half a metre, the lower left corner at (-3, -2): a block from (1, 0.5) to (2, 1), as map_server writes it.
planners::Grid building() {
  source::MemoryFileSystem files;
  files.add("hall.yaml", "image: hall.pgm\nresolution: 0.5\norigin: [-3.0, -2.0, 0.0]\nnegate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
  std::string image = "P2\n12 8\n255\n";
  for (int row = 7; row >= 0; --row) {   // the first row of the image is the topmost
    for (int column = 0; column < 12; ++column) image += row == 5 && (column == 8 || column == 9) ? "0 " : "254 ";
    image += "\n";
  }
  files.add("hall.pgm", image);
  source::Sources sources;
  std::string said;
  diagnostics::ErrorLines listener(sources, said);
  diagnostics::Diagnostics messages(sources, listener);
  auto map = planners::read_map("hall.yaml", files, sources, messages);
  if (!map) throw std::runtime_error(said);
  return std::move(map->grid);
}

std::unique_ptr<Laboratory> before(const planners::Grid& grid, std::string_view text) {
  LayoutOptions layout;
  layout.scale = 1.0;
  layout.background = &grid;
  layout.build.halls.push_back({"A.E", 2.4, false, {}, {}});
  return Laboratory::of_text(text, layout);
}

TEST(Background, ItsWallsStandWhereTheImageIsBlack) {
  const planners::Grid grid = building();
  const auto made = before(grid, kStraight);
  const auto stands = [&](Spot from, Spot to) {
    return std::any_of(made->labyrinth->walls.begin(), made->labyrinth->walls.end(), [&](const Picture::Wall& wall) {
      return (distance(wall.from, from) < 1e-6 && distance(wall.to, to) < 1e-6) || (distance(wall.from, to) < 1e-6 && distance(wall.to, from) < 1e-6);
    });
  };
  EXPECT_TRUE(stands({1.0, 0.5}, {2.0, 0.5}));
  EXPECT_TRUE(stands({1.0, 1.0}, {2.0, 1.0}));
  EXPECT_TRUE(stands({1.0, 0.5}, {1.0, 1.0}));
  EXPECT_TRUE(stands({2.0, 0.5}, {2.0, 1.0}));
}

TEST(Background, TheRobotSeesItTouchesItAndKnowsItInAHall) {
  const planners::Grid grid = building();
  const auto made = before(grid, kStraight);
  Arena arena(*made->labyrinth, {1.5, 0.0, 0.5 * kPi});
  EXPECT_NEAR(arena.ray({1.5, 0.0}, direction(0.5 * kPi), 4.0), 0.5f, 1e-3f);
  for (int i = 0; i < 300; ++i) arena.push(0.3, 0.0, 0.01);
  EXPECT_TRUE(arena.touching());
  EXPECT_NEAR(arena.pose().y_m, 0.5 - kRobotRadius, 0.01);
  const auto map = maps_of_halls(*made->labyrinth)[at(made->labyrinth->end("A.E")->arm->road)];
  ASSERT_NE(map, nullptr);
  EXPECT_NEAR(map->ray({1.5, 0.0}, direction(0.5 * kPi), 4.0), 0.5, 1e-9);
  EXPECT_TRUE(map->grid(0.1, 0.15).blocked(map->grid(0.1, 0.15).cell_at({1.5, 0.45})));
}

// A hall round a corner: from A to the east, then to the north, with a cupboard in the corner's way.
std::unique_ptr<Laboratory> bent(std::string_view control) {
  LayoutOptions layout;
  layout.build.halls.push_back({"A.E", 2.4, false, {{2.6, -0.5, 3.0, 0.1}}, {}});
  return Laboratory::of_text("import std.navigation\nimport std.hall\nimport std.go_to_goal\nmap M {\n landmark A at (0, 0)\n landmark B at (5, 4)\n landmark C at (-2.5, 0)\n landmark D at (5, 6.5)\n"
                             " road A.E -- B.S by open through (5, 0)\n road C.E -- A.W\n road B.N -- D.S\n}\ncommand Go\nroute R on M by Go: A -> B -> D\n"
                             "control Move.open = " + std::string(control) + "\n",
                             layout);
}

TEST(BentHall, ItsWallsKeepItsWidthRoundTheCornerAndItIsFreeFromDoorToDoor) {
  const auto made = bent("bug()");
  const Labyrinth& floor = *made->labyrinth;
  const RoadId id = floor.end("A.E")->arm->road;
  const auto map = maps_of_halls(floor)[at(id)];
  ASSERT_NE(map, nullptr);
  const double long_m = length_of(map->along);
  for (const double along_m : {1.5, long_m - 1.5}) {
    const OnChain at = point_on(map->along, along_m);
    for (const double side : {0.5 * kPi, -0.5 * kPi}) EXPECT_NEAR(map->ray(at.at, direction(at.heading_rad + side), 4.0), 1.2, 1e-6) << along_m;
  }
  EXPECT_NEAR(map->ray({5.0, 0.0}, direction(-0.25 * kPi), 4.0), 1.2 * std::sqrt(2.0), 1e-6) << "the outer corner is mitred";
  const planners::Grid grid = map->grid(0.1, 0.15);
  EXPECT_FALSE(grid.blocked(grid.cell_at({5.0, 0.0}))) << "the corner itself can be driven";
  EXPECT_TRUE(grid.blocked(grid.cell_at({3.0, 3.0}))) << "within the bend there is no hall";
}

class BentHallControl : public ::testing::TestWithParam<const char*> {};

TEST_P(BentHallControl, GetsRoundTheCorner) {
  const auto made = bent(GetParam());
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    Scenario scenario = made->plain();
    scenario.seed = seed;
    const Summary summary = made->drive(scenario);
    EXPECT_EQ(describe(summary), "arrived at D") << "seed " << seed;
    EXPECT_TRUE(summary.collisions.empty()) << "seed " << seed;
  }
}
INSTANTIATE_TEST_SUITE_P(Halls, BentHallControl, ::testing::Values("bug(kind: bug2)", "bug(kind: modified)", "neural_map()", "genetic()"));

}  // namespace
}  // namespace kb::sim::testing
