// Uses every controller, so that all of them are compiled without a standard library.
#include <waymark/controllers/any_controller.h>
#include <waymark/controllers/road_map.h>
#include <waymark/controllers/similarity.h>
#include <waymark/controllers/steady_ranges.h>

namespace {

mts::AnyController controller;
mts::SteadyRanges steady;

[[gnu::noinline]] void start(const mts::Similarity& as, const mts::Task& task, const mts::Senses& small) { controller.start(as.in(task), small); }

[[gnu::noinline]] mts::Task along(const mts::Task& task, const char* by, float limit_m_s) {
  mts::RoadsDriven roads;
  const mts::MapRoad road{"", "", "", "", by, limit_m_s, task.course, task.pieces};
  roads.follow(&road);
  return mts::task_along(roads, {});
}

}  // namespace

extern "C" int freestanding_probe_controllers(const mts::Senses* senses, const mts::Task* task, const char* name, float value) {
  const mts::ControllerEntry* entry = mts::find_controller(name);
  if (entry == nullptr) return -1;
  const mts::Similarity as(value);
  controller.choose(entry->id, as.in(as.out(mts::Body{})));
  const mts::Parameter* side = mts::find_parameter(entry->id, "side");
  if (side != nullptr) static_cast<void>(controller.set("side", mts::number_of_word(*side, "left")));
  const mts::Setting setting = controller.set("speed", value);
  const mts::Senses small = as.in(*senses);
  start(as, value > 1.0f ? *task : along(*task, name, value), small);
  const mts::Motion motion = as.out(controller.step(steady.step(small, 0.01f), as.in(0.01f, "s")));
  return static_cast<int>(motion.speed_m_s + motion.turn_rad_s) + static_cast<int>(setting) + (controller.done() || controller.lost());
}
