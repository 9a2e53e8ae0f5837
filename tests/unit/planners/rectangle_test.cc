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
ShapeClearance corridor() {
  ShapeClearance shapes;
  const double h = kCorridor / 2.0;
  shapes.add_polygon({{0.0, h}, {6.0, h}, {6.0, 5.0}, {0.0, 5.0}});
  shapes.add_polygon({{0.0, -h}, {0.0, -5.0}, {6.0, -5.0}, {6.0, -h}});
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

// Exactly: no corner of a wall lies in the rectangle, and no point of its rim in a wall.
double true_clearance(const Clearance& shapes, const Pose& pose) {
  double least = 1e9;
  const auto points = control_points(kRobot, pose);
  for (std::size_t side = 0; side < 4; ++side) {
    const Point a = points[side], b = points[(side + 1) % 4];
    for (int i = 0; i < 50; ++i) least = std::min(least, shapes.nearest(a + (i / 50.0) * (b - a)).distance_m);
  }
  return least;
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
      ASSERT_GT(true_clearance(shapes, pose), 0.0) << "run " << i;
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

TEST(Rectangle, refuses_a_shape_without_extent) {
  const ShapeClearance shapes = corridor();
  const RectangleField field(shapes, {0.0, 0.4}, {20.0, 0.0}, std::nullopt, 0.1, {});
  EXPECT_EQ(drive_rectangle(field, {}, {}, {}).outcome, Outcome::kInvalid);
}

}  // namespace
}  // namespace kb::planners
