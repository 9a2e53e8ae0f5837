// kbc plan: paths on a map, by any of the planners.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planners/crew.h"
#include "planners/report/rows.h"
#include "planners/report/svg.h"
#include "planners/room.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;
namespace plans = kb::planners;

struct PlanOptions {
  std::string map, from, to, scen, csv, svg, budget;
  std::vector<std::string> methods;
  std::uint64_t seed = 1;
  double radius_m = 0.0;
  unsigned threads = 0;
  bool compare = false, list = false, times = false;
};

// What all parts of this command share.
struct Work {
  const PlanOptions& options;
  Session& session;
  source::Sources sources;
  plans::MapFile map;
  plans::Grid room;   // where the robot's centre may be
  std::vector<const plans::Method*> methods;

  [[nodiscard]] plans::RunOptions run() const {
    plans::RunOptions run;
    run.seed = options.seed;
    if (const auto us = trace::parse_duration(options.budget)) run.budget = std::chrono::microseconds(*us);
    return run;
  }
  /// Then standard output contains nothing but the file.
  [[nodiscard]] bool to_stdout() const { return options.csv == "-" || options.svg == "-"; }
  [[nodiscard]] unsigned threads() const {
    return options.threads > 0 ? options.threads : plans::cores();
  }
};

int print_list(Session& session) {
  for (const plans::Method& method : plans::methods()) {
    session.print(fmt::format("{:<22} {:<12} {}\n", method.name, name(method.knowledge), method.summary));
  }
  return session.exit_code();
}

bool choose_methods(Work& work) {
  std::vector<std::string> wanted = work.options.methods;
  if (wanted.empty() && work.options.compare) {
    for (const plans::Method& method : plans::methods()) wanted.emplace_back(method.name);
  }
  if (wanted.empty()) wanted.emplace_back("neural");
  for (const std::string& name : wanted) {
    if (const plans::Method* const method = plans::find_method(name)) {
      if (std::ranges::find(work.methods, method) == work.methods.end()) work.methods.push_back(method);
      continue;
    }
    std::vector<std::string_view> names;
    for (const plans::Method& method : plans::methods()) names.push_back(method.name);
    work.session.diagnostics(work.sources).report(Kind::kPlanUnknownMethod, {}, {name})
        .suggest(diagnostics::closest(name, names));
    return false;
  }
  return true;
}

std::optional<plans::Problem> read_problem(const Work& work) {
  auto messages = work.session.diagnostics(work.sources);
  if (work.options.from.empty() || work.options.to.empty()) {
    messages.report(Kind::kPlanNoQuestion, {});
    return std::nullopt;
  }
  plans::Problem problem;
  problem.grid = &work.map.grid;   // whether a place is on the map does not depend on the robot
  for (const bool start : {true, false}) {
    const std::string& text = start ? work.options.from : work.options.to;
    const auto place = plans::parse_place(text, work.map.grid, work.map.in_cells);
    if (!place) {
      messages.report(Kind::kPlanPlace, {}, {text, work.map.in_cells ? "`column,row`, from the top left" : "`x,y` in metres"});
      return std::nullopt;
    }
    (start ? problem.start : problem.goal) = *place;
  }
  if (const auto fault = plans::find_fault(problem); fault != plans::Fault::kNone) {
    messages.report(Kind::kPlanImpossible, {}, {name(fault)});
    return std::nullopt;
  }
  problem.grid = &work.room;
  for (const bool start : {true, false}) {
    const plans::Cell cell = start ? problem.start_cell() : problem.goal_cell();
    if (work.room.free(cell)) continue;
    const float room_m = plans::room_of_cells(work.map.grid)[work.map.grid.index(cell)];
    messages.report(Kind::kPlanNoRoom, {}, {start ? "start" : "goal", fmt::format("{:g}", work.options.radius_m), fmt::format("{:.3g}", room_m)});
    return std::nullopt;
  }
  return problem;
}

// A place in the map file's coordinates.
std::string place_text(plans::Point place, const plans::MapFile& map) {
  const plans::Point at = place_in_file(place, map.grid, map.in_cells);
  return fmt::format("{:.2f},{:.2f}", at.x, at.y);
}

