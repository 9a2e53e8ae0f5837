// Dead reckoning: by the place that the wheels tell, so that late loops lose no way, and without it by their speed.
#include <gtest/gtest.h>

#include "tests/unit/controllers/drives.h"

namespace mts::plant {
namespace {

/// A robot that drives as it is told, along x, and is asked each 20 ms but for one period.
struct Late {
  float x_m = 0.0f;
  bool tells = true;
  Senses senses() const {
    Senses senses;
    senses.range_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
    for (float& range : senses.range_m) range = kOutOfRange;
    senses.x_m = tells ? 100.0f + x_m : kNaN;
    return senses;
  }
  float drive(HoldHeading& controller, float course_m, float late_s) {
    Task task;
    task.pieces = 1;
    task.course[0] = {0.0f, course_m};
    controller.start(task, senses());
    Motion motion;
    for (int i = 0; i < 2'000 && !controller.lost(); ++i) {
      const float dt_s = i == 100 ? late_s : 0.02f;
      x_m += motion.speed_m_s * dt_s;
      Senses now = senses();
      now.speed_m_s = motion.speed_m_s;
      motion = controller.step(now, dt_s);
    }
    return x_m;
  }
};

TEST(Reckoning, ALateLoopLosesNoWay) {
  for (const float late_s : {0.02f, 0.3f, 0.5f, 1.0f, 2.0f}) {
    HoldHeading controller;
    controller.gains.overrun_m = 0.0f;
    EXPECT_NEAR(Late{}.drive(controller, 1.5f, late_s), 1.5f, 0.02f) << late_s;
  }
}

TEST(Reckoning, WithoutAPlaceTheSpeedCounts) {
  HoldHeading controller;
  controller.gains.overrun_m = 0.0f;
  EXPECT_NEAR((Late{0.0f, false}.drive(controller, 1.5f, 0.02f)), 1.5f, 0.02f);
}

Senses at(float x_m, float y_m, float speed_m_s) {
  Senses senses;
  senses.odometry_known = senses.heading_known = true;
  senses.x_m = x_m;
  senses.y_m = y_m;
  senses.speed_m_s = speed_m_s;
  return senses;
}

TEST(Reckoning, APlaceThatIsNeverToldIsNotBelievedToStand) {
  Reckoning reckoning;
  reckoning.start(at(0.0f, 0.0f, 0.3f), {});
  for (int i = 0; i < 100; ++i) reckoning.step(at(0.0f, 0.0f, 0.3f), 0.01f);
  EXPECT_NEAR(reckoning.at.x_m, 0.3f, 1e-4f);
}

TEST(Reckoning, OdometryThatIsSlowerThanTheLoopIsCountedOnce) {
  Reckoning reckoning;
  reckoning.start(at(0.0f, 0.0f, 0.5f), {});
  for (int i = 1; i <= 100; ++i) reckoning.step(at(0.005f * static_cast<float>(i / 10 * 10), 0.0f, 0.5f), 0.01f);
  EXPECT_NEAR(reckoning.at.x_m, 0.5f, 1e-4f);
  EXPECT_NEAR(reckoning.travelled_m(), 0.5f, 1e-4f);
}

TEST(Reckoning, CountsBackwardsAndNotAPlaceThatTremblesOrLeaps) {
  Reckoning reckoning;
  reckoning.start(at(0.0f, 0.0f, 0.3f), {});
  float x_m = 0.0f;
  const auto drive = [&](float speed_m_s, int periods) {
    for (int i = 0; i < periods; ++i) reckoning.step(at(x_m += 0.02f * speed_m_s, 0.0f, speed_m_s), 0.02f);
  };
  drive(0.3f, 100);
  EXPECT_NEAR(reckoning.at.x_m, 0.6f, 1e-3f);
  drive(-0.2f, 50);
  EXPECT_NEAR(reckoning.at.x_m, 0.4f, 0.015f);
  const float before = reckoning.at.x_m;
  for (int i = 0; i < 100; ++i) reckoning.step(at(x_m + (i % 2 == 0 ? 0.001f : 0.0f), 0.0f, 0.0f), 0.02f);
  EXPECT_NEAR(reckoning.at.x_m, before, 0.005f) << "who stands does not drive";
  const float stood = reckoning.at.x_m;
  x_m = -50.0f;   // odometry begins again elsewhere
  drive(0.3f, 50);
  EXPECT_NEAR(reckoning.at.x_m - stood, 0.3f, 0.01f);
}

TEST(Reckoning, ALoopThatIsVeryLateLosesNoWayEither) {
  Reckoning reckoning;
  reckoning.start(at(0.0f, 0.0f, 1.0f), {});
  reckoning.step(at(0.02f, 0.0f, 1.0f), 0.02f);
  reckoning.step(at(2.52f, 0.0f, 1.0f), 0.5f);   // the longest period that is told, and a longer one that was
  EXPECT_NEAR(reckoning.at.x_m, 2.52f, 1e-3f);
}

TEST(Reckoning, CorrectionsTurnTheCompassByFifteenDegreesAtMost) {
  Senses senses = at(0.0f, 0.0f, 0.0f);
  senses.heading_known = true;
  senses.heading_rad = 0.0f;
  Reckoning reckoning;
  reckoning.start(senses, {});
  for (int i = 0; i < 10; ++i) reckoning.correct_heading(3.0f * kRadPerDeg);
  for (int i = 0; i < 500; ++i) reckoning.step(senses, 0.02f);
  EXPECT_NEAR(reckoning.at.heading_rad, 15.0f * kRadPerDeg, 1e-3f);
}

TEST(Reckoning, WhatWasDrivenWhileOdometryWasSilentIsNotKnown) {
  Reckoning reckoning;
  reckoning.start(at(0.0f, 0.0f, 0.3f), {});
  reckoning.step(at(0.006f, 0.0f, 0.3f), 0.02f);
  Senses silent = at(0.0f, 0.0f, 0.0f);
  silent.odometry_known = false;
  reckoning.step(silent, 0.02f);
  EXPECT_FALSE(reckoning.distance_known());
  reckoning.step(at(0.2f, 0.0f, 0.3f), 0.02f);   // may have begun again at another zero
  EXPECT_NEAR(reckoning.at.x_m, 0.012f, 1e-4f);
}

TEST(Reckoning, OdometryThatIsFoundStuckHasDrivenBySpeed) {
  Reckoning reckoning;
  reckoning.start(at(0.0f, 0.0f, 0.3f), {});
  reckoning.step(at(0.006f, 0.0f, 0.3f), 0.02f);
  for (int i = 0; i < 10; ++i) reckoning.step(at(0.006f, 0.0f, 0.3f), 0.02f);
  EXPECT_NEAR(reckoning.at.x_m, 0.006f, 1e-4f) << "wheels that do not turn";
  Senses silent = at(0.006f, 0.0f, 0.3f);
  silent.odometry_known = false;
  for (int i = 0; i < 10; ++i) reckoning.step(silent, 0.02f);
  EXPECT_NEAR(reckoning.at.x_m, 0.066f, 1e-4f);
  for (int i = 0; i <= 10; ++i) reckoning.step(at(5.0f + 0.006f * static_cast<float>(i), 0.0f, 0.3f), 0.02f);
  EXPECT_NEAR(reckoning.at.x_m, 0.066f + 0.006f * 11.0f, 1e-4f);
  for (int i = 0; i < 50; ++i) {   // and what was counted once is not counted again
    silent.odometry_known = i % 2 == 0;
    reckoning.step(silent, 0.02f);
  }
  EXPECT_NEAR(reckoning.at.x_m, 0.066f + 0.006f * 36.0f, 1e-4f);
}

}  // namespace
}  // namespace mts::plant
