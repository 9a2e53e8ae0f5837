// Missions begin, end, are given up, follow each other.
#include <fmt/format.h>

#include "tests/world/scenario.h"

namespace kb::world {
namespace {

constexpr std::string_view kRoute2 = "command Start2\nroute Route2 on Labyrinth by Start2: LM2 -> LM3 -> LM9\n";

Finding route1_is_driven_without_a_halt(const Setting& setting) {
  Trial t = route1(setting);
  std::string reports;
  t.disturb([&](Simulation& sim, Readings&) { reports += sim.help(); });
  t.go();
  Finding halted;
  for (const char* strategy : {"Search", "Stop", "Avoid"}) {
    if (t.sim().ever_ran(strategy)) halted = fmt::format("halted without need: {}", strategy);
  }
  return all_of({t.drove(kRoute1Way), halted, expect(reports.empty(), "reported " + reports)});
}

Finding out_of_a_dead_end(const Setting& setting) {
  Trial t(setting, labyrinth_route("LM2 -> LM5 -> LM1 -> LM5 -> LM4"));
  t.at("LM3.N").go(3000, {}, "Go");
  return t.drove("LM2.E LM5.N LM1.S LM5.E");
}

Finding nothing_left_and_standing(Trial& t) {
  const std::string left = t.left_over();
  return all_of({expect(left.empty(), "left over: " + left),
                 expect(t.sim().strategy().empty(), fmt::format("still {}", t.sim().strategy()))});
}

Finding abort_then_another_mission(const Setting& setting, const Simulation::Until& where) {
  Trial t = route1(setting, kRoute2);
  t.go(3000, where);
  t.sim().press("Abort", 3);
  t.wait(30);
  if (Finding found = nothing_left_and_standing(t); !found.empty()) return found;
  t.sim().begin_again();
  t.at("LM5.W").go(3000, {}, "Start2");
  return t.drove("LM2.S LM3.S");
}

Finding abort_in_the_tick_of_a_command(const Setting& setting) {
  Trial t = route1(setting);
  t.wait(1);
  t.sim().press("Start1");
  t.sim().press("Abort");
  t.wait(6);
  return nothing_left_and_standing(t);
}

Finding a_command_while_abort_is_held(const Setting& setting) {
  Trial t = route1(setting);
  t.wait(1);
  t.sim().press("Abort", 20);
  t.wait(5);
  t.sim().press("Start1");
  t.wait(30);
  return nothing_left_and_standing(t);
}

Finding abort_against_a_rule_of_the_user(const Setting& setting) {
  // A user's `while` rule of the same level holds a satellite up: the red button must still work.
  Trial t = route1(setting, "satellite Lamp\nfact Dark\nrule lamp at goal while Dark then +Lamp\n");
  t.disturb([](Simulation&, Readings& now) { now.set("Dark", kSure); });
  t.go(3000, [](const Simulation& sim) { return sim.world.on("LM2.S") && sim.world.position_m() > 1.0; });
  t.sim().press("Abort", 3);
  t.wait(10);
  const std::string left = t.left_over();
  return all_of({expect(left.empty() || left == "Lamp", "left over: " + left),
                 expect(t.sim().strategy().empty(), fmt::format("still {}", t.sim().strategy()))});
}

Finding a_command_during_a_mission_changes_nothing(const Setting& setting) {
  const auto mission = [&](bool disturbed) {
    Trial t = route1(setting, kRoute2);
    t.disturb([disturbed](Simulation& sim, Readings& now) {
      const int n = sim.ticks();
      if (!disturbed || sim.ended() || n <= 20 || n >= 300 || n % 37 >= 3) return;
      now.set("Start1", kSure);
      now.set("Start2", kSure);
    });
    t.go();
    return t;
  };
  Trial calm = mission(false);
  Trial shaken = mission(true);
  bool same = calm.sim().trace().size() == shaken.sim().trace().size();
  for (std::size_t i = 0; same && i < calm.sim().trace().size(); ++i) {
    const program::Tick &a = calm.sim().trace()[i].tick, &b = shaken.sim().trace()[i].tick;
    same = a.fired == b.fired && a.strategy == b.strategy && a.set == b.set;
  }
  return all_of({expect(same, "another trace"), shaken.drove(kRoute1Way)});
}

Finding a_muted_command_starts_nothing(const Setting& setting) {
  Trial t = route1(setting);
  t.wait(1);
  t.mind().poke(t.knowledge().cell("sat Start1"), -1.0f);
  t.sim().press("Start1");
  t.sim().run(30);
  return expect(!t.sim().started(), "started though `sat Start1` was low");
}

Finding two_commands_at_once_contradict_each_other(const Setting& setting) {
  Trial t = route1(setting, "command Start2\nroute Route2 on Labyrinth by Start2: LM5 -> LM4 -> LM8\n");
  t.wait(1);
  t.sim().press("Start1");
  t.sim().press("Start2");
  t.wait(31);
  if (t.sim().started()) return "one of them started";
  if (t.sim().conflicts() == 0) return "not reported";
  t.sim().begin_again();
  t.sim().press("Start1");
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Finding it_stands_after_the_end(const Setting& setting) {
  Trial t = route1(setting);
  t.go();
  const double stopped_at_m = t.world().position_m();
  t.wait(5);
  return all_of({expect(t.sim().ended(), "did not end"),
                 expect(t.sim().strategy().empty(), fmt::format("drives on ({})", t.sim().strategy())),
                 expect(t.world().position_m() == stopped_at_m, "has moved")});
}

Finding a_second_mission_follows_the_first(const Setting& setting) {
  Trial t(setting, labyrinth_route("LM5 -> LM4 -> LM8 -> LM6") +
                       "command Home\nroute H on Labyrinth by Home: LM6 -> LM3 -> LM2\n");
  t.at("LM1.S").go(3000, {}, "Go");
  const Finding first = t.drove("LM5.E LM4.S LM8.W");
  t.sim().begin_again();
  t.go(3000, {}, "Home");
  return all_of({first, t.drove("LM6.W LM3.N")});
}

Finding a_loop_road_leads_back_to_its_landmark(const Setting& setting) {
  Trial t(setting,
          "map M { landmark A landmark B landmark K\n"
          "  road A.E -- B.W by mark  road B.N -- B.E by mark  road B.S -- K.N by mark }\n"
          "command Go\nroute R on M by Go: A -> B.N -> B -> K\n");
  t.at("B.W").go(3000, {}, "Go");
  return t.drove("A.E B.N B.S");
}

Finding a_button_stuck_at_power_up_starts_nothing(const Setting& setting) {
  Trial t = route1(setting);
  t.sim().press("Start1", 50);
  t.wait(50);
  return expect(!t.sim().started(), "started by itself");
}

}  // namespace

Scenarios mission_scenarios() {
  return {
      {"route1_is_driven_without_a_halt", route1_is_driven_without_a_halt},
      {"the_way_leads_out_of_a_dead_end", out_of_a_dead_end},
      {"abort_on_the_road_then_another_mission",
       [](const Setting& setting) {
         return abort_then_another_mission(setting, [](const Simulation& sim) {
           return sim.world.on("LM2.S") && sim.world.position_m() > 1.0;
         });
       }},
      {"abort_inside_a_crossing_then_another_mission",
       [](const Setting& setting) {
         return abort_then_another_mission(setting, [](const Simulation& sim) {
           return sim.world.inside("LM3") && sim.world.position_m() > 0.4;
         });
       }},
      {"abort_in_the_tick_of_a_command_starts_nothing", abort_in_the_tick_of_a_command},
      {"a_command_while_abort_is_held_starts_nothing", a_command_while_abort_is_held},
      {"abort_works_against_a_rule_of_the_user", abort_against_a_rule_of_the_user},
      {"a_command_during_a_mission_changes_nothing", a_command_during_a_mission_changes_nothing},
      {"a_muted_command_starts_nothing", a_muted_command_starts_nothing},
      {"two_commands_at_once_contradict_each_other", two_commands_at_once_contradict_each_other},
      {"it_stands_after_the_end", it_stands_after_the_end},
      {"a_second_mission_follows_the_first", a_second_mission_follows_the_first},
      {"a_loop_road_leads_back_to_its_landmark", a_loop_road_leads_back_to_its_landmark},
      {"a_button_stuck_at_power_up_starts_nothing", a_button_stuck_at_power_up_starts_nothing},
  };
}

}  // namespace kb::world
