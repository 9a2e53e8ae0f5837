// What all controllers have in common: what they do without senses, with readings that are no numbers, and what they are called.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "tests/unit/controllers/drives.h"

namespace mts::plant {
namespace {

static_assert(std::is_trivially_copyable_v<AnyController>);

/// In a corridor with a line, a little aside and askew, so that every controller has something to do.
Plant anywhere() {
  Floor floor;
  floor.add_path({{-1.0, 0.0}, {4.0, 0.0}}, 0.03);
  floor.add_walls({{-1.0, 0.3}, {4.0, 0.3}});
  floor.add_walls({{-1.0, -0.3}, {4.0, -0.3}});
  Plant plant(floor, {}, 1);
  plant.place(0.0, 0.01, 0.02);
  return plant;
}

Task forward() {
  Task task;
  task.pieces = 1;
  task.course[0] = {0.0f, 3.0f};
  return task;
}

enum Sense : unsigned { kLine = 1, kRange = 2, kHeading = 4, kOdometry = 8, kTurned = 16, kAll = 31 };
Senses silenced(Senses senses, unsigned silent) {
  if (silent & kLine) senses.line_known = false;
  if (silent & kRange) senses.range_known = false;
  if (silent & kHeading) senses.heading_known = false;
  if (silent & kOdometry) senses.odometry_known = false;
  if (silent & kTurned) senses.turned_known = false;
  return senses;
}

struct Need { const char* name; unsigned stops_without[4]; unsigned goes_without; };
constexpr Need kNeeds[] = {
    {"follow_line", {kLine, kRange, kAll}, kHeading | kOdometry | kTurned},
    {"keep_wall", {kRange, kAll, kAll}, kLine | kHeading | kOdometry | kTurned},
    {"hold_heading", {kOdometry, kHeading | kTurned, kRange}, kLine | kTurned},
    {"turn_on_line", {kLine, kOdometry, kHeading | kTurned, kRange}, kHeading},
    {"turn_by_walls", {kRange, kOdometry, kHeading | kTurned}, kLine | kHeading},
    {"turn_by_compass", {kOdometry, kHeading | kTurned, kRange}, kLine | kTurned},
    {"round_obstacle", {kRange, kOdometry, kHeading | kTurned}, kLine | kTurned},
    {"turn_round", {kHeading | kTurned, kAll, kAll}, kLine | kRange | kOdometry | kHeading},
    {"look_round", {kHeading | kTurned, kAll, kAll}, kLine | kRange | kOdometry | kTurned},
};

bool moves(const Motion& motion) { return motion.speed_m_s != 0.0f || motion.turn_rad_s != 0.0f; }

TEST(EveryController, StopsWithoutTheSensesThatItNeedsAndGoesOnWithThem) {
  for (const Need& need : kNeeds) {
    for (const unsigned silent : need.stops_without) {
      if (silent == 0) continue;
      Plant plant = anywhere();
      AnyController controller;
      controller.choose(find_controller(need.name)->id);
      controller.start(forward(), plant.sense());
      const auto step = [&](unsigned without) {
        const Motion motion = controller.step(silenced(plant.sense(), without), 0.01f);
        plant.drive(motion, 0.01);
        return motion;
      };
      for (int i = 0; i < 20; ++i) EXPECT_TRUE(moves(step(0))) << need.name;
      for (int i = 0; i < 20; ++i) EXPECT_FALSE(moves(step(silent))) << need.name << " without " << silent;
      step(0);
      EXPECT_TRUE(moves(step(0))) << need.name << " after " << silent;
    }
  }
}

TEST(EveryController, DrivesWithoutTheSensesThatItDoesNotNeed) {
  for (const Need& need : kNeeds) {
    Plant plant = anywhere();
    AnyController controller;
    controller.choose(find_controller(need.name)->id);
    controller.start(forward(), silenced(plant.sense(), need.goes_without));
    for (int i = 0; i < 50; ++i) {
      const Motion motion = controller.step(silenced(plant.sense(), need.goes_without), 0.01f);
      EXPECT_TRUE(moves(motion)) << need.name << " at step " << i;
      plant.drive(motion, 0.01);
    }
  }
}

TEST(EveryController, DrivesWithoutRangeFindersIfItsBodyHasNone) {
  for (const char* name : {"follow_line", "hold_heading", "turn_on_line", "turn_by_compass"}) {
    Plant plant = anywhere();
    AnyController controller;
    controller.choose(find_controller(name)->id, {.has_range_finders = false});
    controller.start(forward(), silenced(plant.sense(), kRange));
    for (int i = 0; i < 50; ++i) {
      const Motion motion = controller.step(silenced(plant.sense(), kRange), 0.01f);
      EXPECT_TRUE(moves(motion)) << name << " at step " << i;
      plant.drive(motion, 0.01);
    }
  }
}

TEST(EveryController, StandsWhenItIsToldNothingAtAll) {
  for (const ControllerEntry& entry : kControllers) {
    AnyController controller;
    controller.choose(entry.id);
    controller.start({}, {});
    for (int i = 0; i < 100; ++i) EXPECT_FALSE(moves(controller.step({}, 0.01f))) << entry.name;
  }
}

TEST(HoldHeading, StandsWhenItHasGoneTooFarWithoutCompassThoughTheWheelsOnceSaidNoNumber) {
  AnyController controller;
  controller.choose(ControllerId::kHoldHeading, {.has_range_finders = false});
  Senses senses;
  senses.odometry_known = senses.turned_known = true;
  senses.speed_m_s = 0.3f;
  controller.start({}, senses);
  EXPECT_TRUE(moves(controller.step(senses, 0.01f)));
  Senses spoiled = senses;
  spoiled.speed_m_s = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(moves(controller.step(spoiled, 0.01f)));
  for (int i = 0; i < 10'000; ++i) static_cast<void>(controller.step(senses, 0.01f));
  EXPECT_FALSE(moves(controller.step(senses, 0.01f))) << "30 m without a compass";
}

TEST(EveryController, AnswersWithNumbersWhateverItIsTold) {
  const float odd[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity, -kInfinity, 3e38f, -1.0f, 0.0f};
  for (const ControllerEntry& entry : kControllers) {
    std::mt19937_64 dice(7);
    Plant plant = anywhere();
    AnyController controller;
    controller.choose(entry.id);
    const auto spoil = [&](float& value) {
      if (dice() % 8 == 0) value = odd[dice() % 6];
    };
    for (int i = 0; i < 2000; ++i) {
      Senses senses = plant.sense();
      if (i % 10 == 0) {
        Task task = forward();
        task.entry_known = true;
        spoil(task.entry_left_m);   // it is measured; what else a task says is the map's
        controller.start(task, senses);
      }
      if (dice() % 2 == 0) {
        for (float& dark : senses.line) spoil(dark);
        for (float& range : senses.range_m) spoil(range);
        spoil(senses.heading_rad);
        spoil(senses.turned_rad);
        spoil(senses.speed_m_s);
        spoil(senses.x_m);
        spoil(senses.y_m);
        spoil(senses.age.range_s);
        spoil(senses.age.odometry_s);
        for (bool* known : {&senses.line_known, &senses.range_known, &senses.heading_known, &senses.turned_known, &senses.odometry_known}) {
          *known = *known && dice() % 8 != 0;
        }
      }
      float dt = 0.01f;
      spoil(dt);
      const Motion motion = controller.step(senses, dt);
      ASSERT_TRUE(std::isfinite(motion.speed_m_s) && std::isfinite(motion.turn_rad_s)) << entry.name << " at step " << i;
      ASSERT_LE(std::fabs(motion.speed_m_s), 0.6f) << entry.name;
      ASSERT_LE(std::fabs(motion.turn_rad_s), 4.2f) << entry.name;
    }
    // And is itself again afterwards.
    controller.start(forward(), plant.sense());
    const Motion motion = controller.step(plant.sense(), 0.01f);
    EXPECT_EQ(moves(motion), entry.id != ControllerId::kStand && !crosses_halls(entry.id)) << entry.name;
  }
}

TEST(HoldHeading, StopsAfterHalfAMetreWithoutTheCompass) {
  Plant plant = anywhere();
  HoldHeading controller;
  controller.start(forward(), plant.sense());
  for (int i = 0; i < 500; ++i) plant.drive(controller.step(silenced(plant.sense(), kHeading), 0.01f), 0.01);
  EXPECT_NEAR(plant.x, 0.5, 0.06);
}

TEST(HoldHeading, DrivesByTheCompassEvenIfItMayNotDriveWithoutIt) {
  Plant plant = anywhere();
  HoldHeading controller;
  controller.gains.blind_m = 0.0f;
  controller.start(forward(), plant.sense());
  EXPECT_TRUE(moves(controller.step(plant.sense(), 0.01f)));
  EXPECT_FALSE(moves(controller.step(silenced(plant.sense(), kHeading), 0.01f)));
  EXPECT_TRUE(moves(controller.step(plant.sense(), 0.01f)));
}

TEST(HoldHeading, StopsWhereNobodyToldItACourse) {
  Plant plant({}, {}, 1);
  plant.place(0.0, 0.0, 0.0);
  HoldHeading controller;
  controller.gains.reach_m = 1.0f;
  controller.start({}, plant.sense());
  drive_until(controller, plant, 0.01, 15.0, [](double) { return false; });
  EXPECT_TRUE(controller.lost());
  EXPECT_NEAR(plant.x, 1.6, 0.06);
}

TEST(HoldHeading, StopsPastTheEndOfItsCourse) {
  Plant plant({}, {}, 1);
  plant.place(0.0, 0.0, 0.0);
  HoldHeading controller;
  Task task = forward();
  task.course[0].length_m = 1.0f;
  controller.start(task, plant.sense());
  drive_until(controller, plant, 0.01, 15.0, [](double) { return false; });
  EXPECT_TRUE(controller.lost());
  EXPECT_NEAR(plant.x, 1.6, 0.06);
}

TEST(Braked, BearsAwayFromWhatItWouldGrazeAndStandsBetweenTwoSuchThings) {
  Senses senses;
  senses.range_known = true;
  for (float& range : senses.range_m) range = 1.0f;
  const Body body;
  const Motion ahead{0.2f, 0.3f};
  EXPECT_FLOAT_EQ(braked(ahead, senses, body).turn_rad_s, 0.3f);
  senses.range_m[1] = 0.16f;   // 13 cm aside, if it lies at the edge of what the finder sees
  EXPECT_LT(braked(ahead, senses, body).turn_rad_s, 0.0f);
  EXPECT_FLOAT_EQ(braked(ahead, senses, body).speed_m_s, 0.2f);
  senses.range_m[1] = 0.13f;
  EXPECT_FLOAT_EQ(braked(ahead, senses, body).speed_m_s, 0.0f) << "straight on would meet it";
  EXPECT_LT(braked(ahead, senses, body).turn_rad_s, 0.0f);
  EXPECT_FLOAT_EQ(braked({0.0f, 0.3f}, senses, body).turn_rad_s, 0.3f) << "a disc may turn on the spot";
  senses.range_m[7] = 0.13f;
  EXPECT_FLOAT_EQ(braked(ahead, senses, body).speed_m_s, 0.0f);
  EXPECT_FLOAT_EQ(braked(ahead, senses, body).turn_rad_s, 0.0f);
}

TEST(TurnRound, TurnsToTheRoadOfItsTask) {
  for (const double askew : {-50.0, 0.0, 50.0}) {   // looked round before
    Plant plant({}, noise_of_level(0), 1);
    plant.place(0.0, 0.0, askew * kDegree);
    AnyController controller;
    controller.choose(ControllerId::kTurnRound);
    Task back;
    back.pieces = 1;
    back.course[0] = {kPi, 1.0f};
    controller.start(back, plant.sense());
    drive_until(controller, plant, 0.02, 10.0, [&](double) { return controller.done(); });
    EXPECT_LT(std::fabs(std::remainder(plant.heading - 2.0 * kQuarter, 4.0 * kQuarter)) / kDegree, 4.0) << askew;
  }
}

TEST(TurnRound, ComesAboutOnTheSpot) {
  for (const double angle : {180.0, -180.0, 90.0, 360.0}) {
    for_each_run([&](const Trial& run) {
      Plant plant({}, noise_of_level(run.level), run.seed);
      plant.place(0.0, 0.0, 1.0);
      AnyController controller;
      controller.choose(ControllerId::kTurnRound);
      ASSERT_EQ(controller.set("angle", static_cast<float>(angle)), Setting::kSet);
      controller.start({}, plant.sense());
      const double took = drive_until(controller, plant, run.dt_s, 10.0, [&](double) { return controller.done(); });
      EXPECT_TRUE(controller.done()) << text(run);
      EXPECT_LT(took, 6.0) << text(run);
      const double off = std::remainder(plant.heading - 1.0 - angle * kDegree, 4.0 * kQuarter);
      EXPECT_LT(std::fabs(off) / kDegree, at({2.5, 4.0, 7.0}, run)) << text(run);
      EXPECT_LT(std::hypot(plant.x, plant.y), 0.03) << text(run);
    }, 3);
  }
}

TEST(LookRound, LooksToBothSidesAndStaysWhereItIs) {
  Plant plant({}, noise_of_level(1), 1);
  plant.place(0.0, 0.0, 0.0);
  LookRound controller;
  controller.start({}, plant.sense());
  double most = 0.0, least_heading = 0.0;
  drive_until(controller, plant, 0.01, 12.0, [&](double) {
    most = std::max(most, plant.heading);
    least_heading = std::min(least_heading, plant.heading);
    return false;
  });
  EXPECT_NEAR(most / kDegree, 60.0, 12.0);
  EXPECT_NEAR(least_heading / kDegree, -60.0, 12.0);
  EXPECT_LT(std::hypot(plant.x, plant.y), 0.03);
}

// At the largest angle and speed it comes past the rear before it can turn back.
TEST(LookRound, LooksToBothSidesAlmostAllRound) {
  Plant plant({}, {}, 1);
  plant.place(0.0, 0.0, 0.0);
  LookRound controller;
  controller.gains = {180.0f * kRadPerDeg, 170.0f * kRadPerDeg};
  controller.start({}, plant.sense());
  bool to_left = true;
  int turns = 0;
  drive_until(controller, plant, 0.02, 20.0, [&](double) {
    const bool now = plant.left_m_s < plant.right_m_s;
    turns += now != to_left ? 1 : 0;
    to_left = now;
    return false;
  });
  EXPECT_GE(turns, 8) << "340 degrees to and fro take 2 s";
}

}  // namespace
}  // namespace mts::plant
