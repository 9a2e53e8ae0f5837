#include <waymark/controllers/liveness.h>

#include <gtest/gtest.h>

namespace mts {
namespace {

constexpr float kPeriod = 0.02f;

/// Readings for `periods`: with noise each is another one.
void read(Liveness<2>& sense, int periods, bool noise, float way_m) {
  for (int i = 0; i < periods; ++i) {
    const float elements[2] = {0.05f, noise ? 0.05f + 0.001f * static_cast<float>(i % 7) : 0.05f};
    sense.step(true, elements, true, way_m, kPeriod);
  }
}

TEST(Liveness, WhatWasNoisyAndSaysTheSameWhileTheWheelsTurnIsStuck) {
  Liveness<2> sense;
  read(sense, 50, true, 0.0f);
  EXPECT_TRUE(sense.sees());
  read(sense, 50, false, 0.008f);
  EXPECT_TRUE(sense.stuck());
  EXPECT_FALSE(sense.sees());
  read(sense, 2, true, 0.008f);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatStandsMaySayTheSameForEver) {
  Liveness<2> sense;
  read(sense, 50, true, 0.0f);
  read(sense, 5000, false, 0.0f);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatHasNoNoiseMaySeeTheSameForMetres) {
  Liveness<2> sense;
  read(sense, 50, false, 0.0f);
  read(sense, 50, true, 0.008f);   // a line that it follows
  read(sense, 500, false, 0.008f);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatMovesSlowlyInShortPeriodsDoesNotStand) {
  Liveness<2> sense;
  for (int i = 0; i < 1000; ++i) {   // at 0.1 m/s over a floor with paint
    const float elements[2] = {0.0f, i % 7 == 0 ? 1.0f : 0.0f};
    sense.step(true, elements, true, 0.0005f, 0.005f);
  }
  read(sense, 500, false, 0.008f);
  EXPECT_TRUE(sense.sees()) << "it has no noise";
}

TEST(Liveness, WhatSaysNothingDoesNotSee) {
  Liveness<2> sense;
  const float elements[2] = {};
  EXPECT_FALSE(sense.sees());
  sense.step(false, elements, true, 0.0f, kPeriod);
  EXPECT_FALSE(sense.sees());
  sense.step(true, elements, true, 0.0f, kPeriod);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatCouldSayNothingElseIsNotStuck) {
  Liveness<2> sense;
  read(sense, 50, true, 0.0f);
  const float elements[2] = {4.0f, 4.0f};
  for (int i = 0; i < 100; ++i) sense.step(true, elements, false, 0.008f, kPeriod);
  EXPECT_TRUE(sense.sees());
}

// ---- compass and odometry

/// A robot with a compass of whole degrees that drives at 0.4 m/s, or turns.
struct Guided {
  Senses senses;
  LiveGuides guides;
  float heading_rad = 0.003f;
  Guided() { senses.heading_known = senses.odometry_known = senses.turned_known = true; }
  Senses step(float speed_m_s, float turn_rad_s, bool compass_works = true, bool odometry_works = true) {
    heading_rad += turn_rad_s * kPeriod;
    if (compass_works) senses.heading_rad = kRadPerDeg * static_cast<float>(static_cast<int>(heading_rad / kRadPerDeg));
    if (odometry_works) {
      senses.speed_m_s = speed_m_s;
      senses.x_m += speed_m_s * kPeriod;
      senses.turned_rad += turn_rad_s * kPeriod;
    }
    Senses heard = senses;
    guides.step(heard, 0.5f, kPeriod);
    return heard;
  }
  /// In how many of so many periods the compass, and odometry, are silent.
  int silent_compass = 0, silent_odometry = 0;
  void drive(int periods, float speed_m_s, float turn_rad_s, bool compass_works = true, bool odometry_works = true) {
    for (int i = 0; i < periods; ++i) {
      const Senses heard = step(speed_m_s, turn_rad_s, compass_works, odometry_works);
      silent_compass += heard.heading_known ? 0 : 1;
      silent_odometry += heard.odometry_known ? 0 : 1;
    }
  }
};

TEST(LiveGuides, ACompassThatSaysTheSameWhileTheWheelsTurnTheRobotIsStuck) {
  Guided robot;
  robot.drive(50, 0.4f, 0.0f);
  robot.drive(50, 0.0f, 1.0f, false);   // a radian
  EXPECT_NEAR(robot.silent_compass, 41, 1) << "after 10 degrees";
  EXPECT_EQ(robot.silent_odometry, 0);
  robot.silent_compass = 0;
  robot.drive(10, 0.0f, 1.0f);
  EXPECT_EQ(robot.silent_compass, 0) << "it is well again";
}

TEST(LiveGuides, ACompassOfWholeDegreesMaySayTheSameOnAStraightRoad) {
  Guided robot;
  for (int i = 0; i < 50; ++i) robot.drive(1, 0.0f, i % 2 == 0 ? 0.2f : -0.2f);   // it stands where two degrees meet
  robot.drive(2'000, 0.4f, 0.0f);
  for (int i = 0; i < 500; ++i) robot.drive(1, 0.4f, i % 2 == 0 ? 0.2f : -0.2f);
  robot.drive(200, 0.0f, 0.9f);
  EXPECT_EQ(robot.silent_compass, 0);
}

TEST(LiveGuides, AGyroscopeThatDriftsProvesNothing) {
  Guided robot;
  for (int i = 0; i < 20'000; ++i) {
    robot.senses.turned_rad += 0.0002f;   // 0.6 degrees a second
    robot.drive(1, 0.0f, 0.0f);
  }
  EXPECT_EQ(robot.silent_compass, 0);
}

TEST(LiveGuides, OdometryWhosePlaceStaysWhileItsSpeedSaysThatItMovesIsStuck) {
  Guided robot;
  robot.drive(10, 0.4f, 0.0f);
  robot.drive(50, 0.4f, 0.0f, true, false);
  EXPECT_NEAR(robot.silent_odometry, 50 - 27, 1) << "0.55 s";
  const Senses heard = robot.step(0.4f, 0.0f, true, false);
  EXPECT_FALSE(heard.turned_known);
  EXPECT_TRUE(heard.heading_known);
  EXPECT_TRUE(robot.step(0.4f, 0.0f).odometry_known) << "it is well again";
}

TEST(LiveGuides, OdometryMayComeTwiceASecond) {
  Guided robot;
  for (int i = 0; i < 500; ++i) {
    robot.drive(1, 0.4f, 0.0f, true, false);
    if (i % 25 == 0) robot.senses.x_m += 0.2f;
    robot.senses.speed_m_s = 0.4f;
  }
  EXPECT_EQ(robot.silent_odometry, 0);
}

TEST(LiveGuides, OdometryOfARobotThatStandsMaySayTheSameForEver) {
  Guided robot;
  robot.drive(10, 0.4f, 0.0f);
  robot.drive(500, 0.0f, 0.0f);
  EXPECT_EQ(robot.silent_odometry, 0);
}

TEST(LiveGuides, OdometryWithoutAPlaceMaySayTheSameSpeedForEver) {
  Guided robot;
  robot.senses.x_m = 5.0f;   // told once
  robot.senses.speed_m_s = 0.4f;
  robot.drive(500, 0.4f, 0.0f, true, false);
  EXPECT_EQ(robot.silent_odometry, 0);
}

}  // namespace
}  // namespace mts
