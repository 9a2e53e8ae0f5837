#include "sim/mind/road_ahead.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <waymark/controllers/road_map.h>
#include "compiler/model/ground.h"
#include "sim/robot_body.h"
#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

/// Three metres to the east, two to the north, by compass; the robot's centre is `before_m` before the stop line.
RoadAhead bent_road(double before_m) {
  auto memory = std::make_shared<Memory>();
  memory->exits.push_back({.name = "E", .method = "azimuth", .course = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 2.0}}});
  RoadAhead road;
  road.enter(memory, 0, {5.0f, 7.0f, 0.0f}, {-before_m, 0.0});
  return road;
}

float first_piece_m(const RoadAhead& road, const mts::Place& at) {
  mts::Task task;
  road.tell(task, at, RoadAhead::Back::kToMiddle);
  EXPECT_EQ(task.pieces, 2);
  EXPECT_NEAR(task.course[1].length_m, 2.0f, 1e-5f);
  return task.course[0].length_m;
}

TEST(RoadAhead, ItsPiecesBeginAtTheRobotAndNotAtTheStopLine) {
  EXPECT_NEAR(first_piece_m(bent_road(0.09), {5.0f, 7.0f, 0.0f}), 3.09f, 1e-5f);
  EXPECT_NEAR(first_piece_m(bent_road(0.2), {5.0f, 7.02f, 0.0f}), 3.2f, 1e-5f);   // hardly aside
}

TEST(RoadAhead, WhatHasBeenDrivenIsNotAhead) {
  EXPECT_NEAR(first_piece_m(bent_road(0.09), {6.09f, 7.0f, 0.0f}), 2.0f, 1e-5f);
}

TEST(RoadAhead, ItsPiecesLeadBackToTheMiddleOrRunBesideIt) {
  const RoadAhead road = bent_road(0.0);
  mts::Task back, beside;
  road.tell(back, {6.0f, 7.2f, 0.0f}, RoadAhead::Back::kToMiddle);
  EXPECT_LT(back.course[0].heading_rad, -0.4f);
  road.tell(beside, {6.0f, 7.2f, 0.0f}, RoadAhead::Back::kNever);
  ASSERT_EQ(beside.pieces, 2);
  EXPECT_NEAR(beside.course[0].heading_rad, 0.0f, 1e-5f);
  EXPECT_NEAR(beside.course[0].length_m, 2.0f, 1e-5f);
}

TEST(RoadAhead, ItIsPassedBehindItsEndAndNotBesideIt) {
  const RoadAhead road = bent_road(0.0);   // it ends at (8, 9), to the north; 15 cm of five metres may be odometry's error
  EXPECT_FALSE(road.passed({8.0f, 9.25f, 1.57f}));
  EXPECT_TRUE(road.passed({8.0f, 9.3f, 1.57f}));
  EXPECT_TRUE(road.passed({8.4f, 9.3f, 0.0f}));
  EXPECT_FALSE(road.passed({5.0f, 9.3f, 0.0f}));   // beside its beginning
  EXPECT_FALSE(RoadAhead().passed({8.0f, 9.3f, 0.0f}));
}

TEST(RoadAhead, BehindItsEndTheWayLeadsOnAndNotBack) {
  mts::Task task;
  bent_road(0.0).tell(task, {8.05f, 9.6f, 1.57f}, RoadAhead::Back::kToMiddle);   // the road was longer than odometry had it
  ASSERT_GE(task.pieces, 1);
  for (int i = 0; i < static_cast<int>(task.pieces); ++i) EXPECT_NEAR(task.course[i].heading_rad, 1.57f, 0.2f);
}

TEST(RoadAhead, WhereItIsCountsFromTheLandmarkWhicheverWayItIsDriven) {
  auto memory = std::make_shared<Memory>();
  memory->landmark = "Mill";
  memory->exits.push_back({.name = "W", .method = "mark", .course = {}});
  memory->exits.push_back({.name = "E", .method = "azimuth", .stop_m = 0.5, .course = {{0.0, 0.0}, {3.0, 0.0}, {3.0, 2.0}}});
  RoadAhead road;
  EXPECT_FALSE(road.where({}));
  road.enter(memory, 1, {5.0f, 7.0f, 0.0f}, {0.0, 0.0});
  const auto is_at = [&](const mts::Place& place, double along_m, bool outwards) {
    const auto on = road.where(place);
    ASSERT_TRUE(on);
    EXPECT_EQ(on->landmark + "." + on->exit, "Mill.E");
    EXPECT_NEAR(on->along_m, along_m, 1e-5);
    EXPECT_EQ(on->outwards, outwards);
  };
  is_at({6.0f, 7.02f, 0.1f}, 1.5, true);
  is_at({6.0f, 7.02f, 3.1f}, 1.5, false);
  road.turn_back();
  is_at({8.0f, 8.0f, -1.5f}, 4.5, false);
  is_at({8.0f, 8.0f, 1.5f}, 4.5, true);
  road.turn_back();
  is_at({8.0f, 8.0f, 1.5f}, 4.5, true);
  road.forget();
  EXPECT_FALSE(road.where({}));
}

