// What keeps a robot from driving into things: stopping in time, also where it hears late, and range finders and bumpers that say
// something else than a distance.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/controllers/drives.h"

namespace mts::plant {
namespace {

constexpr double kMotorLag = 0.05;   // of the plant

/// All is known, and nothing stands anywhere.
Senses in_the_open() {
  Senses senses;
  senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
  for (float& range : senses.range_m) range = kOutOfRange;
  return senses;
}

float speed_with(const Senses& senses, const Body& body = {}, float asked = 0.5f) { return braked({asked, 0.0f}, heard(senses), body).speed_m_s; }

struct Approach { double latency_s, speed_m_s, acceleration_m_s2, period_s; };

/// Towards a wall 3 m ahead, until it stands: how far its edge is from the wall, and how near it came. `told`: the body that the controller takes it for.
struct Halt { double gap_m, nearest_m; bool touched; };
Halt halt_before_wall(const Approach& how, const Body& body, const Body& told) {
  Floor floor;
  floor.add_walls({{3.0, -2.0}, {3.0, 2.0}});
  Noise noise;
  noise.delay_s = how.latency_s;
  Plant plant(floor, noise, 1);
  plant.body = body;
  plant.place(0.0, 0.0, 0.0);
  HoldHeading controller;
  controller.body = told;
  controller.gains.speed_m_s = static_cast<float>(how.speed_m_s);
  controller.start({}, plant.sense());
  drive_until(controller, plant, how.period_s, 30.0, [](double) { return false; });
  return {3.0 - plant.x - static_cast<double>(body.radius_m), plant.nearest_m, plant.touched};
}

Body body_of(const Approach& how) {
  Body body;
  body.top_speed_m_s = 1.2f;
  body.top_acceleration_m_s2 = static_cast<float>(how.acceleration_m_s2);
  body.range_latency_s = static_cast<float>(how.latency_s + how.period_s + kMotorLag);
  return body;
}

TEST(Braked, StandsIfItIsAskedForWhatIsNoNumber) {
  for (const float odd : {kNaN, kInfinity, -kInfinity}) {
    for (const Motion& asked : {Motion{0.2f, odd}, Motion{0.0f, odd}, Motion{odd, 0.2f}}) {
      const Motion motion = braked(asked, heard(in_the_open()), Body{});
      EXPECT_EQ(motion.speed_m_s, 0.0f);
      EXPECT_EQ(motion.turn_rad_s, 0.0f);
    }
  }
}

TEST(Braked, StopsInTimeHoweverLateItHears) {
  for (const double latency_s : {0.0, 0.05, 0.1, 0.2, 0.3}) {
    for (const double speed_m_s : {0.3, 0.6, 1.2}) {
      for (const double acceleration_m_s2 : {0.5, 1.5}) {
        for (const double period_s : {0.005, 0.02}) {
          const Approach how{latency_s, speed_m_s, acceleration_m_s2, period_s};
          const Halt halt = halt_before_wall(how, body_of(how), body_of(how));
          EXPECT_FALSE(halt.touched) << latency_s << " s, " << speed_m_s << " m/s, " << acceleration_m_s2 << " m/s2";
          EXPECT_GT(halt.nearest_m, 0.055) << latency_s << " s, " << speed_m_s << " m/s, " << acceleration_m_s2 << " m/s2";
          EXPECT_LT(halt.gap_m, 0.09) << latency_s << " s, " << speed_m_s << " m/s, " << acceleration_m_s2 << " m/s2";
        }
      }
    }
  }
}

TEST(Braked, DoesNotStopInTimeIfItIsToldOfBetterBrakesOrEarsThanItHas) {
  const Approach how{0.3, 1.2, 0.5, 0.02};
  Body told = body_of(how);
  told.top_acceleration_m_s2 = 1.5f;
  told.range_latency_s = 0.02f;
  EXPECT_TRUE(halt_before_wall(how, body_of(how), told).touched) << "the plant would show nothing that it does not test";
}

TEST(Braked, TheFastestThatStopsSolvesItsEquation) {
  Body body;
  for (const float tau : {0.0f, 0.05f, 0.3f}) {
    for (const float room : {0.001f, 0.1f, 3.0f}) {
      body.range_latency_s = tau;
      const float v = fastest_that_stops(room, body);
      const float a = 0.5f * body.top_acceleration_m_s2, stands = 0.5f * a * tau * tau;
      if (room > stands) EXPECT_NEAR(v * tau + 0.5f * v * v / a + stands, room, 1e-5f * room + 1e-7f) << tau;
      else EXPECT_EQ(v, 0.0f) << tau;
      EXPECT_FLOAT_EQ(fastest_that_stops(room, body, tau), v);
      EXPECT_LE(fastest_that_stops(room, body, 0.5f), v) << "ranges that are older than it was told";
    }
  }
  EXPECT_EQ(fastest_that_stops(0.0f, body), 0.0f);
  EXPECT_EQ(fastest_that_stops(-1.0f, body), 0.0f);
  EXPECT_EQ(fastest_that_stops(kNaN, body), 0.0f);
}

TEST(Braked, NoEchoIsNothingThereAndWhatIsNoRangeIsNotKnown) {
  const Body body;
  for (std::size_t i = 0; i < kRangeFinders; ++i) {
    const bool ahead = i == 0 || i == 1 || i == 7;
    Senses senses = in_the_open();
    for (const float nothing : {kOutOfRange, 65.535f, 3e38f, kInfinity}) {
      senses.range_m[i] = nothing;
      EXPECT_FLOAT_EQ(speed_with(senses), 0.5f) << i << ": " << nothing;
    }
    for (const float unknown : {kNaN, -0.01f, -1.0f, -3e38f}) {
      senses.range_m[i] = unknown;
      EXPECT_FLOAT_EQ(speed_with(senses), ahead ? body.crawl_m_s : 0.5f) << i << ": " << unknown;
      EXPECT_EQ(heard(senses).ranges_unknown, 1u << i);
      EXPECT_EQ(heard(heard(senses)).ranges_unknown, 1u << i);
      EXPECT_TRUE(heard(senses).range_known);
    }
    senses = in_the_open();
    senses.ranges_unknown = static_cast<std::uint8_t>(1u << i);
    senses.range_m[i] = 0.01f;
    EXPECT_FLOAT_EQ(speed_with(senses), ahead ? body.crawl_m_s : 0.5f) << i << ": said to be unknown";
  }
}

TEST(Braked, WhatIsTooNearToBeMeasuredIsNear) {
  Senses senses = in_the_open();
  senses.range_m[0] = -kInfinity;
  EXPECT_EQ(speed_with(senses), 0.0f);
}

TEST(Braked, AnElementThatSaysNothingDoesNotHideWhatTheOthersSee) {
  for (std::size_t silent = 1; silent < kRangeFinders; ++silent) {
    Senses senses = in_the_open();
    senses.range_m[0] = 0.2f;
    const float free = speed_with(senses);
    for (const float odd : {kNaN, kInfinity, -1.0f}) {
      senses.range_m[silent] = odd;
      EXPECT_LE(speed_with(senses), free) << silent << ": " << odd;
    }
  }
}

TEST(Braked, StandsWithoutRangeFindersUnlessTheBodyHasNone) {
  Senses senses = in_the_open();
  for (float& range : senses.range_m) range = kNaN;
  EXPECT_FALSE(heard(senses).range_known);
  EXPECT_EQ(speed_with(senses), 0.0f);
  senses.range_known = false;
  EXPECT_EQ(speed_with(senses), 0.0f);
  EXPECT_EQ(speed_with(senses, {}, -0.2f), 0.0f);
  EXPECT_EQ(braked({0.2f, 0.5f}, heard(senses), Body{}).turn_rad_s, 0.0f);
  EXPECT_FLOAT_EQ(braked({0.0f, 0.5f}, heard(senses), Body{}).turn_rad_s, 0.5f) << "a disc may turn on the spot";
  Body body;
  body.has_range_finders = false;
  EXPECT_FLOAT_EQ(speed_with(senses, body), 0.5f);
  EXPECT_FLOAT_EQ(speed_with(senses, body, 0.9f), body.top_speed_m_s);
  senses = in_the_open();
  senses.range_m[0] = 0.15f;
  EXPECT_EQ(speed_with(senses, body), 0.0f) << "what is seen all the same is not driven into";
}

TEST(Braked, ABumperThatIsPressedStopsWhatDrivesAhead) {
  Senses senses = in_the_open();
  senses.touched = true;
  Body body;
  for (const bool has : {true, false}) {
    body.has_range_finders = has;
    senses.range_known = has;
    EXPECT_EQ(speed_with(senses, body), 0.0f);
    EXPECT_FLOAT_EQ(speed_with(senses, body, -0.2f), -0.2f) << "it may back off";
    EXPECT_FLOAT_EQ(braked({0.3f, 0.4f}, heard(senses), body).turn_rad_s, 0.4f) << "and turn away";
  }
}

TEST(Braked, BacksNoFartherThanTheRangeFinderBehindSees) {
  Senses senses = in_the_open();
  EXPECT_FLOAT_EQ(speed_with(senses, {}, -0.3f), -0.3f);
  senses.range_m[0] = 0.13f;
  EXPECT_FLOAT_EQ(speed_with(senses, {}, -0.3f), -0.3f);
  senses.range_m[4] = 0.2f;
  EXPECT_LT(speed_with(senses, {}, -0.3f), 0.0f);
  EXPECT_GT(speed_with(senses, {}, -0.3f), -0.3f);
  senses.range_m[4] = 0.15f;
  EXPECT_EQ(speed_with(senses, {}, -0.3f), 0.0f);
  senses.range_m[4] = kNaN;
  EXPECT_FLOAT_EQ(speed_with(senses, {}, -0.3f), -Body{}.crawl_m_s);
}

TEST(EveryController, DrivesAheadNeitherBlindNorTouchingNorFasterThanItsBody) {
  for (const ControllerEntry& entry : kControllers) {
    for (int wrong = 0; wrong < 4; ++wrong) {
      Body body;
      body.top_speed_m_s = wrong == 3 ? 0.1f : 0.6f;
      AnyController controller;
      controller.choose(entry.id, body);
      Senses senses = in_the_open();
      senses.line[2] = 1.0f;
      Task task;
      task.pieces = 1;
      task.course[0] = {0.0f, 3.0f};
      controller.start(task, senses);
      if (wrong == 1) senses.range_known = false;
      if (wrong == 2) senses.touched = true;
      for (int i = 0; i < 100; ++i) {
        const float speed = controller.step(senses, 0.02f).speed_m_s;
        EXPECT_LE(speed, wrong == 0 ? 0.6f : wrong == 3 ? 0.1f : 0.0f) << entry.name << ' ' << wrong;
      }
    }
  }
}

TEST(Heard, TakesWhatIsTooOldForSilent) {
  const Body body;
  const float old_s = body.longest_silence_s + 0.01f;
  for (const float age_s : {0.0f, body.longest_silence_s, old_s, -0.1f, kNaN}) {
    const bool fresh = age_s >= 0.0f && age_s < old_s;
    Senses senses = in_the_open();
    senses.age = {age_s, age_s, age_s, age_s};
    const Senses known = heard(senses, body);
    EXPECT_EQ(known.line_known && known.range_known && known.heading_known && known.odometry_known && known.turned_known, fresh) << age_s;
    EXPECT_EQ(known.line_known || known.range_known || known.heading_known || known.odometry_known || known.turned_known, fresh) << age_s;
  }
  Senses senses = in_the_open();
  senses.line[2] = 1.0f;
  AnyController controller;
  controller.choose(ControllerId::kFollowLine);
  controller.start({}, senses);
  EXPECT_GT(controller.step(senses, 0.02f).speed_m_s, 0.0f);
  senses.age.line_s = old_s;
  EXPECT_EQ(controller.step(senses, 0.02f).speed_m_s, 0.0f);
}

TEST(KeepWall, DoesNotTurnWhereItsRangeFinderIsSilent) {
  Senses senses = in_the_open();
  senses.range_m[2] = senses.range_m[6] = 0.3f;
  senses.range_m[1] = senses.range_m[3] = senses.range_m[5] = senses.range_m[7] = 0.424f;
  senses.range_m[0] = 0.38f;   // a blind alley
  for (const float left : {kNaN, kOutOfRange}) {
    KeepWall controller;
    controller.start({}, senses);
    Senses open = senses;
    open.range_m[1] = open.range_m[2] = left;
    const float turn = controller.step(open, 0.02f).turn_rad_s;
    if (std::isnan(left)) EXPECT_LT(std::fabs(turn), 0.1f);
    else EXPECT_GT(turn, 0.5f) << "an open side is a bend";
  }
}

}  // namespace
}  // namespace mts::plant
