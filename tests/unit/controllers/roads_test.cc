// Driving along roads: the line, the walls, the heading; straight, round bends, round corners.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/controllers/drives.h"

namespace mts::plant {
namespace {

struct Road { const char* name; std::vector<Piece> pieces; double radius; };

std::vector<Road> roads() {
  const auto quarter = static_cast<float>(kQuarter);
  return {{"straight", {{0.0f, 3.0f}}, 0.0},
          {"corner to the left", {{0.0f, 1.5f}, {quarter, 1.5f}}, 0.0},
          {"corner to the right", {{0.0f, 1.5f}, {-quarter, 1.5f}}, 0.0},
          {"bend to the left", {{0.0f, 1.5f}, {quarter, 1.5f}}, 0.3},
          {"bend to the right", {{0.0f, 1.5f}, {-quarter, 1.5f}}, 0.3},
          {"two corners", {{0.0f, 1.0f}, {quarter, 1.0f}, {0.0f, 1.0f}}, 0.0},
          {"slanted bend", {{0.0f, 1.5f}, {0.5f * quarter, 1.5f}}, 0.0}};
}

struct Drive { double worst_m = 0.0, end_m = 0.0, time_s = 0.0; bool arrived = false; };

/// From 10 cm past the beginning, askew and a little aside, to 25 cm before the end of the road.
template <class Controller>
Drive drive_road(Controller controller, const Road& road, const Floor& floor, const Trial& run, double aside, bool* touched = nullptr) {
  Plant plant(floor, noise_of_level(run.level), run.seed);
  plant.body = controller.body;
  plant.place(0.1, aside * spread(run.seed, 1), 0.06 * spread(run.seed, 2));
  Task task;
  task.pieces = static_cast<std::uint8_t>(road.pieces.size());
  for (std::size_t i = 0; i < road.pieces.size(); ++i) task.course[i] = road.pieces[i];
  task.course[0].length_m -= 0.1f;
  controller.start(task, plant.sense());
  const std::vector<Point> middle = middle_line({0.0, 0.0}, road.pieces, road.radius);
  const Point goal = middle.back();
  const double heading = static_cast<double>(road.pieces.back().heading_rad);
  Drive drive;
  drive.time_s = drive_until(controller, plant, run.dt_s, 25.0, [&](double t) {
    drive.end_m = std::fabs(left_of(middle, {plant.x, plant.y}));
    if (t > 1.0) drive.worst_m = std::max(drive.worst_m, drive.end_m);   // the first second is for settling
    const double rest = (goal.x - plant.x) * std::cos(heading) + (goal.y - plant.y) * std::sin(heading);
    drive.arrived = rest < 0.25 && std::hypot(goal.x - plant.x, goal.y - plant.y) < 0.6;
    return drive.arrived;
  });
  if (touched != nullptr) *touched = plant.touched;
  return drive;
}

TEST(FollowLine, StaysOnStraightLinesBendsAndCorners) {
  for (const Road& road : roads()) {
    Floor floor;
    floor.add_path(middle_line({0.0, 0.0}, road.pieces, road.radius), 0.03);
    for_each_run([&](const Trial& run) {
      const Drive drive = drive_road(FollowLine{}, road, floor, run, 0.03);
      ASSERT_TRUE(drive.arrived) << road.name << ", " << text(run);
      EXPECT_LT(drive.worst_m, 0.03) << road.name << ", " << text(run);
      EXPECT_LT(drive.end_m, 0.006) << road.name << ", " << text(run);
      EXPECT_LT(drive.time_s, 11.0) << road.name << ", " << text(run);
    });
  }
}

TEST(FollowLine, StaysOnOtherTapeByOtherRows) {
  struct Row { float ahead_m, span_m, line_m; };
  for (const Row& row : {Row{0.04f, 0.10f, 0.03f}, Row{0.20f, 0.10f, 0.03f}, Row{0.09f, 0.06f, 0.03f}, Row{0.09f, 0.06f, 0.02f}, Row{0.09f, 0.15f, 0.05f}}) {
    FollowLine follow;
    follow.body.line_ahead_m = row.ahead_m;
    follow.body.line_span_m = row.span_m;
    follow.body.paint_width_m = row.line_m;
    for (const Road& road : roads()) {
      Floor floor;
      floor.add_path(middle_line({0.0, 0.0}, road.pieces, road.radius), static_cast<double>(row.line_m));
      for_each_run([&](const Trial& run) {
        const Drive drive = drive_road(follow, road, floor, run, 0.2 * static_cast<double>(row.span_m));
        const std::string which = std::string(road.name) + ", row " + std::to_string(row.ahead_m) + " ahead, broad " + std::to_string(row.span_m) +
                                  ", line " + std::to_string(row.line_m) + ", " + text(run);
        ASSERT_TRUE(drive.arrived) << which;
        EXPECT_LT(drive.worst_m, 0.03 + 0.6 * static_cast<double>(row.ahead_m)) << which;   // a corner is cut by a robot that sees it from afar
        EXPECT_LT(drive.end_m, 0.02) << which;
      });
    }
  }
}

TEST(KeepWall, StaysBetweenTheWallsOfStraightRoadsBendsAndCorners) {
  for (const Road& road : roads()) {
    for (const double width : {0.5, 0.6, 0.8}) {
      Floor floor;
      floor.add_walls(parallel_line({0.0, 0.0}, road.pieces, road.radius, 0.5 * width));
      floor.add_walls(parallel_line({0.0, 0.0}, road.pieces, road.radius, -0.5 * width));
      for_each_run([&](const Trial& run) {
        bool touched = false;
        const Drive drive = drive_road(KeepWall{}, road, floor, run, 0.03, &touched);
        ASSERT_TRUE(drive.arrived) << road.name << ' ' << width << ", " << text(run);
        EXPECT_FALSE(touched) << road.name << ' ' << width << ", " << text(run);
        EXPECT_LT(drive.worst_m, at({0.10, 0.11, 0.12}, run)) << road.name << ' ' << width << ", " << text(run);
        EXPECT_LT(drive.end_m, at({0.02, 0.02, 0.06}, run)) << road.name << ' ' << width << ", " << text(run);
      }, 3);
    }
  }
}

// Three metres by the compass alone: what is left is the compass's bias, 2 degrees at the worst level.
TEST(HoldHeading, DrivesTheCourseThatTheTaskTells) {
  for (const Road& road : roads()) {
    if (road.radius > 0.0) continue;
    for_each_run([&](const Trial& run) {
      const Drive drive = drive_road(HoldHeading{}, road, {}, run, 0.0);
      ASSERT_TRUE(drive.arrived) << road.name << ", " << text(run);
      EXPECT_LT(drive.worst_m, at({0.05, 0.06, 0.14}, run)) << road.name << ", " << text(run);
    });
  }
}

// Between two bends that are near to each other both are sharper than they are meant to be, and are driven the more slowly.
TEST(HoldHeading, StaysOnItsCourseBetweenBendsThatAreNearToEachOther) {
  for (const float middle_m : {0.1f, 0.15f, 0.2f, 0.3f}) {
    const Piece pieces[] = {{0.0f, 1.0f}, {static_cast<float>(std::numbers::pi / 2), middle_m}, {0.0f, 1.0f}};
    Task task;
    for (const Piece& piece : pieces) task.course[task.pieces++] = piece;
    HoldHeading controller;
    Course course;
    course.start(pieces, 3, controller.gains.bend_radius_m, {});
    Plant plant({}, {}, 1);
    plant.place(0.0, 0.0, 0.0);
    controller.start(task, plant.sense());
    float worst_m = 0.0f;
    drive_until(controller, plant, 0.01, 9.0, [&](double) {
      worst_m = std::max(worst_m, std::fabs(course.at({static_cast<float>(plant.x), static_cast<float>(plant.y), static_cast<float>(plant.heading)}).left_m));
      return controller.lost();
    });
    EXPECT_LT(worst_m, 0.026f) << middle_m;   // what the lag of the motors takes where they are not near to each other
  }
}

/// The first time after which an offset stays within `band`, and the farthest that it went to the other side.
struct Settling { double after_s = 0.0, overshoot_m = 0.0; };
template <class Controller>
Settling settle(Controller controller, Plant& plant, const Trial& run, double offset, double band) {
  plant.place(0.1, offset, 0.0);
  controller.start({}, plant.sense());
  Settling settling;
  drive_until(controller, plant, run.dt_s, 6.0, [&](double t) {
    if (std::fabs(plant.y) > band) settling.after_s = t;
    settling.overshoot_m = std::max(settling.overshoot_m, offset > 0.0 ? -plant.y : plant.y);
    return false;
  });
  return settling;
}

TEST(FollowLine, IsLostWhereThereIsNoLineAndNotOnIt) {
  FollowLine controller;
  controller.gains.search_m = 0.0f;   // it stands at once where the line ends
  controller.body.has_range_finders = false;
  Senses senses;
  senses.line_known = true;
  senses.line[kLineSensors / 2] = senses.line[kLineSensors / 2 - 1] = 1.0f;
  controller.start({}, senses);
  EXPECT_GT(controller.step(senses, 0.02f).speed_m_s, 0.0f);
  EXPECT_FALSE(controller.lost());
  for (float& dark : senses.line) dark = 0.0f;
  EXPECT_EQ(controller.step(senses, 0.02f).speed_m_s, 0.0f);
  EXPECT_TRUE(controller.lost());
}

TEST(FollowLine, WhoIsToTurnToNoSideStillLooksStraightOn) {
  FollowLine controller;
  controller.gains.search_rad = 0.0f;
  Senses senses;
  senses.line_known = senses.odometry_known = senses.range_known = true;
  for (float& range_m : senses.range_m) range_m = kOutOfRange;
  senses.line[2] = 1.0f;
  controller.start({}, senses);
  static_cast<void>(controller.step(senses, 0.02f));
  senses.line[2] = 0.0f;   // in the middle
  EXPECT_GT(controller.step(senses, 0.02f).speed_m_s, 0.0f);
  EXPECT_FALSE(controller.lost());
}

TEST(KeepWall, IsLostNoLongerWhereItSeesACorner) {
  KeepWall controller;
  Senses senses;
  senses.range_known = senses.odometry_known = true;
  senses.speed_m_s = 0.3f;
  for (float& range : senses.range_m) range = kOutOfRange;
  controller.start({}, senses);
  for (int step = 0; step < 2'000 && !controller.lost(); ++step) static_cast<void>(controller.step(senses, 0.02f));
  ASSERT_TRUE(controller.lost());
  senses.range_m[0] = 0.4f;
  senses.range_m[5] = senses.range_m[7] = 0.42f;
  senses.range_m[6] = 0.3f;
  EXPECT_GT(controller.step(senses, 0.02f).speed_m_s, 0.0f);
  EXPECT_FALSE(controller.lost());
}

TEST(FollowLine, SettlesFromTheSideWithoutSwinging) {
  Floor floor;
  floor.add_path({{0.0, 0.0}, {4.0, 0.0}}, 0.03);
  for_each_run([&](const Trial& run) {
    for (const double offset : {-0.035, 0.035}) {
      Plant plant(floor, noise_of_level(run.level), run.seed);
      const Settling settling = settle(FollowLine{}, plant, run, offset, 0.006);
      EXPECT_LT(settling.after_s, 2.5) << text(run);
      EXPECT_LT(settling.overshoot_m, 0.008) << text(run);
    }
  });
}

TEST(KeepWall, SettlesInTheMiddleWithoutSwinging) {
  Floor floor;
  floor.add_walls({{-1.0, 0.3}, {5.0, 0.3}});
  floor.add_walls({{-1.0, -0.3}, {5.0, -0.3}});
  for_each_run([&](const Trial& run) {
    for (const double offset : {-0.12, 0.12}) {
      Plant plant(floor, noise_of_level(run.level), run.seed);
      const Settling settling = settle(KeepWall{}, plant, run, offset, 0.02);
      EXPECT_LT(settling.after_s, 4.5) << text(run);
      EXPECT_LT(settling.overshoot_m, 0.02) << text(run);
      EXPECT_FALSE(plant.touched) << text(run);
    }
  });
}

TEST(KeepWall, GoesStraightOnWhereAWallHasAGap) {
  Floor floor;
  floor.add_walls({{-1.0, 0.3}, {1.2, 0.3}, {1.2, 1.0}});
  floor.add_walls({{1.8, 1.0}, {1.8, 0.3}, {5.0, 0.3}});
  floor.add_walls({{-1.0, -0.3}, {5.0, -0.3}});
  for_each_run([&](const Trial& run) {
    Plant plant(floor, noise_of_level(run.level), run.seed);
    plant.place(0.0, 0.0, 0.0);
    KeepWall controller;
    controller.start({}, plant.sense());
    double worst = 0.0;
    drive_until(controller, plant, run.dt_s, 15.0, [&](double) {
      worst = std::max(worst, std::fabs(plant.y));
      return plant.x > 3.0;
    });
    EXPECT_GT(plant.x, 3.0) << text(run);
    EXPECT_LT(worst, 0.08) << text(run);
  });
}

TEST(KeepWall, StopsBeforeTheEndOfABlindAlley) {
  Floor floor;
  floor.add_walls({{-1.0, 0.3}, {2.0, 0.3}, {2.0, -0.3}, {-1.0, -0.3}});
  for_each_run([&](const Trial& run) {
    Plant plant(floor, noise_of_level(run.level), run.seed);
    plant.place(0.0, 0.0, 0.0);
    KeepWall controller;
    controller.start({}, plant.sense());
    drive_until(controller, plant, run.dt_s, 15.0, [&](double) { return false; });
    EXPECT_GT(plant.x, 1.5) << text(run);
    EXPECT_FALSE(plant.touched) << text(run);
  });
}

TEST(KeepWall, StopsWhereWallsEndForGood) {
  Floor floor;
  floor.add_walls({{-1.0, 0.3}, {1.0, 0.3}});
  floor.add_walls({{-1.0, -0.3}, {1.0, -0.3}});
  Plant plant(floor, {}, 1);
  plant.place(0.0, 0.0, 0.0);
  KeepWall controller;
  controller.start({}, plant.sense());
  drive_until(controller, plant, 0.01, 15.0, [&](double) { return false; });
  EXPECT_TRUE(controller.lost());
  EXPECT_NEAR(plant.x, 2.0, 0.15);
  EXPECT_NEAR(plant.left_m_s, 0.0, 1e-3);
}

TEST(FollowLine, CrossesAShortGapAndStopsAfterALongOne) {
  for (const double gap : {0.06, 1.0}) {
    Floor floor;
    floor.add_path({{0.0, 0.0}, {1.0, 0.0}}, 0.03);
    floor.add_path({{1.0 + gap, 0.0}, {4.0, 0.0}}, 0.03);
    Plant plant(floor, {}, 1);
    plant.place(0.1, 0.0, 0.0);
    FollowLine controller;
    controller.start({}, plant.sense());
    drive_until(controller, plant, 0.01, 15.0, [&](double) { return plant.x > 3.0; });
    EXPECT_EQ(plant.x > 3.0, gap < 0.1) << gap;
    EXPECT_EQ(controller.lost(), gap > 0.1) << gap;
    if (gap > 0.1) {
      EXPECT_LT(plant.row().x, 1.0 + 0.12 + 0.05);
    }
  }
}

TEST(FollowLine, ADeadEncoderDoesNotMakeItsSearchEndless) {
  Senses senses;
  senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = true;
  for (float& range_m : senses.range_m) range_m = kOutOfRange;
  FollowLine follow;
  follow.start({}, senses);
  double asked_m = 0.0;
  for (int i = 0; i < 3000; ++i) asked_m += 0.02 * static_cast<double>(follow.step(senses, 0.02f).speed_m_s);
  EXPECT_TRUE(follow.lost());
  EXPECT_LT(asked_m, 4.1 * static_cast<double>(follow.gains.search_m));
}

TEST(FollowLine, IsSlowerInABend) {
  Floor floor;
  const std::vector<Piece> pieces{{0.0f, 1.5f}, {static_cast<float>(kQuarter), 1.5f}};
  floor.add_path(middle_line({0.0, 0.0}, pieces, 0.3), 0.03);
  Plant plant(floor, {}, 1);
  plant.place(0.1, 0.0, 0.0);
  FollowLine controller;
  controller.start({}, plant.sense());
  double straight = 0.0, bend = 1.0;
  drive_until(controller, plant, 0.01, 20.0, [&](double) {
    const double speed = 0.5 * (plant.left_m_s + plant.right_m_s);
    if (plant.x < 1.1) straight = std::max(straight, speed);
    if (plant.x > 1.25 && plant.y < 0.2) bend = std::min(bend, speed);
    return plant.y > 1.0;
  });
  EXPECT_GT(straight, 0.39);
  EXPECT_LT(bend, 0.3);
}

TEST(AnyController, ABodyThatIsFasterMayBeDrivenFaster) {
  Body body;
  body.top_speed_m_s = 1.2f;
  AnyController controller;
  controller.choose(ControllerId::kHoldHeading, body);
  EXPECT_EQ(controller.set("speed", 1.21f), Setting::kOutside);
  ASSERT_EQ(controller.set("speed", 1.2f), Setting::kSet);
  Plant plant({}, {}, 1);
  plant.body = body;
  plant.place(0.0, 0.0, 0.1);
  Task task;
  task.pieces = 1;
  task.course[0] = {0.0f, 5.0f};
  controller.start(task, plant.sense());
  double fastest = 0.0;
  drive_until(controller, plant, 0.01, 5.0, [&](double) {
    fastest = std::max(fastest, plant.left_m_s);
    return plant.x > 4.5;
  });
  EXPECT_GT(plant.x, 4.5);
  EXPECT_NEAR(plant.y, 0.0, 0.05);
  EXPECT_GT(fastest, 1.15);
  controller.choose(ControllerId::kHoldHeading);
  EXPECT_EQ(controller.set("speed", 1.2f), Setting::kOutside) << "the body with the defaults does 0.6 m/s";
}

}  // namespace
}  // namespace mts::plant
