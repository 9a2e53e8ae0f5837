#include <waymark/controllers/bind_line.h>
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

TEST(Similarity, AQuickRobotIsConvertedByItsSizeAlone) {
  for (const float size : {0.5f, 1.0f, 3.0f}) {
    const Body robot = Similarity(size).out(Body{});
    EXPECT_EQ(Similarity::slowness(robot), 1.0f) << size;
    EXPECT_EQ(Similarity(robot).of("s"), Similarity(size).of("s")) << size;
    EXPECT_EQ(Similarity(robot).in(robot).top_acceleration_m_s2, robot.top_acceleration_m_s2) << size;
  }
}

TEST(Similarity, ASlowRobotHasTheAccelerationOfAQuickOneInItsOwnTime) {
  Body robot;
  robot.top_acceleration_m_s2 = 0.25f;
  const Similarity as(robot);
  EXPECT_EQ(as.of("s"), 2.0f);
  EXPECT_EQ(as.of("m"), 1.0f);
  EXPECT_EQ(as.in(robot).top_acceleration_m_s2, Similarity::kQuick_m_s2);
  EXPECT_EQ(as.in(robot).range_latency_s, 0.5f * robot.range_latency_s);
  EXPECT_EQ(as.out(Motion{0.4f, 2.0f}).speed_m_s, 0.2f);
  EXPECT_EQ(as.out(Motion{0.4f, 2.0f}).turn_rad_s, 1.0f);
  EXPECT_EQ(as.of_size().of("s"), 1.0f);
}

TEST(Similarity, WhatIsWeakestTellsHowSlowARobotIs) {
  Body robot;
  robot.top_turn_rad_s = 0.5f;
  EXPECT_EQ(Similarity::slowness(robot), 2.0f);
  robot.top_speed_m_s = 0.05f;
  EXPECT_EQ(Similarity::slowness(robot), 4.0f);
  robot.top_acceleration_m_s2 = 0.01f;
  EXPECT_EQ(Similarity::slowness(robot), Similarity::kSlowest);
  for (const float odd : {0.0f, -1.0f, std::numeric_limits<float>::quiet_NaN()}) {
    for (float Body::* limit : {&Body::top_acceleration_m_s2, &Body::top_turn_rad_s, &Body::top_speed_m_s, &Body::size}) {
      Body broken;
      broken.*limit = odd;
      EXPECT_EQ(Similarity::slowness(broken), Similarity::kSlowest) << odd;
    }
  }
}

TEST(Similarity, ASlowRobotMeansTheSpeedsBelowThePresetOfItsLines) {
  Body robot;
  robot.top_acceleration_m_s2 = 0.25f;
  const Similarity as(robot);
  const Parameter &speed = *find_parameter(ControllerId::kFollowLine, "speed"), &kp = *find_parameter(ControllerId::kFollowLine, "kp");
  EXPECT_EQ(speed.preset, 0.4f);
  EXPECT_EQ(as.out(small_value(0.1f, speed, as), "m/s"), 0.1f);
  EXPECT_EQ(as.out(small_value(0.3f, speed, as), "m/s"), 0.2f) << "half of the preset";
  EXPECT_EQ(as.out(small_value(0.6f, speed, as), "m/s"), 0.3f) << "half of what is asked for";
  EXPECT_EQ(small_value(75.0f, kp, as), 75.0f) << "as for a quick one";
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
