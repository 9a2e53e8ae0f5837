// kbc experiment: the knowledge base against programmed control and Bug2, over generated labyrinths and disturbances.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include "planners/maps/maps.h"
#include "sim/experiment/results.h"
#include "sim/experiment/summary.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;
namespace lab = sim::experiment;

struct ExperimentOptions {
  std::string out, maze;
  std::uint32_t scenarios = 1000, labyrinths = 20;
  std::uint64_t seed = 1;
  unsigned jobs = 0;
  std::optional<std::uint32_t> show;
  std::vector<std::string> methods;   // none: all
};

bool wanted(const ExperimentOptions& options, lab::Method method) {
  const std::string_view name = lab::kMethodNames[static_cast<std::size_t>(method)];
  return options.methods.empty() || std::find(options.methods.begin(), options.methods.end(), name) != options.methods.end();
}

/// Those that are wanted: an experiment with one method is a part of that with all.
std::size_t count_runs(const ExperimentOptions& options) {
  std::size_t methods = 0;
  for (std::size_t m = 0; m < lab::kMethodNames.size(); ++m) methods += wanted(options, static_cast<lab::Method>(m)) ? 1 : 0;
  return methods * options.scenarios;
}

std::size_t count_done(const ExperimentOptions& options, const lab::Results& results) {
  const auto rows = results.sorted();
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [&](const lab::Row& row) { return wanted(options, row.method); }));
}

std::string in_folder(const ExperimentOptions& options, const char* name) { return (std::filesystem::path(options.out) / name).string(); }

/// The files of one scenario, to be driven with `kbc sim`.
int show(const ExperimentOptions& options, const lab::Setup& setup, Session& session) {
  for (const lab::Group& group : lab::groups_of(setup)) {
    for (const std::uint32_t scenario : group.scenarios) {
      if (scenario != *options.show) continue;
      const lab::Ground ground = lab::ground_of_number(setup, group.labyrinth, session.files());
      const lab::Prepared prepared(setup, group, ground, session.files());
      const bool written = session.write_files({{in_folder(options, "mission.kb"), prepared.mission()}, {in_folder(options, "scenario.toml"), prepared.case_of(scenario).scenario}});
      return written ? session.exit_code() : static_cast<int>(kErrors);
    }
  }
  session.report(Kind::kExperimentNoScenario, {fmt::format("{}", *options.show), fmt::format("{}", setup.scenarios)});
  return kErrors;
}

/// All runs that are not there yet. False if not all are there now.
bool run_rest(const ExperimentOptions& options, const lab::Setup& setup, lab::Results& results, Session& session) {
  const std::size_t all = count_runs(options), before = count_done(options, results);
  if (before == all) return true;
  const Interrupts interrupts;
  Progress progress(session, "runs");
  progress.begin_at(before);
  lab::RunControl control;
  control.jobs = options.jobs != 0 ? options.jobs : std::max(1u, std::thread::hardware_concurrency());
  // Threads ask while others add: they ask what was there at the beginning.
  std::vector<bool> done(std::size_t{setup.scenarios} * lab::kMethodNames.size(), false);
  const auto place = [](std::uint32_t scenario, lab::Method method) { return scenario * lab::kMethodNames.size() + static_cast<std::size_t>(method); };
  for (const lab::Row& row : results.sorted()) done[place(row.scenario, row.method)] = true;
  control.skip = [&](std::uint32_t scenario, lab::Method method) { return done[place(scenario, method)] || !wanted(options, method); };
  control.go_on = [] { return !Interrupts::came(); };
  std::size_t count = before;
  control.take = [&](const lab::Row& row) {
    if (!results.add(row)) return false;
    progress.show(++count, all);
    return true;
  };
  lab::run_all(setup, session.files(), control);
  if (!results.error().empty()) session.report(Kind::kCannotWrite, {in_folder(options, "runs.part"), results.error()});
  return count == all;
}

