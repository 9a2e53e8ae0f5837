// What follows from the map for the tasks of controllers.
#include <waymark/controllers/road_map.h>
#include <waymark/controllers/similarity.h>

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/controllers/drives.h"

namespace mts {
namespace {

constexpr Piece kCourse[] = {{0.0f, 3.0f}, {0.5f * kPi, 4.0f}};
constexpr MapRoad kBent = {"Arch", "E", "Shelf", "S", "mark", kInfinity, kCourse, 2};
constexpr MapRoad kOpen = {"Arch", "E", "Shelf", "S", "open", 0.3f, kCourse, 2};
constexpr Body kBody{.line_ahead_m = 0.1f, .crossing_m = 0.8f};

constexpr RoadsDriven on(const MapRoad& road) {
  RoadsDriven roads;
  roads.follow(&road);
  return roads;
}

static_assert(task_along(on(kBent), kBody).pieces == 2, "it needs no machine");

TEST(RoadMap, ACourseLeadsFromTheRobotOnTheStopLineOutToTheStopLineIn) {
  const Task task = task_along(on(kBent), kBody);
  ASSERT_EQ(task.pieces, 2);
  EXPECT_NEAR(task.course[0].length_m, 2.7f, 1e-6f);   // from 0.4 m, where the stop line is, and 0.1 m before
  EXPECT_NEAR(task.course[1].length_m, 3.6f, 1e-6f);
  EXPECT_EQ(task.course[1].heading_rad, 0.5f * kPi);
  EXPECT_FALSE(task.in_hall);
}

TEST(RoadMap, WhatIsBehindTheRobotIsNotInItsCourse) {
  const Task bend = task_along(on(kBent), kBody, 3.0f);
  ASSERT_EQ(bend.pieces, 1);
  EXPECT_NEAR(bend.course[0].length_m, 3.3f, 1e-6f);
  const Task end = task_along(on(kBent), kBody, 7.0f);
  ASSERT_EQ(end.pieces, 1) << "a road at its end is no unknown one, on which a controller would go on by itself";
  EXPECT_EQ(end.course[0].heading_rad, 0.5f * kPi);
  EXPECT_EQ(end.course[0].length_m, 0.01f);
  EXPECT_EQ(task_along(on(kBent), kBody, -1.0f).course[0].length_m, task_along(on(kBent), kBody).course[0].length_m);
  EXPECT_EQ(task_along(on(kBent), kBody, plant::kNaN).course[0].length_m, task_along(on(kBent), kBody).course[0].length_m);
}

TEST(RoadMap, OfARoadShorterThanItsCrossingsHardlyAnythingIsLeft) {
  static constexpr Piece kShort[] = {{0.0f, 0.5f}};
  constexpr MapRoad road = {"A", "E", "B", "W", "open", kInfinity, kShort, 1};
  const Task task = task_along(on(road), kBody);
  ASSERT_EQ(task.pieces, 1);
  EXPECT_EQ(task.course[0].length_m, 0.01f);
  EXPECT_FALSE(task.in_hall);
}

TEST(RoadMap, OfARoadWithManyBendsTheFirstPiecesAreTold) {
  Piece zigzag[12];
  for (std::size_t i = 0; i < 12; ++i) zigzag[i] = {i % 2 == 0 ? 0.0f : 1.0f, 1.0f};
  const MapRoad road = {"A", "E", "B", "W", "mark", kInfinity, zigzag, 12};
  const Task task = task_along(on(road), kBody);
  EXPECT_EQ(task.pieces, kLongestCourse);
  EXPECT_EQ(task.course[7].heading_rad, 1.0f);
}

TEST(RoadMap, PiecesInOneDirectionAreOne) {
  static constexpr Piece kSameWay[] = {{0.5f, 1.0f}, {0.5f, 1.0f}, {0.5f, 1.0f}, {1.0f, 1.0f}};
  constexpr MapRoad road = {"A", "E", "B", "W", "azimuth", kInfinity, kSameWay, 4};
  const Task task = task_along(on(road), kBody);
  ASSERT_EQ(task.pieces, 2);
  EXPECT_NEAR(task.course[0].length_m, 2.7f, 1e-6f);
}

TEST(RoadMap, TheDoorsOfAHallAreItsStopLinesSeenFromTheRobot) {
  EXPECT_TRUE(crosses_hall(kOpen));
  EXPECT_FALSE(crosses_hall({"A", "E", "B", "W", "opens", kInfinity, kCourse, 2}));
  EXPECT_FALSE(crosses_hall({"A", "E", "B", "W", "", kInfinity, kCourse, 2}));
  const Task task = task_along(on(kOpen), kBody), later = task_along(on(kOpen), kBody, 0.5f);
  ASSERT_TRUE(task.in_hall);
  EXPECT_NEAR(task.in.x_m, 0.1f, 1e-6f);
  EXPECT_NEAR(task.in.y_m, 0.0f, 1e-6f);
  EXPECT_NEAR(task.out.x_m, 2.7f, 1e-5f);
  EXPECT_NEAR(task.out.y_m, 3.6f, 1e-5f);
  EXPECT_EQ(task.out.heading_rad, 0.5f * kPi);
  EXPECT_NEAR(later.in.x_m, -0.4f, 1e-6f);
  EXPECT_NEAR(later.out.x_m, 2.2f, 1e-5f);
  const Task past_bend = task_along(on(kOpen), kBody, 3.7f);   // 1 m north of the bend
  EXPECT_NEAR(past_bend.in.x_m, -2.6f, 1e-5f);
  EXPECT_NEAR(past_bend.in.y_m, -1.0f, 1e-5f);
  EXPECT_NEAR(past_bend.out.x_m, 0.0f, 1e-5f);
  EXPECT_NEAR(past_bend.out.y_m, 2.6f, 1e-5f);
}

// The sign of Shelf is read on the road from Arch; there the leg by Store turns out to be closed.
TEST(RoadMap, ACrossingIsLeftInTheDirectionOfTheNextRoad) {
  static constexpr Piece kNorth[] = {{0.5f * kPi, 2.0f}}, kWest[] = {{kPi, 2.0f}};
  constexpr MapRoad kStore = {"Shelf", "N", "Store", "S", "mark", kInfinity, kNorth, 1}, kYard = {"Shelf", "W", "Yard", "E", "mark", kInfinity, kWest, 1};
  RoadsDriven roads;
  EXPECT_EQ(task_along(roads, kBody).pieces, 0);
  EXPECT_FALSE(task_across(roads, kBody).entry_known);
  EXPECT_FALSE(task_across(roads, kBody).exit_known);
  roads.follow(&kBent);
  EXPECT_TRUE(task_across(roads, kBody).exit_known);
  EXPECT_EQ(task_across(roads, kBody).exit_heading_rad, 0.0f);
  EXPECT_FALSE(task_across(roads, kBody).entry_known);   // nobody knows how it came to Arch
  for (const MapRoad* leaves : {&kStore, &kYard}) {
    roads.follow(leaves);
    roads.follow(leaves);
    EXPECT_EQ(roads.came(), &kBent);
    EXPECT_EQ(task_across(roads, kBody).exit_heading_rad, leaves->course[0].heading_rad);
    EXPECT_TRUE(task_across(roads, kBody).entry_known);
    EXPECT_EQ(task_across(roads, kBody).entry_heading_rad, 0.5f * kPi);
  }
}

TEST(RoadMap, AStopLineLiesClearOfTheCornerWithTheNextRoad) {
  constexpr Body kWide{.line_ahead_m = 0.1f, .road_width_m = 0.6f, .crossing_m = 0.9f};
  EXPECT_EQ(stop_line_m(kPi, kWide), 0.45f);
  EXPECT_EQ(stop_line_m(0.5f * kPi, kWide), 0.45f);
  EXPECT_NEAR(stop_line_m(0.25f * kPi, kWide), 0.3f / std::tan(kPi / 8.0f) + 0.1f, 1e-5f);
  EXPECT_EQ(stop_line_m(5.0f * kRadPerDeg, kWide), 0.45f);
  EXPECT_EQ(stop_line_m(plant::kNaN, kWide), 0.45f);
  EXPECT_NEAR(stop_line_m(0.25f * kPi, Similarity(3.0f).out(kWide)), 3.0f * stop_line_m(0.25f * kPi, kWide), 1e-5f);
}

TEST(RoadMap, ACrossingIsAsLargeAsItsTwoRoadsMakeIt) {
  static constexpr Piece kFiveEast[] = {{0.0f, 5.0f}};
  constexpr MapRoad in = {"A", "E", "B", "W", "mark", kInfinity, kFiveEast, 1, kPi, 0.25f * kPi}, out = {"B", "E", "C", "W", "mark", kInfinity, kFiveEast, 1, 0.2f * kPi, kPi};
  RoadsDriven roads = on(in);
  roads.follow(&out);
  const Task across = task_across(roads, kBody);
  EXPECT_NEAR(across.middle_m, stop_line_m(0.25f * kPi, kBody), 1e-6f);
  EXPECT_NEAR(across.crossing_m, stop_line_m(0.25f * kPi, kBody) + stop_line_m(0.2f * kPi, kBody), 1e-6f);
  EXPECT_NEAR(task_along(on(in), kBody).course[0].length_m, 5.0f - 0.4f + 0.1f - stop_line_m(0.25f * kPi, kBody), 1e-5f);
  EXPECT_NEAR(task_along(on(out), kBody).course[0].length_m, 5.0f - 0.4f + 0.1f - stop_line_m(0.2f * kPi, kBody), 1e-5f);
}

TEST(RoadMap, ARobotThatIsElsewhereDoesNotKnowHowItCameThere) {
  constexpr MapRoad kFar = {"Mill", "N", "Hill", "S", "mark", kInfinity, kCourse, 1};
  constexpr MapRoad kNext = {"Shelf", "N", "Store", "S", "mark", kInfinity, kCourse, 1};
  RoadsDriven roads = on(kBent);
  roads.follow(&kNext);
  roads.follow(&kFar);
  EXPECT_EQ(roads.came(), nullptr);
  roads.follow(&kBent);
  roads.forget();
  roads.follow(&kBent);
  roads.follow(&kNext);
  EXPECT_EQ(roads.came(), nullptr) << "it was carried while its leg was that";
  roads.follow(nullptr);
  EXPECT_EQ(roads.road(), nullptr);
  roads.follow(&kBent);
  EXPECT_EQ(roads.came(), nullptr);
}

}  // namespace
}  // namespace mts
