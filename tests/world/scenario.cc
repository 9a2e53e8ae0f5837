#include "tests/world/scenario.h"

namespace kb::world {

Scenarios all_scenarios() {
  Scenarios all;
  for (const auto theme : {mission_scenarios, detour_scenarios, obstacle_scenarios, localisation_scenarios,
                           road_scenarios, power_up_scenarios, semantics_scenarios}) {
    const Scenarios some = theme();
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace kb::world
