// What a lookout tells a mind, from senses and signs that are made up period by period. A whole mission: lookout_mission_test.cc.
#include <waymark/controllers/lookout.h>

#include <gtest/gtest.h>

#include "stray.kb.map.h"

namespace mts {
namespace {

constexpr ControlLine kFollows = {"follow_line", nullptr, 0}, kTurns = {"turn_on_line", nullptr, 0}, kHolds = {"hold_heading", nullptr, 0},
                      kRounds = {"round_obstacle", nullptr, 0}, kComesAbout = {"turn_round", nullptr, 0};
constexpr Piece kThree[] = {{0.0f, 3.0f}}, kThreeNorth[] = {{0.5f * kPi, 3.0f}};
constexpr MapRoad kByLine = {"Dock", "E", "Arch", "W", "mark", kInfinity, kThree, 1}, kByWalls = {"Arch", "E", "Shelf", "W", "dist", kInfinity, kThree, 1},
                  kByCompass = {"Arch", "N", "Barn", "S", "azimuth", kInfinity, kThreeNorth, 1};

/// A robot that goes where the test says, whatever its pilot wants.
class Ride {
 public:
  Ride() {
    senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
    for (float& range_m : senses.range_m) range_m = kOutOfRange;
    paint(1);
    go(0.0f, 0.1f);
  }
  /// The line sensors that see paint, from the right: 1 the line in the middle of the road, 5 a line across.
  void paint(int dark) {
    for (int i = 0; i < 5; ++i) senses.line[i] = dark == 5 || (dark == 1 && i == 2) ? 1.0f : 0.0f;
  }
  void drive(const ControlLine* line, const MapRoad* road) { pilot.choose(line, road); }
  /// Follows the road from Dock to Arch, `along_m` from Dock.
  void follow_road(float along_m) {
    drive(&kFollows, &kByLine);
    pilot.put(kByLine, along_m);
  }
  /// Goes `metres` ahead in `time_s`.
  void go(float metres, float time_s) {
    const int periods = static_cast<int>(time_s / 0.02f + 0.5f);
    for (int i = 0; i < periods; ++i) {
      senses.speed_m_s = metres / time_s;
      senses.x_m += senses.speed_m_s * 0.02f * cosine(senses.heading_rad);
      senses.y_m += senses.speed_m_s * 0.02f * sine(senses.heading_rad);
      static_cast<void>(pilot.step(senses, 0.02f));
      lookout.step(pilot, sign, 0.02f);
    }
    lookout.write(facts);
  }
  /// Turns on the spot by so much in a second.
  void turn(float rad) {
    for (int i = 0; i < 50; ++i) {
      senses.heading_rad = wrapped_angle(senses.heading_rad + rad / 50.0f);
      senses.turned_rad += rad / 50.0f;
      go(0.0f, 0.02f);
    }
  }
  /// Comes to the sign of Arch on the road from Dock, and on to its line.
  void come_to_arch() {
    follow_road(1.8f);
    go(0.2f, 0.5f);
    sign = {.landmark = "Arch", .exit = "W", .closed = "N", .cross_by = "mark azimuth"};
    go(0.15f, 0.5f);
    sign = {};
  }

  Senses senses;
  Sign sign;
  stray::Facts facts;
  Pilot pilot;
  Lookout<stray::Knowledge> lookout{Body{}, stray::landmarks()};
};

TEST(Lookout, ASignIsReadForAQuarterOfASecondBeforeItCounts) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  ride.sign = {.landmark = "Arch", .exit = "W"};
  ride.go(0.04f, 0.1f);
  EXPECT_LE(ride.facts.Arch, 0.0f);
  ride.go(0.08f, 0.2f);
  EXPECT_GT(ride.facts.Arch, 0.8f);
  EXPECT_EQ(ride.facts.Dock, -0.9f) << "the reader works, and does not read it";
}

TEST(Lookout, ASignThatIsAheadTellsOfItsCrossing) {
  Ride ride;
  EXPECT_EQ(ride.facts.Safe, 0.0f);
  ride.come_to_arch();
  EXPECT_EQ(ride.facts.Safe, 0.9f);
  EXPECT_EQ(ride.facts.In.W, 0.9f);
  EXPECT_EQ(ride.facts.In.N, -0.9f);
  EXPECT_EQ(ride.facts.Closed.N, 0.9f);
  EXPECT_EQ(ride.facts.Closed.E, -0.9f);
  EXPECT_EQ(ride.facts.CrossBy.mark, 0.9f);
  EXPECT_EQ(ride.facts.CrossBy.dist, -0.9f);
  EXPECT_EQ(ride.facts.CrossBy.azimuth, 0.9f);
  ride.go(0.7f, 1.4f);
  EXPECT_GT(ride.facts.Arch, 0.7f) << "it is still ahead, but not as surely";
  ride.go(0.2f, 0.4f);
  EXPECT_LT(ride.facts.Arch, 0.0f) << "80 cm past its sign it is not";
  EXPECT_EQ(ride.facts.Safe, 0.0f);
}

TEST(Lookout, ASignThatNobodyKnowsDoesNotHideTheOneAfterIt) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  for (const char* landmark : {"Arch", "Arc", "Arch"}) {
    ride.sign = {.landmark = landmark, .exit = "W"};
    ride.go(0.04f, 0.3f);
  }
  EXPECT_GT(ride.facts.Arch, 0.8f);
}

