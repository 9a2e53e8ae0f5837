// What a vehicle says besides its senses: its battery, what stops it, and how far the actions are that it was told to do.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/kbc/vda5050/condition.h"
#include "tools/kbc/wire/fields.h"

namespace kb::wire {

/// Of the base, as vda5050::Condition has it. Nothing: the line does not speak of it.
struct Vehicle {
  std::optional<double> battery_percent = {};
  std::optional<bool> charging = {}, field_violation = {};
  std::optional<std::string> e_stop = {}, mode = {};
};

/// Of one action.
struct ActionWord {
  std::string id, status;        ///< `running`, `paused`, `finished` or `failed`
  std::string result;            ///< for who ordered it; may be empty
  source::Span id_at{};          ///< where the id stands, which is not looked up here
};

/// The value of the field `vehicle`.
void read_vehicle(Reading& reading, const Json& json, Vehicle& vehicle);
/// What a line says changes what was known; all else stays.
void put(const Vehicle& said, vda5050::Condition& condition);
/// The value of the field `actions`: a list of objects, each with an id and a status.
void read_actions(Reading& reading, const Json& json, std::vector<ActionWord>& words);

}  // namespace kb::wire
