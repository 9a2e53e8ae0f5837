// Uses every controller, so that all of them are compiled without a standard library.
#include <waymark/controllers/any_controller.h>
#include <waymark/controllers/steady_ranges.h>

namespace {

mts::AnyController controller;
mts::SteadyRanges steady;

}  // namespace

extern "C" int freestanding_probe_controllers(const mts::Senses* senses, const mts::Task* task, const char* name, float value) {
  const mts::ControllerEntry* entry = mts::find_controller(name);
  if (entry == nullptr) return -1;
  controller.choose(entry->id);
  const mts::Parameter* side = mts::find_parameter(entry->id, "side");
  if (side != nullptr) static_cast<void>(controller.set("side", mts::number_of_word(*side, "left")));
  const mts::Setting setting = controller.set("speed", value);
  controller.start(*task, *senses);
  const mts::Motion motion = controller.step(steady.step(*senses, 0.01f), 0.01f);
  return static_cast<int>(motion.speed_m_s + motion.turn_rad_s) + static_cast<int>(setting) + (controller.done() || controller.lost());
}