TEST(Lookout, ASignWithoutASideIsReadByTheCompassOnARoadThatNobodyKnows) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  ride.sign = {.landmark = "Arch"};
  ride.go(0.15f, 0.4f);
  EXPECT_EQ(ride.facts.In.W, 0.9f) << "it drives to the east";
  ride.drive(&kComesAbout, nullptr);
  ride.turn(0.5f * kPi);
  EXPECT_EQ(ride.facts.In.W, 0.9f) << "and looks elsewhere now";
}

TEST(Lookout, ASignWithoutASideIsReadByTheRoad) {
  Ride ride;
  ride.follow_road(2.2f);
  ride.sign = {.landmark = "Arch"};
  ride.go(0.15f, 0.4f);
  EXPECT_EQ(ride.facts.In.W, 0.9f);
}

TEST(Lookout, ASignThatItDrivesAwayFromIsNoArrival) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  ride.sign = {.landmark = "Arch", .exit = "E"};   // it faces east
  ride.go(0.2f, 0.5f);
  EXPECT_GT(ride.facts.Arch, 0.8f);
  EXPECT_EQ(ride.facts.Safe, 0.0f);
  EXPECT_EQ(ride.facts.In.E, 0.0f);
}

TEST(Lookout, ALandmarkThatTheKnowledgeBaseHasNotGotIsNone) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  EXPECT_TRUE(ride.lookout.knows("Arch"));
  EXPECT_FALSE(ride.lookout.knows("Arc"));
  for (const char* landmark : {"Arc", "Line", ""}) {
    ride.sign = {.landmark = landmark, .exit = "W"};
    ride.go(0.2f, 0.5f);
    EXPECT_EQ(ride.facts.In.W, 0.0f) << landmark;
  }
}

TEST(Lookout, AStopLineIsBroaderThanALineThatLiesAcross) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  ride.paint(5);
  ride.go(0.02f, 0.06f);
  EXPECT_EQ(ride.facts.Line, -0.9f);
  ride.go(0.02f, 0.06f);
  EXPECT_EQ(ride.facts.Line, 0.9f);
  ride.paint(1);
  ride.go(0.02f, 0.06f);
  EXPECT_EQ(ride.facts.Line, -0.9f) << "it is over; the tick before has taken it";
}

TEST(Lookout, InACrossingOnlyALineBehindItsMiddleCounts) {
  Ride ride;
  ride.come_to_arch();
  ride.drive(&kTurns, &kByWalls);
  ride.go(0.3f, 0.6f);
  ride.paint(5);   // the lines of several roads
  ride.go(0.06f, 0.2f);
  EXPECT_EQ(ride.facts.Line, -0.9f);
  ride.paint(1);
  ride.go(0.3f, 0.6f);
  ride.paint(5);
  ride.go(0.06f, 0.2f);
  EXPECT_EQ(ride.facts.Line, 0.9f);
}

TEST(Lookout, TheMapSaysHowTheRoadAheadIsDriven) {
  Ride ride;
  ride.come_to_arch();
  EXPECT_EQ(ride.facts.MoveBy.mark, 0.9f) << "of the road that it is on";
  ride.drive(&kFollows, &kByWalls);
  ride.go(0.02f, 0.06f);
  EXPECT_EQ(ride.facts.MoveBy.mark, 0.0f) << "the leg is another already";
  ride.drive(&kTurns, &kByWalls);
  ride.go(0.02f, 0.06f);
  EXPECT_EQ(ride.facts.MoveBy.dist, 0.9f);
  EXPECT_EQ(ride.facts.MoveBy.mark, -0.9f);
}

