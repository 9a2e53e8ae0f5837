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

struct Wheels {
  Senses senses;
  LiveGuides guides;
  int period = 0;
  Wheels() { senses.heading_known = senses.odometry_known = senses.turned_known = true; }
  /// One period at 0.4 m/s along x, or standing. Returns what is left of the senses.
  Senses step(bool drives, bool compass_works = true, bool odometry_works = true) {
    ++period;
    if (compass_works) senses.heading_rad = 0.01f * static_cast<float>(period % 5);
    if (odometry_works) {
      senses.speed_m_s = drives ? 0.4f : 0.0f;
      senses.x_m += senses.speed_m_s * kPeriod;
    }
    Senses heard = senses;
    guides.step(heard, kPeriod);
    return heard;
  }
};

TEST(LiveGuides, ACompassWithNoiseThatSaysTheSameOnTheWayIsStuck) {
  Wheels robot;
  for (int i = 0; i < 50; ++i) EXPECT_TRUE(robot.step(false).heading_known);
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(robot.step(true, false).heading_known) << "0.2 s";
  for (int i = 0; i < 5; ++i) static_cast<void>(robot.step(true, false));
  EXPECT_FALSE(robot.step(true, false).heading_known);
  EXPECT_TRUE(robot.step(true, false).odometry_known);
  EXPECT_TRUE(robot.step(true).heading_known) << "it is well again";
}

TEST(LiveGuides, ACompassWithoutNoiseMaySayTheSameOnAStraightWay) {
  Wheels robot;
  for (int i = 0; i < 50; ++i) static_cast<void>(robot.step(false, false));
  for (int i = 0; i < 50; ++i) {   // it turns on the spot, ever more slowly
    robot.senses.turned_rad += 0.02f / static_cast<float>(i + 1);
    robot.senses.heading_rad = robot.senses.turned_rad;
    static_cast<void>(robot.step(false, false));
  }
  for (int i = 0; i < 500; ++i) EXPECT_TRUE(robot.step(true, false).heading_known);
}

TEST(LiveGuides, OdometryWhosePlaceStaysWhileItsSpeedSaysThatItMovesIsStuck) {
  Wheels robot;
  for (int i = 0; i < 10; ++i) static_cast<void>(robot.step(true));
  for (int i = 0; i < 15; ++i) EXPECT_TRUE(robot.step(true, true, false).odometry_known) << "0.3 s";
  static_cast<void>(robot.step(true, true, false));
  const Senses heard = robot.step(true, true, false);
  EXPECT_FALSE(heard.odometry_known);
  EXPECT_FALSE(heard.turned_known);
  EXPECT_TRUE(heard.heading_known);
  EXPECT_TRUE(robot.step(true).odometry_known) << "it is well again";
}

TEST(LiveGuides, OdometryOfARobotThatStandsMaySayTheSameForEver) {
  Wheels robot;
  for (int i = 0; i < 10; ++i) static_cast<void>(robot.step(true));
  for (int i = 0; i < 500; ++i) EXPECT_TRUE(robot.step(false).odometry_known);
}

TEST(LiveGuides, OdometryWithoutAPlaceMaySayTheSameSpeedForEver) {
  Wheels robot;
  for (int i = 0; i < 500; ++i) {
    robot.senses.speed_m_s = 0.4f;
    EXPECT_TRUE(robot.step(true, true, false).odometry_known);
  }
}

}  // namespace
}  // namespace mts
