// kbc sim: a knowledge base drives a robot through its own map.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/drive/drive.h"
#include "sim/report/report.h"
#include "sim/scenario/scenario.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/drive_ground.h"
#include "tools/kbc/drive_log.h"
#include "tools/kbc/drive_verdict.h"
#include "tools/kbc/expected_ending.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/live_drive.h"
#include "tools/kbc/named_files.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/wire/line_channel.h"
#include "tools/kbc/wire/remote_helm.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct SimOptions {
  GroundOptions ground;
  std::string scenario;
  std::optional<std::string> expect;
  std::vector<std::string> allow;
  std::string summary, trace, facts, html, svg, perfetto, csv;
  std::optional<std::uint64_t> seed;
  std::optional<std::uint16_t> live;
  std::optional<double> speed;   // seconds of the drive for one second of the clock; nothing: as fast as possible, with a live page 1
  std::optional<std::string> driver;
  std::string driver_timeout = "10s";

  [[nodiscard]] bool reports() const {
    return live || !facts.empty() || !html.empty() || !svg.empty() || !perfetto.empty() || !csv.empty();
  }
  [[nodiscard]] bool to_stdout() const {
    const auto outputs = {&summary, &trace, &facts, &html, &svg, &perfetto, &csv};
    return std::ranges::any_of(outputs, [](const std::string* path) { return is_standard_output(*path); });
  }
};

/// False (reported) if one was not written.
bool write_reports(const SimOptions& options, const sim::Recording& recording, const std::string& summary, Session& session) {
  std::vector<Session::OutputFile> files;
  if (!options.summary.empty()) files.push_back({options.summary, summary});
  const auto add = [&](const std::string& path, std::string (*make)(const sim::Recording&)) {
    if (!path.empty()) files.push_back({path, make(recording)});
  };
  if (!options.facts.empty()) {
    const std::string comment = options.facts != "-" ? knowledge_comment(options.facts, options.ground.file) : std::string();
    files.push_back({options.facts, comment + sim::report::facts(recording)});
  }
  add(options.html, sim::report::html);
  add(options.svg, sim::report::svg);
  add(options.perfetto, sim::report::chrome_trace);
  add(options.csv, sim::report::csv);
  return session.write_each(files);
}

/// Starts the program that --driver names. Null (reported) if it cannot be started.
std::unique_ptr<wire::RemoteHelm> start_driver(const SimOptions& options, const DriveGround& ground, trace::OutputFile& trace, diagnostics::Diagnostics& messages) {
  if (ground.dt_us % sim::kControlUs != 0) {
    messages.report(Kind::kDriverTick, {}, {fmt::format("{:g}", ground.dt_us / 1000.0)});
    return nullptr;
  }
  wire::RemoteOptions how{*options.driver, ground.dt_us, static_cast<int>((*trace::parse_duration(options.driver_timeout) + 999) / 1000)};
  if (!options.trace.empty()) {
    how.on_mind = [&trace](std::string_view tick) {
      trace.write(tick);
      trace.write("\n");
    };
  }
  std::string error;
  auto process = wire::DriverProcess::start(how.command, Interrupts::came, error);
  if (process == nullptr) {
    messages.report(Kind::kDriverEnded, {}, {how.command, error, "0"});
    return nullptr;
  }
  return std::make_unique<wire::RemoteHelm>(std::move(process), *ground.knowledge, std::move(how));
}

/// A drive of a minute takes the simulator an instant, in which no master can send an order.
void hint_at_clock(const SimOptions& options, const sim::Summary& summary, Session& session) {
  if (options.speed || !options.driver || summary.outcome != sim::Summary::Outcome::kNeverStarted || options.driver->find("mqtt") == std::string::npos) return;
  session.remark("the driver seems to take orders from a broker, and they come by the clock; with `--speed 1` the drive keeps to it");
}

/// Drives to the end, or until an interrupt.
void drive_on(sim::Drive& drive, std::optional<double> speed, const Session& session) {
  Progress progress(session, "ticks");
  const auto began = std::chrono::steady_clock::now();
  while (!Interrupts::came() && drive.step()) {
    progress.update(drive.summary().ticks);
    if (speed) wait_until(began + std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(drive.time_s() / *speed)));
  }
}

/// Writes and prints how the drive ended; returns the exit code.
int tell_ending(const SimOptions& options, const Scene& scene, const sim::Summary& summary, const sim::Recording& recording, Session& session,
                diagnostics::Diagnostics& messages) {
  const double scale = scene.labyrinth->scale;
  const bool written = write_reports(options, recording, summary_json(summary, scale, scene.scenario.seed), session);
  if (!options.to_stdout()) session.print(print_summary(summary, scale, scene.scenario.limit_s));
  hint_at_clock(options, summary, session);
  if (options.expect) compare(summary, {*options.expect, options.allow}, messages);
  return written ? session.exit_code() : kErrors;
}

