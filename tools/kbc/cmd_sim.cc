// kbc sim: a knowledge base drives a robot through its own map.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>

#include "planners/maps/maps.h"
#include "sim/drive/drive.h"
#include "sim/scenario/scenario.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/stream.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct Options {
  std::string file, scenario, background, trace, dt;
  std::optional<double> scale;
  std::optional<std::uint64_t> seed;
};

std::string print_summary(const sim::Summary& summary, double scale) {
  std::string out = fmt::format("{}\n", sim::describe(summary));
  out += fmt::format("  time        {:.1f} s\n  length      {:.2f} m\n  way        ", summary.time_s, summary.length_m);
  for (const std::string& exit : summary.way) out += " " + exit;
  out += fmt::format("\n  collisions  {}\n", summary.collisions.size());
  for (const auto& hit : summary.collisions) {
    out += fmt::format("    {:.1f} s: {} at ({:.2f}, {:.2f})\n", hit.t_s, hit.what, hit.at.x_m / scale, hit.at.y_m / scale);
  }
  for (const std::string& fault : summary.faults) out += fmt::format("  fault       {}\n", fault);
  out += fmt::format("  lost without knowing it: {}\n", summary.lost_unaware() ? fmt::format("yes, for {:.1f} s", summary.unaware_s) : "no");
  return out;
}

std::optional<sim::Scenario> read_scenario(const Options& options, const sim::Labyrinth& labyrinth, const sim::Knowledge& knowledge,
                                           driver::Compilation& compiled, Session& session, diagnostics::Diagnostics& messages) {
  if (options.scenario.empty()) return sim::plain_scenario(labyrinth, knowledge, compiled.model, messages);
  const auto file = planners::open_file(options.scenario, session.files(), compiled.sources, messages);
  if (!file) return std::nullopt;
  return sim::read_scenario(*file, labyrinth, knowledge, compiled.model, messages);
}

int run(const Options& options, Session& session) {
  const auto compiled = session.compile(options.file, driver::Stage::kTables);
  if (!compiled->ok()) return kErrors;
  auto messages = session.diagnostics(compiled->sources);
  std::optional<planners::MapFile> background;
  if (!options.background.empty()) {
    background = planners::read_map(options.background, session.files(), compiled->sources, messages);
    if (!background) return kErrors;
  }
  const auto labyrinth = sim::lay_out(compiled->model, {options.scale, background ? &background->grid : nullptr}, messages);
  const auto knowledge = sim::prepare(compiled->model, compiled->program, compiled->tables, messages);
  if (!labyrinth || !knowledge) return kErrors;
  auto scenario = read_scenario(options, *labyrinth, *knowledge, *compiled, session, messages);
  if (!scenario) return kErrors;
  if (options.seed) scenario->seed = *options.seed;

  trace::OutputFile trace;
  if (!options.trace.empty() && !trace.open(options.trace)) {
    messages.report(Kind::kCannotWrite, {}, {options.trace, trace.error()});
    return kErrors;
  }
  sim::DriveOptions how;
  if (!options.dt.empty()) how.dt_us = *trace::parse_duration(options.dt);
  if (!options.trace.empty()) {
    how.on_tick = [&](const program::Tick& tick) {
      trace.write(print_json(compiled->program, tick));
      trace.write("\n");
    };
  }
  sim::Drive drive(*labyrinth, *knowledge, *scenario, how);
  const sim::Summary& summary = drive.run();
  if (!options.trace.empty() && !trace.commit()) {
    messages.report(Kind::kCannotWrite, {}, {options.trace, trace.error()});
    return kErrors;
  }
  if (options.trace != "-") session.print(print_summary(summary, labyrinth->scale));
  return session.exit_code();
}

}  // namespace

Run setup_sim(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("FILE", options->file, "The knowledge base")->required();
  app.add_option("--scenario", options->scenario, "What happens, TOML; without it nothing goes wrong");
  app.add_option("--trace", options->trace, "Write the trace to this file, JSON lines; - for standard output");
  app.add_option("--scale", options->scale, "Metres on the floor for a metre of the map (as many as its shortest road needs)");
  app.add_option("--background", options->background, "Walls of a building: the .yaml of a ROS map, in metres of the floor");
  app.add_option("--seed", options->seed, "Of all noise; goes before the scenario's");
  app.add_option("--dt", options->dt, "How long a tick of the mind is (100ms)")->check(is_duration());
  return [options](Session& session) { return run(*options, session); };
}

}  // namespace kb::cli
