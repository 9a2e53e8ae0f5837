// What controllers of halls are made of.
#include <gtest/gtest.h>

#include <limits>

#include <waymark/controllers/any_controller.h>
#include "tests/unit/controllers/drives.h"

namespace mts {
namespace {

/// Along the wall of a box at its left: east under it, then north beside it.
Trail round_a_box() {
  Trail trail;
  trail.start();
  trail.begin_wall(true);
  for (int i = 0; i <= 20; ++i) trail.add({0.1f * static_cast<float>(i), 0.0f, 0.0f});
  for (int i = 1; i <= 10; ++i) trail.add({2.0f, 0.1f * static_cast<float>(i), 0.0f});
  return trail;
}

TEST(Trail, ForbidsToRunIntoAWallThatWasFollowedAndNotToCrossItsTrailOutwards) {
  const Trail trail = round_a_box();
  EXPECT_TRUE(trail.forbids({1.0f, -1.0f, 0.0f}, {1.0f, 3.0f, 0.0f}));    // from outside into the box
  EXPECT_FALSE(trail.forbids({1.0f, 1.0f, 0.0f}, {1.0f, -3.0f, 0.0f}));   // from the other side
  EXPECT_FALSE(trail.forbids({3.0f, 1.0f, 0.0f}, {6.0f, 1.0f, 0.0f}));    // meets nothing
  Trail right;
  right.start();
  right.begin_wall(false);
  for (int i = 0; i <= 20; ++i) right.add({0.1f * static_cast<float>(i), 0.0f, 0.0f});
  EXPECT_FALSE(right.forbids({1.0f, -1.0f, 0.0f}, {1.0f, 3.0f, 0.0f}));
  EXPECT_TRUE(right.forbids({1.0f, 1.0f, 0.0f}, {1.0f, -3.0f, 0.0f}));
}

TEST(Trail, KeepsItsShapeWhenItHasToForgetPoints) {
  Trail trail;
  trail.start();
  trail.begin_wall(true);
  for (int i = 0; i <= 500; ++i) trail.add({0.1f * static_cast<float>(i), 0.0f, 0.0f});
  EXPECT_TRUE(trail.forbids({25.0f, -5.0f, 0.0f}, {25.0f, 5.0f, 0.0f}));
  EXPECT_FALSE(trail.forbids({60.0f, -5.0f, 0.0f}, {60.0f, 5.0f, 0.0f}));
}

TEST(Trail, ThinningKeepsTheBeginningOfAWallThatWasTheLastPoint) {
  for (int before = 125; before < 130; ++before) {
    Trail trail;
    trail.start();
    trail.begin_wall(true);
    for (int i = 0; i < before; ++i) trail.add({0.11f * static_cast<float>(i), 0.0f, 0.0f});
    trail.leave_wall();
    trail.begin_wall(true);
    for (int i = 0; i < 4; ++i) trail.add({10.0f, 5.0f + 0.21f * static_cast<float>(i), 0.0f});
    EXPECT_FALSE(trail.forbids({16.0f, 3.0f, 0.0f}, {3.0f, 3.0f, 0.0f})) << before << ": between both walls the floor is free";
    EXPECT_FALSE(trail.forbids({3.0f, 3.0f, 0.0f}, {18.0f, 3.0f, 0.0f})) << before;
  }
}

Task hall_of(float length_m) {
  Task task;
  task.in_hall = true;
  task.out.x_m = length_m;
  return task;
}
Senses standing() {
  Senses senses;
  senses.heading_known = senses.odometry_known = senses.range_known = senses.turned_known = true;
  for (float& range : senses.range_m) range = kOutOfRange;
  return senses;
}

TEST(Hall, GoesInCrossesAndGoesOut) {
  Hall hall;
  Senses senses = standing();
  hall.start(hall_of(5.0f), senses, {}, Shut::kBoth);
  senses.speed_m_s = 0.5f;
  int crossed = 0;
  for (int i = 0; i < 2000 && !hall.past(); ++i) {
    static_cast<void>(hall.hear(senses, 0.01f));
    crossed += hall.crosses() ? 1 : 0;
  }
  EXPECT_TRUE(hall.past());
  EXPECT_NEAR(hall.at().x_m, 5.3f, 0.02f);
  EXPECT_GT(crossed, 500);
  EXPECT_LT(crossed, 800);
}

TEST(Hall, ADoorThatIsShutIsSeenAsAWall) {
  Hall hall;
  Task task = hall_of(5.0f);
  task.in.x_m = -1.0f;   // it begins a metre behind the first stop line, in the hall
  Senses senses = standing();
  hall.start(task, senses, {}, Shut::kIn);
  const Senses heard = hall.hear(senses, 0.01f);
  EXPECT_NEAR(heard.range_m[4], 0.5f, 1e-4f);         // behind it
  EXPECT_EQ(heard.range_m[0], kOutOfRange);
  EXPECT_EQ(heard.range_m[3], kOutOfRange);           // the wall beside the door is not its business
}

TEST(AnyController, WhoMissesTheDoorOfAHallSaysSo) {
  for (const ControllerId id : {ControllerId::kBug, ControllerId::kPotential}) {
    AnyController controller;
    controller.choose(id);
    Senses senses = standing();
    controller.start(hall_of(5.0f), senses);
    for (float& range : senses.range_m) range = 0.1f;   // a wall where the way in should go on
    for (int i = 0; i < 950; ++i) static_cast<void>(controller.step(senses, 0.02f));
    EXPECT_EQ(controller.plight(), Plight::kNone) << "somebody may stand in the door";
    for (int i = 0; i < 100; ++i) static_cast<void>(controller.step(senses, 0.02f));
    EXPECT_EQ(controller.plight(), Plight::kTrapped);
  }
}

TEST(AnyController, WhoStandsSinceItSeesNothingIsNotInVain) {
  for (const ControllerId id : {ControllerId::kBug, ControllerId::kPotential, ControllerId::kFollowRules, ControllerId::kNeuralMap}) {
    for (const bool door : {true, false}) {
      for (const bool ranges : {true, false}) {
        AnyController controller;
        Host host;
        host.decide = [](void*, const RulesInput&) { return RulesOutput{0.0f, 1.0f, true}; };
        host.look = [](void*, const WayQuestion& question, Way& way) {
          way.count = 1;
          way.pieces[0] = {0.0f, 4.0f};
          return question.first ? WayNews::kNew : WayNews::kSame;
        };
        controller.choose(id, {}, host);
        Task task = hall_of(5.0f);
        if (!door) task.in.x_m = -2.0f;
        const Senses seeing = standing();
        controller.start(task, seeing);
        Senses blind = seeing;
        (ranges ? blind.range_known : blind.odometry_known) = false;
        for (int i = 0; i < 22 * 50; ++i) static_cast<void>(controller.step(blind, 0.02f));
        static_cast<void>(controller.step(seeing, 0.02f));
        EXPECT_GT(controller.step(seeing, 0.02f).speed_m_s, 0.0f);
        EXPECT_EQ(controller.plight(), Plight::kNone) << static_cast<int>(id) << door << ranges;
      }
    }
  }
}

/// Six boxes between which a bug passes some gaps in one direction only.
plant::Floor crowded_hall() {
  plant::Floor floor;
  for (const double side : {1.05, -1.05}) {
    const double door = side > 0.0 ? 0.3 : -0.3;
    floor.add_walls({{-1.0, door}, {0.5, door}, {0.5, side}, {5.6, side}, {5.6, door}, {7.0, door}});
  }
  floor.add_box({2.75, -1.05}, {2.85, -0.45});
  floor.add_box({1.45, 0.45}, {2.20, 0.60});
  floor.add_box({1.85, -0.10}, {2.55, 0.50});
  floor.add_box({4.05, -1.05}, {4.75, -0.75});
  floor.add_box({3.40, 0.00}, {3.75, 0.60});
  floor.add_box({3.20, -0.85}, {3.35, -0.20});
  return floor;
}

// It used to circle for ever between two of the boxes, away from where it had met them.
TEST(Bug, LeavesALoopThatMissesThePlaceWhereItBegan) {
  for (const int level : {0, 1}) {
    plant::Plant robot(crowded_hall(), plant::noise_of_level(level), static_cast<std::uint64_t>(level) + 1);
    robot.place(0.0, 0.0, 0.0);
    AnyController controller;
    controller.choose(ControllerId::kBug);
    controller.start(hall_of(6.1f), robot.sense());
    const double took_s = plant::drive_until(controller, robot, 0.02, 600.0, [&](double) { return controller.lost(); });
    EXPECT_LT(took_s, 590.0) << level;
    EXPECT_EQ(controller.plight(), Plight::kNone) << level;
    EXPECT_GT(robot.x, 6.0) << level;
    EXPECT_FALSE(robot.touched) << level;
  }
}

/// A robot that is shut up between four walls, which it may have met anywhere.
TEST(Bug, GivesUpInACell) {
  for (const bool right : {false, true}) {
    plant::Floor floor;
    floor.add_walls({{1.5, -0.6}, {3.0, -0.6}, {3.0, 0.6}, {1.5, 0.6}, {1.5, -0.6}});
    plant::Plant robot(floor, plant::noise_of_level(1), 2);
    robot.place(2.0, 0.0, 0.0);
    Task task = hall_of(6.1f);
    task.in.x_m = -2.0f;
    task.out.x_m = 4.1f;
    AnyController controller;
    controller.choose(ControllerId::kBug);
    ASSERT_EQ(controller.set("side", right ? 1.0f : 2.0f), Setting::kSet);
    controller.start(task, robot.sense());
    const double took_s = plant::drive_until(controller, robot, 0.02, 400.0, [&](double) { return controller.lost(); });
    EXPECT_LT(took_s, 390.0);
    EXPECT_EQ(controller.plight(), Plight::kNoWay);
  }
}

TEST(AnyController, WhatCrossesHallsStandsWhereThereIsNone) {
  for (const ControllerId id : {ControllerId::kBug, ControllerId::kPotential, ControllerId::kFollowRules, ControllerId::kNeuralMap, ControllerId::kGenetic}) {
    AnyController controller;
    controller.choose(id);
    controller.start({}, standing());
    const Motion motion = controller.step(standing(), 0.02f);
    EXPECT_EQ(motion.speed_m_s, 0.0f);
    EXPECT_EQ(motion.turn_rad_s, 0.0f);
  }
}

TEST(AnyController, WithoutAHostPlannersAndRulesSayThatThereIsNoWay) {
  for (const ControllerId id : {ControllerId::kFollowRules, ControllerId::kNeuralMap, ControllerId::kGenetic}) {
    AnyController controller;
    controller.choose(id);
    Task task = hall_of(5.0f);
    task.in.x_m = -1.0f;
    controller.start(task, standing());
    static_cast<void>(controller.step(standing(), 0.02f));
    EXPECT_EQ(controller.plight(), Plight::kNoWay);
  }
}

TEST(Potential, StandsStillForEightSecondsAndThenSaysThatItIsCaught) {
  AnyController controller;
  controller.choose(ControllerId::kPotential);
  Task task = hall_of(5.0f);
  task.in.x_m = -1.0f;
  const Senses senses = standing();
  controller.start(task, senses);
  EXPECT_GT(controller.step(senses, 0.02f).speed_m_s, 0.2f);
  for (int i = 0; i < 390; ++i) static_cast<void>(controller.step(senses, 0.02f));
  EXPECT_EQ(controller.plight(), Plight::kNone);
  for (int i = 0; i < 20; ++i) static_cast<void>(controller.step(senses, 0.02f));
  EXPECT_EQ(controller.plight(), Plight::kTrapped);
  EXPECT_EQ(controller.step(senses, 0.02f).speed_m_s, 0.0f);
}

TEST(FollowPlan, IsHeldUpWhicheverWayItFaces) {
  for (const float faces : {0.5f, kPi}) {   // the compass trembles, and west is where angles begin again
    Task task = hall_of(5.0f);
    task.in.x_m = -2.0f;
    FollowPlan plan;
    plan.host.look = [](void*, const WayQuestion& question, Way& way) {
      way.count = 1;
      way.pieces[0] = {0.0f, 3.0f};
      return question.first ? WayNews::kNew : WayNews::kSame;
    };
    Senses senses = standing();
    senses.heading_rad = senses.turned_rad = faces;
    plan.start(task, senses);
    for (int i = 0; i < 500; ++i) {
      senses.heading_rad = senses.turned_rad = wrapped_angle(faces + (i % 2 == 0 ? 4e-4f : -4e-4f));
      static_cast<void>(plan.step(senses, 0.02f));
    }
    EXPECT_EQ(plan.plight(), Plight::kTrapped) << faces;
  }
}

/// A program's planner that needs some time, and then knows a way to the north.
struct SlowPlanner {
  int thinks = 3;                ///< so many questions are answered with kSame
  std::uint8_t pieces = 1;
  int asked = 0, asked_first = 0;

