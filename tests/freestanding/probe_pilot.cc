// Uses the pilot and the lookout, so that they are compiled without a standard library. They need more stack than a controller by itself.
#include <waymark/controllers/lookout.h>

#include "paper.kb.h"

namespace {

constexpr mts::FactRun kLandmarks[] = {{static_cast<std::uint32_t>(route1::Fact::LM5), 1}};
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

extern "C" float freestanding_probe_lookout(route1::Facts* facts, const char* landmark, float dt_s) {
  mts::Lookout<route1::Knowledge> lookout(mts::Body{}, {kLandmarks, 1});
  lookout.keep_place(lookout.knows(landmark));
  lookout.step(pilot, {.landmark = landmark, .exit = "W", .closed = "N E"}, dt_s);
  lookout.write(*facts);
  return facts->Line;
}
