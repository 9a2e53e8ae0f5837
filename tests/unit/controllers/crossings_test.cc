// Driving over crossings: from the stop line in to the stop line out.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/controllers/drives.h"

namespace mts::plant {
namespace {

enum class Way { kLine, kWalls, kCompass };
struct Pose { double across = 0.0, along = 0.0, askew = 0.0; bool done = false, touched = false; };

double heading_out(Turn turn) {
  return turn == Turn::kBack ? 2.0 * kQuarter : turn == Turn::kLeft ? kQuarter : turn == Turn::kRight ? -kQuarter : 0.0;
}
unsigned road_of(Turn turn) { return turn == Turn::kForward ? 1u : turn == Turn::kLeft ? 2u : turn == Turn::kBack ? 4u : 8u; }

/// Arrives from the west, up to 4 cm past the stop line, askew and a little aside. The pose is told in the road of exit: the
/// row of line sensors from the middle of the road, from the stop line, and the heading.
template <class Controller>
Pose cross(Controller controller, const CrossingPlan& plan, Turn turn, const Trial& run, bool size_known) {
  Plant plant(crossing_floor(plan), noise_of_level(run.level), run.seed);
  const double back = 0.5 * plan.span + 0.09 - 0.04 * static_cast<double>(run.seed % 3) / 2.0;
  const double aside = 0.01 * spread(run.seed, 1);
  const double c = std::cos(plan.slant_rad), s = std::sin(plan.slant_rad);
  plant.place(-back * c - aside * s, -back * s + aside * c, plan.slant_rad + 0.03 * spread(run.seed, 2));
  Task task;
  task.turn = turn;
  const double out = plan.slant_rad + heading_out(turn);
  task.exit_known = true;
  task.exit_heading_rad = static_cast<float>(std::remainder(out, 4.0 * kQuarter));
  task.entry_heading_rad = static_cast<float>(plan.slant_rad);
  task.entry_known = true;
  if (size_known) task.crossing_m = static_cast<float>(plan.span);
  controller.start(task, plant.sense());
  drive_until(controller, plant, run.dt_s, 15.0, [&](double) { return controller.done() || controller.lost(); });
  drive_until(controller, plant, run.dt_s, 0.3, [](double) { return false; });   // the wheels come to rest
  Pose pose;
  const Point row = plant.row();
  pose.along = row.x * std::cos(out) + row.y * std::sin(out) - 0.5 * plan.span;
  pose.across = row.y * std::cos(out) - row.x * std::sin(out);
  pose.askew = std::remainder(plant.heading - out, 4.0 * kQuarter);
  pose.done = controller.done();
  pose.touched = plant.touched;
  return pose;
}

struct Bounds { Bound across_m, askew_deg; };

template <class Controller>
void expect_crossings(Way way, const Bounds& bounds, bool size_known, std::initializer_list<double> slants) {
  for (const double span : {0.6, 0.7, 0.8}) {
    for (const unsigned roads : {15u, 14u, 7u, 13u}) {   // the cross; no road ahead, to the right, to the left
      for (const Turn turn : {Turn::kBack, Turn::kLeft, Turn::kForward, Turn::kRight}) {
        if ((roads & road_of(turn)) == 0) continue;
        for (const double slant : slants) {
          for_each_run([&](const Trial& run) {
            const CrossingPlan plan{roads, span, 0.6, way == Way::kLine, way == Way::kWalls, slant};
            const Pose pose = cross(Controller{}, plan, turn, run, size_known);
            const std::string which = "turn " + std::to_string(static_cast<int>(turn)) + ", roads " + std::to_string(roads) +
                                      ", span " + std::to_string(span) + ", slant " + std::to_string(slant) + ", " + text(run);
            ASSERT_TRUE(pose.done) << which;
            EXPECT_FALSE(pose.touched) << which;
            EXPECT_LT(std::fabs(pose.along), 0.03) << which;   // on the stop line
            EXPECT_LT(std::fabs(pose.across), at(bounds.across_m, run)) << which;
            EXPECT_LT(std::fabs(pose.askew) / kDegree, at(bounds.askew_deg, run)) << which;
          }, 3);
        }
      }
    }
  }
}

TEST(TurnOnLine, EndsOnTheStopLineAndOnTheLineOfTheExit) {
  expect_crossings<TurnOnLine>(Way::kLine, {{0.015, 0.015, 0.03}, {3.0, 4.0, 5.0}}, false, {0.0, 0.6});
}
TEST(TurnByWalls, EndsOnTheStopLineBetweenTheWallsOfTheExit) {
  expect_crossings<TurnByWalls>(Way::kWalls, {{0.04, 0.045, 0.05}, {3.0, 4.0, 6.0}}, false, {0.0, 0.6});
}
TEST(TurnByCompass, EndsOnTheStopLineOfTheExit) {
  expect_crossings<TurnByCompass>(Way::kCompass, {{0.03, 0.035, 0.05}, {3.0, 4.0, 6.0}}, true, {0.0, -2.0});
}

// What the line shows corrects the heading as well as the place: a robot that is led to the left by its compass finds itself to the left of the line.
TEST(TurnOnLine, TheLineShowsThatTheCompassIsWrong) {
  for (unsigned seed = 1; seed <= 8; ++seed) {
    CrossingPlan plan;
    plan.walls = false;
    plan.span = 0.9;
    Noise noise;
    noise.compass_bias_rad = 5.0 * kDegree;   // at most, to either side
    Plant plant(crossing_floor(plan), noise, seed);
    plant.place(-0.54, 0.0, 0.0);
    TurnOnLine controller;
    Task task;
    task.exit_known = task.entry_known = true;
    task.crossing_m = 0.9f;
    controller.start(task, plant.sense());
    drive_until(controller, plant, 0.01, 15.0, [&](double) { return controller.done() || controller.lost(); });
    ASSERT_TRUE(controller.done());
    EXPECT_LT(std::fabs(plant.row().y), 0.008) << "seed " << seed;
  }
}

/// A crossing 0.9 m across, whose size the task names, from the west.
CrossingPlan wide_plan() {
  CrossingPlan plan;
  plan.walls = false;
  plan.span = 0.9;
  return plan;
}
/// Drives over it until the controller is done.
void expect_done(Plant& plant, Turn turn, double out_rad) {
  TurnOnLine controller;
  Task task;
  task.turn = turn;
  task.exit_known = true;
  task.exit_heading_rad = static_cast<float>(out_rad);
  task.entry_known = true;
  task.crossing_m = 0.9f;
  controller.start(task, plant.sense());
  drive_until(controller, plant, 0.01, 20.0, [&](double) { return controller.done() || controller.lost(); });
  EXPECT_TRUE(controller.done());
}

// From the west to the south, where a third road lies between the two: its line comes in to the row before the middle does.
TEST(TurnOnLine, IsNotMisledByTheArmOfARoadAtASharpAngle) {
  for (const double degrees : {-164.0, -152.0, -145.0, -130.0}) {
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
      CrossingPlan plan = wide_plan();
      plan.roads = 1u << 2 | 1u << 3;
      Floor floor = crossing_floor(plan);
      floor.add_path({{0.0, 0.0}, {1.5 * std::cos(degrees * kDegree), 1.5 * std::sin(degrees * kDegree)}}, 0.03);
      Plant plant(floor, noise_of_level(1), seed);
      plant.place(-0.53 + 0.002 * seed, 0.0, 0.02 * spread(seed, 3));
      expect_done(plant, Turn::kRight, -kQuarter);
      EXPECT_NEAR(plant.row().x, 0.0, 0.03) << degrees << ", seed " << seed;
    }
  }
}

// From the west to the right of two roads, or of three, that leave ahead: behind the middle their lines lie beside each other.
TEST(TurnOnLine, IsNotMisledByRoadsThatFork) {
  for (const bool three : {false, true}) {
    for (const double degrees : {15.0, 20.0, 26.0, 34.0, 45.0, 60.0}) {
      for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        CrossingPlan plan = wide_plan();
        plan.roads = three ? 1u << 2 | 1u : 1u << 2;
        Floor floor = crossing_floor(plan);
        for (const double out : {degrees * kDegree, -degrees * kDegree}) {
          const double c = std::cos(out), s = std::sin(out);
          floor.add_path({{0.0, 0.0}, {1.5 * c, 1.5 * s}}, 0.03);
          floor.add_path({{0.45 * c - 0.1 * s, 0.45 * s + 0.1 * c}, {0.45 * c + 0.1 * s, 0.45 * s - 0.1 * c}}, 0.05);
        }
        Plant plant(floor, noise_of_level(static_cast<int>(seed % 3)), seed);
        plant.place(-0.54 + 0.01 * spread(seed, 5), 0.01 * spread(seed, 1), 0.03 * spread(seed, 3));
        const double out = -degrees * kDegree;
        expect_done(plant, Turn::kRight, out);
        EXPECT_NEAR(plant.row().y * std::cos(out) - plant.row().x * std::sin(out), 0.0, 0.025) << degrees << ", seed " << seed;
      }
    }
  }
}

