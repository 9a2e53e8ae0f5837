// The program of the robot: what its sensors say in, the motion of its wheels out.
//
// Without a robot at hand it rehearses the first seconds of the mission: a robot that has no floor but the road to the dock, and goes where
// its wheels are told.
#include <cstdint>
#include <cstdio>

#include <waymark/controllers/lookout.h>

#include "@NAME@.kb.map.h"

namespace {

constexpr float kPeriod_s = 0.02f;   // the wheels are told fifty times a second
constexpr int kTick = 5;             // the mind decides on each fifth

// In place of sensors: what they read on a road to the north, `driven_m` from where the robot was put.
void sense(float driven_m, const mts::Motion& wheels, mts::Senses& senses, mts::Sign& sign) {
  const bool line = driven_m >= 1.0f && driven_m < 1.05f;             // the dock's stop line is under the row of line sensors
  for (float& darkness : senses.line) darkness = line ? 1.0f : 0.0f;
  senses.line[2] = 1.0f;                                             // the painted line is under the middle one
  for (float& range_m : senses.range_m) range_m = mts::kOutOfRange;   // nothing stands near
  senses.heading_rad = 0.5f * mts::kPi;                              // it faces north
  senses.speed_m_s = wheels.speed_m_s;
  senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = true;
  const bool reads = driven_m >= 0.6f && driven_m < 0.8f;             // its sign is under the reader
  sign = {.landmark = reads ? "Dock" : nullptr, .exit = "S"};         // it lies on the road to the south of the dock
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
  constexpr mts::Body body;   // measure your robot: waymark/controllers/body.h
  @NAME@::Mind mind;
  @NAME@::Facts facts;
  mts::Pilot pilot(body);
  mts::Lookout<@NAME@::Knowledge> lookout(body, @NAME@::landmarks(), @NAME@::find_road);
  if (!can_drive(pilot)) return 1;
  mts::Senses senses;
  mts::Sign sign;
  mts::Motion wheels;
  float driven_m = 0.0f;
  const char* drove = "";
  for (int period = 0; period < 300; ++period) {
    sense(driven_m, wheels, senses, sign);
    if (period % kTick == 0) {
      lookout.write(facts);                          // what was perceived since the last tick
      facts.Fetch = period == 25 ? 1.0f : 0.0f;      // the button is pressed for a moment
      const auto decision = mind.tick(facts, mts::milliseconds(100));
      pilot.choose(@NAME@::control_line(decision), @NAME@::road_of_leg(mind));
      const char* drives = decision.drives() ? @NAME@::name(decision.strategy()) : "-";
      if (drives != drove) std::printf("%4.1f s  %.2f m  %s\n", static_cast<double>(kPeriod_s) * period, static_cast<double>(driven_m), drives);
      drove = drives;
    }
    wheels = pilot.step(senses, kPeriod_s);
    lookout.step(pilot, sign, kPeriod_s);
    driven_m += kPeriod_s * wheels.speed_m_s;
  }
  return mind.decision().strategy() == @NAME@::Strategy::Cross_right_mark ? 0 : 1;
}
