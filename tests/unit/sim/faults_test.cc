// What goes wrong with sensors and wheels, as scenarios say it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sim/robot/sensors.h"
#include "sim/world/geometry.h"
#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

const Labyrinth& faulty_floor() {
  static const auto made = Laboratory::of_file("examples/04_simulator/route1.kb");
  return *made->labyrinth;
}

/// A robot that stands in the middle of a walled road, 30 cm from the wall to its left, with sensors without noise.
struct Standing {
  const OnChain middle = point_on(faulty_floor()[faulty_floor().end("LM7.S")->arm->road].along, 1.2);
  Sensors sensors{exact(), 1};
  Arena arena{faulty_floor(), {middle.at.x_m, middle.at.y_m, middle.heading_rad}};
  Floor floor{faulty_floor()};
  DriveTrain wheels{{}, 1};
  std::int64_t now_us = 0;

  static SensorBuilds exact() {
    SensorBuilds builds;
    for (std::size_t i = 0; i < kSensorNames.size(); ++i) {
      SensorBuild& build = builds[static_cast<SensorId>(i)];
      build.noise = build.bias = build.latency_s = 0.0;
    }
    return builds;
  }
  mts::Senses after(double seconds) {
    mts::Senses senses;
    const std::int64_t end_us = now_us + static_cast<std::int64_t>(seconds * 1e6);
    while (now_us < end_us) {
      now_us += 10'000;
      sensors.sample(now_us, arena, floor, wheels, 0.01);
    }
    sensors.hear(now_us, senses);
    return senses;
  }
};

TEST(SensorFaults, AnOffsetShiftsOneElementOrAllOfThemUntilItIsOver) {
  Standing robot;
  robot.sensors.set_fault(SensorId::kRange, 2, Fault::kOffset, 0.2);
  mts::Senses senses = robot.after(0.2);
  EXPECT_NEAR(senses.range_m[2], 0.5f, 1e-3f);
  EXPECT_NEAR(senses.range_m[6], 0.3f, 1e-3f);
  robot.sensors.set_fault(SensorId::kRange, {}, Fault::kOffset, -0.1);
  senses = robot.after(0.2);
  EXPECT_NEAR(senses.range_m[2], 0.4f, 1e-3f);
  EXPECT_NEAR(senses.range_m[6], 0.2f, 1e-3f);
  robot.sensors.set_fault(SensorId::kRange, {}, Fault::kNone, 1.0);
  robot.sensors.set_fault(SensorId::kRange, 2, Fault::kNone, 1.0);
  senses = robot.after(0.2);
  EXPECT_NEAR(senses.range_m[2], 0.3f, 1e-3f);
  EXPECT_NEAR(senses.range_m[6], 0.3f, 1e-3f);
}

TEST(SensorFaults, ADeadElementOfAnArrayThatIsOffSaysNothing) {
  for (const Fault fault : {Fault::kOffset, Fault::kDrift}) {
    Standing robot;
    robot.sensors.set_fault(SensorId::kLine, 2, Fault::kDead, 1.0);
    robot.sensors.set_fault(SensorId::kLine, {}, fault, 0.3);
    const mts::Senses senses = robot.after(1.0);
    EXPECT_EQ(senses.line[2], 0.0f);
    EXPECT_GT(senses.line[1], 0.3f);
  }
}

TEST(SensorFaults, ADriftThatWasThereBeforeGoesOn) {
  Standing robot;
  robot.sensors.set_fault(SensorId::kRange, {}, Fault::kDrift, 0.05);
  static_cast<void>(robot.after(1.0));
  robot.sensors.set_fault(SensorId::kRange, {}, Fault::kDead, 1.0);
  static_cast<void>(robot.after(1.0));
  robot.sensors.set_fault(SensorId::kRange, {}, Fault::kDrift, 0.05, 0);
  EXPECT_NEAR(robot.after(1.0).range_m[2], 0.45f, 0.005f);
}

TEST(SensorFaults, ADriftGrowsWithTime) {
  Standing robot;
  robot.sensors.set_fault(SensorId::kRange, 2, Fault::kDrift, 0.05);
  EXPECT_NEAR(robot.after(1.0).range_m[2], 0.35f, 0.005f);
  EXPECT_NEAR(robot.after(1.0).range_m[2], 0.40f, 0.005f);
}

TEST(SensorFaults, SpikesAreEchoesOfNothingNearerThanWhatIsThere) {
  Standing robot;
  robot.sensors.set_fault(SensorId::kRange, 2, Fault::kSpikes, 0.5);
  int spikes = 0;
  for (int i = 0; i < 400; ++i) {
    const float range_m = robot.after(0.05).range_m[2];
    ASSERT_GE(range_m, static_cast<float>(kRangeLeast));
    ASSERT_LE(range_m, 0.301f);
    spikes += range_m < 0.299f ? 1 : 0;
  }
  EXPECT_GT(spikes, 150);
  EXPECT_LT(spikes, 250);
}