int drive(const SimOptions& options, const DriveGround& ground, const Scene& scene, Session& session, diagnostics::Diagnostics& messages) {
  const sim::Labyrinth& labyrinth = *scene.labyrinth;
  const Interrupts interrupts;   // before the trace is opened, so that an interrupt leaves no half of it behind
  trace::OutputFile trace;
  const bool traced = !options.trace.empty();
  if (traced && !session.open_output(trace, options.trace)) return kErrors;
  sim::Recording recording;
  recording.title = options.ground.file;
  sim::DriveOptions how;
  how.dt_us = ground.dt_us;
  if (options.reports()) how.recording = &recording;
  const wire::NoPipeSignal quiet;   // a driver that ends while something is sent to it is noticed when its next answer is read
  std::unique_ptr<wire::RemoteHelm> helm;
  if (options.driver) {
    helm = start_driver(options, ground, trace, messages);
    if (helm == nullptr) return kErrors;
    how.helm = helm.get();
  } else if (traced) {
    how.on_tick = [&](const program::Tick& tick) {
      trace.write(print_json(ground.compiled->program, tick));
      trace.write("\n");
    };
  }
  sim::Drive drive(labyrinth, *ground.knowledge, scene.scenario, how);
  const auto conclude = [&]() -> int {
    if (helm != nullptr && helm->failure()) wire::report(*helm->failure(), {}, messages);
    helm.reset();   // the driver ends before anything is written
    if (traced && !trace.commit()) messages.report(Kind::kCannotWrite, {}, {options.trace, trace.error()});
    return tell_ending(options, scene, drive.summary(), recording, session, messages);
  };
  if (options.live) {
    return drive_live(drive, recording, labyrinth, ground.compiled->program, {*options.live, options.speed.value_or(1.0), how.dt_us}, conclude, session);
  }
  drive_on(drive, options.speed, session);
  return Interrupts::came() ? kInterrupted : conclude();
}

int run(const SimOptions& options, Session& session) {
  const auto ground = prepare_ground(options.ground, session);
  if (!ground) return kErrors;
  auto messages = session.diagnostics(ground->compiled->sources);
  const auto set = one_setting(options.ground.set, session);
  if (!set) return kErrors;
  auto scene = ground->scene(options.scenario, *set, session, messages, options.driver ? sim::MissionsBy::kDriver : sim::MissionsBy::kRoutes);
  if (!scene) return kErrors;
  if (options.expect && !can_be_expected(*options.expect, *scene->labyrinth, *ground->knowledge, options.driver.has_value(), messages)) return kErrors;
  if (options.seed) scene->scenario.seed = *options.seed;
  for (const std::string& report : {options.summary, options.facts, options.html, options.svg, options.perfetto, options.csv}) {
    if (!session.may_write(report)) return kErrors;
  }
  return drive(options, *ground, *scene, session, messages);
}

}  // namespace

Run setup_sim(CLI::App& app) {
  auto options = std::make_shared<SimOptions>();
  add_ground_options(app, options->ground);
  app.add_option("--scenario", options->scenario, "What happens, TOML; without it nothing is done to the robot")->type_name("FILE");
  auto* expect = app.add_option("--expect", options->expect, "Fail unless the drive ends like this, and well: `arrived`, `arrived at Shelf`, `stopped: Help.lost`")
                     ->type_name("ENDING");
  app.add_option("--allow", options->allow, "What --expect lets pass: collisions, closed (roads taken), unsafe (crossings entered), lost (unaware), missed (events)")
      ->delimiter(',')
      ->type_name("WORD,...")
      ->allow_extra_args(false)
      ->check(CLI::IsMember(blemishes()))
      ->needs(expect);
  auto* summary = app.add_option("--summary", options->summary, "Write the result of the drive to this file, JSON; - for standard output")->type_name("FILE");
  auto* trace = app.add_option("--trace", options->trace, "Write the trace to this file, JSON lines; - for standard output")->type_name("FILE");
  auto* facts = app.add_option("--facts", options->facts, "Write what the mind was told to this file, as `kbc run --facts` reads it")->type_name("FILE");
  auto* html = app.add_option("--html", options->html, "Write a page that plays the drive to this file")->type_name("FILE");
  auto* svg = app.add_option("--svg", options->svg, "Draw the floor and the way on it to this file, as SVG")->type_name("FILE")->check(is_svg());
  auto* perfetto = app.add_option("--perfetto", options->perfetto, "Write the drive for https://ui.perfetto.dev to this file")->type_name("FILE");
  auto* csv = app.add_option("--csv", options->csv, "Write a row for each tick to this file: where the robot is, senses, facts")->type_name("FILE");
  auto* live = app.add_option("--live", options->live,
                              "Serve the page while the robot drives, to this machine alone: the port, 0 for any that is free")
                   ->type_name("PORT")
                   ->transform(is_port());
  app.add_option("--speed", options->speed, "Seconds of the drive for a second of the clock (as fast as it goes; with --live 1)")
      ->type_name("FACTOR")
      ->check(is_number<double>("speed; it is a number from 0.01 to 1000", [](double number) { return number >= 0.01 && number <= 1000.0; }));
  auto* driver = app.add_option("--driver", options->driver,
                                "A shell command that drives in place of the knowledge base: it reads a line of JSON with senses and answers a line with "
                                "`speed` and `turn`, as `kbc drive` does")
                     ->type_name("COMMAND")->excludes(facts)->excludes(live);
  app.add_option("--driver-timeout", options->driver_timeout, "The longest that the driver may take for an answer (10s)")->type_name("TIME")->check(is_duration())->needs(driver);
  app.add_option("--seed", options->seed, "The seed of all noise; overrides the scenario's")->type_name("N")->transform(is_whole_number("seed"));
  refuse_shared_standard_output(app, {summary, trace, facts, html, svg, perfetto, csv});
  return [options](Session& session) { return run(*options, session); };
}

}  // namespace kb::cli