// Who comes by compass is some centimetres off for each metre of the road.
TEST(TurnOnLine, LooksForTheLineBesideTheWayIn) {
  for (const Turn turn : {Turn::kForward, Turn::kRight}) {
    for (const double aside : {-0.15, -0.10, 0.10, 0.15}) {
      Plant plant(crossing_floor(wide_plan()), noise_of_level(1), 7);
      plant.place(-0.53, aside, 0.02);
      expect_done(plant, turn, heading_out(turn));
      EXPECT_NEAR(turn == Turn::kForward ? plant.row().y : plant.row().x, 0.0, 0.03) << aside;
    }
  }
}
// Round something, and to the stop line far from the middle of the road.
template <class Controller>
void expect_return(const CrossingPlan& plan, double aside_m, double bound_m) {
  for (const Turn turn : {Turn::kForward, Turn::kLeft, Turn::kRight}) {
    for (const double aside : {-aside_m, -0.67 * aside_m, 0.67 * aside_m, aside_m}) {
      for (const double askew : {0.0, 1.0}) {
        Plant plant(crossing_floor(plan), noise_of_level(1), 7);
        const double heading = aside < 0.0 ? askew : -askew;   // towards the middle
        plant.place(-0.45 - 0.09 * std::cos(heading), aside, heading);
        Controller controller;
        Task task;
        task.turn = turn;
        const double out = heading_out(turn);
        task.exit_known = true;
        task.exit_heading_rad = static_cast<float>(out);
        task.entry_known = true;
        task.entry_left_m = static_cast<float>(aside) + 0.02f;   // odometry is not exact
        task.crossing_m = 0.9f;
        controller.start(task, plant.sense());
        drive_until(controller, plant, 0.01, 20.0, [&](double) { return controller.done() || controller.lost(); });
        EXPECT_TRUE(controller.done()) << aside << ", askew " << askew;
        EXPECT_NEAR(plant.row().y * std::cos(out) - plant.row().x * std::sin(out), 0.0, bound_m) << aside << ", askew " << askew;
        EXPECT_NEAR(plant.row().x * std::cos(out) + plant.row().y * std::sin(out), 0.45, 0.03) << aside << ", askew " << askew;
      }
    }
  }
}
TEST(TurnOnLine, ComesBackToTheMiddleOfItsRoadIfItIsToldHowFarBesideItIs) { expect_return<TurnOnLine>(wide_plan(), 0.3, 0.03); }
TEST(TurnByCompass, ComesBackToTheMiddleOfItsRoadIfItIsToldHowFarBesideItIs) { expect_return<TurnByCompass>(wide_plan(), 0.3, 0.06); }
TEST(TurnByWalls, ComesBackToTheMiddleOfItsRoadIfItIsToldHowFarBesideItIs) {
  CrossingPlan plan = wide_plan();
  plan.walls = true;
  expect_return<TurnByWalls>(plan, 0.16, 0.03);
}

