// Things in the way, on roads and inside crossings.
#include <fmt/format.h>

#include <algorithm>

#include "tests/world/scenario.h"

namespace kb::world {
namespace {

/// Route1 with the road LM2 -> LM3 six metres long.
Trial long_road(const Setting& setting) {
  Trial t = route1(setting);
  t.road("LM2.S").length_m = 6.0;
  return t;
}

Finding inside_a_crossing(const Setting& setting) {
  Trial t = route1(setting);
  t.landmark("LM2").obstacles = {{0.45, {}, true}};
  t.go();
  return t.drove(kRoute1Way);
}

Finding on_a_road(const Setting& setting) {
  Trial t = long_road(setting);
  t.block("LM2.S", 3.0);
  t.go();
  return t.drove(kRoute1Way);
}

Finding marking_in_sight_all_the_way_round(const Setting& setting) {
  Trial t = long_road(setting);
  t.block("LM2.S", 3.0);
  t.disturb([](Simulation& sim, Readings& now) {
    now.track[index(Method::kMark)] = kSure;
    sim.world.aside = false;
    const bool open_road = sim.world.on_road() && sim.world.position_m() > 0.3 && sim.world.to_end_m() > 0.3;
    if (open_road) now.cross_by[index(Method::kMark)] = kSure;  // "the marking is found"
  });
  t.go();
  return t.drove(kRoute1Way);
}

Finding on_a_road_by_walls(const Setting& setting) {
  Trial t(setting, labyrinth_route("LM7 -> LM11 -> LM13"));
  t.at("LM6.S").road("LM7.S").length_m = 6.0;
  t.block("LM7.S", 3.0);
  t.go(3000, {}, "Go");
  return t.drove("LM7.S LM11.E");
}

Finding on_a_road_without_end(const Setting& setting) {
  Trial t = long_road(setting);
  t.block("LM2.S", 3.0, false);
  t.go(1200);
  const Finding stood =
      all_of({t.accident(), expect(t.sim().strategy() == "Stop", "does not stand"),
              expect(t.sim().help() == "blocked", "reports `" + t.sim().help() + "`, not `blocked`")});
  if (!stood.empty()) return stood;
  t.road("LM2.S").obstacles.clear();
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Finding just_before_the_stop_line(const Setting& setting) {
  Trial t = route1(setting);
  t.block("LM2.S", t.road("LM2.S").length_m - 0.15);
  t.go();
  const LandmarkId lm3 = t.world().map.landmark("LM3");
  const auto& trace = t.sim().trace();
  const bool avoided_inside = std::any_of(trace.begin(), trace.end(), [&](const Simulation::Step& step) {
    const auto* in = std::get_if<InCrossing>(&step.pose);
    return in && in->landmark == lm3 && t.sim().strategy_name(step.tick.strategy) == "Avoid";
  });
  return all_of({t.drove(kRoute1Way), expect(!avoided_inside, "took the avoidance into the crossing")});
}

Finding just_behind_the_exit_line(const Setting& setting) {
  Trial t = route1(setting);
  t.block("LM2.S", 0.1);
  t.go();
  return t.drove(kRoute1Way);
}

Finding sight_of_it_flickers(const Setting& setting) {
  Trial t = long_road(setting);
  t.block("LM2.S", 3.0);
  t.landmark("LM3").obstacles = {{0.45, {}, true}};
  t.disturb([](Simulation& sim, Readings& now) {
    if (sim.ticks() % 3 == 0) now.obstacle = -1.0f;
  });
  t.go();
  return t.drove(kRoute1Way);
}

Finding without_end_and_flickering(const Setting& setting) {
  Trial t = long_road(setting);
  t.block("LM2.S", 3.0, false);
  t.disturb([](Simulation& sim, Readings& now) {
    if (sim.ticks() % 9 == 0) now.obstacle = -1.0f;
  });
  t.go(1500);
  if (t.sim().ended()) return "ended, though nobody can pass";
  const auto& trace = t.sim().trace();
  const bool stands = std::all_of(trace.end() - 600, trace.end(), [&](const Simulation::Step& step) {
    return t.sim().strategy_name(step.tick.strategy) == "Stop";
  });
  return all_of({t.accident(), expect(stands, "did not stand still")});
}

Finding an_occupied_crossing(const Setting& setting) {
  Trial t = route1(setting);
  t.landmark("LM3").safe = false;
  t.disturb([waited = 0](Simulation& sim, Readings&) mutable {
    waited += sim.world.heads_for("LM3") && sim.world.on_entry_line();
    if (waited > 60 || sim.ticks() > 700) sim.world.map[sim.world.map.landmark("LM3")].safe = true;
  });
  t.go();
  return t.drove(kRoute1Way);
}

}  // namespace

Finding obstacle_in_a_crossing_without_end(const Setting& setting, int patience_ticks) {
  Trial t = route1(setting);
  t.landmark("LM2").obstacles = {{0.45, {}, false}};
  t.go(patience_ticks);
  const std::string_view strategy = t.sim().strategy();
  const Finding stood =
      all_of({t.accident(), expect(strategy == "Stop", fmt::format("runs `{}`, not `Stop`", strategy)),
              expect(!t.sim().help().empty(), "says nothing")});
  if (!stood.empty()) return stood;
  t.landmark("LM2").obstacles.clear();
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Finding touched(const Setting& setting) {
  // What its range finders do not see it feels: it stands, says so, and goes on when it is gone.
  Trial t = long_road(setting);
  t.disturb([ticks = 0](Simulation& sim, Readings& now) mutable {
    if (sim.world.on("LM2.S") && sim.world.position_m() > 3.0 && ++ticks < 100) now.set("Touched", kSure);
  });
  t.go(3000, [](const Simulation& sim) { return sim.world.on("LM2.S") && sim.world.position_m() > 3.0; });
  t.wait(50);
  const Finding stood = all_of({t.accident(), expect(t.sim().strategy() == "Stop", "does not stand"),
                                expect(t.sim().help() == "blocked", "reports `" + t.sim().help() + "`, not `blocked`")});
  if (!stood.empty()) return stood;
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Finding met_again_and_again(const Setting& setting) {
  // Seen for a second, gone for half of one, and so on: going round it never lasts, and neither does the crossing.
  Trial t = route1(setting);
  t.landmark("LM2").obstacles = {{0.45, {}, false}};
  t.disturb([](Simulation& sim, Readings& now) {
    if (now.obstacle > 0.0f && sim.ticks() % 15 >= 10) now.obstacle = -1.0f;
  });
  t.go(1000);
  return expect(t.sim().help() == "blocked", "reports `" + t.sim().help() + "`, not `blocked`");
}

Scenarios obstacle_scenarios() {
  return {
      {"an_obstacle_inside_a_crossing_is_passed", inside_a_crossing},
      {"an_obstacle_in_a_crossing_that_never_ends_is_reported",
       [](const Setting& setting) { return obstacle_in_a_crossing_without_end(setting, 1500); }},
      {"an_obstacle_on_a_road_is_passed", on_a_road},
      {"an_obstacle_is_passed_with_the_marking_in_sight", marking_in_sight_all_the_way_round},
      {"an_obstacle_on_a_road_by_walls_is_passed", on_a_road_by_walls},
      {"an_obstacle_on_a_road_that_never_ends_is_reported", on_a_road_without_end},
      {"an_obstacle_just_before_the_stop_line_ends_there", just_before_the_stop_line},
      {"an_obstacle_just_behind_the_exit_line_is_passed", just_behind_the_exit_line},
      {"an_obstacle_whose_sight_flickers_is_passed", sight_of_it_flickers},
      {"an_endless_obstacle_whose_sight_flickers_is_endless", without_end_and_flickering},
      {"an_occupied_crossing_is_waited_for", an_occupied_crossing},
      {"what_it_touches_unseen_it_does_not_push", touched},
      {"what_it_meets_again_and_again_in_a_crossing_is_reported", met_again_and_again},
  };
}

}  // namespace kb::world