TEST(SensorFaults, ANoisyRangeFinderSeesNothingWhereNothingIs) {
  Standing robot;
  SensorBuilds noisy = Standing::exact();
  noisy.range.noise = 0.01;
  robot.sensors = Sensors(noisy, 1);
  robot.sensors.set_fault(SensorId::kRange, 2, Fault::kNoisy, 20.0);
  float least_m = 1.0f, most_m = 0.0f;
  for (int i = 0; i < 100; ++i) {
    const float wall_m = robot.after(0.05).range_m[2];
    least_m = std::min(least_m, wall_m);
    most_m = std::max(most_m, wall_m);
  }
  EXPECT_GT(most_m - least_m, 0.3f) << "the wall, whose distance has twenty times the noise";
  robot.arena.put({faulty_floor().high.x_m + 100.0, 0.0, 0.0});
  static_cast<void>(robot.after(0.1));
  for (int i = 0; i < 100; ++i) ASSERT_EQ(robot.after(0.05).range_m[2], mts::out_of_range_m(kRobot));
}

TEST(SensorFaults, SteelTurnsTheCompassNearItAndNowhereElse) {
  Standing robot;
  const float straight_rad = robot.after(0.1).heading_rad;
  robot.sensors.place_steel("beam", robot.middle.at, 0.5, 20.0);
  EXPECT_NEAR(straight_rad - robot.after(0.1).heading_rad, 20.0 * kPi / 180.0, 1e-4);
  robot.sensors.place_steel("beam", robot.middle.at + Spot{0.25, 0.0}, 0.5, 20.0);
  EXPECT_NEAR(straight_rad - robot.after(0.1).heading_rad, 10.0 * kPi / 180.0, 1e-4);
  robot.sensors.place_steel("beam", robot.middle.at + Spot{0.6, 0.0}, 0.5, 20.0);
  EXPECT_FLOAT_EQ(robot.after(0.1).heading_rad, straight_rad);
  robot.sensors.place_steel("beam", robot.middle.at, 0.5, 20.0);
  robot.sensors.remove_steel("beam");
  EXPECT_FLOAT_EQ(robot.after(0.1).heading_rad, straight_rad);
}

/// The body's way and turn after ten seconds at 0.4 m/s, by what the floor sees and by what the wheels believe.
struct Driven {
  double way_m = 0.0, turned_rad = 0.0, wheels_m = 0.0, wheels_rad = 0.0;
  Driven(const DriveLimits& limits, std::uint64_t seed) {
    DriveTrain wheels(limits, seed);
    for (int i = 0; i < 1000; ++i) {
      wheels.drive({0.4f, 0.0f}, 0.01);
      way_m += wheels.speed_m_s() * 0.01;
      turned_rad += wheels.turn_rad_s() * 0.01;
      wheels_m += wheels.wheel_speed_m_s() * 0.01;
      wheels_rad += wheels.wheel_turn_rad_s() * 0.01;
    }
  }
};

TEST(DriveTrain, WheelsThatSlipTurnMoreThanTheyGo) {
  DriveLimits limits;
  limits.slip = 0.0;
  limits.slip_mean = 0.05;
  const Driven driven(limits, 1);
  EXPECT_NEAR(driven.way_m, 0.95 * driven.wheels_m, 1e-6);
}

TEST(DriveTrain, UnequalWheelsTurnTheBodyAndOdometryDoesNotSeeIt) {
  DriveLimits limits;
  limits.slip = 0.0;
  limits.wheel_mismatch = 0.002;
  double square = 0.0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const Driven driven(limits, seed);
    EXPECT_DOUBLE_EQ(driven.wheels_rad, 0.0);
    square += driven.turned_rad * driven.turned_rad / 100.0;
  }
  EXPECT_NEAR(std::sqrt(square), 0.002 * 4.0 / limits.wheel_base_m, 0.01);   // of some 4 m
}

TEST(DriveTrain, AMotorThatLagsComesToItsSpeedLater) {
  DriveLimits limits;
  limits.slip = 0.0;
  limits.motor_lag_s = 0.05;
  DriveTrain prompt({.slip = 0.0}, 1), lazy(limits, 1);
  for (int i = 0; i < 20; ++i) {
    prompt.drive({0.3f, 0.0f}, 0.01);
    lazy.drive({0.3f, 0.0f}, 0.01);
  }
  EXPECT_NEAR(prompt.wheel_speed_m_s(), 0.3, 1e-6);
  EXPECT_LT(lazy.wheel_speed_m_s(), 0.28);
  for (int i = 0; i < 30; ++i) lazy.drive({0.3f, 0.0f}, 0.01);
  EXPECT_NEAR(lazy.wheel_speed_m_s(), 0.3, 1e-3);
}

}  // namespace
}  // namespace kb::sim::testing
