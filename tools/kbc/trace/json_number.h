// Certainties in JSON.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace kb::trace {

/// The number with the digits that distinguish it as a float, not as the double that it would widen to. JSON has no NaN and no infinities: they are
/// texts.
[[nodiscard]] inline nlohmann::ordered_json json_number(float value) {
  std::string digits = fmt::format("{}", value);
  return std::isfinite(value) ? nlohmann::ordered_json::parse(digits) : nlohmann::ordered_json(std::move(digits));
}

}  // namespace kb::trace