  Host host() {
    return {this, [](void* self, const WayQuestion& question, Way& way) { return static_cast<SlowPlanner*>(self)->look(question, way); }, nullptr};
  }
  WayNews look(const WayQuestion& question, Way& way) {
    asked_first += question.first ? 1 : 0;
    if (++asked != thinks + 1) return WayNews::kSame;
    way.count = pieces;
    way.pieces[0] = {0.5f * kPi, 5.0f};
    return WayNews::kNew;
  }
};
Task inside_a_hall() {
  Task task = hall_of(5.0f);
  task.in.x_m = -2.0f;
  return task;
}

TEST(FollowPlan, StandsUntilItHasAPath) {
  SlowPlanner planner;
  FollowPlan plan;
  plan.host = planner.host();
  plan.start(inside_a_hall(), standing());
  for (int i = 0; i < planner.thinks; ++i) {
    const Motion motion = plan.step(standing(), 0.02f);
    EXPECT_EQ(motion.speed_m_s, 0.0f) << "east is no path";
    EXPECT_EQ(motion.turn_rad_s, 0.0f);
  }
  EXPECT_GT(plan.step(standing(), 0.02f).turn_rad_s, 0.5f) << "to the north";
  static_cast<void>(plan.step(standing(), 0.02f));
  EXPECT_EQ(planner.asked_first, planner.thinks + 1) << "as long as there was none";
}

TEST(FollowPlan, DoesNotDriveOnThePathOfItsLastDrive) {
  SlowPlanner planner{.thinks = 0};
  FollowPlan plan;
  plan.host = planner.host();
  plan.start(inside_a_hall(), standing());
  EXPECT_GT(plan.step(standing(), 0.02f).turn_rad_s, 0.5f);
  plan.start(inside_a_hall(), standing());
  EXPECT_EQ(plan.step(standing(), 0.02f).turn_rad_s, 0.0f);
}

TEST(FollowPlan, APathWithoutPiecesIsNone) {
  SlowPlanner planner{.thinks = 0, .pieces = 0};
  FollowPlan plan;
  plan.host = planner.host();
  plan.start(inside_a_hall(), standing());
  EXPECT_EQ(plan.step(standing(), 0.02f).speed_m_s, 0.0f);
}

TEST(FollowPlan, WaitsEightSecondsForAPath) {
  SlowPlanner planner{.thinks = 10'000};
  FollowPlan plan;
  plan.host = planner.host();
  plan.start(inside_a_hall(), standing());
  for (int i = 0; i < 395; ++i) static_cast<void>(plan.step(standing(), 0.02f));
  EXPECT_EQ(plan.plight(), Plight::kNone);
  for (int i = 0; i < 10; ++i) static_cast<void>(plan.step(standing(), 0.02f));
  EXPECT_EQ(plan.plight(), Plight::kTrapped);
}

// Nothing but the bumper tells this robot that something stands in its way.
TEST(FollowPlan, IsHeldUpByItsBumperToo) {
  for (const bool in_door : {true, false}) {
    SlowPlanner planner{.thinks = 0};
    FollowPlan plan;
    plan.body.has_range_finders = false;
    plan.host = planner.host();
    Senses senses = standing();
    senses.range_known = false;
    senses.touched = true;
    senses.heading_rad = senses.turned_rad = in_door ? 0.0f : 0.5f * kPi;
    plan.start(in_door ? hall_of(5.0f) : inside_a_hall(), senses);
    for (int i = 0; i < 50 * (in_door ? 19 : 7); ++i) static_cast<void>(plan.step(senses, 0.02f));
    EXPECT_EQ(plan.plight(), Plight::kNone);
    for (int i = 0; i < 50 * 2; ++i) static_cast<void>(plan.step(senses, 0.02f));
    EXPECT_EQ(plan.plight(), Plight::kTrapped) << in_door;
  }
}

TEST(FollowRules, AnAnswerThatIsNoNumberIsNone) {
  const float none[] = {std::numeric_limits<float>::quiet_NaN(), kInfinity};
  for (const float odd : none) {
    for (const RulesOutput& answer : {RulesOutput{odd, 1.0f, true}, RulesOutput{10.0f, odd, true}}) {
      FollowRules rules;
      rules.host = {const_cast<RulesOutput*>(&answer), nullptr, [](void* self, const RulesInput&) { return *static_cast<RulesOutput*>(self); }};
      Senses senses = standing();
      senses.heading_rad = senses.turned_rad = 1.0f;
      rules.start(inside_a_hall(), senses);
      for (int i = 0; i < 3; ++i) {
        const Motion motion = rules.step(senses, 0.02f);
        EXPECT_EQ(motion.speed_m_s, 0.0f);
        EXPECT_EQ(motion.turn_rad_s, 0.0f) << "east is no answer";
      }
      EXPECT_EQ(rules.plight(), Plight::kTrapped);
    }
  }
}

}  // namespace
}  // namespace mts
