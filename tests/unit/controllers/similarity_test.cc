#include <waymark/controllers/similarity.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/controllers/drives.h"

namespace mts::plant {
namespace {

constexpr Similarity kAs{4.0f};   // times are twice as long
static_assert(Similarity{}.in(Body{}).radius_m == Body{}.radius_m && Similarity{}.of("1/(m s2)") == 1.0f);

TEST(Similarity, KnowsTheUnitsOfAllParameters) {
  EXPECT_EQ(kAs.of("m"), 4.0f);
  EXPECT_EQ(kAs.of("s"), 2.0f);
  EXPECT_EQ(kAs.of("m/s"), 2.0f);
  EXPECT_EQ(kAs.of("m/s2"), 1.0f);
  EXPECT_EQ(kAs.of("1/m"), 0.25f);
  EXPECT_EQ(kAs.of("deg/s"), 0.5f);
  EXPECT_EQ(kAs.of("1/(m s)"), 0.125f);
  EXPECT_EQ(kAs.of("1/(m s2)"), 0.0625f);
  for (const char* same : {"", "deg"}) EXPECT_EQ(kAs.of(same), 1.0f) << same;
  for (const ControllerEntry& entry : kControllers) {
    for_each_parameter(entry.id, [&](const Parameter& parameter) {
      for (const char c : std::string(parameter.unit)) EXPECT_NE(std::string("ms2deg1/() ").find(c), std::string::npos) << parameter.name << ", " << parameter.unit;
    });
  }
}

TEST(Similarity, BrakesAsItDoesAndTurnsSlower) {
  const Body robot = kAs.out(Body{});
  EXPECT_EQ(robot.size, 4.0f);
  EXPECT_EQ(robot.radius_m, 0.48f);
  EXPECT_EQ(robot.road_width_m, 2.4f);
  EXPECT_EQ(robot.top_speed_m_s, 1.2f);
  EXPECT_EQ(robot.top_acceleration_m_s2, Body{}.top_acceleration_m_s2);
  EXPECT_EQ(kAs.out(Motion{0.3f, 3.0f}).turn_rad_s, 1.5f);
  const Body back = kAs.in(robot);
  EXPECT_EQ(back.size, 1.0f);
  EXPECT_EQ(back.line_ahead_m, Body{}.line_ahead_m);
  EXPECT_EQ(back.range_latency_s, Body{}.range_latency_s);
}

TEST(Similarity, WhatSaysNothingSaysNothing) {
  Senses senses;
  senses.range_m[0] = std::numeric_limits<float>::infinity();
  senses.range_m[1] = -std::numeric_limits<float>::infinity();
  senses.range_m[2] = std::numeric_limits<float>::quiet_NaN();
  senses.range_m[3] = out_of_range_m(kAs.out(Body{}));
  senses.ranges_unknown = 0x80;
  senses.age.range_s = 1.0f;
  const Senses small = kAs.in(senses);
  EXPECT_EQ(small.range_m[0], senses.range_m[0]);
  EXPECT_EQ(small.range_m[1], senses.range_m[1]);
  EXPECT_TRUE(std::isnan(small.range_m[2]));
  EXPECT_EQ(small.range_m[3], kOutOfRange);
  EXPECT_EQ(small.ranges_unknown, senses.ranges_unknown);
  EXPECT_EQ(small.age.range_s, 0.5f);
}

/// Between walls with a bend: where the robot is after each period.
std::vector<Point> driven(float size, double period_s) {
  const Similarity as(size);
  const auto long_m = [&](double m) { return m * static_cast<double>(as.of("m")); };
  const std::vector<Piece> pieces{{0.0f, as.out(2.0f, "m")}, {1.0f, as.out(2.0f, "m")}};
  Floor floor;
  for (const double side : {1.0, -1.0}) floor.add_walls(parallel_line({0.0, 0.0}, pieces, long_m(0.3), side * long_m(0.3)));
  Plant plant(floor, {}, 1);
  plant.body = as.out(Body{});
  plant.place(long_m(0.3), long_m(0.05), 0.1);
  AnyController drive;
  drive.choose(ControllerId::kKeepWall, as.in(plant.body));
  EXPECT_EQ(drive.set("speed", as.in(as.out(0.4f, "m/s"), "m/s")), Setting::kSet);
  Task task;
  task.pieces = 1;
  task.course[0] = pieces[0];
  drive.start(as.in(task), as.in(plant.sense()));
  const double dt_s = period_s * static_cast<double>(as.of("s"));
  std::vector<Point> way;
  for (int i = 0; i < 400; ++i) {
    plant.drive(as.out(drive.step(as.in(plant.sense()), as.in(static_cast<float>(dt_s), "s"))), dt_s);
    way.push_back({plant.x / long_m(1.0), plant.y / long_m(1.0)});
  }
  EXPECT_FALSE(plant.touched);
  return way;
}

// But for its motors: the plant's lag by 50 ms whatever its size.
TEST(Similarity, ALargerRobotDrivesAsTheSmallOneDoes) {
  const auto small = driven(1.0f, 0.02);
  EXPECT_GT(small.back().y, 0.5) << "it is round the bend";
  for (const float size : {4.0f, 2.25f}) {
    const auto large = driven(size, 0.02);
    for (std::size_t i = 0; i < small.size(); ++i) ASSERT_NEAR(std::hypot(large[i].x - small[i].x, large[i].y - small[i].y), 0.0, 2e-2) << size << ", period " << i;
  }
}

}  // namespace
}  // namespace mts::plant
