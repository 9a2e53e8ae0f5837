// A vehicle's reports besides its senses: its battery, what stops it, and the progress of its actions.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/kbc/vda5050/condition.h"
#include "tools/kbc/wire/fields.h"

namespace kb::wire {

/// The state of the base, as in vda5050::Condition. Nothing: not in the line.
struct Vehicle {
  std::optional<double> battery_percent = {};
  std::optional<bool> charging = {}, field_violation = {};
  std::optional<std::string> e_stop = {}, mode = {};
};

/// Reads the value of the field `vehicle`.
void read_vehicle(Reading& reading, const Json& json, Vehicle& vehicle);
/// Updates what was known by what a line says; all else stays.
void put(const Vehicle& said, vda5050::Condition& condition);
/// Reads the value of the field `actions`: a list of objects, each with an id and a status.
void read_actions(Reading& reading, const Json& json, std::vector<vda5050::HostActionState>& states);

}  // namespace kb::wire
