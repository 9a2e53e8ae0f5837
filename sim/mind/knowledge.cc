#include "sim/mind/knowledge.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <map>
#include <set>

#include <waymark/controllers/lookout.h>
#include "sim/mind/control_words.h"
#include "sim/mind/hall_rules.h"

namespace kb::sim {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;

/// The controller of a strategy of the standard library that has no control line.
struct Preset { std::string_view strategy, controller; };
constexpr std::array kPresets{
    Preset{"Stop", "stand"},           Preset{"Hold", "stand"},           Preset{"Search", "look_round"},     Preset{"Round", "turn_round"},
    Preset{"Avoid", "round_obstacle"}, Preset{"Move.mark", "follow_line"}, Preset{"Move.dist", "keep_wall"},
    Preset{"Move.azimuth", "hold_heading"}, Preset{"Move.open", "bug"},    Preset{"Escape", "bug"}};
constexpr std::array kCrossPresets{
    Preset{"mark", "turn_on_line"}, Preset{"dist", "turn_by_walls"}, Preset{"azimuth", "turn_by_compass"},
    Preset{"open", "turn_by_compass"}};

/// Finds what a strategy does, its turn and its method in its name: `Cross[left,mark]`, `Move.mark`.
void take_apart(Strategy& strategy) {
  const std::string_view name = strategy.name;
  if (name == "Escape") strategy.doing = Doing::kMove;
  const std::size_t comma = name.find(',');
  if (name.starts_with("Move.")) {
    strategy.doing = Doing::kMove;
    strategy.method = name.substr(5);
  } else if (name.starts_with("Grope.")) {
    strategy.doing = Doing::kCross;
    strategy.method = "azimuth";
    strategy.turn = name.substr(6);
  } else if (name.starts_with("Cross[") && comma != std::string_view::npos) {
    strategy.doing = Doing::kCross;
    strategy.turn = name.substr(6, comma - 6);
    strategy.method = name.substr(comma + 1, name.size() - comma - 2);
  }
}

std::string_view preset_for(const Strategy& strategy) {
  for (const Preset& preset : kPresets) {
    if (preset.strategy == strategy.name) return preset.controller;
  }
  for (const Preset& preset : kCrossPresets) {
    if (strategy.doing == Doing::kCross && preset.strategy == strategy.method) return preset.controller;
  }
  return {};
}

std::string_view word_for(const Strategy& strategy) { return strategy.control != nullptr ? std::string_view(strategy.control->controller) : preset_for(strategy); }

std::string parameter_names(mts::ControllerId id) {
  std::string names;
  mts::for_each_parameter(id, [&](const mts::Parameter& parameter) { names += fmt::format("{}`{}`", names.empty() ? "" : ", ", parameter.name); });
  return names.empty() ? "nothing" : names;
}

std::string words_text(mts::Values values) {
  if (values == mts::Values::kTurn) return "a turn";
  const mts::Words words = mts::words_of(values);
  std::string text;
  for (std::size_t i = 0; i < words.count; ++i) text += fmt::format("{}`{}`", i == 0 ? "" : i + 1 == words.count ? " or " : ", ", words.first[i]);
  return text;
}

bool take_argument(Strategy& strategy, const program::Control& control, const program::Control::Argument& argument, Diagnostics& diagnostics) {
  const mts::Parameter* parameter = mts::find_parameter(strategy.controller, argument.name.c_str());
  if (parameter == nullptr) {
    diagnostics.report(Kind::kSimUnknownParameter, argument.span, {control.controller, argument.name, parameter_names(strategy.controller)});
    return false;
  }
  float value = static_cast<float>(argument.number);
  if (!argument.is_number) {
    value = mts::number_of_word(*parameter, argument.word.c_str());
    // The controllers have no word for turns such as `half_left`: these are driven by the headings of the task.
    if (value < 0.0f && parameter->values == mts::Values::kTurn) {
      strategy.settings.push_back({argument.name, argument.word, {}, 0.0f});
      return true;
    }
  }
  const bool words = mts::words_of(parameter->values).count > 0;
  const bool other_unit = argument.is_number && !argument.unit.empty() && argument.unit != parameter->unit;
  if (words == argument.is_number || other_unit || (words ? value < 0.0f : !fits_some_robot(*parameter, value))) {
    diagnostics.report(Kind::kSimBadParameter, argument.span,
                       {argument.name, control.controller, words ? words_text(parameter->values) : range_text(*parameter, kRobot), value_text(argument)});
    return false;
  }
  strategy.settings.push_back({argument.name, argument.word, argument.unit, argument.is_number ? value : 0.0f});
  return true;
}

void report_unknown_controller(const std::string& name, const Strategy& strategy, const program::Program& program, Diagnostics& diagnostics, model::StandardNames* library,
                               bool can_stub) {
  std::vector<std::string_view> names;
  for (const mts::ControllerEntry& known : mts::kControllers) names.emplace_back(known.name);
  const std::string list = fmt::format("`{}`", fmt::join(names, "`, `"));
  for (const fuzzy::Controller& rules : program.fuzzy) names.emplace_back(rules.name);
  auto message = diagnostics.report(Kind::kSimUnknownController, strategy.control->controller_span, {name, strategy.name, list});
  const auto brings = library != nullptr ? library->file_with(name) : std::nullopt;
  const auto meant = diagnostics::closest(name, names);
  if (brings) message.note(Kind::kImportBrings, {}, {*brings});
  else if (!meant && can_stub) message.note(Kind::kSimStubHelps, {}, {name});
  else message.suggest(meant);
}

bool check_stubs(const program::Program& program, const std::vector<std::string>& stubs, Diagnostics& diagnostics) {
  std::vector<std::string_view> named;
  for (const program::Control& control : program.controls) named.emplace_back(control.controller);
  bool good = true;
  for (const std::string& stub : stubs) {
    if (std::find(named.begin(), named.end(), stub) != named.end()) continue;
    diagnostics.report(Kind::kSimStubUnknown, {}, {stub}).suggest(diagnostics::closest(stub, named));
    good = false;
  }
  return good;
}

/// Finds the controller of a strategy and checks its control line. `unknown`: the controllers already reported as unknown.
bool bind(Strategy& strategy, const program::Program& program, std::set<std::string>& unknown, Diagnostics& diagnostics, model::StandardNames* library,
          const std::vector<std::string>* stubs) {
  const auto control = std::find_if(program.controls.begin(), program.controls.end(), [&](const program::Control& c) { return c.strategy == strategy.cell; });
  const bool written = control != program.controls.end();
  strategy.control = written ? &*control : nullptr;
  const std::string name(word_for(strategy));
  if (written && stubs != nullptr && std::find(stubs->begin(), stubs->end(), name) != stubs->end()) return true;   // the controller is `stand`
  if (written && control->fuzzy != fuzzy::kNone) {
    strategy.controller = mts::ControllerId::kFollowRules;
    return check_rules(program.fuzzy[control->fuzzy], *control, diagnostics);
  }
  if (name.empty()) {
    diagnostics.report(Kind::kSimNoController, program[strategy.cell].declared, {strategy.name});
    return false;
  }
  const mts::ControllerEntry* entry = mts::find_controller(name.c_str());
  if (entry == nullptr) {
    if (unknown.insert(name).second) report_unknown_controller(name, strategy, program, diagnostics, library, stubs != nullptr);
    return false;
  }
  strategy.controller = entry->id;
  bool good = true;
  if (written) {
    for (const auto& argument : control->arguments) good = take_argument(strategy, *control, argument, diagnostics) && good;
  }
  return good;
}

void find_facts(const model::Model& model, const program::Program& program, Knowledge& out) {
  constexpr std::string_view kCrossBy = "CrossBy.";
  for (std::size_t i = 0; i < program.facts; ++i) {
    const std::string_view name = program.cells[i].name;
    const bool single = std::ranges::any_of(mts::kPerceivedFacts, [&](const char* fact) { return name == fact; });
    const std::string_view group = name.substr(0, name.find('.'));
    const bool member = group.size() < name.size() && std::ranges::any_of(mts::kPerceivedGroups, [&](const char* one) { return group == one; });
    if (single || member) out.perceived.push_back(static_cast<program::CellId>(i));
    if (name.starts_with(kCrossBy)) out.methods.push_back(name.substr(kCrossBy.size()));
  }
  out.landmarks = program::landmark_runs(model);
  for (const program::CellRun& run : out.landmarks) {
    for (std::uint32_t i = 0; i < run.count; ++i) out.perceived.push_back(program::CellId{static_cast<std::uint32_t>(run.first) + i});
  }
}

std::string landmark_in(const model::Model& model, const model::Row& row, std::string_view field) {
  const model::Row* landmark = model.row_in(row, field);
  return std::string(landmark != nullptr ? landmark->name : "");
}

void find_plans(const model::Model& model, Knowledge& out) {
  const auto order = program::cell_order(model);
  std::map<std::string_view, std::string> goals;   // by route
  std::map<model::CellId, model::RowId> roads;     // by leg
  for (const model::LegRoad& leg : model.leg_roads) roads.emplace(leg.leg, leg.road);
  for (const model::RowId id : model.rows_of("Leg")) {
    const model::Row& row = model[id];
    if (row.cell == model::CellId::kNone) continue;
    // Legs of a route are named `Route1.0:...`, those of its detours `Route1.d0.0:...` and the like: a letter follows the point.
    const std::size_t dot = row.name.find('.');
    const bool detour = dot != std::string::npos && dot + 1 < row.name.size() && (row.name[dot + 1] < '0' || row.name[dot + 1] > '9');
    const model::Row* to = model.row_in(row, "to");
    const bool seen = to != nullptr && to->cell != model::CellId::kNone;
    const auto road = roads.find(row.cell);
    const bool leaves = road != roads.end() && road->second != model::RowId::kNone;
    out.legs.push_back({order[model::index(row.cell)], std::string(row.name), landmark_in(model, row, "from"),
                        std::string(leaves ? model.member_in(model[road->second], "exit") : std::string_view()), landmark_in(model, row, "to"), detour,
                        model.row_in(row, "ends") != nullptr, seen ? order[model::index(to->cell)] : program::CellId::kNone});
    if (!detour) goals[row.name.substr(0, dot)] = out.legs.back().to;
  }
  for (const model::RowId id : model.rows_of("Route")) {
    const model::Row& row = model[id];
    if (row.cell != model::CellId::kNone) out.routes.push_back(order[model::index(row.cell)]);
    const model::Row* command = model.row_in(row, "command");
    if (command != nullptr && command->cell != model::CellId::kNone) out.missions.push_back({order[model::index(command->cell)], goals[row.name]});
  }
  for (std::size_t i = 0; i < out.program->cells.size(); ++i) {
    const program::Cell& cell = out.program->cells[i];
    if (cell.name.starts_with("Help.")) out.reports.push_back(static_cast<program::CellId>(i));
    if (cell.output) out.outputs.push_back(static_cast<program::CellId>(i));
  }
}

void find_feeds(const program::Program& program, std::vector<SensorFeed>& feeds) {
  struct Known { std::string_view name; SensorFeed::What what; std::uint32_t most; bool text; };
  using What = SensorFeed::What;
  constexpr std::array kKnown{Known{"line", What::kLine, mts::kLineSensors, false}, Known{"range", What::kRange, mts::kRangeFinders, false},
                              Known{"compass", What::kCompass, 1, false}, Known{"tag", What::kTag, 1, true},
                              Known{"memory", What::kMemory, 1, true}, Known{"speed", What::kSpeed, 1, false}};
  for (const program::Sensor& sensor : program.perception.sensors) {
    for (const Known& known : kKnown) {
      if (sensor.name == known.name && sensor.text == known.text) feeds.push_back({known.what, sensor.first, std::min(sensor.count, known.most)});
    }
  }
}

}  // namespace

