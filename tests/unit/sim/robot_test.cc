#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <waymark/controllers/stop_line.h>
#include "sim/robot/sensors.h"
#include "sim/world/geometry.h"
#include "tests/unit/sim/laboratory.h"

namespace kb::sim::testing {
namespace {

const Labyrinth& test_floor() {
  static const auto made = Laboratory::of_file("examples/04_simulator/route1.kb");
  return *made->labyrinth;
}

TEST(Random, IsTheSameForTheSameSeedAndHasTheMomentsItClaims) {
  Random a(7, 3), b(7, 3), c(7, 4);
  EXPECT_EQ(a.next(), b.next());
  EXPECT_NE(a.next(), c.next());
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 200'000;
  for (int i = 0; i < kDraws; ++i) {
    const double x = static_cast<double>(a.bell());
    ASSERT_LT(std::abs(x), 3.47);
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / kDraws, 0.0, 0.01);
  EXPECT_NEAR(squares / kDraws, 1.0, 0.02);
}

TEST(Channel, IsHeardAfterItsLatencyAndItsFaultsDoWhatTheySay) {
  Channel<int> channel({10.0, 0.15, 0.0, 0.0});   // every 100 ms
  for (int t = 1; t <= 10; ++t) {
    ASSERT_TRUE(channel.due(t * 100'000));
    channel.take(t * 100'000, t);
  }
  EXPECT_FALSE(channel.due(1'050'000));
  EXPECT_EQ(*channel.heard(1'000'000), 8);
  EXPECT_EQ(*channel.heard(1'060'000), 9);
  EXPECT_EQ(*channel.heard(1'200'000), 10);
  channel.set_fault(Fault::kDelayed, 0.3);
  EXPECT_EQ(*channel.heard(1'000'000), 5);
  channel.set_fault(Fault::kStuck, 1.0);
  EXPECT_FALSE(channel.due(2'000'000));
  EXPECT_EQ(*channel.heard(2'000'000), 10);
  channel.set_fault(Fault::kDead, 1.0);
  EXPECT_EQ(channel.heard(2'000'000), nullptr);
  channel.set_fault(Fault::kNone, 1.0);
  channel.clear();
  EXPECT_EQ(channel.heard(2'000'000), nullptr);
}

TEST(Channel, AStuckSensorIsHeardAfterItsLatencyAndOutlastsAPowerCut) {
  Channel<int> channel({10.0, 0.25, 0.0, 0.0});
  for (int t = 1; t <= 10; ++t) channel.take(t * 100'000, t);
  EXPECT_EQ(*channel.heard(1'000'000), 7);
  channel.set_fault(Fault::kStuck, 1.0);
  EXPECT_EQ(*channel.heard(1'000'000), 7) << "what it said before it was stuck is under way";
  EXPECT_EQ(*channel.heard(1'160'000), 9);
  EXPECT_EQ(*channel.heard(1'250'000), 10);
  channel.clear();
  EXPECT_FALSE(channel.due(5'000'000));
  EXPECT_EQ(*channel.heard(5'000'000), 10);
  channel.set_fault(Fault::kNone, 1.0);
  channel.clear();
  EXPECT_EQ(channel.heard(5'000'000), nullptr);
  channel.set_fault(Fault::kStuck, 1.0);
  channel.clear();
  EXPECT_EQ(channel.heard(6'000'000), nullptr) << "it has never said anything";
}

TEST(Channel, TheLongestDelayOfTheFastestSensorIsNotCut) {
  Channel<int> channel({100.0, 1.0, 0.0, 0.0});
  channel.set_fault(Fault::kDelayed, 2.0);
  for (int t = 1; t <= 1000; ++t) channel.take(t * 10'000, t);
  EXPECT_EQ(*channel.heard(10'000'000), 700);
}

TEST(DriveTrain, KeepsToItsLimitsAndPutsTheTurnFirst) {
  DriveLimits limits;
  limits.slip = 0.0;
  DriveTrain wheels(limits, 1);
  wheels.drive({0.5f, 0.0f}, 0.01);
  EXPECT_NEAR(wheels.wheel_speed_m_s(), limits.acceleration_m_s2 * 0.01, 1e-9);
  for (int i = 0; i < 200; ++i) wheels.drive({10.0f, 2.0f}, 0.01);
  EXPECT_NEAR(wheels.wheel_turn_rad_s(), 2.0, 1e-6);
  EXPECT_NEAR(wheels.wheel_speed_m_s(), limits.speed_m_s - 0.5 * 2.0 * limits.wheel_base_m, 1e-6);
  for (int i = 0; i < 200; ++i) wheels.drive({std::numeric_limits<float>::quiet_NaN(), 1.0f}, 0.01);
  EXPECT_DOUBLE_EQ(wheels.wheel_speed_m_s(), 0.0);
}

TEST(DriveTrain, TurnsNoFasterThanItsWheelsCan) {
  const DriveLimits limits{.speed_m_s = 0.05, .turn_rad_s = 10.0};
  const double fastest_rad_s = 2.0 * limits.speed_m_s / limits.wheel_base_m;
  for (const float way : {1.0f, -1.0f}) {
    DriveTrain wheels(limits, 1);
    for (int i = 0; i < 200; ++i) wheels.drive({0.05f, 10.0f * way}, 0.01);
    EXPECT_NEAR(wheels.wheel_turn_rad_s(), static_cast<double>(way) * fastest_rad_s, 1e-9);
    EXPECT_NEAR(wheels.wheel_speed_m_s(), 0.0, 1e-9);
  }
}

TEST(DriveLimits, ALargerRobotTurnsSlower) {
  EXPECT_DOUBLE_EQ(limits_of(robot_of(1.0f)).turn_rad_s, DriveLimits{}.turn_rad_s);
  EXPECT_DOUBLE_EQ(limits_of(robot_of(4.0f)).turn_rad_s, 0.5 * DriveLimits{}.turn_rad_s);
}

TEST(StopLine, MetAslantIsKnownByLessOfItAndAPaintedLineIsStillNone) {
  const auto periods = [](bool aslant) {
    mts::StopLine line(kRobot);
    mts::Senses senses;
    senses.line_known = senses.odometry_known = senses.turned_known = true;
    for (float& darkness : senses.line) darkness = 0.9f;
    senses.speed_m_s = 0.1f;
    for (int i = 1; i <= 100; ++i) {
      senses.turned_rad += 0.034f;   // 1.7 rad/s: the row, 9 cm ahead, goes 3 mm aside meanwhile
      line.step(senses, 0.02f, aslant);
      if (line.now()) return i;
    }
    return 0;
  };
  EXPECT_EQ(periods(false), 25);     // 5 cm by the wheels
  EXPECT_GE(periods(true), 6);
  EXPECT_LE(periods(true), 8);       // 2.5 cm of the row's own way
  mts::StopLine line(kRobot);
  mts::Senses senses;
  senses.line_known = senses.odometry_known = true;
  senses.speed_m_s = 0.1f;
  for (int i = 0; i < 3; ++i) senses.line[i] = 0.9f;   // a line along the road
  for (int i = 0; i < 100; ++i) line.step(senses, 0.02f, true);
  EXPECT_FALSE(line.now());
}

TEST(Arena, AWallHoldsTheRobotUpAndIsOneHit) {
  const Labyrinth& l = test_floor();
  const Road& road = l[l.end("LM7.S")->arm->road];
  const OnChain middle = point_on(road.along, 1.2);
  Arena arena(l, {middle.at.x_m, middle.at.y_m, middle.heading_rad + kPi / 2.0});   // across the road, at its wall
  EXPECT_NEAR(arena.ray(middle.at, direction(middle.heading_rad + kPi / 2.0), 4.0), 0.3f, 1e-4f);
  for (int i = 0; i < 200; ++i) arena.push(0.3, 0.0, 0.01);
  EXPECT_TRUE(arena.touching());
  const auto hits = arena.take_hits();
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].what, "a wall");
  const Pose pose = arena.pose();
  EXPECT_NEAR(distance(middle.at, {pose.x_m, pose.y_m}), 0.3 - kRobotRadius, 0.01);
}

TEST(Arena, AnEdgeWhereTwoWallsMeetIsOneHit) {
  Labyrinth l;
  l.walls = {{{1.0, 0.0}, {2.0, 1.0}}, {{1.0, 0.0}, {2.0, -1.0}}};
  Arena arena(l, {});
  for (int i = 0; i < 500 && !arena.touching(); ++i) arena.push(0.3, 0.0, 0.01);
  ASSERT_TRUE(arena.touching());
  EXPECT_EQ(arena.take_hits().size(), 1u);
}

TEST(Arena, ObstaclesAppearMoveAndVanish) {
  const Labyrinth& l = test_floor();
  const Pose start = l.place(*l.end("LM5.W"), 0.3);
  Arena arena(l, start);
  const Spot from{start.x_m, start.y_m}, ahead = direction(start.heading_rad);
  const float clear = arena.ray(from, ahead, 2.0);
  arena.place_obstacle({"crate", from + 0.8 * ahead, 0.1});
  EXPECT_NEAR(arena.ray(from, ahead, 2.0), 0.7f, 1e-3f);
  arena.place_obstacle({"crate", from + 1.0 * ahead, 0.1});
  EXPECT_NEAR(arena.ray(from, ahead, 2.0), 0.9f, 1e-3f);
  EXPECT_EQ(arena.obstacles().size(), 1u);
  arena.remove_obstacle("crate");
  EXPECT_FLOAT_EQ(arena.ray(from, ahead, 2.0), clear);
}

TEST(Arena, ASlowRobotGoesAsFarWhereverTheFloorLies) {
  for (const double floor_m : {0.0, 490.0, 1'490.0}) {
    Labyrinth l;
    l.low = {floor_m, 0.0};
    l.high = {floor_m + 20.0, 10.0};
    const Spot start{floor_m + 2.0, 1.0};
    Arena arena(l, {start.x_m, start.y_m, 0.0});
    arena.place_obstacle({"crate", start + Spot{1.0, 0.0}, 0.1});
    for (int i = 0; i < 1000; ++i) arena.push(0.05, 0.0, 0.01);
    const Pose pose = arena.pose();
    EXPECT_NEAR(pose.x_m - start.x_m, 0.5, 0.001) << floor_m;
    EXPECT_NEAR(arena.ray({pose.x_m, pose.y_m}, {1.0, 0.0}, 4.0), 0.4f, 0.001f) << floor_m;
    for (int i = 0; i < 1000; ++i) arena.push(0.05, 0.0, 0.01);
    const auto hits = arena.take_hits();
    ASSERT_EQ(hits.size(), 1u) << floor_m;
    EXPECT_NEAR(hits[0].at.x_m, start.x_m + 0.9 - kRobotRadius, 0.01) << floor_m;
  }
}

TEST(Sensors, TheLineSensorsSitWhereTheBodySays) {
  const Labyrinth& l = test_floor();
  const Labyrinth::End end = *l.end("LM7.S");
  const Pose on_line = l.place(end, 0.0);   // of the stop line, facing out
  SensorBuilds builds;
  builds.line.noise = builds.line.bias = 0.0;
  for (const float ahead_m : {0.03f, 0.09f, 0.2f}) {
    mts::Body body = kRobot;
    body.line_ahead_m = ahead_m;
    body.line_span_m = 0.12f;
    const auto dark_from = [&](double back_m) {
      Sensors sensors(builds, 1, body);
      const Spot at = Spot{on_line.x_m, on_line.y_m} - back_m * direction(on_line.heading_rad);
      Arena arena(l, {at.x_m, at.y_m, on_line.heading_rad});
      const Floor floor(l);
      const DriveTrain wheels({}, 1);
      for (std::int64_t t = 10'000; t <= 50'000; t += 10'000) sensors.sample(t, arena, floor, wheels, 0.01);
      mts::Senses senses;
      sensors.hear(50'000, senses);
      return senses.line[0];
    };
    EXPECT_GT(dark_from(static_cast<double>(ahead_m)), 0.9f) << ahead_m;
    EXPECT_LT(dark_from(static_cast<double>(ahead_m) + 0.065), 0.1f) << ahead_m;   // half of a stop line, and what a sensor sees
    EXPECT_LT(dark_from(static_cast<double>(ahead_m) - 0.065), 0.1f) << ahead_m;
  }
}

/// Drives over paint as broad as that, all sensors on it; whether it was a stop line.
bool is_stop_line(const mts::Body& body, double broad_m) {
  mts::StopLine line(body);
  mts::Senses senses;
  senses.line_known = senses.odometry_known = true;
  senses.speed_m_s = 0.4f;
  for (double way_m = 0.0; way_m < broad_m; way_m += 0.008) {
    std::fill(std::begin(senses.line), std::end(senses.line), 0.95f);
    line.step(senses, 0.02f, false);
  }
  return line.now();
}

TEST(StopLine, IsHalfAsBroadAtLeastAsTheFloorsAre) {
  for (const auto& [line_m, stop_line_m] : {std::pair(0.02f, 0.06f), std::pair(0.03f, 0.1f), std::pair(0.05f, 0.12f), std::pair(0.05f, 0.2f)}) {
    mts::Body body = kRobot;
    body.paint_width_m = line_m;
    body.stop_line_width_m = stop_line_m;
    EXPECT_FALSE(is_stop_line(body, static_cast<double>(line_m))) << line_m << ' ' << stop_line_m;
    EXPECT_TRUE(is_stop_line(body, static_cast<double>(stop_line_m))) << line_m << ' ' << stop_line_m;
  }
}

TEST(Sensors, SayTheTruthWithoutNoise) {
  const Labyrinth& l = test_floor();
  const Road& road = l[l.end("LM7.S")->arm->road];
  const OnChain middle = point_on(road.along, 1.2);
  SensorBuilds builds;
  for (int i = 0; i < 6; ++i) builds[static_cast<SensorId>(i)].noise = builds[static_cast<SensorId>(i)].bias = 0.0;
  Sensors sensors(builds, 1);
  Arena arena(l, {middle.at.x_m, middle.at.y_m, middle.heading_rad});
  const Floor floor(l);
  const DriveTrain wheels({}, 1);
  for (std::int64_t t = 10'000; t <= 200'000; t += 10'000) sensors.sample(t, arena, floor, wheels, 0.01);
  mts::Senses senses;
  sensors.hear(200'000, senses);
  EXPECT_NEAR(senses.range_m[2], 0.3f, 1e-3f);
  EXPECT_NEAR(senses.range_m[6], 0.3f, 1e-3f);
  EXPECT_NEAR(senses.heading_rad, wrap(middle.heading_rad), 1e-5);
  EXPECT_TRUE(senses.line_known && senses.range_known && senses.heading_known && senses.odometry_known && senses.turned_known);
  sensors.set_fault(SensorId::kRange, 2, Fault::kDead, 1.0);
  sensors.set_fault(SensorId::kCompass, std::nullopt, Fault::kDead, 1.0);
  for (std::int64_t t = 210'000; t <= 400'000; t += 10'000) sensors.sample(t, arena, floor, wheels, 0.01);
  sensors.hear(400'000, senses);
  EXPECT_TRUE(std::isnan(senses.range_m[2])) << "unknown, not free";
  EXPECT_TRUE(senses.range_known);
  EXPECT_NEAR(senses.range_m[6], 0.3f, 1e-3f);
  EXPECT_FALSE(senses.heading_known);
}

}  // namespace
}  // namespace kb::sim::testing