TEST(Lookout, TracksAreThoseThatCanBeFollowedHere) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  ride.go(0.1f, 0.3f);
  EXPECT_EQ(ride.facts.Track.mark, 0.9f);
  EXPECT_EQ(ride.facts.Track.dist, -0.9f);
  EXPECT_EQ(ride.facts.Track.azimuth, -0.9f) << "a compass says where east is, not where a road lies of which nobody told";
  ride.senses.range_m[2] = ride.senses.range_m[6] = 0.3f;
  ride.pilot.put(kByCompass, 1.0f);
  ride.drive(&kHolds, &kByCompass);
  ride.senses.heading_rad = 0.5f * kPi;
  ride.senses.turned_rad = 0.5f * kPi;
  ride.paint(0);
  ride.go(0.3f, 1.0f);
  EXPECT_EQ(ride.facts.Track.mark, -0.9f);
  EXPECT_EQ(ride.facts.Track.dist, 0.9f);
  EXPECT_EQ(ride.facts.Track.azimuth, 0.9f);
  ride.senses.heading_known = false;
  ride.go(0.1f, 0.3f);
  EXPECT_EQ(ride.facts.Track.azimuth, -0.9f);
}

TEST(Lookout, DueIsWhereTheRoadEnds) {
  Ride ride;
  ride.follow_road(1.5f);
  ride.go(0.5f, 1.5f);
  EXPECT_EQ(ride.facts.Due, -0.9f);
  ride.go(0.5f, 1.5f);
  EXPECT_EQ(ride.facts.Due, 0.9f);
  EXPECT_EQ(ride.facts.In.W, 0.9f) << "even without a sign";
}

TEST(Lookout, ARobotThatHasComeAboutFacesBackAlongItsRoad) {
  Ride ride;
  ride.follow_road(1.5f);
  ride.go(0.3f, 1.0f);
  ride.drive(&kComesAbout, &kByLine);
  ride.turn(0.9f * kPi);
  EXPECT_EQ(ride.facts.Turned, -0.9f);
  ride.turn(0.1f * kPi);
  EXPECT_EQ(ride.facts.Turned, 0.9f);
  ride.drive(&kFollows, &kByLine);
  ride.go(0.02f, 0.06f);
  EXPECT_EQ(ride.facts.Turned, -0.9f) << "it turns round no longer";
}

TEST(Lookout, ARobotThatHasLookedRoundComesAboutToItsRoad) {
  Ride ride;
  ride.follow_road(1.5f);
  ride.turn(0.4f * kPi);
  ride.drive(&kComesAbout, &kByLine);
  ride.turn(0.6f * kPi);
  EXPECT_EQ(ride.facts.Turned, 0.9f);
}

TEST(Lookout, WhatStandsOnTheTrackIsAnObstacleWhereverTheRobotFaces) {
  Ride ride;
  ride.follow_road(1.0f);
  ride.go(0.3f, 1.0f);
  EXPECT_EQ(ride.facts.Obst, -0.9f);
  ride.senses.range_m[0] = 0.3f;
  ride.go(0.02f, 0.2f);
  EXPECT_EQ(ride.facts.Obst, 0.9f);
  ride.drive(&kRounds, &kByLine);
  ride.senses.range_m[0] = kOutOfRange;
  ride.senses.range_m[6] = 0.3f;
  ride.turn(0.5f * kPi);
  EXPECT_EQ(ride.facts.Obst, 0.9f) << "the range finder to the right looks along the road";
  ride.senses.range_m[6] = kOutOfRange;
  ride.senses.range_m[0] = 0.3f;
  ride.go(0.0f, 0.2f);
  EXPECT_EQ(ride.facts.Obst, -0.9f) << "that stands beside it";
}

TEST(Lookout, SensesThatAreSilentOrStuckAreBlind) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  EXPECT_EQ(ride.facts.Blind.line, -0.9f);
  EXPECT_EQ(ride.facts.Blind.ranges, -0.9f);
  ride.senses.line_known = false;
  ride.senses.ranges_unknown = 1u << 7;
  ride.go(0.1f, 0.3f);
  EXPECT_EQ(ride.facts.Blind.line, 0.9f);
  EXPECT_EQ(ride.facts.Blind.ranges, 0.9f) << "it would not see into what it drives";
  EXPECT_EQ(ride.facts.Line, 0.0f);
  ride.senses.line_known = true;
  ride.senses.ranges_unknown = 0;
  for (int i = 0; i < 50; ++i) {   // a sensor with noise, while the robot stands
    ride.senses.line[0] = 0.001f * static_cast<float>(i % 7);
    ride.go(0.0f, 0.02f);
  }
  EXPECT_EQ(ride.facts.Blind.line, -0.9f);
  ride.go(0.2f, 0.6f);
  EXPECT_EQ(ride.facts.Blind.line, 0.9f) << "it says the same for 20 cm";
}

TEST(Lookout, ASignWithoutALineBehindItMeansThatTheLineIsNotSeen) {
  Ride ride;
  ride.come_to_arch();
  ride.go(0.5f, 1.0f);
  EXPECT_EQ(ride.facts.Blind.line, -0.9f);
  ride.go(0.2f, 0.4f);
  EXPECT_EQ(ride.facts.Blind.line, 0.9f);
}

