#include "tools/kbc/drive_ground.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <set>

#include "compiler/model/standard_names.h"
#include "sim/batch/batch.h"
#include "sim/drive/helm.h"
#include "sim/mind/control_words.h"
#include "tools/kbc/checks.h"

namespace kb::cli {

using diagnostics::Kind;

void add_ground_options(CLI::App& app, GroundOptions& options) {
  app.add_option("FILE", options.file, "The knowledge base")->required();
  app.add_option("--scale", options.scale, "Metres on the floor for a metre of the map (as many as its shortest road needs)")->type_name("FACTOR")->check(is_factor());
  app.add_option("--background", options.background, "Walls of a building: the .yaml of a ROS map, in metres of the floor")->type_name("FILE");
  app.add_option("--stub", options.stub, "The robot stands while this controller would drive, which only the program on the robot has; may be given often")
      ->type_name("CONTROLLER")
      ->allow_extra_args(false);
  app.add_option("--dt", options.dt, "How long a tick of the mind is (100ms)")->type_name("TIME")->check(is_duration());
  add_set_option(app, options.set);
}

void add_set_option(CLI::App& app, std::vector<std::string>& set) {
  app.add_option("--set", set, "Override a value of the scenario, such as sensors.range.noise=0.1; may be given often")
      ->check(is_sweep())->type_name("KEY=VALUE,...")->allow_extra_args(false);
}

std::optional<sim::Combinations> combinations(const std::vector<std::string>& set,
                                              const std::function<std::string(std::string_view key)>& refused, Session& session) {
  constexpr std::size_t kMost = 1000;   // each value has a floor of its own
  std::vector<sim::Sweep> sweeps;
  std::size_t count = 1;
  for (const std::string& text : set) {
    std::string why;
    sim::Sweep sweep = sim::read_sweep(text, why).value();   // checked when the command line was read
    why = refused(sweep.key);
    const bool twice = std::any_of(sweeps.begin(), sweeps.end(), [&](const sim::Sweep& other) { return other.key == sweep.key; });
    count *= sweep.values.size();
    if (!why.empty()) session.report(Kind::kSimSetNot, {sweep.key, why});
    else if (twice) session.report(Kind::kSimSetTwice, {sweep.key});
    else if (count > kMost) session.report(Kind::kSimSetLarge, {fmt::format("{}", kMost)});
    if (!why.empty() || twice || count > kMost) return std::nullopt;
    sweeps.push_back(std::move(sweep));
  }
  return sim::rows_of(sweeps);
}

std::optional<std::vector<sim::Setting>> one_setting(const std::vector<std::string>& set, Session& session) {
  const auto rows = combinations(set, [](std::string_view) { return std::string(); }, session);
  if (!rows) return std::nullopt;
  for (std::size_t i = 0; i < rows->front().size(); ++i) {
    std::set<std::string_view> values;
    for (const auto& row : *rows) values.insert(row[i].value);
    if (values.size() == 1) continue;
    session.report(Kind::kSimSetMany, {rows->front()[i].key, fmt::format("{}", values.size())});
    return std::nullopt;
  }
  return rows->front();
}

bool are_few_enough(std::uint64_t count, std::string_view what, std::uint64_t each, Session& session) {
  if (count <= sim::batch::kMostRuns / each) return true;
  session.report(Kind::kFleetTooMany, {fmt::format("{}", count), what, fmt::format("{}", each), fmt::format("{}", sim::batch::kMostRuns)});
  return false;
}

std::unique_ptr<DriveGround> prepare_ground(const GroundOptions& options, Session& session) {
  return prepare_ground(options, session.compile(options.file, driver::Stage::kTables), session);
}

std::unique_ptr<DriveGround> prepare_ground(const GroundOptions& options, std::unique_ptr<driver::Compilation> made, Session& session) {
  auto ground = std::make_unique<DriveGround>();
  ground->compiled = std::move(made);
  driver::Compilation& compiled = *ground->compiled;
  if (!compiled.ok()) return nullptr;
  auto messages = session.diagnostics(compiled.sources);
  if (!options.dt.empty()) ground->dt_us = *trace::parse_duration(options.dt);
  if (ground->dt_us % sim::kStepUs != 0 || ground->dt_us > 1'000'000) {
    messages.report(Kind::kSimTick, {}, {fmt::format("{:g}", ground->dt_us / 1000.0)});
    return nullptr;
  }
  if (!options.background.empty()) {
    ground->background = planners::read_map(options.background, session.files(), compiled.sources, messages);
    if (!ground->background) return nullptr;
  }
  ground->scale = options.scale;
  ground->stub = options.stub;
  return ground;
}

std::unique_ptr<sim::Labyrinth> DriveGround::floor(const std::string& path, Script& script, Session& session, diagnostics::Diagnostics& messages) {
  sim::LayoutOptions layout{scale, background ? &background->grid : nullptr, {}};
  if (path.empty() && !script.settings.empty()) script.file = compiled->sources.add("no scenario", "");
  if (!path.empty()) {
    script.file = diagnostics::open_file(path, session.files(), compiled->sources, messages);
    if (!script.file) return nullptr;
  }
  if (script.file) {
    auto build = sim::read_floor(*script.file, script.settings, messages);
    if (!build) return nullptr;
    layout.build = std::move(*build);
  }
  auto floor = sim::lay_out(compiled->model, layout, messages);
  if (!floor && compiled->model.maps.empty()) return nullptr;   // without a map, the controllers are not the simulator's either
  model::StandardNames library(session.library(), session.files());
  const bool first = !knowledge;
  if (first) knowledge = sim::prepare(compiled->model, compiled->program, compiled->tables, messages, &library, &stub);
  if (!floor || !knowledge) return nullptr;
  if (first) sim::check_halls(*knowledge, *floor, messages);
  return std::make_unique<sim::Labyrinth>(std::move(*floor));
}

std::optional<Scene> DriveGround::scene(const std::string& path, const std::vector<sim::Setting>& settings, Session& session,
                                        diagnostics::Diagnostics& messages, sim::MissionsBy by) {
  Script script{sim::add_settings(settings, compiled->sources), std::nullopt};
  const bool first = !knowledge;
  auto labyrinth = floor(path, script, session, messages);
  if (first && knowledge) sim::report_lacking_sensors(*knowledge, messages);
  if (!labyrinth) return std::nullopt;
  auto scenario = script.file ? sim::read_scenario(*script.file, script.settings, *labyrinth, *knowledge, compiled->model, messages, by)
                              : sim::plain_scenario(*labyrinth, *knowledge, compiled->model, messages, by);
  if (!scenario || !sim::check_settings(*knowledge, scenario->body, messages)) return std::nullopt;
  return Scene{std::move(labyrinth), std::move(*scenario)};
}

std::optional<Scene> DriveGround::robot(const std::string& path, const std::vector<sim::Setting>& settings, Session& session,
                                        diagnostics::Diagnostics& messages) {
  Script script{sim::add_settings(settings, compiled->sources), std::nullopt};
  auto labyrinth = floor(path, script, session, messages);
  if (!labyrinth) return std::nullopt;
  auto robot = script.file ? sim::read_robot(*script.file, script.settings, *labyrinth, *knowledge, messages) : sim::Scenario{};
  if (!robot || !sim::check_settings(*knowledge, robot->body, messages)) return std::nullopt;
  return Scene{std::move(labyrinth), std::move(*robot)};
}

}  // namespace kb::cli
