// Makes the scenario of a drive for which none is given: a command is pressed, and nothing is done to the robot.
#include <algorithm>

#include "sim/scenario/names.h"
#include "sim/scenario/plain.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr double kPressAt = 1.0;      // s
// m, times the floor's size
constexpr double kStartBefore = 1.2;  // before the stop line of the first landmark
constexpr double kFromBend = 0.30;    // nearer to a bend the robot would stand neither on the line nor in the middle between the walls
constexpr double kShortest = 0.20;    // a last straight stretch that is shorter is too short to start on

/// How far before the stop line of an arm the robot begins: on the last straight stretch of the road, unless that is too short.
double start_before_m(const Labyrinth& labyrinth, const Arm& arm) {
  const std::vector<Spot> chain = labyrinth.course(arm);   // from the stop line
  const double wanted_m = std::min(labyrinth.size * kStartBefore, length_of(chain)), straight_m = distance(chain[0], chain[1]) - labyrinth.size * kFromBend;
  return chain.size() == 2 || straight_m < labyrinth.size * kShortest ? wanted_m : std::min(wanted_m, straight_m);
}

}  // namespace

const model::Row* first_route(const model::Model& model) {
  const auto routes = model.rows_of("Route");
  return routes.empty() ? nullptr : &model[routes.front()];
}

std::optional<Scenario> unplaced_scenario(const Knowledge& knowledge, const model::Model& model, diagnostics::Diagnostics& diagnostics, MissionsBy by) {
  const model::Row* route = first_route(model);
  const auto* command = route != nullptr ? model.row_in(*route, "command") : nullptr;
  Scenario scenario;
  if (route == nullptr && by == MissionsBy::kDriver) {
    scenario.open_end = true;
    return scenario;
  }
  if (command == nullptr || begin_of(model, *route) == nullptr) {
    diagnostics.report(diagnostics::Kind::kSimNoRoute, {});
    return std::nullopt;
  }
  scenario.title = "a drive without a scenario";   // whether something goes wrong is not known yet
  Event press;
  press.when.time_s = kPressAt;
  press.action.kind = Action::Kind::kPress;
  press.action.cell = knowledge.find(command->name);
  press.text = std::string(command->name) + " pressed";
  scenario.events.push_back(std::move(press));
  return scenario;
}

std::optional<Pose> start_before(const model::Row& route, const Labyrinth& labyrinth, const model::Model& model,
                                 diagnostics::Diagnostics& diagnostics) {
  const std::string_view landmark = begin_of(model, route)->name;
  const CrossingId first = labyrinth.crossing(landmark);
  for (const Road& road : labyrinth.roads) {   // the first road that leads there, in the order of the map
    const Arm* arm = road.to == first ? labyrinth[first].arm(road.approach) : road.from == first ? labyrinth[first].arm(road.exit) : nullptr;
    const bool leads_there = road.to == first || labyrinth[road.to].arm(road.approach)->leads_out;
    if (arm == nullptr || !leads_there) continue;
    Pose start = labyrinth.place({first, arm}, start_before_m(labyrinth, *arm));
    start.heading_rad += kPi;
    return start;
  }
  diagnostics.report(diagnostics::Kind::kSimNoWayToStart, route.declared, {landmark, route.name});
  return std::nullopt;
}

std::optional<Scenario> plain_scenario(const Labyrinth& labyrinth, const Knowledge& knowledge, const model::Model& model,
                                       diagnostics::Diagnostics& diagnostics, MissionsBy by) {
  auto scenario = unplaced_scenario(knowledge, model, diagnostics, by);
  if (!scenario) return std::nullopt;
  if (scenario->open_end) {
    diagnostics.report(diagnostics::Kind::kSimMissing, {}, {"a drive without a route", "--scenario` with `[start]"});
    return std::nullopt;
  }
  const auto start = start_before(*first_route(model), labyrinth, model, diagnostics);
  if (!start) return std::nullopt;
  scenario->start = *start;
  return scenario;
}

}  // namespace kb::sim
