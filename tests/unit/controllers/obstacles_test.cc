// Going round what stands in the way, and keeping one wall.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/controllers/drives.h"

namespace mts::plant {
namespace {

struct Box { double half_width, half_length, aside; };

/// Boxes that a range finder sees ahead of the robot. One that stands between two range finders nobody can see.
std::vector<Box> boxes() {
  std::vector<Box> all;
  for (const double half_width : {0.1, 0.15, 0.3}) {
    for (const double half_length : {0.05, 0.15, 0.4}) {
      for (const double aside : {-0.08, 0.0, 0.08}) all.push_back({half_width, half_length, aside});
    }
  }
  return all;
}

std::string text(const Box& box, const Trial& run) {
  return std::to_string(box.half_width) + " x " + std::to_string(box.half_length) + " at " + std::to_string(box.aside) + ", " + text(run);
}

Plant before(const Box& box, const Trial& run) {
  Floor floor;
  floor.add_box({1.0, box.aside - box.half_width}, {1.0 + 2.0 * box.half_length, box.aside + box.half_width});
  Plant plant(floor, noise_of_level(run.level), run.seed);
  plant.place(0.68 - 0.1 * static_cast<double>(run.seed % 3), 0.0, 0.02 * spread(run.seed, 1));
  return plant;
}

TEST(RoundObstacle, ComesBackToTheTrackBeyondItWithoutTouching) {
  for (const Box& box : boxes()) {
    for (const Side side : {Side::kBoth, Side::kLeft, Side::kRight}) {
      for_each_run([&](const Trial& run) {
        Plant plant = before(box, run);
        RoundObstacle controller;
        controller.gains.side = side;
        controller.start({}, plant.sense());
        drive_until(controller, plant, run.dt_s, 40.0, [&](double) { return controller.done() || controller.lost(); });
        ASSERT_TRUE(controller.done()) << text(box, run);
        EXPECT_FALSE(plant.touched) << text(box, run);
        EXPECT_GT(plant.x, 1.0 + box.half_length) << text(box, run);
        // The track is where the compass and the odometry say: the worst of both over two metres of way.
        EXPECT_LT(std::fabs(plant.y), at({0.09, 0.13, 0.22}, run)) << text(box, run);
        EXPECT_LT(std::fabs(plant.heading) / kDegree, at({9.0, 10.0, 14.0}, run)) << text(box, run);
      }, 2);
    }
  }
}

/// A box with a bend `to_bend` m behind its middle, driven round with each hand.
void round_before_a_bend(const Box& box, double turn, double to_bend) {
  const double middle = 1.0 + box.half_length;
  for (const Side side : {Side::kBoth, Side::kLeft, Side::kRight}) {
    for_each_run([&](const Trial& run) {
      Plant plant = before(box, run);
      Task task;
      task.pieces = 2;
      task.course[0] = {0.0f, static_cast<float>(middle + to_bend - plant.x)};
      task.course[1] = {static_cast<float>(turn), 3.0f};
      const std::vector<Point> track = middle_line({plant.x, plant.y}, {task.course[0], task.course[1]}, 0.3);
      RoundObstacle controller;
      controller.gains.side = side;
      controller.start(task, plant.sense());
      drive_until(controller, plant, run.dt_s, 40.0, [&](double) { return controller.done() || controller.lost(); });
      const std::string what = std::to_string(turn / kDegree) + " degrees, " + std::to_string(to_bend) + " m behind " + text(box, run);
      ASSERT_TRUE(controller.done()) << what;
      EXPECT_FALSE(plant.touched) << what;
      EXPECT_GT(plant.x + std::fabs(plant.y), middle) << what;
      EXPECT_LT(std::fabs(left_of(track, {plant.x, plant.y})), at({0.09, 0.13, 0.22}, run)) << what;
    }, 2);
  }
}

TEST(RoundObstacle, ComesBackToACourseThatBends) {
  for (const double half_length : {0.07, 0.15}) {
    for (const double turn : {kQuarter, -kQuarter, 0.5 * kQuarter}) {
      for (const double to_bend : {0.0, 0.2, 0.4, 0.6}) round_before_a_bend({0.1, half_length, 0.0}, turn, to_bend);
    }
  }
}

TEST(RoundObstacle, PassesOnTheSideWithMoreRoom) {
  for (const double hand : {1.0, -1.0}) {
    Floor floor;
    floor.add_box({1.0, -0.1}, {1.2, 0.1});
    floor.add_walls({{-1.0, 0.35 * hand}, {4.0, 0.35 * hand}});
    Plant plant(floor, {}, 1);
    plant.place(0.6, 0.0, 0.0);
    RoundObstacle controller;
    controller.start({}, plant.sense());
    double aside = 0.0;
    drive_until(controller, plant, 0.01, 40.0, [&](double) {
      aside = std::max(aside, -hand * plant.y);
      return controller.done() || controller.lost();
    });
    EXPECT_TRUE(controller.done());
    EXPECT_FALSE(plant.touched);
    EXPECT_GT(aside, 0.2);
  }
}

TEST(RoundObstacle, ACornerThatItHasPassedIsNotWhatStandsInItsWay) {
  for (const double hand : {1.0, -1.0}) {
    for_each_run([&](const Trial& run) {
      Floor floor;
      floor.add_box({1.0, -0.06}, {1.12, 0.06});
      floor.add_walls({{0.36, 1.5 * hand}, {0.36, 0.25 * hand}, {-0.5, 0.25 * hand}});   // ends nearer to the robot than the box stands
      Plant plant(floor, noise_of_level(run.level), run.seed);
      plant.place(0.62, 0.0, 0.0);
      RoundObstacle controller;
      controller.gains.side = hand > 0.0 ? Side::kLeft : Side::kRight;
      controller.gains.distance_m = 0.25f;
      controller.start({}, plant.sense());
      drive_until(controller, plant, run.dt_s, 40.0, [&](double) { return controller.done() || controller.lost(); });
      EXPECT_TRUE(controller.done()) << hand << ' ' << text(run) << " at " << plant.x << ' ' << plant.y;
      EXPECT_FALSE(plant.touched) << hand << ' ' << text(run);
    });
  }
}

TEST(RoundObstacle, ComesBackWhenThereIsNothingToGoRoundAnyMore) {
  for_each_run([&](const Trial& run) {
    Plant plant = before({0.15, 0.15, 0.0}, run);
    RoundObstacle controller;
    controller.start({}, plant.sense());
    drive_until(controller, plant, run.dt_s, 10.0, [&](double) { return std::fabs(plant.y) > 0.15; });
    plant.remove_walls();
    drive_until(controller, plant, run.dt_s, 25.0, [&](double) { return controller.done() || controller.lost(); });
    EXPECT_TRUE(controller.done()) << text(run);
    EXPECT_LT(std::fabs(plant.y), at({0.09, 0.13, 0.22}, run)) << text(run);
    EXPECT_LT(std::fabs(plant.heading) / kDegree, at({9.0, 10.0, 14.0}, run)) << text(run);
  });
}

TEST(RoundObstacle, StandsWhileSomethingComesNearerThanItDrives) {
  Floor floor;
  floor.add_box({1.0, -0.1}, {1.2, 0.1});
  Plant plant(floor, {}, 1);
  plant.place(0.6, 0.0, 0.0);
  RoundObstacle controller;
  controller.start({}, plant.sense());
  Senses senses = plant.sense();
  double fastest = 0.0;
  for (int i = 0; i < 100; ++i) {
    for (float& range : senses.range_m) range = kOutOfRange;
    senses.range_m[6] = 0.34f - 0.002f * static_cast<float>(i);   // 0.2 m/s at a period of 10 ms, from the right
    const Motion motion = controller.step(senses, 0.01f);
    if (i > 70) fastest = std::max(fastest, static_cast<double>(std::fabs(motion.speed_m_s) + std::fabs(motion.turn_rad_s)));
  }
  EXPECT_EQ(fastest, 0.0);
}

TEST(KeepWall, WithOneHandGoesRoundABox) {
  for (const Box& box : boxes()) {
    for (const Side side : {Side::kLeft, Side::kRight}) {
      for_each_run([&](const Trial& run) {
        Plant plant = before(box, run);
        KeepWall controller;
        controller.gains.side = side;
        controller.gains.distance_m = 0.2f;
        controller.gains.speed_m_s = 0.2f;
        controller.start({}, plant.sense());
        bool beyond = false;
        drive_until(controller, plant, run.dt_s, 40.0, [&](double) {
          beyond = plant.x > 1.0 + 2.0 * box.half_length && std::fabs(plant.y) < 0.02;
          return beyond;
        });
        EXPECT_TRUE(beyond) << text(box, run);
        EXPECT_FALSE(plant.touched) << text(box, run);
      }, 2);
    }
  }
}

// The line of std.obstacle in a road with walls: the right wall is kept, the obstacle stands at the left.
TEST(KeepWall, AtTheRightHandPassesWhatStandsAtTheLeft) {
  for_each_run([&](const Trial& run) {
    Floor floor;
    floor.add_walls({{-1.0, 0.3}, {4.0, 0.3}});
    floor.add_walls({{-1.0, -0.3}, {4.0, -0.3}});
    floor.add_box({1.0, 0.08}, {1.2, 0.3});
    Plant plant(floor, noise_of_level(run.level), run.seed);
    plant.place(0.5, 0.0, 0.0);
    KeepWall controller;
    controller.gains.side = Side::kRight;
    controller.gains.distance_m = 0.18f;
    controller.gains.speed_m_s = 0.2f;
    controller.start({}, plant.sense());
    drive_until(controller, plant, run.dt_s, 30.0, [&](double) { return plant.x > 2.0; });
    EXPECT_GT(plant.x, 2.0) << text(run);
    EXPECT_FALSE(plant.touched) << text(run);
  });
}

/// One wall at the left or the right hand, as RoundObstacle keeps it.
struct AtOneHand {
  OneWallGains gains;
  Body body;
  Reckoning reckoning;
  OneWall wall;
  AtOneHand(bool left, bool passes, Plant& plant) {
    gains.passes = passes;
    reckoning.start(heard(plant.sense()), {});
    wall.start(left);
  }
  Motion step(const Senses& raw, float dt_s) {
    const Senses senses = heard(raw);
    reckoning.step(senses, dt_s);
    return braked(wall.step(senses, reckoning.at, dt_s, gains, body), senses, body);
  }
};

// A wall ends, and 42 cm beyond its end stands a box, nearer to who goes round the end than the wall is.
TEST(OneWall, DrivesBetweenTheWallAndAnotherThingOnlyIfItPasses) {
  for (const double hand : {1.0, -1.0}) {
    Floor floor;
    floor.add_walls({{-1.0, 0.2 * hand}, {1.0, 0.2 * hand}});
    floor.add_box({1.42, std::min(0.1 * hand, 0.7 * hand)}, {1.7, std::max(0.1 * hand, 0.7 * hand)});
    for (const bool passes : {true, false}) {
      for_each_run([&](const Trial& run) {
        Plant plant(floor, noise_of_level(run.level), run.seed);
        plant.place(0.3, 0.0, 0.0);
        AtOneHand controller(hand > 0.0, passes, plant);
        const auto through = [&] { return plant.x < 1.42 && hand * plant.y > 0.4; };
        drive_until(controller, plant, run.dt_s, 30.0, [&](double) { return through() || plant.x > 1.8; });
        EXPECT_TRUE(through() == passes || run.level == 2) << text(run);   // the worst range finders see it narrower
        EXPECT_FALSE(plant.touched) << text(run);
      });
    }
  }
}

TEST(KeepWall, IsNotLostBesideAWallEvenIfItMayNotDriveWithoutOne) {
  Floor floor;
  floor.add_walls({{-1.0, 0.3}, {1.5, 0.3}});
  Plant plant(floor, {}, 1);
  plant.place(0.0, 0.0, 0.0);
  KeepWall controller;
  controller.gains.side = Side::kLeft;
  controller.gains.gap_m = 0.0f;
  controller.start({}, plant.sense());
  drive_until(controller, plant, 0.02, 20.0, [&](double) { return plant.x > 1.0 || controller.lost(); });
  EXPECT_GT(plant.x, 1.0);
  plant.remove_walls();
  drive_until(controller, plant, 0.02, 20.0, [&](double) { return controller.lost(); });
  EXPECT_TRUE(controller.lost());
  const Motion motion = controller.step(plant.sense(), 0.02f);
  EXPECT_EQ(motion.speed_m_s, 0.0f) << "who is lost stands";
  EXPECT_EQ(motion.turn_rad_s, 0.0f);
}

TEST(KeepWall, WithOneHandFollowsInnerAndOuterCorners) {
  for (const double hand : {1.0, -1.0}) {
    Floor floor;   // along, out round a corner, and into one
    floor.add_walls({{-1.0, 0.3 * hand}, {1.5, 0.3 * hand}, {1.5, 1.5 * hand}, {3.0, 1.5 * hand}, {3.0, -2.0 * hand}});
    for_each_run([&](const Trial& run) {
      Plant plant(floor, noise_of_level(run.level), run.seed);
      plant.place(0.0, 0.0, 0.0);
      KeepWall controller;
      controller.gains.side = hand > 0.0 ? Side::kLeft : Side::kRight;
      controller.gains.speed_m_s = 0.3f;
      controller.start({}, plant.sense());
      double straight = 0.0;
      drive_until(controller, plant, run.dt_s, 40.0, [&](double) {
        if (plant.x < 1.3 && plant.x > 0.8 && hand * plant.y < 0.3) straight = std::max(straight, std::fabs(plant.y));
        return plant.x > 2.5 && hand * plant.y < -0.5;
      });
      EXPECT_LT(hand * plant.y, -0.5) << text(run);
      EXPECT_FALSE(plant.touched) << text(run);
      EXPECT_LT(straight, at({0.02, 0.03, 0.06}, run)) << text(run);
    });
  }
}

}  // namespace
}  // namespace mts::plant
