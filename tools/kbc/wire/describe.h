// The description that a host can read before it drives.
#pragma once

#include <string>

#include "sim/mind/knowledge.h"
#include "sim/scenario/scenario.h"
#include "sim/world/labyrinth.h"
#include "tools/kbc/wire/exchange.h"

namespace kb::wire {

/// JSON: the fields of a line, the facts and who gives them, buttons, landmarks with their exits, the robot, and times.
[[nodiscard]] std::string describe(const sim::Knowledge& knowledge, const sim::Labyrinth& labyrinth, const sim::Scenario& robot, const ExchangeOptions& options);

}  // namespace kb::wire
