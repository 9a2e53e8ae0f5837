// A goal that moves, and obstacles that move.
#include "planners/pursuit.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planners/dice.h"

namespace kb::planners {
namespace {

double between(Dice& dice, double low, double high) { return low + (high - low) * static_cast<double>(dice.below(1u << 20)) / (1u << 20); }

TEST(Pursuit, catches_every_goal_that_is_slower_than_the_robot) {
  Dice dice(5);
  for (int i = 0; i < 500; ++i) {
    PursuitScene scene;
    scene.robot = {{between(dice, -20, 20), between(dice, -20, 20)}, {}};
    const Point from{between(dice, -20, 20), between(dice, -20, 20)};
    const double course = between(dice, -kPi, kPi), speed = between(dice, 0.0, 0.9);
    const Point velocity{speed * std::cos(course), speed * std::sin(course)};
    scene.goal = [=](double t) { return MovingPoint{from + t * velocity, velocity}; };
    const PursuitResult result = pursue(scene, {}, {}, {});
    ASSERT_EQ(result.outcome, Outcome::kReached) << "run " << i << ", speed " << speed;
  }
}

TEST(Pursuit, does_not_catch_a_faster_goal_and_says_so) {
  PursuitScene scene;
  scene.goal = [](double t) { return MovingPoint{{5.0 + 1.5 * t, 0.0}, {1.5, 0.0}}; };
  EXPECT_EQ(pursue(scene, {}, {.time_s = 60.0}, {}).outcome, Outcome::kLimit);
}

TEST(Pursuit, comes_to_rest_beside_a_goal_that_stands) {
  PursuitScene scene;
  scene.goal = [](double) { return MovingPoint{{10.0, 3.0}, {}}; };
  const PursuitResult result = pursue(scene, {}, {}, {});
  EXPECT_EQ(result.outcome, Outcome::kReached);
  EXPECT_LT(result.time_s, 20.0);   // 10.4 m at 1 m/s, and half a second to hold
}

// Only while the robot closes in, and only where it could no longer brake outside of the zone: Ge and Cui's two conditions.
TEST(Pursuit, minds_obstacles_only_while_it_closes_in_on_them) {
  const PursuitParameters parameters;
  const MovingPoint goal{{10.0, 0.0}, {1.0, 0.0}};
  const MovingPoint robot{{0.0, 0.0}, {1.0, 0.0}};
  const Point free = pursuit_acceleration(robot, goal, {}, parameters);
  const auto with = [&](const MovingDisc& disc) { return pursuit_acceleration(robot, goal, std::span(&disc, 1), parameters); };
  EXPECT_EQ(with({{1.0, 0.0}, {2.0, 0.0}, 0.2}), free);            // draws away
  EXPECT_EQ(with({{1.0, 0.0}, {1.0, 0.0}, 0.2}), free);            // keeps its distance
  EXPECT_EQ(with({{5.0, 0.0}, {0.0, 0.0}, 0.2}), free);            // is far away
  EXPECT_LT(with({{1.0, 0.0}, {0.0, 0.0}, 0.2}).x, free.x);        // stands in the way
  EXPECT_LT(with({{1.7, 0.0}, {-1.0, 0.0}, 0.2}).x, free.x);       // comes nearer
  // To the left of the way: pushed to the right.
  EXPECT_LT(with({{0.8, 0.3}, {0.0, 0.0}, 0.2}).y, free.y);
}

TEST(Pursuit, goes_round_discs_that_cross_its_way) {
  Dice dice(9);
  int caught = 0, touched = 0;
  for (int i = 0; i < 100; ++i) {
    PursuitScene scene;
    scene.goal = [](double t) { return MovingPoint{{15.0 + 0.3 * t, 0.0}, {0.3, 0.0}}; };
    std::vector<MovingDisc> discs;
    for (int k = 0; k < 3; ++k) {
      const double x = between(dice, 4.0, 14.0), y = between(dice, 2.0, 8.0) * (dice.below(2) == 0 ? 1.0 : -1.0);
      discs.push_back({{x, y}, {between(dice, -0.2, 0.2), y > 0 ? -0.4 : 0.4}, 0.4});
    }
    scene.obstacles = [discs](double t) {
      std::vector<MovingDisc> now = discs;
      for (MovingDisc& disc : now) disc.at = disc.at + t * disc.velocity;
      return now;
    };
    const PursuitResult result = pursue(scene, {}, {.time_s = 120.0}, {});
    caught += result.outcome == Outcome::kReached;
    touched += result.outcome == Outcome::kNumeric;
  }
  // No guarantee: a disc may run into a robot from the side.
  EXPECT_GE(caught, 95);
  EXPECT_LE(touched, 5);
}

TEST(Pursuit, refuses_parameters_that_make_no_sense) {
  PursuitScene scene;
  EXPECT_EQ(pursue(scene, {}, {}, {}).outcome, Outcome::kInvalid);   // no goal
  scene.goal = [](double) { return MovingPoint{}; };
  EXPECT_EQ(pursue(scene, {.top_speed = 0.0}, {}, {}).outcome, Outcome::kInvalid);
  EXPECT_EQ(pursue(scene, {.top_speed = 0.0}, {}, {}).fault, Fault::kBadParameter);
  EXPECT_EQ(pursue(scene, {}, {.step_s = std::nan("")}, {}).outcome, Outcome::kInvalid);
}

}  // namespace
}  // namespace kb::planners
