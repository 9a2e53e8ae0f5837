// Certainties in JSON.
#pragma once

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kb::trace {

/// The number with the digits that distinguish it as a float, not as the double that it would widen to.
[[nodiscard]] inline nlohmann::ordered_json json_number(float value) { return nlohmann::ordered_json::parse(fmt::format("{}", value)); }

}  // namespace kb::trace
