// kbc experiment: the knowledge base against programmed control and Bug2, over generated labyrinths and disturbances.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planners/crew.h"
#include "planners/maps/maps.h"
#include "sim/batch/batch.h"
#include "sim/experiment/results.h"
#include "sim/experiment/summary.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/drive_ground.h"
#include "tools/kbc/experiment_minds.h"
#include "tools/kbc/experiment_show.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/source_print.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/output_file.h"
#include "tools/kbc/trace/stream.h"

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
  std::vector<std::string> minds, set;
};

/// Counts all methods of the setup: an experiment with one method is a part of the experiment with all.
std::size_t count_runs(const lab::Setup& setup) { return setup.methods.size() * setup.set.size() * setup.scenarios; }

/// The index of a method in the setup; nothing if its runs are not wanted this time.
std::optional<std::size_t> method_of(const lab::Setup& setup, const std::string& name) {
  for (std::size_t m = 0; m < setup.methods.size(); ++m) {
    if (setup.methods[m].name == name) return m;
  }
  return std::nullopt;
}

std::size_t count_done(const lab::Setup& setup, const lab::Results& results) {
  const auto rows = results.sorted();
  return static_cast<std::size_t>(std::count_if(rows.begin(), rows.end(), [&](const lab::Row& row) { return method_of(setup, row.method).has_value(); }));
}

/// Keeps only the methods that --method names. False (reported) if it names one that does not exist.
bool choose_methods(const ExperimentOptions& options, lab::Setup& setup, Session& session) {
  for (const std::string& name : options.methods) {
    if (method_of(setup, name)) continue;
    std::string names;
    for (const lab::Method& m : setup.methods) names += (names.empty() ? "`" : ", `") + m.name + "`";
    session.report(Kind::kExperimentNoMethod, {name, names});
    return false;
  }
  if (options.methods.empty()) return true;
  std::erase_if(setup.methods, [&](const lab::Method& m) { return std::find(options.methods.begin(), options.methods.end(), m.name) == options.methods.end(); });
  return true;
}

std::string in_folder(const ExperimentOptions& options, const char* name) { return (std::filesystem::path(options.out) / name).string(); }

/// Whether each window of the maze that will be used contains a labyrinth. If not, reports it before anything is written.
bool fits(const lab::Setup& setup, const std::string& maze, Session& session) {
  try {
    for (std::uint32_t i = 0; setup.maze != nullptr && i < setup.labyrinths; ++i) {
      if (lab::in_maze(setup, i)) static_cast<void>(lab::ground_of_number(setup, i, session.files()));
    }
    return true;
  } catch (const lab::MazeFails&) {
    session.report(Kind::kExperimentMaze, {maze});
    return false;
  }
}

