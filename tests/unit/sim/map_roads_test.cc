// The roads of a floor as a driver knows them, against what a C++ program gets of the same map.
#include "sim/mind/map_roads.h"

#include <gtest/gtest.h>

#include "compiler/model/ground.h"
#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

// A one-way road, two roads between the same landmarks, a bend, and a road that comes back to where it began.
constexpr std::string_view kTown = R"(
import std.navigation
import std.compass8
map Town {
    landmark Inn  at (0, 0)
    landmark Well at (6, 0)
    landmark Mill at (6, 6)
    road Inn.E  -- Well.W by mark
    road Inn.S  -- Well.S by dist through (0, -3), (6, -3)
    road Well.N -> Mill.S by azimuth
    road Mill.N -- Mill.E by mark through (6, 9), (9, 9), (9, 6)
    road Inn.NE -- Mill.W by mark through (3, 6)
}
command Go
route Errand on Town by Go: Inn.E -> Well -> Mill
)";

TEST(MapRoads, AreThoseOfTheMapAsItLiesOnTheFloor) {
  const auto made = Laboratory::of_text(kTown);
  const Labyrinth& floor = *made->labyrinth;
  const MapRoads roads(floor);
  const auto ground = model::ground_roads(made->compiled->model, made->compiled->model.maps.front());
  ASSERT_TRUE(ground);
  EXPECT_EQ(ground->size(), 9u) << "four roads there and back, and one of one way";
  for (const model::GroundRoad& road : *ground) {
    const mts::MapRoad* const found = roads.find(road.from, road.exit);
    ASSERT_NE(found, nullptr) << road.from << '.' << road.exit;
    EXPECT_EQ(std::string_view(found->to), road.to);
    EXPECT_EQ(std::string_view(found->approach), road.approach);
    EXPECT_EQ(std::string_view(found->by), road.by);
    EXPECT_NEAR(found->begins_apart_rad, road.begins_apart_rad, 1e-5);
    EXPECT_NEAR(found->ends_apart_rad, road.ends_apart_rad, 1e-5);
    const auto pieces = model::pieces_of(road.course);
    ASSERT_EQ(found->pieces, pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      EXPECT_NEAR(found->course[i].heading_rad, pieces[i].heading_rad, 1e-5);
      EXPECT_NEAR(found->course[i].length_m, floor.scale * pieces[i].length_m, 1e-4);
    }
    EXPECT_EQ(floor[roads.end_of(*found).crossing].name, road.from);
  }
}

TEST(MapRoads, AOneWayRoadIsKnownFromItsEndToo) {
  const auto made = Laboratory::of_text(kTown);
  const MapRoads roads(*made->labyrinth);
  const mts::MapRoad *const there = roads.find("Well", "N"), *const back = roads.find("Mill", "S");
  ASSERT_NE(there, nullptr);
  ASSERT_NE(back, nullptr);
  EXPECT_TRUE(mts::is_way_back(*back, *there));
  EXPECT_EQ(roads.find("Well", "NE"), nullptr);
}

}  // namespace
}  // namespace kb::sim::testing