std::string_view controller_name(const Strategy& strategy) { return word_for(strategy); }

program::CellId Knowledge::find(std::string_view cell) const {
  for (std::size_t i = 0; i < program->cells.size(); ++i) {
    if (program->cells[i].name == cell) return static_cast<program::CellId>(i);
  }
  return program::CellId::kNone;
}

std::uint32_t elements_of_robot(const Knowledge& knowledge, const program::Sensor& sensor) {
  const auto feed = std::find_if(knowledge.feeds.begin(), knowledge.feeds.end(), [&](const SensorFeed& one) { return one.first == sensor.first; });
  return feed == knowledge.feeds.end() ? 0 : feed->count;
}

void report_lacking_sensors(const Knowledge& knowledge, Diagnostics& diagnostics) {
  const std::string all = fmt::format("`line[0]` to `line[{}]`, `range[0]` to `range[{}]`, `compass` and `speed`, and of texts `tag` and `memory`",
                                      mts::kLineSensors - 1, mts::kRangeFinders - 1);
  for (const program::Sensor& sensor : knowledge.program->perception.sensors) {
    const std::uint32_t has = elements_of_robot(knowledge, sensor);
    if (has == sensor.count) continue;
    const std::string lacking = has == 0 ? fmt::format("sensor `{}`{}", sensor.name, sensor.text ? " of texts" : "") : fmt::format("`{}[{}]`", sensor.name, has);
    diagnostics.report(Kind::kSimNoSensor, sensor.declared, {lacking, all});
  }
}

