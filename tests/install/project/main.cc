// Drives the bumper robot past a wall with no robot at hand: six ticks of half a second.
#include <cstdio>

#define X 7   // a macro that the project has before it includes anything of Waymark, and wants to have afterwards

#include <waymark/controllers/any_controller.h>
#include <waymark/controllers/lookout.h>
#include <waymark/runtime/compact_mind.h>
#include <waymark/runtime/image_mind.h>
#include "bumper.kb.h"
#include "near.kb.h"
#include "pace.kb.h"
#include "route1.kb.map.h"
#include "senses.kb.h"

static_assert(X == 7);
static_assert(!mts::find_controller("keep_wall")->ends, "the controllers are part of the package");

bool stands_at_first();   // shared.cc

namespace {

struct Wheels {
  float speed_m_per_s = 0.0f;
  void drive(const bumper::Drive& how) { speed_m_per_s = how.speed_m_per_s; }
  void idle() { speed_m_per_s = 0.0f; }
};

/// Sees, brakes, and backs off.
struct Robot {
  float range_m = 2.0f, speed_m_per_s = 0.0f;
  void sense(senses::Brake::Inputs& in) const { in.range_m = range_m; }
  void Brake(const senses::Brake::Outputs& out) { speed_m_per_s = out.speed_m_per_s; }
  void drive(const senses::Drive& how) { speed_m_per_s = how.speed_m_per_s; }
  void idle() { speed_m_per_s = 0.0f; }
};

/// Knowledge bases of which only a part is there.
bool parts_work() {
  near::Readings readings;
  near::Perception perception;
  near::Mind mind;
  readings.range = {0.1f, {0}};
  readings.tag = {"door", {0}};
  if (perception.look(readings, {0}, mind).Door != 1.0f) return false;
  readings.tag = {nullptr, {0}};   // as drivers of readers say that there is nothing
  if (perception.look(readings, {0}, mind).Door != 0.0f) return false;
  static_cast<void>(mind.tick(perception.facts(), mts::milliseconds(20)));
  pace::Pace::Inputs in;
  in.range_m = 3.0f;
  return mind.high(near::Satellite::Warned) && !mind.decision().drives() && pace::Pace::evaluate(in).speed_m_per_s == 0.5f;
}

bool sees_and_brakes() {
  constexpr struct { float go, range, speed; } kTicks[] = {{-1.0f, 2.0f, 0.0f}, {0.9f, 2.0f, 0.5f}, {0.0f, 0.65f, 0.25f}, {0.0f, 0.1f, -0.2f}};
  senses::Readings readings;
  senses::Perception perception;
  senses::Mind mind;
  Robot robot;
  std::int64_t now_us = 0;
  for (const auto& tick : kTicks) {
    const mts::Instant now{now_us += 100'000};
    readings.range = {robot.range_m = tick.range, now};
    perception.facts().Go = tick.go;
    senses::drive(mind.tick(perception.look(readings, now, mind), mts::milliseconds(100)), robot);
    const float off = robot.speed_m_per_s - tick.speed;
    if (off > 1e-3f || off < -1e-3f) return false;
  }
  return true;
}

/// Told to set out, it comes to the first landmark of its route.
bool knows_its_roads() {
  route1::Mind mind;
  route1::Facts facts;
  mts::RoadsDriven roads;
  const auto tick = [&] {
    const bool drives = mind.tick(facts, mts::milliseconds(500)).drives();
    roads.follow(route1::road_of_leg(mind));
    return drives;
  };
  if (tick()) return false;
  facts.Start1 = 0.9f;
  static_cast<void>(tick());
  if (roads.road() != nullptr) return false;
  facts.LM5 = 0.9f;
  static_cast<void>(tick());
  mts::Pilot pilot;
  constexpr mts::ControlLine stands = {"stand", nullptr, 0};
  pilot.choose(&stands, roads.road());
  static_cast<void>(pilot.step({}, 0.02f));
  mts::Lookout<route1::Knowledge> lookout({}, route1::landmarks());
  lookout.step(pilot, {.landmark = "LM5"}, 0.02f);
  lookout.write(facts);
  if (!lookout.knows("LM5") || facts.Line != 0.0f || route1::find_road("LM5", "W") == nullptr) return false;
  return pilot.drives() && roads.road() != nullptr && mts::same_text(roads.road()->from, "LM5") && mts::task_along(roads, {}).pieces == 1 && mts::task_across(roads, {}).exit_heading_rad > 3.14f;
}

}  // namespace

int main() {
  if (!sees_and_brakes() || !parts_work() || !stands_at_first()) return 1;
  constexpr struct { float button, wall, speed; } kTicks[] = {
      {0.0f, -1.0f, 0.0f},  {0.9f, -1.0f, 0.4f}, {0.0f, -1.0f, 0.4f},
      {0.0f, 0.9f, -0.2f},  {0.0f, 0.2f, -0.2f}, {0.0f, -1.0f, -0.2f}, {0.0f, -1.0f, 0.4f},
  };
  bumper::Mind mind;
  bumper::Facts facts;
  Wheels wheels;
  for (const auto& now : kTicks) {
    facts.Button = now.button;
    facts.Wall = now.wall;
    const auto decision = mind.tick(facts, mts::milliseconds(500));
    bumper::drive(decision, wheels);
    std::printf("%llu %s %.1f m/s\n", static_cast<unsigned long long>(decision.tick()), mts::text(decision.status()),
                static_cast<double>(wheels.speed_m_per_s));
    if (wheels.speed_m_per_s != now.speed) return 1;
  }
  return knows_its_roads() ? 0 : 1;
}
