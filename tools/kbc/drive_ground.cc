#include "tools/kbc/drive_ground.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "tools/kbc/checks.h"

namespace kb::cli {

using diagnostics::Kind;

void add_ground_options(CLI::App& app, GroundOptions& options) {
  app.add_option("FILE", options.file, "The knowledge base")->required();
  app.add_option("--scale", options.scale, "Metres on the floor for a metre of the map (as many as its shortest road needs)")->type_name("FACTOR")->check(is_factor());
  app.add_option("--background", options.background, "Walls of a building: the .yaml of a ROS map, in metres of the floor")->type_name("FILE");
  app.add_option("--dt", options.dt, "How long a tick of the mind is (100ms)")->type_name("TIME")->check(is_duration());
}

std::unique_ptr<DriveGround> prepare_ground(const GroundOptions& options, Session& session) {
  auto ground = std::make_unique<DriveGround>();
  ground->compiled = session.compile(options.file, driver::Stage::kTables);
  driver::Compilation& compiled = *ground->compiled;
  if (!compiled.ok()) return nullptr;
  auto messages = session.diagnostics(compiled.sources);
  if (!options.dt.empty()) ground->dt_us = *trace::parse_duration(options.dt);
  if (ground->dt_us % 10'000 != 0 || ground->dt_us > 1'000'000) {
    messages.report(Kind::kSimTick, {}, {fmt::format("{:g}", ground->dt_us / 1000.0)});
    return nullptr;
  }
  if (!options.background.empty()) {
    ground->background = planners::read_map(options.background, session.files(), compiled.sources, messages);
    if (!ground->background) return nullptr;
  }
  ground->scale = options.scale;
  return ground;
}

std::optional<Scene> DriveGround::scene(const std::string& path, Session& session, diagnostics::Diagnostics& messages) {
  std::optional<source::FileId> script;
  sim::LayoutOptions layout{scale, background ? &background->grid : nullptr, {}};
  if (!path.empty()) {
    script = planners::open_file(path, session.files(), compiled->sources, messages);
    auto halls = script ? sim::read_halls(*script, messages) : std::nullopt;
    if (!halls) return std::nullopt;
    layout.halls = std::move(*halls);
  }
  auto floor = sim::lay_out(compiled->model, layout, messages);
  if (!floor && compiled->model.maps.empty()) return std::nullopt;   // nor are its controllers the simulator's
  if (!knowledge) knowledge = sim::prepare(compiled->model, compiled->program, compiled->tables, messages);
  if (!floor || !knowledge) return std::nullopt;
  auto labyrinth = std::make_unique<sim::Labyrinth>(std::move(*floor));
  auto scenario = script ? sim::read_scenario(*script, *labyrinth, *knowledge, compiled->model, messages)
                         : sim::plain_scenario(*labyrinth, *knowledge, compiled->model, messages);
  if (!scenario) return std::nullopt;
  return Scene{std::move(labyrinth), std::move(*scenario)};
}

}  // namespace kb::cli
