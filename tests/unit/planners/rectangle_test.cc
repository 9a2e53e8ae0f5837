// A rectangle in a field: no moment where all is symmetric, and a corridor that it can only enter lengthwise.
#include "planners/rectangle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "planners/dice.h"

namespace kb::planners {
namespace {

constexpr Rectangle kRobot{1.0, 0.4};
constexpr double kCorridor = 1.2 * 0.4;

// Two walls with a corridor between them along the x axis, from x = 0 to 6.
const std::vector<Point> kLeftWall = {{0.0, kCorridor / 2.0}, {6.0, kCorridor / 2.0}, {6.0, 5.0}, {0.0, 5.0}};
const std::vector<Point> kRightWall = {{0.0, -kCorridor / 2.0}, {0.0, -5.0}, {6.0, -5.0}, {6.0, -kCorridor / 2.0}};
ShapeClearance corridor() {
  ShapeClearance shapes;
  shapes.add_polygon(kLeftWall);
  shapes.add_polygon(kRightWall);
  return shapes;
}

// The zone is 0.1 m wide, and a force of 1 m/s is balanced 0.02 m from a wall: half of the room to either side.
PotentialParameters narrow(Attraction attraction) {
  PotentialParameters parameters;
  parameters.attraction = attraction;
  parameters.zone_cells = 1.0;
  parameters.balance_cells = 0.2;
  parameters.least_cells = 0.01;
  return parameters;
}

// Exactly, and not as the library does it: two convex bodies are apart if and only if a line along a side of one of them parts them.
bool are_apart(const std::vector<Point>& one, const std::vector<Point>& other) {
  const auto parts = [](const std::vector<Point>& body, const std::vector<Point>& from) {
    for (std::size_t i = 0, j = body.size() - 1; i < body.size(); j = i++) {
      const auto left_of_side = [&](Point p) { return cross(body[i] - body[j], p - body[j]); };
      double nearest = -1e9;   // counter-clockwise: outside is to the right
      for (const Point p : from) nearest = std::max(nearest, left_of_side(p));
      if (nearest < 0.0) return true;
    }
    return false;
  };
  return parts(one, other) || parts(other, one);
}
std::vector<Point> corners_of(const Pose& pose) {
  const auto points = control_points(kRobot, pose);
  return {points.begin(), points.begin() + 4};
}

TEST(Clearance, of_a_body_is_the_least_of_all_its_points) {
  ShapeClearance shapes;
  shapes.add_disc({3.1, 2.4}, 0.02);
  shapes.add_segment({1.0, 4.0}, {1.6, 4.3});
  shapes.add_polygon({{4.5, 3.6}, {4.7, 3.6}, {4.6, 3.9}});
  Grid grid(24, 20, 0.25);
  for (const Cell cell : {Cell{4, 5}, {12, 9}, {13, 9}, {18, 14}}) grid.set_blocked(cell, true);
  const GridClearance squares(grid, 1.0);
  Dice dice(4);
  const auto between = [&dice](double low, double high) { return low + (high - low) * dice.below(10'000) / 10'000.0; };
  int touched = 0;
  for (int i = 0; i < 300; ++i) {
    const Pose pose{{between(0.3, 5.7), between(0.3, 4.7)}, between(-kPi, kPi)};
    const auto corners = corners_of(pose);
    for (const Clearance* const world : {static_cast<const Clearance*>(&shapes), static_cast<const Clearance*>(&squares)}) {
      constexpr int kAlong = 100, kAcross = 40;   // a point every centimetre
      double least = 1e9;
      for (int a = 0; a <= kAlong; ++a) {
        for (int b = 0; b <= kAcross; ++b) {
          const Point across = corners[0] + (static_cast<double>(b) / kAcross) * (corners[1] - corners[0]);
          least = std::min(least, world->nearest(across + (static_cast<double>(a) / kAlong) * (corners[3] - corners[0])).distance_m);
        }
      }
      const double seen = world->distance_of(corners);
      touched += seen == 0.0 ? 1 : 0;
      if (least > 0.9) continue;   // the squares are seen up to a metre
      EXPECT_LE(seen, least + 1e-12) << "run " << i;
      EXPECT_GE(seen, least - 0.01) << "run " << i;
    }
  }
  EXPECT_GT(touched, 100);
}

TEST(Clearance, of_a_body_outside_of_the_map_is_none) {
  const Grid grid(24, 20, 0.25);
  const GridClearance squares(grid, 1.0);
  EXPECT_EQ(squares.distance_of(corners_of({{-30.0, 2.0}, 0.0})), 0.0);
  EXPECT_NEAR(squares.distance_of(corners_of({{1.0, 2.5}, 0.0})), 0.5, 1e-12);
  EXPECT_TRUE(std::isinf(squares.distance_of(corners_of({{3.0, 2.5}, 0.0}))));
}

TEST(Rectangle, has_its_control_points_at_corners_and_middles) {
  const auto points = control_points(kRobot, {{2.0, 1.0}, kPi / 2.0});
  EXPECT_NEAR(points[0].x, 2.2, 1e-12);   // front right, heading up
  EXPECT_NEAR(points[0].y, 1.5, 1e-12);
  EXPECT_NEAR(points[5].x, 1.8, 1e-12);   // left
  EXPECT_NEAR(points[5].y, 1.0, 1e-12);
}

TEST(Rectangle, feels_no_moment_in_the_middle_of_a_corridor) {
  const ShapeClearance shapes = corridor();
  const RectangleField field(shapes, kRobot, {20.0, 0.0}, std::nullopt, 0.1, narrow(Attraction::kConic));
  const ForceAndMoment act = field.at({{3.0, 0.0}, 0.0});
  EXPECT_NEAR(act.moment, 0.0, 1e-12);
  EXPECT_NEAR(act.force.y, 0.0, 1e-12);
  EXPECT_NEAR(act.force.x, 1.0, 1e-12);
}

TEST(Rectangle, is_turned_back_where_it_is_tilted) {
  const ShapeClearance shapes = corridor();
  const RectangleField field(shapes, kRobot, {20.0, 0.0}, std::nullopt, 0.1, narrow(Attraction::kConic));
  EXPECT_LT(field.at({{3.0, 0.0}, 0.05}).moment, 0.0);
  EXPECT_GT(field.at({{3.0, 0.0}, -0.05}).moment, 0.0);
}

// From random poses to a pose in front of the mouth, then through. The field is local: a robot that is drawn to the goal past
// the mouth would end at the wall beside it, so a route has to give the pose in front.
TEST(Rectangle, aligns_with_a_corridor_that_it_could_not_enter_crosswise) {
  const ShapeClearance shapes = corridor();
  const RectangleField to_mouth(shapes, kRobot, {-1.0, 0.0}, 0.0, 0.1, narrow(Attraction::kParabolic));
  const RectangleField through(shapes, kRobot, {8.0, 0.0}, 0.0, 0.1, narrow(Attraction::kParabolic));
  Dice dice(3);
  const auto between = [&dice](double low, double high) { return low + (high - low) * dice.below(1000) / 1000.0; };
  for (int i = 0; i < 20; ++i) {
    const Pose start{{between(-6.0, -4.0), between(-2.0, 2.0)}, between(-2.5, 2.5)};
    RectangleDrive how;
    how.tolerance_m = 0.02;
    const RectangleResult before = drive_rectangle(to_mouth, start, how, {});
    ASSERT_EQ(before.outcome, Outcome::kReached) << "run " << i;
    const RectangleResult result = drive_rectangle(through, before.poses.back(), how, {});
    ASSERT_EQ(result.outcome, Outcome::kReached) << "run " << i << " at " << result.poses.back().at.x << ","
                                                 << result.poses.back().at.y << " heading " << result.poses.back().heading_rad;
    int inside = 0;
    for (const Pose& pose : result.poses) {
      for (const auto& wall : {kLeftWall, kRightWall}) ASSERT_TRUE(are_apart(corners_of(pose), wall)) << "run " << i;
      if (pose.at.x < 1.0 || pose.at.x > 5.0) continue;
      ++inside;
      EXPECT_LE(std::abs(pose.heading_rad), 2.0 * kPi / 180.0) << "run " << i;
    }
    EXPECT_GT(inside, 10);
  }
}

TEST(Rectangle, straightens_out_in_a_corridor_under_either_drive) {
  const ShapeClearance shapes = corridor();
  const RectangleField field(shapes, kRobot, {5.0, 0.0}, std::nullopt, 0.1, narrow(Attraction::kConic));
  for (const Drive drive : {Drive::kKinematic, Drive::kDynamic}) {
    RectangleDrive how;
    how.drive = drive;
    const RectangleResult result = drive_rectangle(field, {{1.0, 0.005}, 0.05}, how, {});   // 2.9 degrees
    ASSERT_EQ(result.outcome, Outcome::kReached);
    EXPECT_LE(std::abs(result.poses.back().heading_rad), 2.0 * kPi / 180.0);
  }
}

// Across the mouth it stays outside, is told to be trapped, and touches nothing.
TEST(Rectangle, is_trapped_across_the_mouth) {
  const ShapeClearance shapes = corridor();
  const RectangleField field(shapes, kRobot, {20.0, 0.0}, std::nullopt, 0.1, narrow(Attraction::kConic));
  const RectangleResult result = drive_rectangle(field, {{-2.0, 0.0}, kPi / 2.0}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::kTrapped);
  EXPECT_EQ(result.trap.kind, Trap::Kind::kRest);
  EXPECT_LT(result.poses.back().at.x, 0.0);
}

// No control point comes within the zone of the disc: it would pass between the front's middle and its left corner.
TEST(Rectangle, says_that_it_touches_what_none_of_its_control_points_feels) {
  constexpr Point kThing{2.0, 0.1};
  constexpr double kRadius = 0.02;
  ShapeClearance shapes;
  shapes.add_disc(kThing, kRadius);
  PotentialParameters parameters = narrow(Attraction::kConic);
  parameters.zone_cells = 0.6;
  const RectangleField field(shapes, kRobot, {6.0, 0.0}, std::nullopt, 0.1, parameters);
  const RectangleResult result = drive_rectangle(field, {}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::kNumeric) << name(result.outcome);
  EXPECT_NEAR(result.poses.back().at.x + 0.5 * kRobot.length_m, kThing.x - kRadius, 1e-5);   // its front is there
}

// A thing that the body covers, clear of its rim.
TEST(Rectangle, touches_what_lies_under_it) {
  ShapeClearance shapes;
  shapes.add_disc({0.2, 0.0}, 0.02);
  const RectangleField field(shapes, kRobot, {6.0, 0.0}, std::nullopt, 0.1, narrow(Attraction::kConic));
  EXPECT_EQ(drive_rectangle(field, {}, {}, {}).outcome, Outcome::kNumeric);
}

TEST(Rectangle, refuses_a_shape_without_extent) {
  const ShapeClearance shapes = corridor();
  const RectangleField field(shapes, {0.0, 0.4}, {20.0, 0.0}, std::nullopt, 0.1, {});
  EXPECT_EQ(drive_rectangle(field, {}, {}, {}).outcome, Outcome::kInvalid);
  EXPECT_EQ(drive_rectangle(field, {}, {}, {}).fault, Fault::kBadParameter);
}

}  // namespace
}  // namespace kb::planners
