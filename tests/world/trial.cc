#include "tests/world/trial.h"

#include <fmt/format.h>

namespace kb::world {
namespace {

constexpr double kStartBefore_m = 1.2;
constexpr int kTicksAfterTheEnd = 5;

World world_of(const Knowledge& knowledge, const WorldOptions& options) {
  World world;
  world.map = map_of(knowledge.model(), options.length_m);
  world.arrival_seen = options.arrival_seen;
  world.memory_read = options.memory_read;
  return world;
}

void record(Recording& recording, const Knowledge& knowledge, Simulation& sim,
            std::shared_ptr<const Knowledge> owner) {
  recording = Recording{std::move(owner), {}, {}};
  sim.observer = [&recording, &knowledge](std::span<const float> facts, std::uint32_t, const program::Tick& tick) {
    recording.rows.push_back({tick.time_us, {facts.begin(), facts.begin() + knowledge.program().facts}});
    recording.ticks.push_back(tick);
  };
}

}  // namespace

Trial::Trial(const Setting& setting, std::string_view text, WorldOptions options)
    : knowledge_(Knowledge::cached(fmt::format("import std.navigation\n{}", text))),
      mind_(make_mind(setting.mind, *knowledge_)),
      sim_(std::make_unique<Simulation>(*knowledge_, *mind_, world_of(*knowledge_, options))) {
  if (setting.recording) record(*setting.recording, *knowledge_, *sim_, knowledge_);
}

Trial& Trial::at(std::string_view edge) { return at(edge, road(edge).length_m - kStartBefore_m); }

Trial& Trial::at(std::string_view edge, double s_m) {
  world().put(world().map.edge(edge), s_m);
  return *this;
}

Trial& Trial::disturb(Simulation::Disturbance disturbance) {
  sim_->disturbances.push_back(std::move(disturbance));
  return *this;
}

bool Trial::go(int ticks, const Simulation::Until& until, std::string_view command) {
  sim_->tick();
  sim_->press(command);
  return sim_->run(ticks, until);
}

void Trial::wait(int ticks) {
  for (int i = 0; i < ticks; ++i) sim_->tick();
}

void Trial::block(std::string_view edge, double at_m, bool passable) {
  road(edge).obstacles.push_back({at_m, world().map.edge(edge), passable});
}

Finding Trial::drove(std::string_view way) {
  wait(kTicksAfterTheEnd);
  const std::string driven = world().way_text();
  const bool at_last_sign = world().on_road() && world().to_end_m() <= kSignBefore + 0.06;
  const std::string left = left_over();
  return all_of({
      expect(driven == way, fmt::format("drove `{}`, not `{}`", driven, way)),
      expect(sim_->ended(), "did not end"),
      accident(),
      expect(sim_->conflicts() == 0, "rules contradicted each other"),
      expect(sim_->overlaps() == 0, "two strategies at once"),
      sim_->broken_promise(),
      expect(sim_->strategy().empty(), fmt::format("drives on after the end ({})", sim_->strategy())),
      expect(at_last_sign, fmt::format("ended at {}, not at the last sign", world().where())),
      expect(left.empty(), fmt::format("left over: {}", left)),
  });
}

std::string Trial::left_over() const {
  std::string left;
  const program::Program& program = knowledge_->program();
  for (std::size_t i = program.facts; i < program.first_strategy(); ++i) {
    if (mind_->value(static_cast<program::CellId>(i)) == program.cells[i].initial) continue;
    if (!left.empty()) left += ", ";
    left += program.cells[i].name;
  }
  return left;
}

Finding Trial::accident() const {
  const auto& faults = sim_->world.faults;
  return faults.empty() ? Finding{} : fmt::format("{} (at {} ms)", faults.front().what, faults.front().time_ms);
}

Finding expect(bool holds, std::string_view otherwise) { return holds ? Finding{} : Finding(otherwise); }

Finding all_of(std::initializer_list<Finding> findings) {
  Finding joined;
  for (const Finding& finding : findings) {
    if (finding.empty()) continue;
    if (!joined.empty()) joined += "; ";
    joined += finding;
  }
  return joined;
}

const std::string& labyrinth() {
  static const std::string text = project_file("examples/01_route1/labyrinth.kb");
  return text;
}

Trial route1(const Setting& setting, std::string_view extra, WorldOptions options) {
  Trial trial(setting, fmt::format("{}{}{}", labyrinth(), kRoute1, extra), options);
  trial.at("LM1.S");
  return trial;
}

std::string labyrinth_route(std::string_view stops) {
  return fmt::format("{}command Go\nroute R on Labyrinth by Go: {}\n", labyrinth(), stops);
}

}  // namespace kb::world