std::string describe(const plans::Result& result, double optimum_m, const plans::MapFile& map) {
  std::string text(name(result.outcome));
  if (result.outcome == plans::Outcome::kReached) {
    text += fmt::format(", {:.3f} m", result.length_m);
    if (optimum_m > 0.0) text += fmt::format(", {:.4f} of the shortest", result.length_m / optimum_m);
  }
  if (result.outcome == plans::Outcome::kTrapped) text += fmt::format(" ({}) at {}", name(result.trap.kind), place_text(result.trap.at, map));
  if (result.outcome == plans::Outcome::kLimit) text += fmt::format(" ({})", name(result.statistics.stop));
  if (!result.refused.empty()) text += fmt::format(": {}", result.refused);
  return text;
}

// Appends the table of one method; all tables share one header.
void append_csv(std::string& csv, const std::string& text) { csv += csv.empty() ? text : text.substr(text.find('\n') + 1); }

void print_answer(const Work& work, const plans::Method& method, const plans::Result& result, const std::string& text) {
  if (work.to_stdout()) return;
  work.session.print(fmt::format("{:<22} {:<12} {}\n", method.name, name(method.knowledge), text));
  if (work.options.compare) return;
  for (const auto& [what, value] : result.statistics.more) work.session.print(fmt::format("    {:<30} {:.6g}\n", what, value));
  for (const auto& [what, place] : result.statistics.places) work.session.print(fmt::format("    {:<30} {}\n", what, place_text(place, work.map)));
}

plans::Result answer_with_progress(const Work& work, const plans::Method& method, const plans::Problem& problem) {
  const std::string what = fmt::format("% by {}", method.name);
  Progress progress(work.session, what);
  plans::RunOptions run = work.run();
  run.progress = [&](double share) { progress.show(static_cast<std::uint64_t>(100.0 * share)); };
  return plan(method, problem, run);
}

// Answers one question, with a panel of the picture for each method.
int answer_one(Work& work) {
  const auto problem = read_problem(work);
  if (!problem) return kErrors;
  const plans::Method& astar = *plans::find_method("astar");
  const plans::Result optimum = answer_with_progress(work, astar, *problem);   // its length is 0 if the budget ends it
  std::vector<plans::Result> results;
  std::vector<plans::Panel> panels;
  std::string csv;
  const bool draws = !work.options.svg.empty();   // on a large map, a field takes longer than the path
  results.reserve(work.methods.size());
  for (const plans::Method* method : work.methods) {
    const plans::Result& result = results.emplace_back(method == &astar ? optimum : answer_with_progress(work, *method, *problem));
    const std::string text = describe(result, optimum.length_m, work.map);
    print_answer(work, *method, result, text);
    if (result.repelled_from_m > 0.0 && result.outcome != plans::Outcome::kReached) {
      work.session.report(Kind::kPlanGoalRepelled, {fmt::format("{:.3g}", result.repelled_from_m), method->name});
    }
    append_csv(csv, print_path(*method, result, work.map.grid, work.map.in_cells));
    const auto letter = static_cast<char>('a' + panels.size() % 26);
    panels.push_back({work.methods.size() > 1 ? fmt::format("{}) {}", letter, method->name) : std::string(method->name), text,
                      &*problem, &result, draws && method->draw != nullptr ? method->draw(*problem, result) : plans::Picture{},
                      work.options.radius_m > 0.0 ? &work.map.grid : nullptr});
  }
  std::vector<Session::OutputFile> files;
  if (!work.options.svg.empty()) files.push_back({work.options.svg, draw_svg(panels, panels.size() > 4 ? 4 : 2)});
  if (!work.options.csv.empty()) files.push_back({work.options.csv, csv});
  const bool written = work.session.write_each(files);
  const plans::Result& only = results.front();
  if (results.size() == 1 && only.outcome != plans::Outcome::kReached) {
    work.session.report(Kind::kPlanFailed, {work.methods.front()->name, describe(only, optimum.length_m, work.map)});
  }
  return written ? work.session.exit_code() : kErrors;
}

