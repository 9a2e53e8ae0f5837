// kbc diff: which decisions change on recorded facts.
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "compiler/model/model.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/recorded_input.h"
#include "tools/kbc/support.h"
#include "tools/kbc/trace/decision_diff.h"
#include "tools/kbc/trace/map_diff.h"

namespace kb::cli {
namespace {

struct DiffOptions {
  std::string before, after;
  RecordedOptions recorded;
  bool json = false;
  std::uint64_t most = 20;
};

struct DiffCounts {
  std::uint64_t ticks = 0, differ = 0, strategy = 0, first = 0;
};

void show(const trace::TickDifference& difference, const DiffOptions& options, DiffCounts& counts, Session& session) {
  ++counts.ticks;
  if (!difference.any()) return;
  ++counts.differ;
  counts.strategy += difference.strategy_differs() ? 1 : 0;
  if (counts.first == 0) counts.first = difference.tick;
  if (options.json) session.print(trace::print_json(difference) + "\n");
  else if (counts.differ <= options.most) session.print(trace::print(difference));
}

void summarise(const DiffOptions& options, const DiffCounts& counts, Session& session) {
  if (options.json) {
    session.print(fmt::format("{{\"ticks\":{},\"differ\":{},\"strategy_differs\":{}}}\n", counts.ticks, counts.differ, counts.strategy));
  } else if (counts.differ == 0) {
    session.print(fmt::format("the same decisions in {}\n", diagnostics::counted(counts.ticks, "tick")));
  } else {
    session.print(fmt::format("{} of {} ticks differ, the strategy in {}; the first is tick {}\n", counts.differ, counts.ticks,
                              counts.strategy, counts.first));
  }
}

/// What drives during a strategy: `follow_line(speed: 0.4 m/s)`, for a fuzzy controller also its whole block.
struct Driver {
  std::string call, block;
  friend bool operator==(const Driver&, const Driver&) = default;
};

Driver driver_of(const model::Model& model, const model::Control& control) {
  std::vector<std::string> arguments;
  for (const model::Control::Argument& argument : control.arguments) arguments.push_back(model::text(argument));
  std::sort(arguments.begin(), arguments.end());   // their order means nothing
  const bool fuzzy = control.fuzzy != fuzzy::kNone;
  return {fmt::format("{}({})", control.controller, fmt::join(arguments, ", ")), fuzzy ? fuzzy::print(model.fuzzy[control.fuzzy], nullptr) : ""};
}

std::map<std::string, Driver> drivers_of(const model::Model& model) {
  std::map<std::string, Driver> drivers;
  for (const model::Control& control : model.controls) drivers.emplace(model[control.strategy].name, driver_of(model, control));
  return drivers;
}

/// How a strategy of both is driven otherwise; an empty call: nothing drives it.
std::string print_drivers(std::string_view strategy, const Driver& old, const Driver& now) {
  if (now.call.empty()) return fmt::format("{} is driven only in OLD: {}\n", strategy, old.call);
  if (old.call.empty()) return fmt::format("{} is driven only in NEW: {}\n", strategy, now.call);
  if (old.call == now.call) return fmt::format("{} drives otherwise: {} has other terms, values or rules\n", strategy, now.call);
  return fmt::format("{} drives otherwise: {} instead of {}\n", strategy, now.call, old.call);
}

/// Says what could not be compared. An image may run on the robot, whose program has controllers and map of its own.
void show_uncompared(const driver::Compilation& before, const driver::Compilation& after, const DiffOptions& options, Session& session) {
  if (!before.image && !after.image) return;
  if (options.json) session.print("{\"not_compared\":[\"controllers\",\"maps\"]}\n");
  else session.print(fmt::format("controllers and maps are not compared: {} is an image, which has none\n", before.image ? options.before : options.after));
}

/// Shows strategies that another controller drives, or none in one of the two: the same decision may then drive differently. Images do not
/// say what drives. Strategies of only one are told of already.
void show_drivers(const driver::Compilation& before, const driver::Compilation& after, const trace::DecisionDiffer& differ, const DiffOptions& options, Session& session) {
  if (before.image || after.image) return;
  std::map<std::string, std::pair<Driver, Driver>> drivers;   // old and new
  for (auto&& [strategy, driver] : drivers_of(before.model)) drivers[strategy].first = std::move(driver);
  for (auto&& [strategy, driver] : drivers_of(after.model)) drivers[strategy].second = std::move(driver);
  for (const trace::OnlyIn* only : {&differ.only_before(), &differ.only_after()}) {
    for (const std::string& strategy : only->strategies) drivers.erase(strategy);
  }
  nlohmann::ordered_json changed = nlohmann::ordered_json::array();
  for (const auto& [strategy, pair] : drivers) {
    const auto& [was, is] = pair;
    if (was == is) continue;
    if (options.json) changed.push_back({{"strategy", strategy}, {"old", was.call}, {"new", is.call}});
    else session.print(print_drivers(strategy, was, is));
  }
  if (!changed.empty()) session.print(nlohmann::ordered_json{{"controllers", changed}}.dump() + "\n");
}

/// Shows where the maps differ: there the same decisions may lead elsewhere, or may never have been needed.
void show_maps(const std::vector<trace::MapChange>& changes, const DiffOptions& options, Session& session) {
  nlohmann::ordered_json maps = nlohmann::ordered_json::array();
  std::size_t count = 0;
  for (const trace::MapChange& change : changes) {
    if (options.json) maps.push_back({{"map", change.map}, {"old", change.before}, {"new", change.after}, {"reached", change.reached}});
    else if (++count <= options.most) session.print(trace::print(change) + "\n");
  }
  if (count > options.most) session.print(fmt::format("... and {} more differences of the maps (--most)\n", count - options.most));
  if (!maps.empty()) session.print(nlohmann::ordered_json{{"maps", maps}}.dump() + "\n");
}

/// Whether both knowledge bases can take the given kind of recording. If not, reports it.
bool can_have(const DiffOptions& options, const driver::Compilation& before, const driver::Compilation& after, diagnostics::Diagnostics& diagnostics) {
  if (!options.recorded.has_readings()) return true;
  if (before.image || after.image) {
    report_no_sensors(before.image ? options.before : options.after, diagnostics);
    return false;
  }
  const auto torn = trace::torn_column(before.program, after.program);
  if (torn) diagnostics.report(diagnostics::Kind::kReadingsTorn, {}, {torn->name, torn->before, torn->after});
  return !torn;
}

int diff(const DiffOptions& options, Session& session) {
  const auto before = session.load(options.before, driver::Stage::kTables);
  const auto after = session.load(options.after, driver::Stage::kTables);
  if (!before->ok() || !after->ok()) return kErrors;
  source::Sources sources;
  auto diagnostics = session.diagnostics(sources);
  if (!can_have(options, *before, *after, diagnostics)) return kErrors;
  const program::Program inputs = trace::union_of_inputs(before->program, after->program);
  const RecordedInput input = open_recorded(options.recorded, inputs, sources, diagnostics);
  if (!input.reader) return kErrors;
  const auto old_engine = make_engine(trace::EngineKind::kTables, *before), new_engine = make_engine(trace::EngineKind::kTables, *after);
  trace::DecisionDiffer differ({before->program, *old_engine}, {after->program, *new_engine}, inputs);
  if (options.json) session.print(trace::print_json(differ.only_before(), differ.only_after()) + "\n");
  else session.print(trace::print(differ.only_before(), differ.only_after(), options.most));
  show_drivers(*before, *after, differ, options, session);
  std::vector<trace::MapChange> maps = trace::map_changes(before->model, after->model);   // an image has none
  trace::MapWatch watch(maps, {before->program, *old_engine}, {after->program, *new_engine});
  DiffCounts counts;
  Progress progress(session, "ticks");
  while (const trace::FactsRow* row = input.reader->next()) {
    show(differ.tick(*row), options, counts, session);
    watch.look();
    progress.update(counts.ticks);
  }
  if (input.reader->failed()) return kErrors;
  if (counts.ticks == 0) {   // nothing can differ
    diagnostics.report(diagnostics::Kind::kWhyNoTick, {}, {"1", options.recorded.path(), "0 ticks"});
    return kErrors;
  }
  if (!options.json && counts.differ > options.most) session.print(fmt::format("... and {} more ticks (--most)\n", counts.differ - options.most));
  show_maps(maps, options, session);
  show_uncompared(*before, *after, options, session);
  summarise(options, counts, session);
  return counts.differ != 0 ? static_cast<int>(kErrors) : session.exit_code();
}

}  // namespace

Run setup_diff(CLI::App& app) {
  auto options = std::make_shared<DiffOptions>();
  app.add_option("FILE", options->before, "OLD: a knowledge base, or an image of one (.kbt)")->required();
  app.add_option("NEW", options->after, "The other one")->required();
  add_recorded_options(app, options->recorded);
  app.add_flag("--json", options->json, "For programs: a line of JSON for what only one has, for each tick that differs, and for the counts");
  app.add_option("--most", options->most, "The most ticks to print, and names of a kind that only one has; the others are counted")->type_name("N")->transform(is_whole_number("count"))->capture_default_str();
  return [options](Session& session) { return diff(*options, session); };
}

}  // namespace kb::cli