TEST(Lookout, ATouchCountsHoweverBriefly) {
  Ride ride;
  ride.senses.touched = true;
  for (int i = 0; i < 2; ++i) ride.lookout.step(ride.pilot, {}, 0.02f);
  static_cast<void>(ride.pilot.step(ride.senses, 0.02f));
  ride.lookout.step(ride.pilot, {}, 0.02f);
  ride.senses.touched = false;
  ride.go(0.0f, 0.06f);
  EXPECT_EQ(ride.facts.Touched, 0.9f);
  ride.go(0.0f, 0.06f);
  EXPECT_EQ(ride.facts.Touched, -0.9f);
}

TEST(Lookout, ARobotThatWasCarriedKnowsNoRoad) {
  Ride ride;
  ride.follow_road(1.0f);
  ride.go(0.3f, 1.0f);
  ASSERT_NE(ride.pilot.place().road(), nullptr);
  EXPECT_EQ(ride.facts.Carried, -0.9f);
  ride.drive(&kHolds, &kByLine);
  ride.senses.heading_rad = 2.0f;   // and the wheels have not turned
  ride.go(0.1f, 0.3f);
  EXPECT_EQ(ride.facts.Track.azimuth, 0.9f) << "along the road on which it was set down";
  EXPECT_EQ(ride.facts.Carried, 0.9f);
  EXPECT_EQ(ride.pilot.place().road(), nullptr);
  ride.go(0.3f, 1.0f);
  EXPECT_EQ(ride.facts.Carried, -0.9f) << "it is said for half a second";
  ride.sign = {.landmark = "Arch", .exit = "N"};
  ride.go(0.1f, 0.4f);
  EXPECT_LE(ride.facts.Arch, 0.0f) << "it was set down facing away from that sign";
}

TEST(Lookout, ARobotThatRestsMayHaveBeenCarriedUnlessItIsNever) {
  for (const bool keeps : {false, true}) {
    Ride ride;
    ride.lookout.keep_place(keeps);
    ride.follow_road(1.0f);
    ride.go(0.3f, 1.0f);
    ride.drive(nullptr, nullptr);
    ride.go(0.0f, 1.5f);
    EXPECT_NE(ride.pilot.place().road(), nullptr);
    ride.go(0.0f, 1.0f);
    EXPECT_EQ(ride.pilot.place().road() != nullptr, keeps);
  }
}

TEST(Lookout, ASignThatIsReadNoMoreIsForgottenAtRest) {
  Ride ride;
  ride.drive(&kFollows, nullptr);
  ride.sign = {.landmark = "Arch", .exit = "W"};
  ride.go(0.15f, 0.5f);
  ride.drive(nullptr, nullptr);
  ride.go(0.0f, 5.0f);
  EXPECT_GT(ride.facts.Arch, 0.8f) << "it stands before the sign";
  ride.sign = {};
  ride.go(0.0f, 1.0f);
  EXPECT_LT(ride.facts.Arch, 0.0f) << "it was carried off";
}

TEST(Lookout, APlaceThatWasPutIsKeptUntilTheMissionAndALegKeepsIt) {
  Ride ride;
  ride.drive(nullptr, nullptr);
  ride.pilot.put(kByLine, 1.0f);
  ride.go(0.0f, 5.0f);
  EXPECT_NE(ride.pilot.place().road(), nullptr) << "it has not driven yet";
  ride.drive(&kFollows, &kByLine);
  ride.go(0.3f, 1.0f);
  ride.drive(nullptr, &kByLine);   // nothing can be followed for a while
  ride.go(0.0f, 5.0f);
  EXPECT_NE(ride.pilot.place().road(), nullptr) << "it is on a mission";
}

TEST(Lookout, ARobotThatIsCarriedAtRestIsNotSetDownOnARoad) {
  Ride ride;
  ride.drive(nullptr, nullptr);
  ride.go(0.0f, 3.0f);
  ride.senses.heading_rad = 2.0f;   // it is being turned, and will stand otherwise
  ride.go(0.0f, 0.4f);
  EXPECT_EQ(ride.facts.Carried, 0.9f);
  EXPECT_FALSE(ride.pilot.is_set_down());
}

TEST(Lookout, AMissionThatBeginsAtAStopLineIsToldOfIt) {
  Ride ride;
  ride.lookout.keep_place(true);
  ride.come_to_arch();
  ride.paint(5);
  ride.go(0.04f, 0.12f);
  ride.paint(1);
  ride.go(0.02f, 0.06f);   // it brakes, with the line just behind its sensors
  EXPECT_EQ(ride.facts.Line, -0.9f);
  ride.drive(nullptr, nullptr);
  ride.go(0.0f, 1.0f);
  ride.drive(&kFollows, nullptr);
  ride.go(0.0f, 0.1f);
  EXPECT_EQ(ride.facts.Line, 0.9f);
}

}  // namespace
}  // namespace mts
