// kbc plan: paths on a map, by any of the planners.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "planners/report/rows.h"
#include "planners/report/svg.h"
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
  unsigned threads = 0;
  bool compare = false, list = false, times = false;
};

// What is common to all that this command does.
struct Work {
  const PlanOptions& options;
  Session& session;
  source::Sources sources;
  plans::MapFile map;
  std::vector<const plans::Method*> methods;

  [[nodiscard]] plans::RunOptions run() const {
    plans::RunOptions run;
    run.seed = options.seed;
    run.threads = threads();
    if (const auto us = trace::parse_duration(options.budget)) run.budget = std::chrono::microseconds(*us);
    return run;
  }
  [[nodiscard]] unsigned threads() const {
    return options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
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
    work.methods.push_back(plans::find_method(name));
    if (work.methods.back() != nullptr) continue;
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
  problem.grid = &work.map.grid;
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
  return problem;
}

std::string describe(const plans::Result& result, double optimum_m) {
  std::string text(name(result.outcome));
  if (result.outcome == plans::Outcome::kReached) {
    text += fmt::format(", {:.3f} m", result.length_m);
    if (optimum_m > 0.0) text += fmt::format(", {:.4f} of the shortest", result.length_m / optimum_m);
  }
  if (result.outcome == plans::Outcome::kTrapped) {
    text += fmt::format(" ({}) at {:.2f}, {:.2f} m", name(result.trap.kind), result.trap.at.x, result.trap.at.y);
  }
  if (!result.refused.empty()) text += fmt::format(": {}", result.refused);
  return text;
}

// One start and goal, one panel for each method.
int answer_one(Work& work) {
  const auto problem = read_problem(work);
  if (!problem) return kErrors;
  const double optimum_m = plan(*plans::find_method("astar"), *problem).length_m;
  std::vector<plans::Result> results;
  std::vector<plans::Panel> panels;
  results.reserve(work.methods.size());
  for (const plans::Method* method : work.methods) {
    const plans::Result& result = results.emplace_back(plan(*method, *problem, work.run()));
    const std::string text = describe(result, optimum_m);
    work.session.print(fmt::format("{:<22} {:<12} {}\n", method->name, name(method->knowledge), text));
    for (const auto& [what, value] : result.statistics.more) {
      if (!work.options.compare) work.session.print(fmt::format("    {:<30} {:.6g}\n", what, value));
    }
    const auto letter = static_cast<char>('a' + panels.size() % 26);
    panels.push_back({work.methods.size() > 1 ? fmt::format("{}) {}", letter, method->name) : std::string(method->name), text,
                      &*problem, &result, method->draw != nullptr ? method->draw(*problem, result) : plans::Picture{}});
  }
  if (!work.options.svg.empty() &&
      !work.session.write_files({{work.options.svg, draw_svg(panels, panels.size() > 4 ? 4 : 2)}})) {
    return kErrors;
  }
  const plans::Result& only = results.front();
  if (results.size() == 1 && only.outcome != plans::Outcome::kReached) {
    work.session.report(Kind::kPlanFailed, {work.methods.front()->name, describe(only, optimum_m)});
  }
  return work.session.exit_code();
}

// All rows of a scenario file.
int answer_many(Work& work) {
  auto messages = work.session.diagnostics(work.sources);
  const auto file = plans::open_file(work.options.scen, work.session.files(), work.sources, messages);
  const auto rows = file ? plans::read_scenarios(*file, work.map.grid, messages) : std::nullopt;
  if (!rows) return kErrors;
  std::vector<plans::Summary> summaries;
  std::string csv;
  for (const plans::Method* method : work.methods) {
    const std::string what = fmt::format("rows by {}", method->name);
    Progress progress(work.session, what);
    const auto answers = answer_rows(*method, work.map.grid, *rows, work.run(), work.threads(),
                                     [&](std::size_t done) { progress.update(done, rows->size()); });
    summaries.push_back(summarise(*method, *rows, answers));
    std::string text = print_csv(*method, work.map.grid, *rows, answers);
    csv += csv.empty() ? text : text.substr(text.find('\n') + 1);
  }
  if (!work.options.csv.empty() && !work.session.write_files({{work.options.csv, csv}})) return kErrors;
  const bool asked = work.options.csv.empty() || (work.options.csv != "-" && !work.session.quiet());
  if (asked) work.session.print(print_table(summaries, work.options.times));
  return work.session.exit_code();
}

int run_plan(const PlanOptions& options, Session& session) {
  if (options.list) return print_list(session);
  Work work{options, session, {}, {}, {}};
  if (!choose_methods(work)) return kErrors;
  auto messages = session.diagnostics(work.sources);
  auto map = plans::read_map(options.map, session.files(), work.sources, messages);
  if (!map) return kErrors;
  work.map = std::move(*map);
  return options.scen.empty() ? answer_one(work) : answer_many(work);
}

}  // namespace

Run setup_plan(CLI::App& app) {
  auto options = std::make_shared<PlanOptions>();
  auto* list = app.add_flag("--list", options->list, "Name all methods, with what each knows of the world");
  app.add_option("FILE", options->map, "The map: MovingAI's .map, or the .yaml of a ROS map");
  app.add_option("--from", options->from, "The start: column,row from the top left of a .map, x,y in metres of a ROS map")->type_name("POINT");
  app.add_option("--to", options->to, "The goal")->type_name("POINT");
  app.add_option("--method", options->methods, "The planner (neural); may be given several times")->type_name("METHOD");
  app.add_flag("--compare", options->compare, "All methods, or those of --method, side by side")->excludes(list);
  app.add_option("--svg", options->svg, "Draw map, field and path to this file")->type_name("FILE");
  app.add_option("--scen", options->scen, "Answer all rows of this scenario file")->type_name("FILE");
  app.add_option("--csv", options->csv, "With --scen: write a line for each row to this file")->type_name("FILE");
  app.add_flag("--times", options->times, "With --scen: also how long a row took, which differs between machines");
  app.add_option("--seed", options->seed, "Of the methods that throw dice")->capture_default_str();
  app.add_option("--threads", options->threads, "How many at once (all cores); the answers do not depend on it");
  app.add_option("--budget", options->budget, "How long one plan may take, such as 500ms")->type_name("TIME")->check(is_duration());
  return [options](Session& session) { return run_plan(*options, session); };
}

}  // namespace kb::cli
