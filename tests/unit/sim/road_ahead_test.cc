#include "sim/mind/road_ahead.h"

#include <gtest/gtest.h>

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
  road.tell(task, at, false);
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

}  // namespace
}  // namespace kb::sim::testing