TEST(TurnOnLine, GoesOnByReckoningWhereThereIsNoLine) {
  CrossingPlan plan = wide_plan();
  plan.lines = false;
  Plant plant(crossing_floor(plan), {}, 1);
  plant.place(-0.53, 0.0, 0.0);
  expect_done(plant, Turn::kForward, 0.0);
  EXPECT_NEAR(plant.row().x, 0.45, 0.05);
  EXPECT_NEAR(plant.row().y, 0.0, 0.05);
}

TEST(TurnOnLine, LooksForTheLineOutNoFartherThanItsOverrun) {
  CrossingPlan plan;
  plan.walls = false;
  Floor floor = crossing_floor(plan);
  std::erase_if(floor.paint, [](const Stroke& stroke) { return stroke.width > 0.04; });   // no stop lines at all
  Plant plant(floor, {}, 1);
  plant.place(-0.44, 0.0, 0.0);
  TurnOnLine controller;
  Task task;
  controller.start(task, plant.sense());
  drive_until(controller, plant, 0.01, 15.0, [](double) { return false; });
  EXPECT_TRUE(controller.lost());
  EXPECT_FALSE(controller.done());
  EXPECT_NEAR(plant.row().x, 0.35 + 0.25, 0.08);
}

TEST(TurnByCompass, EndsByOdometryWhereTheLineSensorsAreSilent) {
  Plant plant(crossing_floor({}), {}, 1);
  plant.place(-0.44, 0.0, 0.0);
  TurnByCompass controller;
  Task task;
  task.turn = Turn::kLeft;
  task.exit_known = true;
  task.exit_heading_rad = static_cast<float>(kQuarter);
  const auto deaf = [&] {
    Senses senses = plant.sense();
    senses.line_known = false;
    return senses;
  };
  controller.start(task, plant.sense());
  for (double t = 0.0; t < 10.0 && !controller.done(); t += 0.01) plant.drive(controller.step(deaf(), 0.01f), 0.01);
  EXPECT_TRUE(controller.done());
  EXPECT_NEAR(plant.row().y, 0.35, 0.03);
  EXPECT_NEAR(plant.x, 0.0, 0.03);
}

