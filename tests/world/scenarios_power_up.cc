// Where it is switched on.
#include <fmt/format.h>

#include <algorithm>

#include "tests/world/scenario.h"

namespace kb::world {
namespace {

Finding started_at(const Setting& setting, double before_end_m) {
  Trial t = route1(setting);
  t.at("LM1.S", t.road("LM1.S").length_m - before_end_m).go();
  return t.drove(kRoute1Way);
}

Finding woken_inside_a_crossing(const Setting& setting) {
  // It takes the exit line for a stop line, knows nothing, and stands.
  Trial t = route1(setting);
  t.world().put_in_crossing(t.world().map.landmark("LM8"), Direction::kN, Turn::kLeft, 0.3);
  t.go(600);
  const auto& faults = t.world().faults;
  const bool only_inside = std::all_of(faults.begin(), faults.end(), [](const Fault& fault) {
    return fault.what.find("inside the crossing") != std::string::npos;
  });
  return all_of({expect(t.world().way.empty(), "crossed " + t.world().way_text()),
                 only_inside ? Finding{} : t.accident(),
                 expect(t.sim().help() == "lost", "reports `" + t.sim().help() + "`, not `lost`")});
}

}  // namespace

Scenarios power_up_scenarios() {
  return {
      {"switched_on_in_the_middle_of_a_road_it_drives_route1",
       [](const Setting& setting) { return started_at(setting, 1.7); }},
      {"switched_on_on_a_stop_line_it_drives_route1", [](const Setting& setting) { return started_at(setting, 0.05); }},
      {"switched_on_inside_a_crossing_it_stands_at_the_line", woken_inside_a_crossing},
  };
}

}  // namespace kb::world
