// The drive in which nothing goes wrong.
#include <algorithm>

#include "sim/scenario/scenario.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr double kPressAt = 1.0;      // s
constexpr double kStartBefore = 1.2;  // m before the stop line of the first landmark

const model::Row* first_route(const model::Model& model) {
  for (const model::Relation& relation : model.relations) {
    if (relation.name == "Route" && !relation.rows.empty()) return &model[relation.rows.front()];
  }
  return nullptr;
}

}  // namespace

std::optional<Scenario> plain_scenario(const Labyrinth& labyrinth, const Knowledge& knowledge, const model::Model& model,
                                       diagnostics::Diagnostics& diagnostics) {
  const model::Row* route = first_route(model);
  const auto* command = route != nullptr ? model.row_in(*route, "command") : nullptr;
  const auto* leg = route != nullptr ? model.row_in(*route, "first") : nullptr;
  const auto* landmark = leg != nullptr ? model.row_in(*leg, "to") : nullptr;
  if (command == nullptr || landmark == nullptr) {
    diagnostics.report(diagnostics::Kind::kSimNoRoute, {});
    return std::nullopt;
  }
  Scenario scenario;
  scenario.title = "nothing goes wrong";
  Event press;
  press.when.time_s = kPressAt;
  press.action.kind = Action::Kind::kPress;
  press.action.cell = knowledge.find(command->name);
  press.text = std::string(command->name) + " pressed";
  scenario.events.push_back(std::move(press));
  const CrossingId first = labyrinth.crossing(landmark->name);
  for (const Road& road : labyrinth.roads) {   // the first in the order of the map
    const Arm* arm = road.to == first ? labyrinth[first].arm(road.approach) : road.from == first ? labyrinth[first].arm(road.exit) : nullptr;
    const bool leads_there = road.to == first || labyrinth[road.to].arm(road.approach)->leads_out;
    if (arm == nullptr || !leads_there) continue;
    scenario.start = labyrinth.place({first, arm}, std::min(kStartBefore, road.ends_m - road.begins_m));
    scenario.start.heading_rad += kPi;
    return scenario;
  }
  diagnostics.report(diagnostics::Kind::kSimNoWayToStart, route->declared, {landmark->name, route->name});
  return std::nullopt;
}

}  // namespace kb::sim
