#include "sim/mind/control_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <waymark/controllers/any_controller.h>

namespace kb::sim {
namespace {

using diagnostics::Kind;

struct Bounds {
  float low = 0.0f, high = 0.0f;
  bool whole = false;
  [[nodiscard]] bool hold(float value) const { return value >= low && value <= high && (!whole || value == std::floor(value)); }
};

Bounds bounds_of(const mts::Parameter& parameter, const mts::Body& body) {
  const float ratio = mts::Similarity(body.size).of(parameter.unit), high = parameter.high * ratio;
  const bool speed = std::string_view(parameter.unit) == "m/s";
  const float low = parameter.from_centre ? std::max(parameter.low * ratio, body.radius_m + mts::kNearestBeside_m * ratio) : parameter.low * ratio;
  return {low, speed ? std::max(high, body.top_speed_m_s) : high, parameter.values == mts::Values::kWhole};
}

std::string unit_of(const mts::Parameter& parameter) { return *parameter.unit != '\0' ? fmt::format(" {}", parameter.unit) : ""; }
std::string text_of(double value, const mts::Parameter& parameter) { return fmt::format("{:.7g}{}", value, unit_of(parameter)); }

/// Checks a number that is written for a parameter. Words, and names that are no parameters of the controller that drives (a stub has
/// none), need no check here: they were checked when they were read.
bool check_number(const Strategy& strategy, const program::Control::Argument& written, const mts::Body& body, diagnostics::Diagnostics& diagnostics) {
  const mts::Parameter* parameter = mts::find_parameter(strategy.controller, written.name.c_str());
  if (parameter == nullptr || !written.is_number || bounds_of(*parameter, body).hold(static_cast<float>(written.number))) return true;
  diagnostics.report(Kind::kSimBadParameter, written.span, {written.name, strategy.control->controller, range_text(*parameter, body), text_of(written.number, *parameter)});
  return false;
}

// Checks that `balance` fits `zone`: a balance beyond the zone of repulsion could not be kept, and the controller would silently take a
// smaller one.
bool check_field(const Strategy& strategy, const mts::Body& body, diagnostics::Diagnostics& diagnostics) {
  const mts::Similarity as(body.size);
  const mts::PotentialGains usual;
  const auto written = [&](std::string_view name) {
    const auto found = std::find_if(strategy.control->arguments.begin(), strategy.control->arguments.end(), [&](const auto& argument) { return argument.name == name; });
    return found != strategy.control->arguments.end() ? &*found : nullptr;
  };
  const program::Control::Argument *zone = written("zone"), *balance = written("balance");
  const float zone_m = zone != nullptr ? static_cast<float>(zone->number) : as.out(usual.zone_m, "m"), most_m = mts::kMostBalanceOfZone * zone_m;
  if (balance == nullptr || static_cast<float>(balance->number) <= most_m * 1.0001f) return true;
  const float least_m = as.out(mts::find_parameter(strategy.controller, "balance")->low, "m");
  diagnostics.report(Kind::kSimBadParameter, balance->span,
                     {balance->name, strategy.control->controller, fmt::format("{:g} to {:g} m with a `zone` of {:g} m", least_m, most_m, zone_m),
                      fmt::format("{:g} m", balance->number)});
  return false;
}

void check_argument(const program::Control& control, const program::Control::Argument& argument, mts::ControllerId id, diagnostics::Diagnostics& diagnostics) {
  const mts::Parameter* parameter = mts::find_parameter(id, argument.name.c_str());
  if (parameter == nullptr) {
    std::optional<std::string> meant;
    mts::for_each_parameter(id, [&](const mts::Parameter& known) {
      if (diagnostics::is_slip_of(argument.name, known.name)) meant = known.name;
    });
    const bool given = std::any_of(control.arguments.begin(), control.arguments.end(), [&](const auto& other) { return meant && other.name == *meant; });
    diagnostics.report(Kind::kControlArgument, argument.name_span(), {control.controller, argument.name}).suggest(given ? std::nullopt : meant);
    return;
  }
  if (!argument.is_number || mts::words_of(parameter->values).count > 0) return;   // words may belong to the user's own tasks
  const bool same_unit = argument.unit.empty() || argument.unit == parameter->unit;
  if (same_unit && fits_some_robot(*parameter, static_cast<float>(argument.number))) return;
  const char* const whose = parameter->values == mts::Values::kWhole ? "" : " for a robot of size 1";
  diagnostics.report(Kind::kControlRange, argument.span, {argument.name, control.controller, range_text(*parameter, kRobot) + whose,
                                                          same_unit ? text_of(argument.number, *parameter) : fmt::format("{:g} {}", argument.number, argument.unit)});
}

/// Whether a strategy may drive outside of halls. A `Move` does only if the map has roads of its method; otherwise it does not count, as it
/// may just share its control line with other strategies.
bool drives_elsewhere(const Strategy& strategy, const Labyrinth& labyrinth) {
  if (strategy.doing != Doing::kMove) return true;
  return std::any_of(labyrinth.roads.begin(), labyrinth.roads.end(), [&](const Road& road) { return road.method == strategy.method && road.kind != Picture::Kind::kOpen; });
}

/// Whether a leg of a route or a detour leads along the road.
bool is_driven(const Road& road, const Knowledge& knowledge, const Labyrinth& labyrinth) {
  return std::ranges::any_of(knowledge.legs, [&](const Leg& leg) {
    return (leg.from == labyrinth[road.from].name && leg.exit == road.exit) || (leg.from == labyrinth[road.to].name && leg.exit == road.approach);
  });
}

/// Whether a strategy is to cross a hall by a line. Walls are no such case: in a narrow hall they are within reach.
bool follows_line_in_hall(const Strategy& strategy, const Knowledge& knowledge, const Labyrinth& labyrinth) {
  return strategy.doing == Doing::kMove && strategy.method == "open" && strategy.controller == mts::ControllerId::kFollowLine &&
         std::ranges::any_of(labyrinth.roads, [&](const Road& road) { return road.method == "open" && is_driven(road, knowledge, labyrinth); });
}

}  // namespace

std::string range_text(const mts::Parameter& parameter, const mts::Body& body) {
  const Bounds bounds = bounds_of(parameter, body);
  if (bounds.whole) return fmt::format("a whole number from {:.0f} to {:.0f}", bounds.low, bounds.high);
  const std::string whose = body.size != 1.0f ? fmt::format(" for a robot of size {:g}", body.size) : "";
  return fmt::format("{:g} to {:g}{}{}", bounds.low, bounds.high, unit_of(parameter), whose);
}

std::string value_text(const program::Control::Argument& argument) {
  return argument.is_number ? fmt::format("{:.7g}{}{}", argument.number, argument.unit.empty() ? "" : " ", argument.unit) : argument.word;
}

bool fits_some_robot(const mts::Parameter& parameter, float value) {
  const Bounds small = bounds_of(parameter, robot_of(kLeastSize)), large = bounds_of(parameter, robot_of(kMostSize));
  return Bounds{std::min(small.low, large.low), std::max(small.high, large.high), small.whole}.hold(value);
}

bool check_settings(const Knowledge& knowledge, const mts::Body& body, diagnostics::Diagnostics& diagnostics) {
  bool good = true;
  std::set<std::pair<std::uint32_t, std::uint32_t>> told;   // many strategies may share one line
  for (const Strategy& strategy : knowledge.strategies) {
    if (strategy.control == nullptr) continue;
    const source::Span at = strategy.control->controller_span;
    if (!told.insert({static_cast<std::uint32_t>(at.file), at.begin}).second) continue;
    bool fits = true;
    for (const auto& argument : strategy.control->arguments) fits = check_number(strategy, argument, body, diagnostics) && fits;
    if (fits && strategy.controller == mts::ControllerId::kPotential) fits = check_field(strategy, body, diagnostics);
    good = good && fits;
  }
  return good;
}

std::map<std::string_view, std::vector<std::string_view>> controller_arguments() {
  std::map<std::string_view, std::vector<std::string_view>> found;
  for (const mts::ControllerEntry& entry : mts::kControllers) {
    std::vector<std::string_view>& names = found[entry.name];
    mts::for_each_parameter(entry.id, [&](const mts::Parameter& parameter) { names.emplace_back(parameter.name); });
  }
  return found;
}

void check_halls(const Knowledge& knowledge, const Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> told;   // many strategies may share one line
  for (const Strategy& strategy : knowledge.strategies) {
    if (strategy.control == nullptr) continue;
    const bool no_hall = crosses_halls(strategy.controller) && drives_elsewhere(strategy, labyrinth), no_line = follows_line_in_hall(strategy, knowledge, labyrinth);
    const source::Span at = strategy.control->controller_span;
    if ((!no_hall && !no_line) || !told.insert({static_cast<std::uint32_t>(at.file), at.begin}).second) continue;
    diagnostics.report(no_hall ? Kind::kSimNoHall : Kind::kSimNoLine, at, {strategy.control->controller, strategy.name});
  }
}

void check_controls(const program::Program& program, diagnostics::Diagnostics& diagnostics) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> told;   // many strategies may share one line
  for (const program::Control& control : program.controls) {
    const source::Span at = control.controller_span;
    if (control.fuzzy != fuzzy::kNone || !told.insert({static_cast<std::uint32_t>(at.file), at.begin}).second) continue;
    const mts::ControllerEntry* entry = mts::find_controller(control.controller.c_str());
    if (entry != nullptr) {
      for (const auto& argument : control.arguments) check_argument(control, argument, entry->id, diagnostics);
      continue;
    }
    const auto compare = [&](std::string_view known) {
      if (diagnostics::is_slip_of(control.controller, known)) diagnostics.report(Kind::kControlName, at, {control.controller}).suggest(std::string(known));
    };
    for (const fuzzy::Controller& known : program.fuzzy) compare(known.name);
    for (const mts::ControllerEntry& known : mts::kControllers) compare(known.name);
  }
}

}  // namespace kb::sim