/// The road as `kbc compile --map` emits it.
mts::MapRoad emitted(const model::GroundRoad& road, std::vector<mts::Piece>& course) {
  for (std::size_t i = 1; i < road.course.size(); ++i) {
    const Spot piece{road.course[i].x - road.course[i - 1].x, road.course[i].y - road.course[i - 1].y};
    course.push_back({static_cast<float>(heading(piece)), static_cast<float>(std::hypot(piece.x_m, piece.y_m))});
  }
  return {"", "", "", "", road.by == "open" ? "open" : "mark", mts::kInfinity, course.data(), static_cast<std::uint16_t>(course.size()),
          static_cast<float>(road.begins_apart_rad), static_cast<float>(road.ends_apart_rad)};
}

// A program that has only the map asks of its controllers what the simulator asks of them.
TEST(RoadAhead, TellsAtTheBeginningOfARoadWhatTheMapTellsAProgram) {
  const auto yard = Laboratory::of_text(R"(
import std.navigation
import std.hall
map Yard {
    landmark Dock  at (0, 0)
    landmark Arch  at (5, 0)
    landmark Shelf at (8, 6)
    landmark Store at (8, 12)
    landmark Hill  at (8, -3.4)
    road Arch.S  -- Hill.N  by mark
    road Dock.E  -- Arch.W  by mark
    road Arch.E  -- Shelf.S through (8, 0) by dist
    road Shelf.N -- Store.S by open
    road Dock.N  -- Store.W through (0, 9), (2, 12) by mark
}
)");
  const model::Model& model = yard->compiled->model;
  const auto roads = model::ground_roads(model, model.maps.front());
  ASSERT_TRUE(roads);
  const Floor floor(*yard->labyrinth);
  for (const model::GroundRoad& road : *roads) {
    const auto& memory = floor.memory(yard->labyrinth->by_name.at(std::string(road.from)));
    const auto arm = std::find_if(memory->exits.begin(), memory->exits.end(), [&](const Memory::Exit& exit) { return exit.name == road.exit; });
    ASSERT_NE(arm, memory->exits.end());
    EXPECT_NEAR(mts::stop_line_m(static_cast<float>(road.begins_apart_rad), kRobot), arm->stop_m, 1e-6) << road.from << "." << road.exit;
    std::vector<mts::Piece> course;
    const mts::MapRoad in_program = emitted(road, course);
    mts::RoadsDriven roads_driven;
    roads_driven.follow(&in_program);
    const mts::Task task = mts::task_along(roads_driven, kRobot);
    const float before_m = kRobot.line_ahead_m, heading_rad = course.front().heading_rad;
    const mts::Place at{7.0f, 5.0f, heading_rad};
    RoadAhead ahead;
    ahead.enter(memory, static_cast<std::uint32_t>(arm - memory->exits.begin()), at, {-before_m * std::cos(heading_rad), -before_m * std::sin(heading_rad)});
    mts::Task told;
    ahead.tell(told, at, RoadAhead::Back::kToMiddle);
    ASSERT_EQ(task.pieces, told.pieces) << road.from << "." << road.exit;
    for (std::size_t i = 0; i < told.pieces; ++i) {
      EXPECT_NEAR(task.course[i].heading_rad, told.course[i].heading_rad, 1e-4f);
      EXPECT_NEAR(task.course[i].length_m, told.course[i].length_m, 1e-4f);
    }
    if (!task.in_hall) continue;
    EXPECT_NEAR(task.in.x_m, told.in.x_m, 1e-4f);
    EXPECT_NEAR(task.in.y_m, told.in.y_m, 1e-4f);
    EXPECT_NEAR(task.out.x_m, told.out.x_m, 1e-4f);
    EXPECT_NEAR(task.out.y_m, told.out.y_m, 1e-4f);
    EXPECT_NEAR(task.out.heading_rad, told.out.heading_rad, 1e-4f);
  }
}

}  // namespace
}  // namespace kb::sim::testing
