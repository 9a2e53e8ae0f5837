// `--expect arrived>=95%,collisions=0` of commands that count runs.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/demands.h"

namespace kb::cli {

class Session;

/// The demands, none if the text is empty. Nothing (reported) if it cannot be read.
[[nodiscard]] std::optional<std::vector<sim::batch::Demand>> expected_counts(const std::string& text, std::span<const std::string_view> names, Session& session);

}  // namespace kb::cli