/// Drives all runs that are missing. False if some are still missing afterwards.
bool run_rest(const ExperimentOptions& options, const lab::Setup& setup, lab::Results& results, Session& session) {
  const std::size_t all = count_runs(setup), before = count_done(setup, results);
  if (before == all) return true;
  const Interrupts interrupts;
  Progress progress(session, "runs");
  progress.begin_at(before);
  lab::RunControl control;
  control.jobs = options.jobs != 0 ? options.jobs : planners::cores();
  // A copy of what was there at the beginning, because other threads add results meanwhile.
  std::vector<bool> done(all, false);
  const auto place = [&setup](std::uint32_t scenario, std::size_t method, std::size_t set) { return (scenario * setup.methods.size() + method) * setup.set.size() + set; };
  for (const lab::Row& row : results.sorted()) {
    if (const auto method = method_of(setup, row.method)) done[place(row.scenario, *method, row.set)] = true;
  }
  control.skip = [&](std::uint32_t scenario, std::size_t method, std::size_t set) { return done[place(scenario, method, set)]; };
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

/// Writes those files of the results that do not say it yet: a finished experiment may lie where nothing can be written.
bool write_results(const ExperimentOptions& options, const lab::Setup& setup, const lab::Results& results, Session& session) {
  const auto rows = results.sorted();
  const auto shares = lab::summarise(rows);
  const std::string table = lab::print_table(shares, setup.set) + lab::print_kinds(rows, setup.set);
  std::vector<Session::OutputFile> files{{in_folder(options, "runs.csv"), results.print()}, {in_folder(options, "table.md"), table},
                                         {in_folder(options, "outcomes.svg"), lab::draw_outcomes(shares, setup.set)}, {in_folder(options, "times.svg"), lab::draw_times(shares, setup.set)}};
  std::erase_if(files, [](const Session::OutputFile& file) {
    std::string error;
    return trace::read_all(file.path, SIZE_MAX, error) == file.bytes;
  });
  if (!session.write_files(files)) return false;
  session.print(table);
  return true;
}

/// Copies a file whole or not at all. False if that fails (reported).
bool copy(const std::string& from, const std::string& to, Session& session) {
  std::string error;
  auto bytes = trace::read_all(from, SIZE_MAX, error);
  if (!bytes) session.report(Kind::kCannotRead, {from, error});
  return bytes && session.write_files({{to, std::move(*bytes)}});
}

/// Whether these are results to go on with. If not, it is reported.
bool are_ours(const ExperimentOptions& options, lab::Results::Opened opened, const lab::Results& results, Session& session) {
  using Opened = lab::Results::Opened;
  constexpr const char* kRemove = ", or remove its runs.part and runs.csv";
  if (opened == Opened::kFailed) session.report(Kind::kCannotWrite, {in_folder(options, "runs.part"), results.error()});
  if (opened == Opened::kOther) session.report(Kind::kExperimentOther, {options.out, "the runs of another experiment (" + results.error() + ")", kRemove});
  if (opened == Opened::kNotOurs) session.report(Kind::kExperimentOther, {options.out, results.error(), ""});
  if (opened == Opened::kOtherMind) session.report(Kind::kExperimentOtherMind, {options.out, results.error()});
  return opened == Opened::kOpen;
}

/// The runs that are there, or are to be.
struct Folder {
  std::string fingerprint;
  lab::Results::Minds minds;
};

/// The exit code if the folder holds all of the experiment, which is then printed, or cannot hold it; nothing if something is to be driven.
std::optional<int> print_finished(const ExperimentOptions& options, const lab::Setup& setup, const Folder& folder, Session& session) {
  lab::Results results;
  const std::string whole = in_folder(options, "runs.csv");
  const auto opened = results.look(whole, folder.fingerprint, setup, folder.minds);
  if (opened == lab::Results::Opened::kFailed) session.report(Kind::kCannotRead, {whole, results.error()});
  else static_cast<void>(are_ours(options, opened, results, session));
  if (opened != lab::Results::Opened::kOpen) return kErrors;
  const bool all = results.bad_line() == 0 && count_done(setup, results) == count_runs(setup);
  if (!all) return std::nullopt;
  return write_results(options, setup, results, session) ? session.exit_code() : static_cast<int>(kErrors);
}

/// Opens the results that exist, drives the rest, and writes the results.
int drive_all(const ExperimentOptions& options, const lab::Setup& setup, const Folder& folder, Session& session) {
  std::error_code failed;
  const std::string part = in_folder(options, "runs.part"), whole = in_folder(options, "runs.csv");
  if (!std::filesystem::exists(part, failed) && std::filesystem::exists(in_folder(options, "shards"), failed)) {
    session.report(Kind::kExperimentOther, {options.out, "a batch of `kbc fleet`", ""});
    return kErrors;
  }
  // If the experiment is complete, its file is just a file of results: with other methods it goes on from there.
  const bool complete = std::filesystem::exists(whole, failed) && !std::filesystem::exists(part, failed);
  if (complete) {
    if (const auto code = print_finished(options, setup, folder, session)) return *code;
    if (!copy(whole, part, session)) return kErrors;
  }
  lab::Results results;
  if (!are_ours(options, results.open(part, folder.fingerprint, setup, folder.minds), results, session)) return kErrors;
  if (results.bad_line() != 0) {
    session.remark(fmt::format("line {} of `{}` is no result of this experiment: its run and those of the lines behind it are driven again", results.bad_line(), complete ? whole : part));
  }
  if (!run_rest(options, setup, results, session)) {
    if (session.exit_code() != kClean) return kErrors;
    session.remark(fmt::format("interrupted: {} of {} runs are kept; the same command goes on", count_done(setup, results), count_runs(setup)));
    return kInterrupted;
  }
  if (!write_results(options, setup, results, session)) return kErrors;
  std::filesystem::remove(part, failed);
  return session.exit_code();
}

/// Why an experiment cannot set this key; empty if it can. It can set what all scenarios have, whatever is drawn for them.
std::string refused(std::string_view key) {
  if (key.starts_with("sensors.") || key.starts_with("robot.") || key.starts_with("floor.") || key == "limit") return {};
  return "the rest of a scenario is drawn; an experiment sets `sensors...`, `robot...`, `floor...` and `limit`";
}

int run_experiment(const ExperimentOptions& options, Session& session) {
  source::Sources sources;
  auto messages = session.diagnostics(sources);
  // Errors in towns are not shown, since a town without enough room is drawn again. So errors in the library are reported first.
  const std::string rules = session.library() + "/std/navigation.kb";
  if (const auto read = session.files().read(rules); !read.bytes) {
    session.report(Kind::kCannotRead, {rules, read.error});
    return kErrors;
  }
  const auto minds = read_minds(options.minds, session);
  auto set = minds ? combinations(options.set, refused, session) : std::nullopt;
  if (!set) return kErrors;
  lab::Setup setup{options.scenarios, options.labyrinths, options.seed, nullptr, session.library(), lab::built_in_methods(), std::move(*set)};
  setup.methods.insert(setup.methods.end(), minds->begin(), minds->end());
  if (!choose_methods(options, setup, session)) return kErrors;
  const lab::Method* shown = nullptr;
  if (options.show) {
    shown = method_to_show(setup, options.methods, session);
    if (shown == nullptr || !one_setting(options.set, session)) return kErrors;
  }
  if (!are_few_enough(setup.scenarios, "scenarios", setup.methods.size() * setup.set.size(), session)) return kErrors;
  std::optional<planners::MapFile> maze;
  if (!options.maze.empty()) {
    maze = planners::read_map(options.maze, session.files(), sources, messages);
    if (!maze) return kErrors;
    setup.maze = &maze->grid;
  }
  const auto fingerprints = check_minds(setup, *minds, session);
  if (!fingerprints || !fits(setup, options.maze, session)) return kErrors;
  if (const auto failed = trace::make_folders(options.out)) {
    session.report(Kind::kCannotMakeFolder, {options.out, *failed});
    return kErrors;
  }
  if (shown != nullptr) return show_scenario(setup, *shown, *options.show, options.out, session);
  try {
    const std::string program = fmt::format("{} {}", KB_VERSION, source_print());
    return drive_all(options, setup, {lab::fingerprint(setup, program, session.files()), *fingerprints}, session);
  } catch (const lab::MindFails& fails) {
    const std::string said = fails.what();
    session.report(Kind::kExperimentMindFails, {fails.mind, fmt::format("{}", fails.scenario), said.substr(0, said.find('\n'))});
    return kErrors;
  }
}

}  // namespace

