// Uses the pilot, so that it is compiled without a standard library. It needs more stack than a controller by itself.
#include <waymark/controllers/pilot.h>

namespace {

mts::Pilot pilot;

}  // namespace

extern "C" int freestanding_probe_pilot(const mts::Senses* senses, const mts::Piece* course, const char* name, float value) {
  const mts::ControlArgument argument{"speed", "", value, "m/s"};
  const mts::ControlLine line{name, &argument, 1};
  const mts::MapRoad road{"", "", "", "", name, value, course, 1};
  if (pilot.fits(line) != mts::Setting::kSet) return -1;
  pilot.put(road, value);
  pilot.choose(&line, &road, value);
  const mts::Motion motion = pilot.step(*senses, 0.01f);
  pilot.leave_crossing();
  pilot.forget_place();
  return static_cast<int>(motion.speed_m_s + motion.turn_rad_s) + (pilot.done() || pilot.lost() || pilot.plight() != mts::Plight::kNone);
}
