// The program of the robot: what its sensors say in, the motion of its wheels out.
//
// Without a robot at hand it rehearses the first seconds of the mission, and prints what the wheels would be told.
#include <cstdint>
#include <cstdio>

#include <waymark/controllers/pilot.h>

#include "@NAME@.kb.map.h"

namespace {

// In place of sensors: the facts that the mind decides by, each with how certain it is (1 surely so, -1 surely not, 0 nothing known), and
// the readings that the controllers drive by.
void sense(int tick, @NAME@::Facts& facts, mts::Senses& senses) {
  const bool sign = tick >= 7 && tick < 12;          // the dock's sign is in view
  const bool line = tick >= 10 && tick < 12;         // its stop line is under the robot
  facts.Fetch = tick == 2 ? 1.0f : 0.0f;             // the button is pressed for a moment
  facts.Track.mark = 0.9f;                           // the painted line can be followed
  facts.Dock = sign ? 0.9f : 0.0f;
  facts.In.S = sign ? 0.8f : 0.0f;                   // it comes from the south
  facts.CrossBy.mark = sign ? 0.9f : 0.0f;           // the crossing has a painted line too
  facts.Safe = sign ? 0.9f : 0.0f;
  facts.Line = line ? 0.9f : 0.0f;

  for (float& darkness : senses.line) darkness = line ? 1.0f : 0.0f;
  senses.line[2] = 1.0f;                             // the painted line is under the middle sensor
  for (float& range_m : senses.range_m) range_m = mts::kOutOfRange;   // nothing stands near
  senses.heading_rad = 0.5f * mts::kPi;              // it faces north
  senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = true;
}

// Whether all controllers that @NAME@.kb names are Waymark's, with parameters that this robot can have. To drive by functions of your own, see
// `@NAME@::drive` in the generated header.
bool can_drive(const mts::Pilot& pilot) {
  for (std::uint32_t i = 0; i < @NAME@::Knowledge::kShape.strategies; ++i) {
    const auto strategy = static_cast<@NAME@::Strategy>(i);
    const mts::ControlLine* line = @NAME@::control_line(strategy);
    if (line != nullptr && pilot.fits(*line) == mts::Setting::kSet) continue;
    std::printf("nothing can drive %s\n", @NAME@::name(strategy));
    return false;
  }
  return true;
}

}  // namespace

int main() {
  @NAME@::Mind mind;
  @NAME@::Facts facts;
  mts::Senses senses;
  mts::Pilot pilot{mts::Body{}};   // measure your robot: waymark/controllers/body.h
  if (!can_drive(pilot)) return 1;
  for (int tick = 0; tick < 14; ++tick) {
    sense(tick, facts, senses);
    const auto decision = mind.tick(facts, mts::milliseconds(200));
    pilot.choose(@NAME@::control_line(decision), @NAME@::road_of_leg(mind));
    mts::Motion wheels;
    for (int period = 0; period < 10; ++period) wheels = pilot.step(senses, 0.02f);
    std::printf("%4.1f s  %-20s %.2f m/s, %.0f deg/s\n", 0.2 * tick, decision.drives() ? @NAME@::name(decision.strategy()) : "-",
                static_cast<double>(wheels.speed_m_s), static_cast<double>(wheels.turn_rad_s / mts::kRadPerDeg));
  }
  return mind.decision().strategy() == @NAME@::Strategy::Cross_right_mark ? 0 : 1;
}
