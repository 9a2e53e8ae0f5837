#include "tools/kbc/wire/vehicle.h"

#include <fmt/format.h>

#include <array>
#include <utility>

namespace kb::wire {
namespace {

constexpr Range kPercent{0.0, 100.0};
constexpr std::array<std::string_view, 4> kStatuses{"running", "paused", "finished", "failed"};

constexpr std::array kVehicleFields{
    Field<Vehicle>{"battery", [](Reading& reading, const Json& json, Vehicle& vehicle) { reading.number("vehicle.battery", json, kPercent, vehicle.battery_percent.emplace()); }},
    Field<Vehicle>{"charging", [](Reading& reading, const Json& json, Vehicle& vehicle) { reading.truth("vehicle.charging", json, vehicle.charging.emplace()); }},
    Field<Vehicle>{"e_stop", [](Reading& reading, const Json& json, Vehicle& vehicle) { reading.word("vehicle.e_stop", json, vda5050::kStops, vehicle.e_stop.emplace()); }},
    Field<Vehicle>{"field_violation", [](Reading& reading, const Json& json, Vehicle& vehicle) { reading.truth("vehicle.field_violation", json, vehicle.field_violation.emplace()); }},
    Field<Vehicle>{"mode", [](Reading& reading, const Json& json, Vehicle& vehicle) { reading.word("vehicle.mode", json, vda5050::kModes, vehicle.mode.emplace()); }},
};

/// An action of the list while it is read; `actions[2].` precedes the names of its fields in messages.
struct ActionDraft {
  std::string prefix;
  vda5050::HostActionState state;
};

constexpr std::array kActionFields{
    Field<ActionDraft>{"id", [](Reading& reading, const Json& json, ActionDraft& draft) { reading.text(draft.prefix + "id", json, draft.state.id); }},
    Field<ActionDraft>{"status", [](Reading& reading, const Json& json, ActionDraft& draft) { reading.word(draft.prefix + "status", json, kStatuses, draft.state.status); }},
    Field<ActionDraft>{"result", [](Reading& reading, const Json& json, ActionDraft& draft) { reading.text(draft.prefix + "result", json, draft.state.result); }},
};

}  // namespace

void read_vehicle(Reading& reading, const Json& json, Vehicle& vehicle) {
  if (reading.is("vehicle", json, Json::Kind::kObject)) read_fields<Vehicle>(reading, "vehicle.", json, kVehicleFields, vehicle);
}

void put(const Vehicle& said, vda5050::Condition& condition) {
  if (said.battery_percent) condition.battery_percent = said.battery_percent;
  condition.charging = said.charging.value_or(condition.charging);
  condition.e_stop = said.e_stop.value_or(condition.e_stop);
  condition.field_violation = said.field_violation.value_or(condition.field_violation);
  condition.mode = said.mode.value_or(condition.mode);
}

void read_actions(Reading& reading, const Json& json, std::vector<vda5050::HostActionState>& states) {
  if (!reading.is("actions", json, Json::Kind::kList)) return;
  for (std::size_t i = 0; i < json.parts.size() && !reading.mistake(); ++i) {
    const Json& part = json.parts[i];
    ActionDraft draft{fmt::format("actions[{}].", i), {}};
    if (!reading.is(fmt::format("actions[{}]", i), part, Json::Kind::kObject)) return;
    read_fields<ActionDraft>(reading, draft.prefix, part, kActionFields, draft);
    if (draft.state.id.empty()) reading.missing(draft.prefix + "id", "the answer that told of the action says it", part.span);
    if (draft.state.status.empty()) reading.missing(draft.prefix + "status", "it says how far the action is", part.span);
    states.push_back(std::move(draft.state));
  }
}

}  // namespace kb::wire
