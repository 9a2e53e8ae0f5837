// The scenarios that a faithful system must get right, as data: a name that is a sentence, and what to do.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/world/trial.h"

namespace kb::world {

struct Scenario {
  std::string name;   ///< a sentence in snake_case; unique
  std::function<Finding(const Setting&)> run;
};
using Scenarios = std::vector<Scenario>;

// One list a theme, one file a list.
[[nodiscard]] Scenarios mission_scenarios();       ///< missions begin, end, are given up, follow each other
[[nodiscard]] Scenarios detour_scenarios();        ///< closed roads, by hand and planned
[[nodiscard]] Scenarios obstacle_scenarios();      ///< things in the way, on roads and inside crossings
[[nodiscard]] Scenarios localisation_scenarios();  ///< signs and roads of arrival: late, weak, alike, missing
[[nodiscard]] Scenarios road_scenarios();          ///< tracks and stop lines
[[nodiscard]] Scenarios power_up_scenarios();      ///< where and how it is switched on
[[nodiscard]] Scenarios semantics_scenarios();     ///< attention, thresholds, periods, bad values

// Two of them can be had shorter: `patience_ticks` is for how long the robot is left to its trouble.
[[nodiscard]] Finding obstacle_in_a_crossing_without_end(const Setting& setting, int patience_ticks);
[[nodiscard]] Finding weak_sign_and_unknown_arrival(const Setting& setting, int patience_ticks);

/// All of them, theme by theme.
[[nodiscard]] Scenarios all_scenarios();

}  // namespace kb::world
