// A compiled mind, its lookout, its pilot and a robot: a mission in closed loop.
#include <waymark/controllers/lookout.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "errand.kb.map.h"
#include "tests/unit/controllers/drives.h"
#include "tests/unit/controllers/plant.h"

namespace mts {
namespace {

using plant::Plant;

/// What the floor of errand.kb looks like, with a box before its bend.
plant::Floor yard(bool box) {
  plant::Floor floor;
  floor.add_path({{-1.5, 0.0}, {3.35, 0.0}}, 0.03);
  for (const double x : {-0.35, 0.35, 2.65, 3.35}) floor.add_path({{x, -0.3}, {x, 0.3}}, 0.05);
  floor.add_path({{5.7, 3.65}, {6.3, 3.65}}, 0.05);
  if (box) floor.add_box({4.6, -0.12}, {4.8, 0.12});
  return floor;
}

/// The sign that a reader reads where the robot is: one lies on each road, 15 cm before the stop line.
Sign sign_at(const Plant& robot) {
  constexpr struct { double x, y; const char *landmark, *exit; } kSigns[] = {
      {-0.5, 0.0, "Dock", "W"}, {0.5, 0.0, "Dock", "E"}, {2.5, 0.0, "Arch", "W"}, {3.5, 0.0, "Arch", "E"}, {6.0, 3.5, "Shelf", "S"}};
  for (const auto& sign : kSigns) {
    if (std::hypot(robot.x - sign.x, robot.y - sign.y) < 0.25) return {.landmark = sign.landmark, .exit = sign.exit};
  }
  return {};
}

struct Mission {
  double time_s = 0.0, fastest_m_s = 0.0;   ///< the second on the road with a limit
  bool avoided = false, over = false, touched = false;
  double x = 0.0, y = 0.0, heading = 0.0;
};

Mission drive_errand(bool box, const plant::Trial& run) {
  Plant robot(yard(box), plant::noise_of_level(run.level), run.seed);
  robot.place(-1.0, 0.0, 0.0);
  errand::Mind mind;
  errand::Facts facts;
  Pilot pilot(robot.body);
  Lookout<errand::Knowledge> lookout(robot.body, errand::landmarks(), errand::find_road);
  Mission mission;
  for (std::uint64_t tick = 0; mission.time_s < 120.0 && !mission.over; ++tick) {
    const Senses senses = robot.sense();
    lookout.write(facts);
    facts.Go = tick == 5 ? 0.9f : -0.9f;
    const auto decision = mind.tick(facts, milliseconds(static_cast<std::uint32_t>(std::lround(run.dt_s * 1000.0))));
    pilot.choose(errand::control_line(decision), errand::road_of_leg(mind), errand::speed_limit_m_per_s(mind));
    const Motion wanted = pilot.step(senses, static_cast<float>(run.dt_s));
    lookout.step(pilot, sign_at(robot), static_cast<float>(run.dt_s));
    robot.drive(wanted, run.dt_s);
    mission.time_s += run.dt_s;
    mission.avoided = mission.avoided || (decision.drives() && decision.strategy() == errand::Strategy::Avoid);
    if (robot.x > 0.5 && robot.x < 2.2) mission.fastest_m_s = std::max(mission.fastest_m_s, static_cast<double>(wanted.speed_m_s));
    mission.over = tick > 100 && !mind.high(errand::Satellite::Errand);
  }
  mission.touched = robot.touched;
  mission.x = robot.x, mission.y = robot.y, mission.heading = robot.heading;
  return mission;
}

TEST(Lookout, AMissionNeedsNothingButSensesSignsControlLinesAndTheMap) {
  for (std::uint32_t s = 0; s != errand::Knowledge::kShape.strategies; ++s) {
    const ControlLine* line = errand::control_line(static_cast<errand::Strategy>(s));
    ASSERT_NE(line, nullptr);
    EXPECT_EQ(Pilot().fits(*line), Setting::kSet) << line->controller;
  }
  plant::for_each_run([](const plant::Trial& run) {
    for (const bool box : {false, true}) {
      const Mission mission = drive_errand(box, run);
      const std::string which = text(run) + (box ? ", with a box" : "");
      EXPECT_TRUE(mission.over) << which << " at " << mission.x << ", " << mission.y;
      EXPECT_FALSE(mission.touched) << which;
      EXPECT_EQ(mission.avoided, box) << which;
      EXPECT_LT(mission.fastest_m_s, 0.2501) << which;
      EXPECT_NEAR(mission.x, 6.0, plant::at({0.08, 0.15, 0.35}, run)) << which;
      EXPECT_NEAR(mission.heading, std::numbers::pi / 2, plant::at({0.05, 0.1, 0.2}, run)) << which;
    }
  });
}

}  // namespace
}  // namespace mts
