// Where on a road of the map a robot is that has driven, turned back, or left its middle.
#include <waymark/controllers/on_road.h>

#include <gtest/gtest.h>

namespace mts {
namespace {

constexpr Piece kElbow[] = {{0.0f, 3.0f}, {0.5f * kPi, 4.0f}}, kElbowBack[] = {{-0.5f * kPi, 4.0f}, {kPi, 3.0f}};
constexpr MapRoad kElbowOut = {"Arch", "E", "Shelf", "S", "azimuth", kInfinity, kElbow, 2};
constexpr MapRoad kWayBack = {"Shelf", "S", "Arch", "E", "azimuth", kInfinity, kElbowBack, 2};
constexpr MapRoad kElbowHall = {"Arch", "E", "Shelf", "S", "open", kInfinity, kElbow, 2};
constexpr Body kCart{.line_ahead_m = 0.1f, .crossing_m = 0.8f};   // a road begins at 0.3 m

/// Enters `road` and goes straight to a place that is `x_m`, `y_m` from where it entered; there it faces `heading_rad`.
OnRoad moved(const MapRoad& road, float x_m, float y_m, float heading_rad = 0.0f, const Body& body = kCart) {
  Senses senses;
  senses.heading_known = senses.odometry_known = true;
  OnRoad place(body);
  place.enter(&road, senses);
  const float way_m = square_root(x_m * x_m + y_m * y_m), direction_rad = angle_of(x_m, y_m);
  senses.heading_rad = direction_rad;
  place.step(senses, 1e6f);   // it takes all the time that it needs to believe the compass
  for (int i = 0; i < 100; ++i) {
    senses.speed_m_s = way_m / 100.0f / body.size;   // senses are those of a robot of size 1
    place.step(senses, 1.0f);
  }
  senses.speed_m_s = 0.0f;
  senses.heading_rad = heading_rad;
  place.step(senses, 1e6f);
  return place;
}

TEST(OnRoad, CountsFromTheMiddleOfTheFirstCrossing) {
  const OnRoad::Spot spot = moved(kElbowOut, 1.0f, 0.2f).spot();
  EXPECT_NEAR(spot.along_m, 1.3f, 0.01f);
  EXPECT_NEAR(spot.left_m, 0.2f, 0.01f);
  EXPECT_NEAR(spot.x_m, 0.0f, 0.01f);
  EXPECT_NEAR(spot.y_m, -0.2f, 0.01f);
  EXPECT_EQ(spot.heading_rad, 0.0f);
  const OnRoad::Spot corner = moved(kElbowOut, 2.7f, 1.0f).spot();
  EXPECT_NEAR(corner.along_m, 4.0f, 0.01f) << "round the bend, though it was cut";
  EXPECT_NEAR(corner.left_m, 0.0f, 0.02f);
}

TEST(OnRoad, OfALargeRobotCountsInItsOwnMetres) {
  const OnRoad::Spot spot = moved(kElbowOut, 1.0f, 0.2f, 0.0f, {.size = 4.0f, .line_ahead_m = 0.1f, .crossing_m = 0.8f}).spot();
  EXPECT_NEAR(spot.along_m, 1.3f, 0.01f);
  EXPECT_NEAR(spot.left_m, 0.2f, 0.01f);
}

TEST(OnRoad, IsNowhereThatTheRobotCannotHaveReached) {
  static constexpr Piece kLoop[] = {{0.0f, 2.0f}, {0.5f * kPi, 2.0f}, {kPi, 2.0f}, {-0.5f * kPi, 1.9f}, {0.0f, 2.0f}};   // comes back to 10 cm from its beginning
  static constexpr MapRoad kRound = {"A", "E", "B", "W", "azimuth", kInfinity, kLoop, 5};
  EXPECT_NEAR(moved(kRound, 0.5f, 0.09f).spot().along_m, 0.8f, 0.01f) << "the last piece is nearer";
}

TEST(OnRoad, ATaskLeadsBackToTheMiddleOrRunsBesideIt) {
  const OnRoad place = moved(kElbowOut, 1.0f, 0.2f);
  const Task beside = place.task(OnRoad::Back::kNever), back = place.task(OnRoad::Back::kToMiddle);
  ASSERT_EQ(beside.pieces, 2);
  EXPECT_NEAR(beside.course[0].length_m, 1.7f, 0.01f);
  ASSERT_EQ(back.pieces, 3);
  EXPECT_NEAR(back.course[0].heading_rad, angle_of(0.35f, -0.2f), 0.03f);
  EXPECT_NEAR(back.course[1].length_m, 1.35f, 0.01f);
  EXPECT_NEAR(back.course[2].length_m, 3.6f, 0.01f);
  EXPECT_EQ(moved(kElbowOut, 1.0f, 0.01f).task(OnRoad::Back::kToMiddle).pieces, 2) << "so near the middle nothing leads back";
}

TEST(OnRoad, TheDoorsOfAHallAreSeenFromTheRobot) {
  const Task task = moved(kElbowHall, 1.0f, 0.2f).task(OnRoad::Back::kToMiddle);
  ASSERT_TRUE(task.in_hall);
  EXPECT_NEAR(task.in.x_m, -0.9f, 0.01f);
  EXPECT_NEAR(task.in.y_m, -0.2f, 0.01f);
  EXPECT_NEAR(task.out.x_m, 1.7f, 0.01f);
  EXPECT_NEAR(task.out.y_m, 3.4f, 0.01f);
}

TEST(OnRoad, TurnedBackItCountsFromTheOtherEnd) {
  OnRoad place = moved(kElbowOut, 2.7f, 1.0f, -0.5f * kPi);
  EXPECT_TRUE(place.faces_back());
  place.turn_back(kWayBack);
  EXPECT_FALSE(place.faces_back());
  EXPECT_EQ(place.road(), &kWayBack);
  EXPECT_NEAR(place.spot().along_m, 3.0f, 0.01f);
  const Task task = place.task(OnRoad::Back::kToMiddle);
  ASSERT_EQ(task.pieces, 2);
  EXPECT_NEAR(task.course[0].length_m, 1.0f, 0.01f);
  EXPECT_NEAR(task.course[1].length_m, 2.6f, 0.01f);
}

TEST(OnRoad, OfAnUnknownRoadNothingIsTold) {
  OnRoad place(kCart);
  EXPECT_EQ(place.road(), nullptr);
  EXPECT_EQ(place.task(OnRoad::Back::kToMiddle).pieces, 0);
  EXPECT_FALSE(place.faces_back());
  place.enter(nullptr, {});
  EXPECT_EQ(place.task(OnRoad::Back::kToMiddle).pieces, 0);
}

/// Drives `length_m` on with the road's line `line_left_m` to the left of the robot's axis.
void follow(OnRoad& place, float heading_rad, float length_m, float line_left_m) {
  Senses senses;
  senses.heading_known = senses.odometry_known = senses.line_known = true;
  senses.heading_rad = heading_rad;
  senses.speed_m_s = 0.25f;
  for (std::size_t i = 0; i < kLineSensors; ++i) senses.line[i] = magnitude(Body{}.line_sensor_left_m(i) - line_left_m) < 0.005f ? 1.0f : 0.0f;
  for (float way_m = 0.0f; way_m < length_m; way_m += 0.005f) {
    place.step(senses, 0.02f);
    place.settle(senses, 0.02f);
  }
}

constexpr MapRoad kMarked = {"Arch", "E", "Shelf", "S", "mark", kInfinity, kElbow, 2};

TEST(OnRoad, ItsLineSaysHowFarAsideTheRobotIs) {
  OnRoad place = moved(kMarked, 0.5f, 0.15f);   // by odometry; it has followed the line all the time
  follow(place, 0.0f, 1.2f, 0.0f);
  EXPECT_NEAR(place.spot().left_m, 0.0f, 0.02f);
  EXPECT_NEAR(place.spot().along_m, 2.0f, 0.03f) << "of that a line along the road says nothing";
  follow(place, 0.0f, 0.2f, 0.02f);
  EXPECT_NEAR(place.spot().left_m, -0.01f, 0.011f) << "the line is to the left of the robot";
}

TEST(OnRoad, ALineFarAsideIsThatOfAnotherRoad) {
  OnRoad place = moved(kMarked, 1.0f, 0.6f);
  follow(place, 0.0f, 1.0f, 0.0f);
  EXPECT_NEAR(place.spot().left_m, 0.6f, 0.02f);
}

TEST(OnRoad, ARobotThatFacesAlongThePieceBehindABendHasPassedIt) {
  OnRoad place = moved(kMarked, 2.5f, 0.0f);   // it is at the bend, 20 cm farther than its odometry says
  follow(place, 0.5f * kPi, 0.6f, 0.0f);
  EXPECT_GT(place.spot().along_m, 3.4f);
  follow(place, 0.5f * kPi, 0.8f, 0.0f);
  EXPECT_NEAR(place.spot().left_m, 0.0f, 0.02f);
}

TEST(OnRoad, ATaskThatSeeksTheLineZigzagsAboutTheMiddle) {
  const Task task = moved(kMarked, 0.5f, 0.1f).task(OnRoad::Back::kToLine);
  ASSERT_GE(task.pieces, 4);
  EXPECT_NEAR(task.course[0].heading_rad, angle_of(0.3f, 0.2f), 0.03f) << "30 cm to the left of the middle";
  EXPECT_NEAR(task.course[1].heading_rad, -0.25f * kPi, 0.01f);
  EXPECT_NEAR(task.course[1].length_m, 0.849f, 0.01f) << "and as far to the right";
  EXPECT_NEAR(task.course[2].heading_rad, 0.25f * kPi, 0.01f);
  EXPECT_NEAR(task.course[3].length_m, 3.0f - 0.8f - 1.2f, 0.02f) << "then along the road";
  EXPECT_TRUE(moved(kMarked, 0.5f, 0.1f).has_room_to_seek());
  EXPECT_FALSE(moved(kElbowOut, 2.7f, 2.5f, 0.5f * kPi).has_room_to_seek()) << "its end is too near";
}

TEST(OnRoad, ARobotThatCrossesItsLineLearnsWhereTheRoadIs) {
  OnRoad place = moved(kMarked, 1.0f, 0.0f, 0.25f * kPi);   // it was pushed to the right, unnoticed
  Senses senses;
  senses.line_known = true;
  EXPECT_FALSE(place.cross_line(senses, true)) << "no paint";
  for (float& darkness : senses.line) darkness = 0.0f;
  senses.line[2] = senses.line[1] = 1.0f;
  EXPECT_FALSE(place.cross_line(senses, false)) << "hardly farther aside than it was thought to be";
  place = moved(kMarked, 1.0f, 0.2f, -0.25f * kPi);
  EXPECT_TRUE(place.cross_line(senses, true));
  EXPECT_NEAR(place.spot().left_m, 0.07f, 0.02f) << "the row, 10 cm before it, is on the line";
}

TEST(OnRoad, NearItsEndItTellsHowFarBesideTheRoadTheRobotIs) {
  EXPECT_NEAR(moved(kElbowOut, 2.5f, 3.2f, 0.5f * kPi).left_of_end_m(0.5f * kPi), 0.2f, 0.02f);
  EXPECT_EQ(moved(kElbowOut, 2.65f, 3.2f, 0.5f * kPi).left_of_end_m(0.5f * kPi), 0.0f) << "so near the middle the line tells it better";
  EXPECT_EQ(moved(kElbowOut, 2.5f, 3.2f, 0.5f * kPi).left_of_end_m(0.0f), 0.0f) << "it comes by another road";
}

TEST(OnRoad, CarriedItFacesAsItsCompassSays) {
  OnRoad place = moved(kElbowOut, 1.0f, 0.0f);
  Senses senses;
  senses.heading_known = senses.odometry_known = true;
  senses.heading_rad = kPi;
  place.step(senses, 0.02f);
  EXPECT_LT(magnitude(place.heading_rad()), 0.5f * kPi);
  place.forget();
  place.step(senses, 0.02f);
  EXPECT_NEAR(magnitude(place.heading_rad()), kPi, 0.01f);
}

}  // namespace
}  // namespace mts
