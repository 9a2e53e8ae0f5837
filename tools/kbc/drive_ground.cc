#include "tools/kbc/drive_ground.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "tools/kbc/checks.h"

namespace kb::cli {

using diagnostics::Kind;

void add_ground_options(CLI::App& app, GroundOptions& options) {
  app.add_option("FILE", options.file, "The knowledge base")->required();
  app.add_option("--scale", options.scale, "Metres on the floor for a metre of the map (as many as its shortest road needs)")->type_name("FACTOR")->check(CLI::PositiveNumber);
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
  ground->labyrinth = sim::lay_out(compiled.model, {options.scale, ground->background ? &ground->background->grid : nullptr}, messages);
  ground->knowledge = sim::prepare(compiled.model, compiled.program, compiled.tables, messages);
  return ground->labyrinth && ground->knowledge ? std::move(ground) : nullptr;
}

std::optional<sim::Scenario> DriveGround::scenario(const std::string& path, Session& session, diagnostics::Diagnostics& messages) {
  if (path.empty()) return sim::plain_scenario(*labyrinth, *knowledge, compiled->model, messages);
  const auto file = planners::open_file(path, session.files(), compiled->sources, messages);
  if (!file) return std::nullopt;
  return sim::read_scenario(*file, *labyrinth, *knowledge, compiled->model, messages);
}

}  // namespace kb::cli
