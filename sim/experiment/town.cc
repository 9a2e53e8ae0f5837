#include "sim/experiment/town.h"

#include <fmt/format.h>

#include <stdexcept>

#include "compiler/diagnostics/consumers.h"
#include "sim/mind/control_words.h"

namespace kb::sim::experiment {
namespace {

constexpr std::string_view kMission = "mission.kb";

std::unique_ptr<driver::Compilation> compile(const std::string& text, const std::string& library, const source::FileSystem& files) {
  driver::Options options;
  options.library = library;
  options.analyse = false;
  std::string said;
  // The knowledge base comes from memory; its imports are read from their files.
  auto compiled = driver::compile(kMission, source::OneFileMore(kMission, text, files), options, diagnostics::ErrorLines::make, &said);
  if (!compiled->ok()) throw std::runtime_error(fmt::format("{}\n{}", said, text));
  return compiled;
}

/// `scale`: that of the floor for a robot of size 1, if it is known already.
Labyrinth laid_out(const driver::Compilation& compiled, const FloorBuild& build = {}, std::optional<double> scale = {}) {
  std::string said;
  diagnostics::ErrorLines listener(compiled.sources, said);
  diagnostics::Diagnostics messages(compiled.sources, listener);
  LayoutOptions options;
  options.build = build;
  if (scale) options.scale = *scale * build.size;
  auto labyrinth = lay_out(compiled.model, options, messages);
  if (!labyrinth) throw std::runtime_error(said);
  return std::move(*labyrinth);
}

std::string controls(float size) {
  const auto own = [as = mts::Similarity(size)](double value, const char* unit) { return fmt::format("{:.4g} {}", value * static_cast<double>(as.of(unit)), unit); };
  return fmt::format(R"(
control Move.mark         = follow_line(speed: {})
control Move.dist         = keep_wall(distance: {}, speed: {})
control Move.azimuth      = hold_heading(speed: {})
control Cross[t, mark]    = turn_on_line(turn: t)
control Cross[t, dist]    = turn_by_walls(turn: t)
control Cross[t, azimuth] = turn_by_compass(turn: t)
control Avoid             = round_obstacle(side: both, distance: {}, speed: {})
control Search            = look_round()
control Round             = turn_round()
control Stop              = stand()
)", own(kMarkSpeed, "m/s"), own(0.3, "m"), own(kOtherSpeed, "m/s"), own(kOtherSpeed, "m/s"), own(0.2, "m"), own(0.2, "m/s"));
}

}  // namespace

std::string mission_text(const Sketch& sketch, const Labyrinth& labyrinth, const RoutePlan& route, const std::string& mind, float size) {
  std::string stops;
  for (std::size_t i = 0; i < route.exits.size(); ++i) {
    stops += fmt::format("{}.{} -> ", labyrinth[route.crossings[i]].name, route.exits[i]->name);
  }
  const std::string rules = mind.empty() ? std::string(kRules) : "import \"" + mind + "\"\n";
  return fmt::format("{}\n# {}\n{}\ncommand Go\n\nroute Way on Town by Go:\n    {}{}\n{}{}", rules, sketch.origin, print(sketch), stops,
                     labyrinth[route.crossings.back()].name, mind.empty() ? "\ndetours on Way when Closed[exit]\n" : "", mind.empty() ? controls(size) : "");
}

Labyrinth floor_of(const Sketch& sketch, const std::string& library, const source::FileSystem& files) {
  return laid_out(*compile("import std.navigation\n" + print(sketch), library, files));
}

Town::Town(const std::string& text, const std::string& library, const source::FileSystem& files)
    : compiled_(compile(text, library, files)), labyrinth_(laid_out(*compiled_)) {
  std::string said;
  diagnostics::ErrorLines listener(compiled_->sources, said);
  diagnostics::Diagnostics messages(compiled_->sources, listener);
  knowledge_ = prepare(compiled_->model, compiled_->program, compiled_->tables, messages);
  if (!knowledge_) throw std::runtime_error(said);
}

Scenario Town::scenario(const std::string& toml, const std::vector<Setting>& settings) {
  std::string said;
  diagnostics::ErrorLines listener(compiled_->sources, said);
  diagnostics::Diagnostics messages(compiled_->sources, listener);
  const auto set = add_settings(settings, compiled_->sources);
  const source::FileId script = compiled_->sources.add("scenario.toml", toml);
  const auto floor = read_floor(script, set, messages);
  if (floor && (floor->widths != labyrinth_->widths || floor->size != labyrinth_->size)) labyrinth_ = laid_out(*compiled_, *floor, labyrinth_->scale / labyrinth_->size);
  auto scenario = floor ? read_scenario(script, set, *labyrinth_, *knowledge_, compiled_->model, messages) : std::nullopt;
  if (!scenario || !check_settings(*knowledge_, scenario->body, messages)) throw std::runtime_error(fmt::format("{}\n{}", said, toml));
  return std::move(*scenario);
}

}  // namespace kb::sim::experiment
