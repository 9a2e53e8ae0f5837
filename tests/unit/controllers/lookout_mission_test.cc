// A compiled mind, a pilot and a robot: a mission in closed loop.
#include <waymark/controllers/pilot.h>

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

/// A perception that knows where the robot is; it stands for tags, and reads line and range finders as they are. `beside_road`: it goes round
/// something and has not come back.
void perceive(const Plant& robot, const Senses& senses, bool beside_road, errand::Facts& facts) {
  const auto truth = [](bool is) { return is ? 0.9f : -0.9f; };
  const auto dark = std::count_if(std::begin(senses.line), std::end(senses.line), [](float darkness) { return darkness > 0.5f; });
  facts.Line = truth(dark >= 4);
  facts.Track.mark = truth(dark >= 1);
  facts.Track.dist = -0.9f;
  facts.Track.azimuth = truth(robot.x > 3.0 && !beside_road);
  facts.Obst = truth(senses.range_m[0] < 0.4f);
  facts.Safe = facts.CrossBy.mark = 0.9f;
  facts.Touched = truth(senses.touched);
  const auto near = [&](double x, double y) { return std::hypot(robot.x - x, robot.y - y) < 0.7; };
  facts.Dock = truth(near(0.0, 0.0));
  facts.Arch = truth(near(3.0, 0.0));
  facts.Shelf = truth(near(6.0, 4.0));
  facts.In.W = truth(near(-0.3, 0.0) || near(2.7, 0.0));
  facts.In.S = truth(near(6.0, 3.7));
  facts.MoveBy.mark = truth(near(0.0, 0.0));
  facts.MoveBy.azimuth = truth(near(3.0, 0.0));
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
  Mission mission;
  bool avoids = false;
  for (std::uint64_t tick = 0; mission.time_s < 120.0 && !mission.over; ++tick) {
    const Senses senses = robot.sense();
    perceive(robot, senses, avoids && !pilot.done(), facts);
    facts.Go = tick == 5 ? 0.9f : -0.9f;
    const auto decision = mind.tick(facts, milliseconds(static_cast<std::uint32_t>(std::lround(run.dt_s * 1000.0))));
    pilot.choose(errand::control_line(decision), errand::road_of_leg(mind), errand::speed_limit_m_per_s(mind));
    const Motion wanted = pilot.step(senses, static_cast<float>(run.dt_s));
    robot.drive(wanted, run.dt_s);
    mission.time_s += run.dt_s;
    avoids = decision.drives() && decision.strategy() == errand::Strategy::Avoid;
    mission.avoided = mission.avoided || avoids;
    if (robot.x > 0.5 && robot.x < 2.2) mission.fastest_m_s = std::max(mission.fastest_m_s, static_cast<double>(wanted.speed_m_s));
    mission.over = tick > 100 && !mind.high(errand::Satellite::Errand);
  }
  mission.touched = robot.touched;
  mission.x = robot.x, mission.y = robot.y, mission.heading = robot.heading;
  return mission;
}

TEST(Pilot, DrivesAMissionByControlLinesAndMapAlone) {
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