bool can_take(const Knowledge& now, const Knowledge& next) {
  if (now.image == nullptr || next.image == nullptr || now.program->facts != next.program->facts) return false;
  const auto same_name = [](const program::Cell& a, const program::Cell& b) { return a.name == b.name; };
  const auto same_driver = [](const Strategy& a, const Strategy& b) { return a.name == b.name && controller_name(a) == controller_name(b); };
  return std::equal(now.program->cells.begin(), now.program->cells.begin() + static_cast<std::ptrdiff_t>(now.program->facts), next.program->cells.begin(), same_name) &&
         std::equal(now.strategies.begin(), now.strategies.end(), next.strategies.begin(), next.strategies.end(), same_driver);
}

std::optional<Knowledge> prepare(const model::Model& model, const program::Program& program, const tables::Tables& tables,
                                 Diagnostics& diagnostics, model::StandardNames* library, const std::vector<std::string>* stubs) {
  Knowledge out;
  out.program = &program;
  out.tables = &tables;
  find_facts(model, program, out);
  find_plans(model, out);
  out.limits = limits_of(model);
  bool good = stubs == nullptr || check_stubs(program, *stubs, diagnostics);
  std::set<std::string> unknown;
  for (std::size_t i = program.cells.size() - program.strategies; i < program.cells.size(); ++i) {
    Strategy strategy;
    strategy.cell = static_cast<program::CellId>(i);
    strategy.name = program.cells[i].name;
    take_apart(strategy);
    good = bind(strategy, program, unknown, diagnostics, library, stubs) && good;
    out.strategies.push_back(std::move(strategy));
  }
  if (!program.perception.empty()) {
    find_feeds(program, out.feeds);
    out.perception = tables::build_perception(program);
  }
  if (!good) return std::nullopt;
  return out;
}

}  // namespace kb::sim
