#include "sim/mind/control_lines.h"

#include <algorithm>
#include <iterator>

#include <waymark/controllers/bind_line.h>

namespace kb::sim {

ControlLines::ControlLines(const Knowledge& knowledge) {
  for (const Strategy& strategy : knowledge.strategies) {
    std::vector<mts::ControlArgument>& arguments = arguments_.emplace_back();
    for (const Strategy::Setting& setting : strategy.settings) arguments.push_back({setting.name.c_str(), setting.word.c_str(), setting.number, setting.unit.c_str()});
    const bool has_turn = std::ranges::any_of(strategy.settings, [](const Strategy::Setting& setting) { return setting.name == "turn"; });
    if (!has_turn && !strategy.turn.empty() && mts::find_parameter(strategy.controller, "turn") != nullptr) arguments.push_back({"turn", strategy.turn.c_str(), 0.0f, ""});
    const auto entry = std::ranges::find_if(mts::kControllers, [&](const mts::ControllerEntry& one) { return one.id == strategy.controller; });
    lines_.push_back({entry != std::end(mts::kControllers) ? entry->name : mts::kRulesOfHost, arguments.data(), static_cast<std::uint32_t>(arguments.size())});
  }
}

}  // namespace kb::sim
