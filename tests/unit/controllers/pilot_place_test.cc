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
  constexpr MapRoad on = {"Dock", "N", "Hill", "S", "azimuth", kInfinity, kStraightNorth, 1};
  trip.pilot.choose(&kAbout, &kFirstBack);
  trip.drive(4.0);
  trip.pilot.choose(&kAbout, &on);   // the sign of Dock was read, and the leg leads on
  trip.drive(0.1);
  trip.pilot.choose(&kMove, &on);
  trip.drive(0.1);
  ASSERT_NE(trip.pilot.place().road(), nullptr);
  EXPECT_STREQ(trip.pilot.place().road()->from, "Arch");
}

TEST(Pilot, WhoTurnsRoundThoughNoLegSaysSoIsOnTheWayBack) {
  Trip trip(1.5);
  trip.pilot.put(kFirst, 1.5f);
  trip.pilot.can_turn_back(&kFirstBack);
  trip.pilot.choose(&kAbout);
  trip.drive(4.0);
  trip.pilot.choose(&kMove);
  trip.drive(3.0);
  ASSERT_NE(trip.pilot.place().road(), nullptr);
  EXPECT_STREQ(trip.pilot.place().road()->from, "Arch");
  EXPECT_LT(trip.robot.x, 1.2);
  EXPECT_NEAR(trip.robot.y, 0.0, 0.05);
}

TEST(Pilot, ASignTellsItsRoadToARobotThatDidNotKnowWhereItWas) {
  Trip trip(0.4);
  trip.pilot.choose(&kMove);
  trip.drive(0.5);
  ASSERT_EQ(trip.pilot.place().road(), nullptr);
  trip.pilot.learn_road(kFirst);
  ASSERT_EQ(trip.pilot.place().road(), &kFirst);
  EXPECT_NEAR(trip.pilot.place().spot().along_m, 0.5f, 0.02f) << "signs lie 15 cm behind the line out";
  trip.pilot.learn_road(kThird);
  EXPECT_EQ(trip.pilot.place().road(), &kFirst) << "it knows now";
}

TEST(Pilot, ARobotThatIsCarriedOutOfACrossingDoesNotCrossWhereItIsSetDown) {
  Trip trip(2.6);
  trip.pilot.choose(&kCross, &kThird);
  trip.drive(0.5);
  ASSERT_TRUE(trip.pilot.in_crossing());
  trip.pilot.set_down(0.0f);
  trip.drive(0.1);   // the mind has not decided yet
  EXPECT_TRUE(trip.pilot.is_set_down());
  EXPECT_FALSE(trip.pilot.in_crossing());
  EXPECT_EQ(trip.last.speed_m_s, 0.0f);
  trip.pilot.choose(&kMove, &kThird);
  trip.drive(1.0);
  EXPECT_GT(trip.last.speed_m_s, 0.1f);
}

TEST(Pilot, ARobotThatFacesBackInAHallKnowsItsDoors) {
  constexpr ControlLine straight = {"bug", nullptr, 0};
  static constexpr Piece kLong[] = {{0.0f, 6.0f}};
  constexpr MapRoad hall = {"Arch", "E", "Shelf", "W", "open", kInfinity, kLong, 1};
  plant::Floor floor;
  floor.add_walls({{0.3, -0.3}, {0.85, -0.3}, {0.85, -2.0}, {5.15, -2.0}, {5.15, -0.3}, {5.7, -0.3}});
  floor.add_walls({{0.3, 0.3}, {0.85, 0.3}, {0.85, 2.0}, {5.15, 2.0}, {5.15, 0.3}, {5.7, 0.3}});
  Trip trip(2.0, floor);
  trip.robot.place(2.0, 0.0, kPi);
  trip.drive(0.1);
  trip.pilot.put(hall, 2.0f);
  trip.pilot.choose(&straight, &hall);
  trip.drive(20.0);
  EXPECT_GT(trip.robot.x, 5.0);
}

// note [pushed aside]
TEST(Pilot, WhoWasPushedBesideItsLineLooksForItToBothSides) {
  static constexpr Piece kStretch[] = {{0.0f, 8.0f}};
  constexpr MapRoad marked = {"Dock", "E", "Arch", "W", "mark", kInfinity, kStretch, 1};
  constexpr ControlLine follows = {"follow_line", nullptr, 0};
  for (const double push_m : {-0.2, 0.2}) {
    plant::Floor floor;
    floor.paint.push_back({{{0.0, 0.0}, {8.0, 0.0}}, 0.02});
    Trip trip(0.5, floor);
    trip.pilot.put(marked, 0.5f);
    trip.pilot.choose(&follows, &marked);
    trip.drive(2.0);
    trip.robot.place(trip.robot.x, push_m, 0.0);   // its wheels do not notice
    Senses senses = trip.robot.sense();
    senses.touched = true;
    static_cast<void>(trip.pilot.step(senses, 0.02f));
    EXPECT_TRUE(trip.pilot.beside_line());
    trip.pilot.choose(&kMove, &marked);   // there is no line any more: by compass
    for (int i = 0; i < 1000 && trip.pilot.beside_line(); ++i) trip.drive(0.02);
    EXPECT_FALSE(trip.pilot.beside_line()) << push_m;
    trip.drive(2.0);
    EXPECT_NEAR(trip.robot.y, 0.0, 0.05) << push_m;
    EXPECT_NEAR(trip.pilot.place().spot().left_m, 0.0f, 0.05f) << "it has learnt where the road is";
  }
}

TEST(Pilot, RulesOfTheHostDriveUnderAName) {
  Host host;
  host.decide = [](void*, const RulesInput&) { return RulesOutput{0.0f, 1.0f, true}; };
  constexpr ControlLine rules = {kRulesOfHost, nullptr, 0};
  EXPECT_EQ(Pilot({}, host).fits(rules), Setting::kSet);
  EXPECT_EQ(Pilot().fits(rules), Setting::kUnknown);
}

}  // namespace
}  // namespace mts
