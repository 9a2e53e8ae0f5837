// The pilot between a mind and the wheels: what begins where, and what is continued. A mission: lookout_mission_test.cc.
#include <waymark/controllers/pilot.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/controllers/drives.h"
#include "tests/unit/controllers/plant.h"
#include "tests/unit/controllers/trip.h"

namespace mts {
namespace {

TEST(Pilot, SaysBeforeTheRobotDrivesWhetherItCanDriveByALine) {
  const Pilot pilot;
  EXPECT_EQ(pilot.fits(kMove), Setting::kSet);
  EXPECT_EQ(pilot.fits(kAvoid), Setting::kSet);
  EXPECT_EQ(pilot.fits({"drive_by_feel", nullptr, 0}), Setting::kUnknown);
  constexpr ControlArgument clearance[] = {{"clearance", "", 0.2f, "m"}}, fast[] = {{"speed", "", 2.0f, "m/s"}}, unit[] = {{"speed", "", 0.2f, "m"}};
  constexpr ControlArgument word[] = {{"turn", "about", 0.0f, ""}}, number[] = {{"side", "", 1.0f, ""}}, no_number[] = {{"speed", "fast", 0.0f, ""}};
  EXPECT_EQ(pilot.fits({"round_obstacle", clearance, 1}), Setting::kUnknown);
  EXPECT_EQ(pilot.fits({"hold_heading", fast, 1}), Setting::kOutside);
  EXPECT_EQ(pilot.fits({"hold_heading", unit, 1}), Setting::kOutside);
  EXPECT_EQ(pilot.fits({"hold_heading", no_number, 1}), Setting::kOutside);
  EXPECT_EQ(pilot.fits({"turn_on_line", word, 1}), Setting::kOutside);
  EXPECT_EQ(pilot.fits({"keep_wall", number, 1}), Setting::kOutside);
}

TEST(Pilot, TurnsOfEightSidesAreDrivenByTheMap) {
  for (const char* word : {"half_left", "sharp_left", "half_right", "sharp_right"}) {
    const ControlArgument turn[] = {{"turn", word, 0.0f, ""}};
    EXPECT_EQ(Pilot().fits({"turn_on_line", turn, 1}), Setting::kSet) << word;
  }
}

TEST(Pilot, ASpeedThatOtherRobotsCanDriveBecomesTheTopSpeedOfASlowerOne) {
  constexpr ControlArgument usual[] = {{"speed", "", 0.4f, "m/s"}};
  Body body;
  body.top_speed_m_s = 0.3f;
  EXPECT_EQ(Pilot(body).fits({"hold_heading", usual, 1}), Setting::kSet);
  constexpr ControlArgument large[] = {{"speed", "", 1.2f, "m/s"}};
  Body large_body = Similarity(4.0f).out(Body{});
  EXPECT_EQ(Pilot(large_body).fits({"hold_heading", large, 1}), Setting::kSet) << "a robot four times as large drives twice as fast";
}

TEST(Pilot, StandsWhereNothingDrivesAndWhereTheLineIsNotForIt) {
  Trip trip(0.0);
  trip.drive(0.5);
  trip.pilot.choose(nullptr);
  trip.drive(0.5);
  EXPECT_FALSE(trip.pilot.drives());
  constexpr ControlLine own = {"drive_by_feel", nullptr, 0};
  trip.pilot.choose(&own);
  trip.drive(0.5);
  EXPECT_FALSE(trip.pilot.drives());
  EXPECT_EQ(trip.robot.x, 0.0);
  trip.pilot.choose(&kMove);
  EXPECT_FALSE(trip.pilot.drives()) << "it begins with the next period";
  trip.drive(0.5);
  EXPECT_TRUE(trip.pilot.drives());
  EXPECT_GT(trip.robot.x, 0.03);
}

TEST(Pilot, AManoeuvreThatWasInterruptedIsContinued) {
  Trip trip(-0.44, plant::crossing_floor({}));
  trip.pilot.choose(&kMove, &kFirst);
  trip.drive(0.02);
  trip.pilot.choose(&kMove, &kThird);   // the sign of the crossing
  trip.drive(0.02);
  trip.pilot.choose(&kCross, &kThird);
  trip.drive(1.5);
  trip.pilot.choose(&kStop, &kThird);
  trip.drive(1.0);
  EXPECT_EQ(trip.last.speed_m_s, 0.0f);
  trip.pilot.choose(nullptr, &kThird);
  trip.drive(1.0);
  trip.pilot.choose(&kCross, &kThird);
  trip.drive(15.0);
  EXPECT_TRUE(trip.pilot.done());
  EXPECT_NEAR(trip.robot.x, 0.0, 0.03) << "begun afresh it would have turned farther on";
  EXPECT_NEAR(trip.robot.y, 0.35 - 0.09, 0.04);
  EXPECT_NEAR(trip.robot.heading, std::numbers::pi / 2, 0.05);
}

TEST(Pilot, AManoeuvreThatIsOverIsNotDrivenAgain) {
  Trip trip(-0.44, plant::crossing_floor({}));
  trip.pilot.choose(&kCross, &kThird);
  trip.drive(12.0);
  ASSERT_TRUE(trip.pilot.done());
  const double y = trip.robot.y;
  trip.pilot.choose(&kStop, &kThird);
  trip.drive(1.0);
  trip.pilot.choose(&kCross, &kThird);
  trip.drive(6.0);
  EXPECT_NEAR(trip.robot.y, y, 0.02);
}

TEST(Pilot, WithoutAMapAManoeuvreIsForgottenOnceARoadIsFollowed) {
  Trip trip(-0.44);
  trip.pilot.choose(&kCross);
  trip.drive(1.0);
  trip.pilot.choose(&kMove);
  trip.drive(10.0);
  const double x = trip.robot.x;
  trip.pilot.choose(&kCross);
  trip.drive(10.0);
  EXPECT_NEAR(trip.robot.x, x + 0.44, 0.1) << "it turns in the middle of this crossing, and not back to the first";
  EXPECT_NEAR(trip.robot.heading, std::numbers::pi / 2, 0.1);
}

TEST(Pilot, AStrategyThatWaversForATickChangesNoRoad) {
  Trip before(0.26), within(-0.44, plant::crossing_floor({}));
  before.pilot.leave_crossing();
  before.pilot.choose(&kMove, &kFirst);
  before.drive(10.0);
  before.pilot.choose(&kCross, &kThird);   // to the north, 0.5 m before that crossing
  before.drive(0.02);
  before.pilot.choose(&kMove, &kThird);
  before.drive(1.0);
  EXPECT_EQ(before.pilot.place().road(), &kFirst);
  EXPECT_NEAR(before.robot.heading, 0.0, 0.05);

  within.pilot.choose(&kStraight, &kSecond);
  within.drive(0.3);
  within.pilot.choose(&kMove, &kSecond);
  within.drive(0.02);
  within.pilot.choose(&kStraight, &kSecond);
  within.drive(8.0);
  ASSERT_TRUE(within.pilot.done());
  within.pilot.choose(&kMove, &kSecond);
  within.drive(0.1);
  EXPECT_NEAR(within.pilot.place().spot().along_m, within.robot.x, 0.03);
}

TEST(Pilot, AWayRoundThatAHaltInterruptsIsContinued) {
  constexpr ControlLine around = {"round_obstacle", nullptr, 0};
  for (const double halt_m : {1.0, 1.25, 1.5, 1.8}) {
    plant::Floor floor;
    floor.add_box({1.3, -0.12}, {1.5, 0.12});
    Trip trip(0.26, floor);
    trip.pilot.leave_crossing();
    trip.pilot.choose(&kMove, &kSecond);
    for (int i = 0; i < 600 && trip.robot.x < 0.9; ++i) trip.drive(0.02);
    trip.pilot.choose(&around, &kSecond);
    trip.halt_at(halt_m, around, kSecond);
    EXPECT_TRUE(trip.pilot.done()) << halt_m;
    EXPECT_NEAR(trip.robot.y, 0.0, 0.1) << halt_m;
    EXPECT_FALSE(trip.robot.touched);
  }
}

TEST(Pilot, ARoadThatIsEnteredOnTheWayRoundSomethingBeginsAtItsCrossing) {
  plant::Floor floor = plant::crossing_floor({.roads = 5, .walls = false});
  floor.add_box({0.7, -0.1}, {0.9, 0.1});
  constexpr ControlLine around = {"round_obstacle", nullptr, 0};
  Trip trip(-0.44, floor);
  trip.pilot.choose(&kMove, &kFirst);
  trip.drive(0.02);
  trip.pilot.choose(&kStraight, &kSecond);
  for (int i = 0; i < 600 && !trip.pilot.done(); ++i) trip.drive(0.02);
  trip.pilot.choose(&around, &kSecond);
  for (int i = 0; i < 1500 && !trip.pilot.done(); ++i) trip.drive(0.02);
  ASSERT_GT(trip.robot.x, 1.0);
  trip.pilot.choose(&kMove, &kSecond);
  trip.drive(0.1);
  EXPECT_NEAR(trip.pilot.place().spot().along_m, trip.robot.x, 0.06);
}

TEST(Pilot, AManoeuvreOfAnotherLegBeginsAfresh) {
  Trip trip(-0.44, plant::crossing_floor({}));
  trip.pilot.choose(&kStraight, &kFirst);
  trip.drive(1.5);
  trip.pilot.choose(&kStop, &kFirst);
  trip.drive(0.5);
  trip.pilot.choose(&kStop, &kSecond);
  trip.robot.place(-0.44, 0.0, 0.0);
  trip.pilot.choose(&kStraight, &kSecond);
  trip.drive(8.0);
  EXPECT_TRUE(trip.pilot.done());
  EXPECT_NEAR(trip.robot.x, 0.35 - 0.09, 0.03);
}

TEST(Pilot, WhatBeginsInTheMiddleOfARoadIsToldTheRestOfIt) {
  Trip trip(0.26);
  trip.pilot.leave_crossing();
  trip.pilot.choose(&kMove, &kSecond);
  trip.drive(1.0);
  EXPECT_LE(trip.last.speed_m_s, 0.1f) << "the limit of the road";
  trip.drive(19.0);
  const OnRoad::Spot here = trip.pilot.place().spot();
  EXPECT_NEAR(here.along_m, trip.robot.x, 0.02);
  trip.pilot.choose(&kStop, &kSecond);
  trip.drive(0.5);
  trip.robot.heading = 0.3;   // it is pushed aside
  trip.robot.y += 0.2;
  trip.pilot.choose(&kMove, &kSecond);
  trip.drive(60.0);
  EXPECT_NEAR(trip.robot.x, 3.0, 0.25) << "the bend is where the map has it";
  EXPECT_NEAR(trip.robot.heading, std::numbers::pi / 2, 0.05);
  EXPECT_NEAR(trip.robot.y, 4.0 - 0.35 + 0.6, 0.3) << "the end of the course, and `overrun` past it";
}

TEST(Pilot, ARobotThatHasComeAboutIsToldTheWayBack) {
  Trip trip(0.26);
  trip.pilot.leave_crossing();
  trip.pilot.choose(&kMove, &kSecond);
  trip.drive(45.0);
  ASSERT_GT(trip.robot.y, 0.5) << "it is past the bend";
  constexpr ControlLine round = {"turn_round", nullptr, 0};
  trip.pilot.choose(&round, &kSecond);
  trip.drive(6.0);
  EXPECT_TRUE(trip.pilot.done());
  EXPECT_NEAR(trip.robot.heading, -std::numbers::pi / 2, 0.05);
  trip.pilot.choose(&kMove, &kSecondBack);
  trip.drive(0.1);
  EXPECT_EQ(trip.pilot.place().road(), &kSecondBack);
  EXPECT_NEAR(trip.pilot.place().spot().along_m, 4.0 - trip.robot.y, 0.05);
  trip.drive(60.0);
  EXPECT_NEAR(std::abs(trip.robot.heading), std::numbers::pi, 0.05);
  EXPECT_NEAR(trip.robot.y, 0.0, 0.05);
}

TEST(Pilot, ARobotThatStandsAskewTurnsToItsRoad) {
  Trip trip(0.26);
  trip.pilot.put(kSecond, 0.26f);
  trip.pilot.choose(&kMove, &kSecond);
  trip.drive(4.0);
  trip.pilot.choose(&kStop, &kSecond);
  trip.drive(0.5);
  trip.robot.heading = 1.76;
  trip.pilot.choose(&kMove, &kSecond);
  trip.drive(10.0);
  EXPECT_NEAR(trip.robot.heading, 0.0, 0.1);
  EXPECT_NEAR(trip.robot.y, 0.0, 0.1);
}

TEST(Pilot, HaltsDoNotLeadPastTheEndOfARoad) {
  Trip trip(0.26);
  trip.pilot.put(kFirst, 0.26f);
  for (int i = 0; i < 30; ++i) {
    trip.pilot.choose(&kMove, &kFirst);
    trip.drive(2.0);
    trip.pilot.choose(&kStop, &kFirst);
    trip.drive(0.5);
  }
  EXPECT_LT(trip.robot.x, 3.0 - 0.35 + 0.6 + 0.25 + 30 * 0.01) << "the line in, which is missing here, `overrun`, braking, and a centimetre each time";
}

TEST(Pilot, ARobotThatHaltsInTheDoorOutOfAHallDrivesOut) {
  constexpr ControlLine straight = {"bug", nullptr, 0};
  static constexpr Piece kLong[] = {{0.0f, 6.0f}};
  constexpr MapRoad hall = {"Arch", "E", "Shelf", "W", "open", kInfinity, kLong, 1};
  for (const double halt_m : {2.0, 4.9, 5.3, 5.5}) {
    plant::Floor floor;
    floor.add_walls({{0.3, -0.3}, {0.85, -0.3}, {0.85, -2.0}, {5.15, -2.0}, {5.15, -0.3}, {5.7, -0.3}});
    floor.add_walls({{0.3, 0.3}, {0.85, 0.3}, {0.85, 2.0}, {5.15, 2.0}, {5.15, 0.3}, {5.7, 0.3}});
    Trip trip(0.26, floor);
    trip.pilot.leave_crossing();
    trip.pilot.choose(&straight, &hall);
    trip.halt_at(halt_m, straight, hall);
    EXPECT_GT(trip.robot.x, 5.6) << halt_m;
    EXPECT_NEAR(trip.robot.y, 0.0, 0.1) << halt_m;
  }
}

TEST(Pilot, NoLimitDrivesBackwards) {
  for (const float limit : {-0.1f, 0.0f, plant::kNaN, -kInfinity}) {
    Trip trip(0.0);
    trip.pilot.choose(&kMove, nullptr, limit);
    trip.drive(1.0);
    EXPECT_EQ(trip.robot.x, 0.0);
  }
}

TEST(Pilot, AnAngleOfTheLineCountsMoreThanTheRoad) {
  static constexpr ControlArgument quarter[] = {{"angle", "", 90.0f, "deg"}};
  constexpr ControlLine turn = {"turn_round", quarter, 1};
  Trip trip(0.26);
  trip.pilot.put(kFirst, 0.26f);
  trip.pilot.choose(&turn, &kFirst);
  trip.drive(4.0);
  EXPECT_NEAR(trip.robot.heading, std::numbers::pi / 2, 0.05);
}

TEST(Pilot, ARoadWithMoreBendsThanATaskHoldsIsToldInParts) {
  Piece zigzag[13];
  for (std::size_t i = 0; i < 13; ++i) zigzag[i] = {i % 2 == 0 ? 0.0f : 0.5f * kPi, 1.5f};
  const MapRoad road = {"A", "E", "B", "W", "azimuth", kInfinity, zigzag, 13};
  Trip trip(0.26);
  trip.pilot.leave_crossing();
  trip.pilot.choose(&kMove, &road);
  trip.drive(150.0);
  EXPECT_TRUE(trip.pilot.drives());
  EXPECT_NEAR(trip.robot.x, 7.0 * 1.5 - 0.35 + 0.6, 0.3) << "the end of the course, and `overrun` past it";
  EXPECT_NEAR(trip.robot.y, 6.0 * 1.5, 0.1);
}

}  // namespace
}  // namespace mts
