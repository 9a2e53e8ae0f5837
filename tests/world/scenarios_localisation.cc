// Signs and roads of arrival: late, weak, alike, missing, denied.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "tests/world/dice.h"
#include "tests/world/scenario.h"

namespace kb::world {
namespace {

constexpr std::array<std::string_view, 7> kStops{"LM5", "LM2", "LM3", "LM6", "LM7", "LM13", "LM15"};

float& sign(const Simulation& sim, Readings& now, std::string_view landmark) {
  return now.landmark[index(sim.world.map.landmark(landmark))];
}

/// The sign that the robot drives to; it must be on a road.
float& sign_ahead(const World& world, Readings& now) {
  return now.landmark[index(world.map[world.on_road()->edge].to)];
}

Finding route1_with(const Setting& setting, Simulation::Disturbance disturbance, WorldOptions options = {}) {
  Trial t = route1(setting, "", options);
  t.disturb(std::move(disturbance));
  t.go();
  return t.drove(kRoute1Way);
}

Finding no_exit_is_left_over_from_an_unknown_arrival(const Setting& setting) {
  // The road of arrival is not known at LM2: nothing may be crossed there; when it is known, LM2 is left by S.
  Trial t = route1(setting);
  t.disturb([waited = 0, hidden = true](Simulation& sim, Readings& now) mutable {
    if (!sim.world.heads_for("LM2")) return;
    if (sim.world.on_entry_line()) hidden = ++waited < 60;
    if (hidden) now.in.fill(0.0f);
  });
  t.go();
  return all_of({t.drove(kRoute1Way), expect(t.sim().ever_ran("Search"), "did not search")});
}

/// Whenever the sign of a stop is in view, so are (.8) those of the stops before and after it.
Simulation::Disturbance neighbours_look_alike(double miss) {
  return [dice = Dice(5), miss](Simulation& sim, Readings& now) mutable {
    for (std::size_t i = 0; i < kStops.size(); ++i) {
      if (sign(sim, now, kStops[i]) <= 0.84f) continue;
      sign(sim, now, kStops[i]) = dice.chance(miss) ? -1.0f : 0.85f;
      for (const std::size_t j : {i - 1, i + 1}) {  // i - 1 wraps round for the first
        if (j >= kStops.size()) continue;
        float& other = sign(sim, now, kStops[j]);
        other = std::max(other, dice.chance(miss) ? -1.0f : 0.8f);
      }
    }
  };
}

void others_look_alike(Simulation&, Readings& now) {
  const std::size_t n = now.landmark.size();
  for (std::size_t i = 0; i < n; ++i) {
    if (now.landmark[i] <= 0.5f) continue;
    now.landmark[i] = 0.85f;
    float& other = now.landmark[(i + 2) % n];
    other = std::max(other, 0.8f);
  }
}

Finding a_sign_seen_again(const Setting& setting) {
  Trial t(setting, labyrinth_route("LM2 -> LM5 -> LM2 -> LM3"));
  t.at("LM3.N").disturb([](Simulation& sim, Readings& now) {
    if (sim.ticks() % 4 == 0) std::fill(now.landmark.begin(), now.landmark.end(), -1.0f);
  });
  t.go(3000, {}, "Go");
  return t.drove("LM2.E LM5.W LM2.S");
}

void later_landmarks_seem_in_view(Simulation& sim, Readings& now) {
  const auto& way = sim.world.way;
  if (!way.empty()) {
    const std::string& last = sim.world.map[way.back().landmark].name;
    if (last == "LM5" || last == "LM2" || last == "LM3" || last == "LM6") sign(sim, now, "LM7") = kSure;
  }
  if (sim.ticks() == 40) sign(sim, now, "LM13") = kSure;
}

/// The sign ahead is seen only when the robot has stood on the line for `ticks` ticks; `but_for` is seen as always.
Simulation::Disturbance sign_comes_after_the_line(int ticks, std::string_view but_for) {
  return [on_line = 0, ticks, but_for](Simulation& sim, Readings& now) mutable {
    if (!sim.world.on_road()) return;
    on_line = sim.world.on_entry_line() ? on_line + 1 : 0;
    const bool hidden = on_line < ticks && sim.world.position_m() > 0.3 && !sim.world.heads_for(but_for);
    if (hidden) sign_ahead(sim.world, now) = -1.0f;
  };
}

Finding a_sign_half_a_second_after_the_line(const Setting& setting) {
  Trial t = route1(setting, "", {ArrivalSeen::kOnLine});
  t.disturb(sign_comes_after_the_line(6, "LM15"));
  t.go();
  return all_of({t.drove(kRoute1Way), expect(!t.sim().ever_ran("Search"), "searched without need")});
}

/// Signs are not seen from inside their crossing; the next one is, far off; and the compass turns with the robot.
void next_sign_in_view_inside_the_crossing(Simulation& sim, Readings& now) {
  const InCrossing* here = sim.world.in_crossing();
  if (!here) return;
  now.landmark[index(here->landmark)] = -1.0f;
  const auto stop = std::find(kStops.begin(), kStops.end(), sim.world.map[here->landmark].name);
  if (stop != kStops.end() && stop + 1 != kStops.end() && stop[1] != "LM15") sign(sim, now, stop[1]) = kSure;
  now.in.fill(0.0f);
  now.in[static_cast<std::size_t>(sim.ticks()) % 4] = kSure;
}

Finding two_roads_of_arrival(const Setting& setting) {
  // The compass says N and E for a while, both high: nothing may be crossed until it is one.
  Trial t = route1(setting);
  t.disturb([seen = 0](Simulation& sim, Readings& now) mutable {
    if (!sim.world.heads_for("LM3") || sim.world.to_end_m() >= kSignBefore || ++seen >= 60) return;
    now.in[index(Direction::kN)] = 0.8f;
    now.in[index(Direction::kE)] = 0.75f;
  });
  t.go();
  const bool reported = t.sim().conflicts() > 0;
  t.sim().forget_conflicts();
  return all_of({expect(reported, "the contradiction was not reported"), t.drove(kRoute1Way)});
}

Finding a_missing_sign(const Setting& setting) {
  Trial t = route1(setting);
  t.disturb([](Simulation& sim, Readings& now) { sign(sim, now, "LM3") = -1.0f; });
  t.go(1500);
  const std::string way = t.world().way_text();
  const std::string_view strategy = t.sim().strategy();
  return all_of({t.accident(), expect(way == "LM5.W LM2.S", "drove `" + way + "`"),
                 expect(t.sim().help() == "lost", "reported `" + t.sim().help() + "`, not `lost`"),
                 expect(strategy.empty() || strategy == "Stop" || strategy == "Search", "does not stand")});
}

Finding carried_away_on_the_road(const Setting& setting) {
  // From LM2-LM3 to LM4-LM8: it must not cross LM8 by the plan for LM3; carried back, it goes on.
  Trial t = route1(setting);
  t.go(3000, [](const Simulation& sim) { return sim.world.on("LM2.S") && sim.world.position_m() > 1.0; });
  t.at("LM4.S", 0.8).sim().run(900);
  const Finding stood = all_of({t.accident(), expect(t.sim().help() == "lost", "reported `" + t.sim().help() + "`"),
                                expect(!t.sim().strategy().starts_with("Move"), "drives on")});
  if (!stood.empty()) return stood;
  t.at("LM2.S", 1.0).wait(5);
  t.sim().press("Resume");
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Finding carried_away_after_the_sign(const Setting& setting) {
  // Between the sign of LM3 and its line: one crossing by the plan for LM3 cannot be helped, a second one can.
  Trial t = route1(setting);
  t.go(3000, [](const Simulation& sim) { return sim.world.on("LM2.S") && sim.world.to_end_m() < 0.5; });
  t.at("LM4.S", 1.0).sim().run(900);
  return all_of({expect(t.world().way.size() <= 3, "drove on blindly: " + t.world().way_text()),
                 expect(t.sim().help() == "lost", "reported `" + t.sim().help() + "`, not `lost`")});
}

/// The memory of a landmark can be read only when the robot has stood on its line for a while.
Simulation::Disturbance memory_is_read_late() {
  return [on_line = 0](Simulation& sim, Readings& now) mutable {
    on_line = sim.world.on_entry_line() ? on_line + 1 : 0;
    if (on_line == 0 || on_line >= 15) return;
    now.cross_by[index(Method::kMark)] = 0.0f;
    now.safe = 0.0f;
  };
}

void signs_are_seen_on_the_line_only(Simulation& sim, Readings& now) {
  if (sim.world.on_road() && sim.world.position_m() > 0.3 && !sim.world.on_entry_line())
    sign_ahead(sim.world, now) = -1.0f;
}

/// Route1 with a disturbance, as a scenario of its own.
Scenario disturbed(std::string name, Simulation::Disturbance disturbance, WorldOptions options = {}) {
  return {std::move(name), [disturbance = std::move(disturbance), options](const Setting& setting) {
            return route1_with(setting, disturbance, options);
          }};
}

}  // namespace

Finding weak_sign_and_unknown_arrival(const Setting& setting, int patience_ticks) {
  Trial t = route1(setting);
  bool weak = true;
  t.disturb([&weak](Simulation& sim, Readings& now) {
    if (!weak || !sim.world.heads_for("LM2")) return;
    sign(sim, now, "LM2") = std::min(sign(sim, now, "LM2"), 0.3f);
    now.in.fill(0.0f);
  });
  t.go(patience_ticks);
  const std::string way = t.world().way_text();
  const Finding stood = all_of({t.accident(), expect(way == "LM5.W", "drove `" + way + "`, not `LM5.W`"),
                                expect(t.sim().ever_ran("Search"), "did not search"),
                                expect(t.sim().help() == "lost", "reported `" + t.sim().help() + "`, not `lost`")});
  if (!stood.empty()) return stood;
  weak = false;
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Scenarios localisation_scenarios() {
  return {
      {"no_exit_is_left_over_from_an_unknown_arrival", no_exit_is_left_over_from_an_unknown_arrival},
      {"a_weak_sign_and_an_unknown_arrival_stop_it_at_the_line",
       [](const Setting& setting) { return weak_sign_and_unknown_arrival(setting, 1200); }},
      disturbed("of_two_landmarks_that_look_alike_only_the_awaited_counts", others_look_alike),
      disturbed("a_next_landmark_that_looks_like_this_one_is_no_arrival", neighbours_look_alike(0.0)),
      disturbed("a_next_landmark_that_looks_like_this_one_and_flickers_is_no_arrival", neighbours_look_alike(0.15)),
      {"a_sign_seen_again_does_not_advance_twice", a_sign_seen_again},
      disturbed("a_later_landmark_in_view_moves_nothing", later_landmarks_seem_in_view),
      {"a_sign_half_a_second_after_the_line_is_soon_enough", a_sign_half_a_second_after_the_line},
      disturbed("a_sign_some_time_after_the_line_is_searched_for", sign_comes_after_the_line(12, ""),
                {ArrivalSeen::kOnLine}),
      disturbed("a_sign_seen_only_on_the_line_is_enough", signs_are_seen_on_the_line_only, {ArrivalSeen::kOnLine}),
      disturbed("the_next_sign_in_view_inside_a_crossing_is_no_arrival", next_sign_in_view_inside_the_crossing),
      disturbed("a_memory_that_is_read_late_is_waited_for", memory_is_read_late()),
      disturbed("an_exit_road_that_nobody_tells_is_found", [](Simulation&, Readings& now) { now.move_by.fill(0.0f); }),
      {"two_roads_of_arrival_at_once_are_reported", two_roads_of_arrival},
      {"a_missing_sign_stops_it_at_the_line", a_missing_sign},
      {"carried_away_on_the_road_it_stands_at_the_next_line", carried_away_on_the_road},
      {"carried_away_after_the_sign_it_crosses_once_at_most", carried_away_after_the_sign},
  };
}

}  // namespace kb::world
