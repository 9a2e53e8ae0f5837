// What the pilot knows of where the robot came from, and what it forgets when the robot is carried.
#include <gtest/gtest.h>

#include <numbers>
#include <utility>

#include "tests/unit/controllers/trip.h"

namespace mts {
namespace {

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