Run setup_experiment(CLI::App& app) {
  auto options = std::make_shared<ExperimentOptions>();
  app.add_option("--out", options->out, "The folder for results, table and pictures; an interrupted experiment goes on there")->required()->type_name("DIR");
  app.add_option("--scenarios", options->scenarios, "The number of scenarios, each driven by every method")->transform(is_count(1, 1'000'000))->capture_default_str();
  app.add_option("--labyrinths", options->labyrinths, "The number of labyrinths, used in turn")->transform(is_count(1, 4096))->capture_default_str();
  app.add_option("--maze", options->maze, "A MovingAI .map of corridors: every fourth labyrinth is a window of it")->type_name("FILE");
  app.add_option("--seed", options->seed, "The seed of labyrinths, routes, disturbances and noise")->type_name("N")->transform(is_whole_number("seed"))->capture_default_str();
  app.add_option("--jobs", options->jobs, "How many runs at once (all cores); the results do not depend on it")->transform(is_count(1, 1024));
  app.add_option("--mind", options->minds, "Rules of your own, a .kb without map and route, as one method more; may be given often")
      ->allow_extra_args(false)->type_name("FILE=NAME");
  add_set_option(app, options->set);
  app.add_option("--method", options->methods, "Only this one: mts, programmed, bug2 or a mind's name; may be given again (all). What is missing can be added later")
      ->allow_extra_args(false)->type_name("NAME");
  app.add_option("--show", options->show, "Drive nothing: write mission.kb and scenario.toml of this scenario, with --set, for `kbc sim`")->type_name("N")->transform(is_whole_number("scenario"));
  app.callback([options] {
    if (!options->maze.empty() && options->labyrinths < 4) throw CLI::ValidationError("--maze", "every fourth labyrinth is a window of it, so there have to be --labyrinths 4 or more");
  });
  return [options](Session& session) { return run_experiment(*options, session); };
}

}  // namespace kb::cli