// Where the map says nothing, the exit is where the turn leads from the robot's own direction, and not in the east.
TEST(TurnByCompass, TurnsByItsOwnHeadingWhereNoExitIsTold) {
  for (const auto& [turn, by] : {std::pair(Turn::kForward, 0.0), std::pair(Turn::kLeft, kQuarter), std::pair(Turn::kRight, -kQuarter)}) {
    for (const double heading : {0.35, 1.05, -0.8, 3.0}) {
      Plant plant({}, {}, 1);
      plant.place(0.0, 0.0, heading);
      TurnByCompass controller;
      Task task;
      task.turn = turn;
      controller.start(task, plant.sense());
      const auto deaf = [&] {
        Senses senses = plant.sense();
        senses.line_known = false;
        return senses;
      };
      for (double t = 0.0; t < 15.0 && !controller.done(); t += 0.01) plant.drive(controller.step(deaf(), 0.01f), 0.01);
      EXPECT_TRUE(controller.done());
      EXPECT_NEAR(std::remainder(plant.heading - heading - by, 4.0 * kQuarter), 0.0, 0.05) << heading;
    }
  }
}

// Stop lines need not lie equally far from the middle: where roads leave at a sharp angle, theirs lie farther out.
TEST(TurnByCompass, TurnsInTheMiddleWhereverTheStopLinesLie) {
  for (const double in : {0.35, 0.9}) {
    Floor floor;
    const double out = 1.25 - in;
    floor.add_path({{-0.3, out}, {0.3, out}}, 0.05);
    Plant plant(floor, {}, 1);
    plant.place(-in - 0.07, 0.0, 0.0);
    TurnByCompass controller;
    Task task;
    task.turn = Turn::kLeft;
    task.exit_known = true;
    task.exit_heading_rad = static_cast<float>(kQuarter);
    task.entry_known = true;
    task.crossing_m = 1.25f;
    task.middle_m = static_cast<float>(in);
    controller.start(task, plant.sense());
    drive_until(controller, plant, 0.01, 15.0, [&](double) { return controller.done() || controller.lost(); });
    EXPECT_TRUE(controller.done());
    EXPECT_NEAR(plant.x, 0.0, 0.05);
    EXPECT_NEAR(plant.row().y, out, 0.05);
  }
}

/// Drives from the stop line of a road eastwards into one whose heading is known and called left: done, and along it.
void expect_turned_into(double degrees, double line_m, double start_m, Task task) {
  const double out = degrees * kDegree;
  const Point line{line_m * std::cos(out), line_m * std::sin(out)};
  Floor floor;
  floor.add_path({{line.x - 0.3 * std::sin(out), line.y + 0.3 * std::cos(out)},
                  {line.x + 0.3 * std::sin(out), line.y - 0.3 * std::cos(out)}}, 0.05);
  Plant plant(floor, {}, 1);
  plant.place(-start_m, 0.0, 0.0);
  TurnByCompass controller;
  task.turn = Turn::kLeft;
  task.exit_known = true;
  task.exit_heading_rad = static_cast<float>(out);
  controller.start(task, plant.sense());
  drive_until(controller, plant, 0.01, 10.0, [&](double) { return controller.done() || controller.lost(); });
  EXPECT_TRUE(controller.done());
  EXPECT_NEAR(plant.heading / kDegree, degrees, 5.0);
}

// Where roads meet at all angles, a turn is called by the sides of the roads, and may be nearly none.
TEST(TurnByCompass, TurnsByHeadingsThatAreKnownHoweverTheTurnIsCalled) {
  Task task;
  task.entry_known = true;
  task.crossing_m = 0.9f;
  expect_turned_into(10.0, 0.45, 0.54, task);
  expect_turned_into(170.0, 0.45, 0.54, task);
}

// At a slanted exit, and with an entry that nobody told: the compass says how it came.
TEST(TurnByCompass, TurnsIntoASlantedRoad) {
  Task task;
  task.entry_known = false;
  expect_turned_into(50.0, 0.35, 0.40, task);
}

}  // namespace
}  // namespace mts::plant