// Answers all rows of a scenario file.
int answer_many(Work& work) {
  auto messages = work.session.diagnostics(work.sources);
  const auto file = diagnostics::open_file(work.options.scen, work.session.files(), work.sources, messages);
  const auto rows = file ? plans::read_scenarios(*file, work.map.grid, messages, work.options.map) : std::nullopt;
  if (!rows) return kErrors;
  std::vector<plans::Summary> summaries;
  std::string csv;
  for (const plans::Method* method : work.methods) {
    const std::string what = fmt::format("rows by {}", method->name);
    Progress progress(work.session, what);
    const auto answers = answer_rows(*method, work.room, *rows, work.run(), work.threads(),
                                     [&](std::size_t done) { progress.show(done, rows->size()); });
    summaries.push_back(summarise(*method, *rows, answers));
    append_csv(csv, print_csv(*method, work.map.grid, *rows, answers));
  }
  const bool written = work.options.csv.empty() || work.session.write_files({{work.options.csv, csv}});
  if (!work.to_stdout()) work.session.print(print_table(summaries, work.options.times));
  return written ? work.session.exit_code() : kErrors;
}

int run_plan(const PlanOptions& options, Session& session) {
  if (options.list) return print_list(session);
  Work work{options, session, {}, {}, {}, {}};
  if (!choose_methods(work)) return kErrors;
  auto messages = session.diagnostics(work.sources);
  auto map = plans::read_map(options.map, session.files(), work.sources, messages);
  if (!map) return kErrors;
  work.map = std::move(*map);
  work.room = plans::inflate(work.map.grid, options.radius_m);
  return options.scen.empty() ? answer_one(work) : answer_many(work);
}

}  // namespace

Run setup_plan(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  auto* list = app.add_flag("--list", options->list, "Print all methods, and what each of them knows of the world");
  app.add_option("FILE", options->map, "The map: MovingAI's .map, or the .yaml of a ROS map");
  auto* from = app.add_option("--from", options->from, "The start: column,row of a .map, counted from the top left; x,y in metres on a ROS map. Planners on the grid go from the middle of its cell to the middle of the goal's")->type_name("POINT");
  auto* to = app.add_option("--to", options->to, "The goal, written like the start")->type_name("POINT");
  app.add_option("--radius", options->radius_m, "The robot's radius: all methods keep this distance from blocked cells (0: a point)")->type_name("METRES")->check(is_length());
  app.add_option("--method", options->methods, "The method, as --list names it (neural); may be given several times")->type_name("METHOD");
  app.add_flag("--compare", options->compare, "Run all methods, or those given by --method, and compare them")->excludes(list);
  auto* svg = app.add_option("--svg", options->svg, "Draw map, field and path to this file, as SVG")->type_name("FILE")->check(is_svg());
  auto* scen = app.add_option("--scen", options->scen, "Find a path for each row of this MovingAI scenario file, instead of --from and --to")->type_name("FILE");
  scen->excludes(from)->excludes(to)->excludes(svg);
  auto* csv = app.add_option("--csv", options->csv, "Write each point of the path to this file, or with --scen the result of each row")->type_name("FILE");
  app.add_flag("--times", options->times, "With --scen: also print the median time of a row, which differs between machines")->needs(scen);
  app.add_option("--seed", options->seed, "The seed of the methods that use random numbers")->type_name("N")->transform(is_whole_number("seed"))->capture_default_str();
  app.add_option("--threads", options->threads, "How many threads share the rows of --scen (all cores); the answers do not depend on it")->transform(is_count(1, 1024));
  app.add_option("--budget", options->budget, "How long a method may take for one path, such as 500ms")->type_name("TIME")->check(is_duration());
  refuse_shared_standard_output(app, {svg, csv});
  for (CLI::Option* const with_a_map : {from, to, scen, svg, csv}) list->excludes(with_a_map);
  app.callback([options] {
    if (options->map.empty() && !options->list) throw CLI::RequiredError("FILE");
  });
  return [options](Session& session) { return run_plan(*options, session); };
}

}  // namespace kb::cli