bool write_results(const ExperimentOptions& options, const std::string& fingerprint, const lab::Results& results, Session& session) {
  const auto rows = results.sorted();
  const auto shares = lab::summarise(rows);
  std::string csv = fmt::format("{}\n{}\n", fingerprint, lab::kRowHeader);
  for (const lab::Row& row : rows) csv += lab::print(row) + "\n";
  const std::string table = lab::print_table(shares) + "\nOf the knowledge base's runs, those in which one thing alone went wrong:\n\n" + lab::print_kinds(rows);
  if (!session.write_files({{in_folder(options, "runs.csv"), csv}, {in_folder(options, "table.md"), table}, {in_folder(options, "outcomes.svg"), lab::draw_outcomes(shares)},
                            {in_folder(options, "times.svg"), lab::draw_times(rows)}})) {
    return false;
  }
  if (!session.quiet()) session.print(table);   // it stands in table.md
  return true;
}

int run_experiment(const ExperimentOptions& options, Session& session) {
  source::Sources sources;
  auto messages = session.diagnostics(sources);
  // Towns are compiled unseen and drawn again where they have no room: what is wrong with the library is said before.
  const std::string rules = session.library() + "/std/navigation.kb";
  if (const auto read = session.files().read(rules); !read.bytes) {
    session.report(Kind::kCannotRead, {rules, read.error});
    return kErrors;
  }
  lab::Setup setup{options.scenarios, options.labyrinths, options.seed, nullptr, session.library()};
  std::optional<planners::MapFile> maze;
  if (!options.maze.empty()) {
    maze = planners::read_map(options.maze, session.files(), sources, messages);
    if (!maze) return kErrors;
    setup.maze = &maze->grid;
  }
  std::error_code failed;
  std::filesystem::create_directories(options.out, failed);
  if (failed) {
    messages.report(Kind::kCannotWrite, {}, {options.out, failed.message()});
    return kErrors;
  }
  if (options.show) return show(options, setup, session);
  const std::string part = in_folder(options, "runs.part"), whole = in_folder(options, "runs.csv");
  // What is complete is a file of results like any other: with the same options there is nothing left to run.
  const bool complete = std::filesystem::exists(whole, failed) && !std::filesystem::exists(part, failed);
  if (complete) std::filesystem::copy_file(whole, part, failed);
  const std::string fingerprint = lab::fingerprint(setup, session.files());
  lab::Results results;
  const auto opened = results.open(part, fingerprint, options.scenarios);
  if (opened == lab::Results::Opened::kFailed) {
    messages.report(Kind::kCannotWrite, {}, {part, results.error()});
    return kErrors;
  }
  if (opened == lab::Results::Opened::kOther) {
    if (complete) std::filesystem::remove(part, failed);
    messages.report(Kind::kExperimentOther, {}, {options.out});
    return kErrors;
  }
  if (!run_rest(options, setup, results, session)) {
    if (session.exit_code() != kClean) return kErrors;
    session.remark(fmt::format("interrupted: {} of {} runs are kept; the same command goes on", count_done(options, results), count_runs(options)));
    return 128 + SIGINT;
  }
  if (!write_results(options, fingerprint, results, session)) return kErrors;
  std::filesystem::remove(part, failed);
  return session.exit_code();
}

}  // namespace

Run setup_experiment(CLI::App& app) {
  auto options = std::make_shared<ExperimentOptions>();
  app.add_option("--out", options->out, "The folder for results, table and pictures; an interrupted experiment goes on there")->required()->type_name("DIR");
  app.add_option("--scenarios", options->scenarios, "How many, each driven by three methods")->check(CLI::Range(1u, 1'000'000u))->capture_default_str();
  app.add_option("--labyrinths", options->labyrinths, "How many, dealt out in turn")->check(CLI::Range(1u, 4096u))->capture_default_str();
  app.add_option("--maze", options->maze, "A MovingAI .map of corridors: every fourth labyrinth is a window of it")->type_name("FILE");
  app.add_option("--seed", options->seed, "Of labyrinths, routes, disturbances and noise")->capture_default_str();
  app.add_option("--jobs", options->jobs, "How many runs at once (all cores); the results do not depend on it");
  app.add_option("--method", options->methods, "Only this one: mts, programmed or bug2; may be given again (all). What is missing can be added later")
      ->check(CLI::IsMember(std::vector<std::string>(lab::kMethodNames.begin(), lab::kMethodNames.end())))->allow_extra_args(false)->type_name("NAME");
  app.add_option("--show", options->show, "Drive nothing: write mission.kb and scenario.toml of this scenario, for `kbc sim`")->type_name("NUMBER");
  return [options](Session& session) { return run_experiment(*options, session); };
}

}  // namespace kb::cli
