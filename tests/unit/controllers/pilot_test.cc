// The pilot between a mind and the wheels: what begins where, and what is continued. A mission: lookout_mission_test.cc.
#include <waymark/controllers/pilot.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/unit/controllers/drives.h"
#include "tests/unit/controllers/plant.h"

namespace mts {
namespace {

using plant::Plant;

constexpr ControlArgument kSlow[] = {{"speed", "", 0.2f, "m/s"}};
constexpr ControlArgument kLeft[] = {{"turn", "left", 0.0f, ""}};
constexpr ControlArgument kAside[] = {{"side", "right", 0.0f, ""}, {"distance", "", 0.2f, "m"}};
constexpr ControlArgument kForward[] = {{"turn", "forward", 0.0f, ""}};
constexpr ControlLine kStraight = {"turn_by_compass", kForward, 1};
constexpr ControlLine kMove = {"hold_heading", kSlow, 1}, kCross = {"turn_by_compass", kLeft, 1}, kAvoid = {"keep_wall", kAside, 2}, kStop = {"stand", nullptr, 0}, kAbout = {"turn_round", nullptr, 0};
constexpr Piece kEast[] = {{0.0f, 3.0f}}, kBend[] = {{0.0f, 3.0f}, {0.5f * kPi, 4.0f}}, kBendBack[] = {{-0.5f * kPi, 4.0f}, {kPi, 3.0f}};
constexpr MapRoad kFirst = {"Dock", "E", "Arch", "W", "azimuth", kInfinity, kEast, 1};
constexpr Piece kStraightNorth[] = {{0.5f * kPi, 3.0f}};
constexpr MapRoad kThird = {"Arch", "N", "Mill", "S", "azimuth", kInfinity, kStraightNorth, 1};
constexpr MapRoad kElsewhere = {"Hill", "S", "Arch", "N", "azimuth", kInfinity, kBendBack, 1};
constexpr MapRoad kSecond = {"Arch", "E", "Shelf", "S", "azimuth", 0.1f, kBend, 2};
constexpr MapRoad kSecondBack = {"Shelf", "S", "Arch", "E", "azimuth", kInfinity, kBendBack, 2};

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

/// A robot that faces east, with the same period for mind and wheels.
struct Trip {
  explicit Trip(double x, const plant::Floor& floor = {}) : robot(floor, {}, 1) { robot.place(x, 0.0, 0.0); }
  void drive(double time_s) {
    for (double t = 0.0; t < time_s; t += 0.02) {
      last = pilot.step(robot.sense(), 0.02f);
      robot.drive(last, 0.02);
    }
  }
  /// Drives until x, halts for a second, and then goes on.
  void halt_at(double x, const ControlLine& line, const MapRoad& road) {
    for (int i = 0; i < 3000 && robot.x < x; ++i) drive(0.02);
    pilot.choose(&kStop, &road);
    drive(1.0);
    pilot.choose(&line, &road);
    drive(20.0);
  }
  Plant robot;
  Pilot pilot;
  Motion last;
};

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

TEST(Pilot, AtTheFirstCrossingTheSignSaysHowFarItsMiddleIs) {
  static constexpr Piece kWest[] = {{kPi, 3.0f}};
  constexpr MapRoad behind = {"Arch", "W", "Dock", "E", "azimuth", kInfinity, kWest, 1, 0.25f * kPi, kPi};
  const auto to_middle_m = [](const MapRoad* from, double heading_rad) {
    Trip trip(-1.0);
    trip.robot.place(-1.0, 0.0, heading_rad);
    trip.pilot.arrives_from(from);
    trip.pilot.choose(&kCross, &kThird);
    trip.drive(0.02);
    return trip.pilot.to_middle_m();
  };
  const Body body;
  EXPECT_EQ(to_middle_m(nullptr, 0.0), stop_line_m(kPi, body));
  EXPECT_EQ(to_middle_m(&behind, 0.0), stop_line_m(0.25f * kPi, body));
  EXPECT_EQ(to_middle_m(&behind, 0.5 * std::numbers::pi), stop_line_m(kPi, body)) << "by the compass it comes from elsewhere";
  EXPECT_EQ(to_middle_m(&kSecondBack, 0.0), stop_line_m(kPi, body)) << "that is another crossing";
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

TEST(Pilot, ARobotThatComesFromElsewhereTurnsByItsOwnHeading) {
  Trip trip(-0.44, plant::crossing_floor({}));
  trip.pilot.choose(&kMove, &kElsewhere);
  trip.drive(0.02);
  trip.pilot.choose(&kCross, &kThird);   // left, as the rules say of a robot that they have seen come from the west
  trip.drive(15.0);
  EXPECT_TRUE(trip.pilot.done());
  EXPECT_NEAR(trip.robot.heading, std::numbers::pi / 2, 0.05);
}

TEST(Pilot, OfARobotThatWasCarriedNothingIsKept) {
  Trip trip(0.26);
  trip.pilot.leave_crossing();
  trip.pilot.choose(&kMove, &kSecond);
  trip.drive(0.5);
  EXPECT_EQ(trip.pilot.place().road(), &kSecond);
  trip.pilot.forget_place();
  trip.pilot.choose(&kMove);
  trip.drive(0.5);
  EXPECT_EQ(trip.pilot.place().road(), nullptr);
  EXPECT_TRUE(trip.pilot.drives());
}

TEST(Pilot, WhereNothingIsWantedAnyMoreItStandsWhateverItWasTold) {
  const std::pair<const char*, void (*)(Pilot&)> calls[] = {{"forget_place", [](Pilot& pilot) { pilot.forget_place(); }},
                                                            {"set_down", [](Pilot& pilot) { pilot.set_down(0.3f); }},
                                                            {"put", [](Pilot& pilot) { pilot.put(kSecond, 1.0f); }}};
  for (const auto& [name, tell] : calls) {
    Trip trip(0.0);
    trip.pilot.choose(&kMove);
    trip.drive(1.0);
    EXPECT_GT(trip.last.speed_m_s, 0.1f) << name;
    tell(trip.pilot);
    trip.pilot.choose(nullptr);
    for (int i = 0; i < 100; ++i) {
      trip.drive(0.02);
      ASSERT_EQ(trip.last.speed_m_s, 0.0f) << name;
      ASSERT_EQ(trip.last.turn_rad_s, 0.0f) << name;
    }
  }
}

TEST(Pilot, ARobotThatWasSetDownHoldsTheHeadingOfItsRoad) {
  Trip trip(0.0);
  trip.pilot.choose(&kMove);
  trip.drive(0.5);
  trip.robot.place(0.0, 0.0, 1.1);   // it is carried, and has turned a little since
  trip.pilot.set_down(1.0f);
  trip.drive(8.0);
  EXPECT_NEAR(trip.robot.heading, 1.0, 0.05);
}

TEST(Pilot, ARobotThatComesAboutAtABendIsOnItsWayBack) {
  Trip trip(0.0);
  trip.pilot.put(kSecond, 2.9f);   // the bend is at 3 m, and it faces neither along the one piece nor along the other
  trip.robot.place(0.0, 0.0, 0.7);
  trip.pilot.choose(&kAbout, &kSecondBack);
  trip.drive(6.0);
  trip.pilot.choose(&kMove, &kSecondBack);
  trip.drive(0.1);
  ASSERT_NE(trip.pilot.place().road(), nullptr);
  EXPECT_STREQ(trip.pilot.place().road()->from, "Shelf");
}

TEST(Pilot, ASignAheadThatIsReadOnTheSpotDoesNotHideThatItHasComeAbout) {
  Trip trip(0.0);
  trip.pilot.choose(&kMove, &kFirst);
  trip.pilot.put(kFirst, 1.5f);
  trip.drive(0.5);
  static constexpr Piece west[] = {{kPi, 3.0f}};
  constexpr MapRoad back = {"Arch", "W", "Dock", "E", "azimuth", kInfinity, west, 1}, on = {"Dock", "N", "Hill", "S", "azimuth", kInfinity, kStraightNorth, 1};
  trip.pilot.choose(&kAbout, &back);
  trip.drive(4.0);
  trip.pilot.choose(&kAbout, &on);   // the sign of Dock was read, and the leg leads on
  trip.drive(0.1);
  trip.pilot.choose(&kMove, &on);
  trip.drive(0.1);
  ASSERT_NE(trip.pilot.place().road(), nullptr);
  EXPECT_STREQ(trip.pilot.place().road()->from, "Arch");
}

}  // namespace
}  // namespace mts
