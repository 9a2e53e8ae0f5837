// Closed roads: detours written by hand, and planned by the compiler.
#include <fmt/format.h>

#include "tests/world/scenario.h"

namespace kb::world {
namespace {

constexpr std::string_view kDetour = "detour LM7 -> LM11 -> LM13 when Closed[exit]\n";
constexpr std::string_view kPlanned = "detours on Route1\n";
constexpr std::string_view kDetourWay = "LM5.W LM2.S LM3.E LM6.S LM7.S LM11.E LM13.E";

/// M0..M5 in a row; from M1 a way round over V1..Vn to M(1+k); for k > 1, V1 also has a road to M2, which must not
/// tempt.
std::string map_with_a_way_round(int n, int k) {
  std::string text = "map M {\n";
  for (int i = 0; i < 6; ++i) text += fmt::format("  landmark M{0} at ({0}, 0)\n", i);
  for (int i = 1; i <= n; ++i) text += fmt::format("  landmark V{0} at ({0}, -1)\n", i);
  for (int i = 0; i < 5; ++i) text += fmt::format("  road M{}.E -- M{}.W by mark\n", i, i + 1);
  text += "  road M1.S -- V1.N by mark\n";
  for (int i = 1; i < n; ++i) text += fmt::format("  road V{}.E -- V{}.W by mark\n", i, i + 1);
  text += fmt::format("  road V{}.E -- M{}.S by mark\n", n, 1 + k);
  if (k > 1) text += "  road V1.S -- M2.N by mark\n";
  return text + "}\ncommand Go\nroute R on M by Go: M0 -> M1 -> M2 -> M3 -> M4 -> M5\n";
}

Finding detour_over(const Setting& setting, int n, int k) {
  std::string detour = "detour M1";
  std::string way = "M0.E M1.S";
  for (int i = 1; i <= n; ++i) {
    detour += fmt::format(" -> V{}", i);
    way += fmt::format(" V{}.E", i);
  }
  for (int i = 1 + k; i < 5; ++i) way += fmt::format(" M{}.E", i);
  Trial t(setting, map_with_a_way_round(n, k) + detour + fmt::format(" -> M{} when Closed[exit]\n", 1 + k));
  t.road("M1.E").closed = true;
  t.at("M1.W").go(3000, {}, "Go");
  return t.drove(way);
}

Finding route1_round(const Setting& setting, std::string_view declarations, std::initializer_list<const char*> closed,
                     std::string_view way, WorldOptions options = {}, Simulation::Disturbance disturbance = {}) {
  Trial t = route1(setting, declarations, options);
  for (const char* edge : closed) t.road(edge).closed = true;
  if (disturbance) t.disturb(std::move(disturbance));
  t.go(6000);
  return t.drove(way);
}

/// Signs are seen only from the line on.
void signs_on_the_line_only(Simulation& sim, Readings& now) {
  const World& world = sim.world;
  if (!world.on_road() || world.on_entry_line() || world.position_m() <= 0.3) return;
  now.landmark[index(world.map[world.on_road()->edge].to)] = -1.0f;
}

/// One closure or pair of closures on Route1: the robot arrives by some way, or stands and reports.
Finding arrives_or_reports(const Setting& setting, const char* first, const char* second) {
  Trial t = route1(setting, kPlanned);
  t.road(first).closed = t.road(second).closed = true;
  t.go(4000);
  if (!t.sim().ended()) return all_of({t.accident(), expect(!t.sim().help().empty(), "stands and says nothing")});
  const std::string way = t.world().way_text();
  return all_of({t.drove(way), expect(way.starts_with("LM5."), "did not begin at LM5"),
                 expect(t.world().heads_for("LM15"), "did not arrive at LM15")});
}

Finding planned_detours_for_every_pair_of_closures(const Setting& setting) {
  constexpr const char* kRoads[] = {"LM5.W", "LM2.S", "LM3.E", "LM6.S", "LM7.E", "LM13.E"};
  for (std::size_t i = 0; i < std::size(kRoads); ++i) {
    for (std::size_t j = i; j < std::size(kRoads); ++j) {
      const Finding found = arrives_or_reports(setting, kRoads[i], kRoads[j]);
      if (!found.empty()) return fmt::format("{} and {} closed: {}", kRoads[i], kRoads[j], found);
    }
  }
  return {};
}

Finding a_planned_detour_that_is_closed_itself(const Setting& setting) {
  Trial t = route1(setting, kPlanned);
  t.road("LM7.E").closed = t.road("LM11.E").closed = true;
  t.go(5000);
  return all_of({t.drove(t.world().way_text()), expect(t.world().heads_for("LM15"), "did not arrive at LM15")});
}

constexpr std::string_view kThreeDetours =
    "detour LM7 -> LM11 -> LM13 when Closed[exit]\n"
    "detour LM11 -> LM7 -> LM6 -> LM8 -> LM12 -> LM14 -> LM15 -> LM13 when Closed[exit]\n"
    "detour LM7 -> LM9 -> LM10 -> LM11 -> LM13 when Closed[exit]\n";

Finding a_detour_for_the_detour_and_a_second_choice(const Setting& setting) {
  return all_of({
      route1_round(setting, kThreeDetours, {"LM7.E", "LM11.E"},
                   "LM5.W LM2.S LM3.E LM6.S LM7.S LM11.N LM7.N LM6.E LM8.E LM12.S LM14.S LM15.W LM13.E"),
      route1_round(setting, kThreeDetours, {"LM7.E", "LM7.S"},
                   "LM5.W LM2.S LM3.E LM6.S LM7.W LM9.S LM10.E LM11.E LM13.E"),
  });
}

Finding an_occupied_crossing_on_the_detour(const Setting& setting) {
  Trial t = route1(setting, kDetour);
  t.road("LM7.E").closed = true;
  t.landmark("LM11").safe = false;
  t.disturb([waited = 0](Simulation& sim, Readings&) mutable {
    waited += sim.world.heads_for("LM11");
    if (waited > 150) sim.world.map[sim.world.map.landmark("LM11")].safe = true;
  });
  t.go(5000);
  return t.drove(kDetourWay);
}

Finding a_road_opens_while_it_waits(const Setting& setting) {
  Trial t = route1(setting);
  t.road("LM3.E").closed = true;
  std::string reports;
  t.disturb([&reports, waited = 0](Simulation& sim, Readings&) mutable {
    if (const std::string help = sim.help(); !help.empty() && reports.find(help) == std::string::npos) reports += help;
    waited += sim.world.heads_for("LM3");
    if (waited > 400) sim.world.map.road(sim.world.map.edge("LM3.E")).closed = false;
  });
  t.go(4000);
  return all_of({t.drove(kRoute1Way), expect(reports == "refused", "reported `" + reports + "`, not `refused`")});
}

Finding a_closure_behind_it_is_no_matter(const Setting& setting) {
  Trial t = route1(setting);
  t.disturb([](Simulation& sim, Readings&) {
    if (sim.world.on("LM3.E") && sim.world.position_m() > 1.0)
      sim.world.map.road(sim.world.map.edge("LM3.E")).closed = true;
  });
  t.go();
  return t.drove(kRoute1Way);
}

Finding a_road_that_stays_blocked_is_left_backwards(const Setting& setting) {
  Trial t = route1(setting, "import std.retreat\ndetours on Route1\n");
  t.road("LM7.E").length_m = 6.0;
  t.block("LM7.E", 3.0, false);
  t.go(6000);
  return t.drove("LM5.W LM2.S LM3.E LM6.S LM7.E LM7.S LM11.E LM13.E");
}

void closures_flicker(Simulation& sim, Readings& now) {
  if (now.line <= 0.5f && !(sim.world.to_end_m() < kSignBefore)) return;
  now.closed.fill(sim.ticks() / 3 % 3 != 0 ? kSure : kSureNot);
}

const char* landmarks(int n) {
  constexpr const char* kWords[] = {"one_landmark", "two_landmarks", "three_landmarks"};
  return kWords[n - 1];
}

const char* stops(int n) {
  constexpr const char* kWords[] = {"one_stop", "two_stops", "three_stops"};
  return kWords[n - 1];
}

}  // namespace

Scenarios detour_scenarios() {
  Scenarios scenarios;
  scenarios.push_back({"a_skipped_goal_offers_no_exit_on_the_way_round",
                       [](const Setting& setting) { return detour_over(setting, 2, 2); }});
  for (int n = 1; n <= 3; ++n) {
    for (int k = 1; k <= 3; ++k) {
      scenarios.push_back({fmt::format("a_detour_over_{}_rejoins_{}_further_on", landmarks(n), stops(k)),
                           [n, k](const Setting& setting) { return detour_over(setting, n, k); }});
    }
  }
  const Scenarios others{
      {"planned_detours_serve_every_pair_of_closures", planned_detours_for_every_pair_of_closures},
      {"a_planned_detour_may_be_closed_itself", a_planned_detour_that_is_closed_itself},
      {"the_detour_of_the_experiment",
       [](const Setting& setting) { return route1_round(setting, kDetour, {"LM7.E"}, kDetourWay); }},
      {"a_detour_has_a_detour_and_a_second_choice", a_detour_for_the_detour_and_a_second_choice},
      {"an_occupied_crossing_on_the_detour_is_not_entered", an_occupied_crossing_on_the_detour},
      {"a_closure_that_is_learned_on_the_line_only",
       [](const Setting& setting) {
         return route1_round(setting, kDetour, {"LM7.E"}, kDetourWay, {ArrivalSeen::kAtSign, MemoryRead::kOnLine});
       }},
      {"sign_line_and_closure_come_in_one_tick",
       [](const Setting& setting) {
         return route1_round(setting, kDetour, {"LM7.E"}, kDetourWay, {ArrivalSeen::kOnLine, MemoryRead::kOnLine},
                             signs_on_the_line_only);
       }},
      {"a_road_that_opens_while_it_waits_is_taken", a_road_opens_while_it_waits},
      {"a_road_that_closes_behind_it_is_no_matter", a_closure_behind_it_is_no_matter},
      {"a_road_that_stays_blocked_is_left_backwards", a_road_that_stays_blocked_is_left_backwards},
      {"a_detour_for_another_reason_speaks_before_the_crossing",
       [](const Setting& setting) {
         return route1_round(setting, "fact Festival\ndetour LM7 -> LM11 -> LM13 when Festival\n", {}, kDetourWay,
                             {ArrivalSeen::kOnLine, MemoryRead::kOnLine}, [](Simulation& sim, Readings& now) {
                               now.set("Festival", 1.0f);
                               signs_on_the_line_only(sim, now);
                             });
       }},
      {"closures_that_flicker_only_delay_it",
       [](const Setting& setting) { return route1_round(setting, "", {}, kRoute1Way, {}, closures_flicker); }},
  };
  scenarios.insert(scenarios.end(), others.begin(), others.end());
  return scenarios;
}

}  // namespace kb::world
