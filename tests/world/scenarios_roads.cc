// Tracks and stop lines.
#include <fmt/format.h>

#include <algorithm>

#include "tests/world/scenario.h"

namespace kb::world {
namespace {

constexpr MethodSet kAllTracks{Method::kMark, Method::kDist, Method::kAzimuth};

/// The strategies that ran on `edge`, each once where it changed; "-" for none.
Simulation::Disturbance note_strategies(std::string edge, std::vector<std::string>& into) {
  return [edge = std::move(edge), &into](Simulation& sim, Readings&) {
    if (!sim.world.on(edge)) return;
    const std::string strategy(sim.strategy().empty() ? "-" : sim.strategy());
    if (into.empty() || into.back() != strategy) into.push_back(strategy);
  };
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text;
}

/// Whether `part` is `whole` with some words left out.
bool is_part_of(const std::vector<std::string>& part, const std::vector<std::string>& whole) {
  std::size_t next = 0;
  for (const std::string& word : whole) {
    if (next < part.size() && word == part[next]) ++next;
  }
  return next == part.size();
}

Finding marking_lost(const Setting& setting) {
  Trial t = route1(setting);
  t.road("LM2.S").tracks = kAllTracks;
  t.road("LM2.S").length_m = 12.0;
  std::vector<std::string> driven;
  t.disturb([gone = 0](Simulation& sim, Readings&) mutable {  // for the tick after this one
    if (!sim.world.on("LM2.S")) return;
    const double x = sim.world.position_m();
    MethodSet& tracks = sim.world.map.road(sim.world.on_road()->edge).tracks;
    tracks = x < 2.0 || x > 6.0 ? kAllTracks
             : x < 3.5          ? MethodSet{Method::kDist, Method::kAzimuth}
             : x < 5.0          ? MethodSet{Method::kAzimuth}
                                : MethodSet{Method::kAzimuth, Method::kDist};
    if (x > 4.2 && x < 4.4 && gone < 60) {
      tracks = {};
      ++gone;
    }
  });
  t.disturb(note_strategies("LM2.S", driven));
  t.go();
  const bool as_it_should =
      is_part_of({"Move.mark", "-", "Move.dist", "Move.azimuth", "-", "Move.azimuth", "Move.mark"}, driven);
  return all_of({t.drove(kRoute1Way), expect(as_it_should, "drove by " + joined(driven))});
}

Finding walls_asked_marking_seen(const Setting& setting) {
  // The walls fade, the marking serves; the walls flicker, then come back: walls again.
  Trial t(setting, labyrinth_route("LM7 -> LM11 -> LM13"));
  t.at("LM6.S").road("LM7.S").length_m = 10.0;
  std::vector<std::string> driven;
  t.disturb([](Simulation& sim, Readings& now) {
    if (!sim.world.on("LM7.S")) return;
    const double x = sim.world.position_m();
    MethodSet& tracks = sim.world.map.road(sim.world.on_road()->edge).tracks;
    tracks = x < 2.0 || x > 5.0 ? kAllTracks : MethodSet{Method::kMark, Method::kAzimuth};
    if (x > 3.0 && x < 4.0 && sim.ticks() / 5 % 2 != 0) {
      now.track[index(Method::kDist)] = kSure;
      tracks = kAllTracks;
    }
  });
  t.disturb(note_strategies("LM7.S", driven));
  t.go(3000, {}, "Go");
  const Finding arrived = t.drove("LM7.S LM11.E");
  std::erase(driven, "-");
  if (!driven.empty() && driven.front().starts_with("Cross")) driven.erase(driven.begin());
  const bool as_it_should = driven == std::vector<std::string>{"Move.dist", "Move.mark", "Move.dist"};
  return all_of({arrived, expect(as_it_should, "drove by " + joined(driven))});
}

Finding a_line_on_the_open_road(const Setting& setting) {
  // It stands and asks; told that this was no stop line, it drives on.
  Trial t = route1(setting);
  t.disturb([](Simulation& sim, Readings& now) {
    const double x = sim.world.position_m();
    if (sim.world.comes_from("LM2") && x > 0.9 && x < 1.05 && sim.ticks() < 200) now.line = kSure;
  });
  t.go(900);
  if (t.sim().ended()) return t.drove(kRoute1Way);
  const Finding stood = all_of({t.accident(), expect(t.sim().help() == "lost", "reports `" + t.sim().help() + "`")});
  if (!stood.empty()) return stood;
  t.sim().press("Resume");
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

/// On the road LM2 -> LM3 a sense is silent for 15 s.
Finding blind_for_a_while(const Setting& setting, std::string_view sense) {
  Trial t = route1(setting);
  t.road("LM2.S").length_m = 6.0;
  t.disturb([fact = "Blind." + std::string(sense), ticks = 0](Simulation& sim, Readings& now) mutable {
    if (!sim.world.on("LM2.S") || sim.world.position_m() < 1.0 || ++ticks > 150) return;
    (fact == "Blind.line" ? now.line : now.obstacle) = 0.0f;
    now.set(fact, kSure);
  });
  t.go(3000, [](const Simulation& sim) { return sim.world.on("LM2.S") && sim.world.position_m() > 1.0; });
  t.wait(100);
  const Finding stood = all_of({expect(t.sim().strategy() == "Stop", "does not stand"), expect(t.world().on("LM2.S"), "drove over the stop line"),
                                expect(t.sim().help() == "no_" + std::string(sense), "reports `" + t.sim().help() + "`")});
  if (!stood.empty()) return stood;
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Finding resume_before_an_unsafe_crossing(const Setting& setting) {
  // Whatever is pressed: it waits for the crossing to be safe.
  Trial t = route1(setting);
  t.landmark("LM3").safe = false;
  t.go(1200);
  for (int i = 0; i < 3; ++i) {
    t.sim().press("Resume");
    t.wait(100);
  }
  const Finding stood = all_of({t.accident(), expect(t.sim().help() == "refused", "reports `" + t.sim().help() + "`"), expect(t.world().on("LM2.S"), "went on")});
  if (!stood.empty()) return stood;
  t.landmark("LM3").safe = true;
  t.sim().run(3000);
  return t.drove(kRoute1Way);
}

Finding resume_where_the_road_ends(const Setting& setting) {
  // The sign cannot be read, but by the way that it drove this is the stop line: it is not told that it is none.
  Trial t = route1(setting);
  t.disturb([](Simulation& sim, Readings& now) {
    if (!sim.world.on("LM2.S") || sim.world.to_end_m() > 1.0) return;
    std::fill(now.landmark.begin(), now.landmark.end(), 0.0f);
    now.in = {};
    now.safe = 0.0f;
    now.set("Due", kSure);
  });
  t.go(1200);
  t.sim().press("Resume");
  t.wait(100);
  return all_of({t.accident(), expect(t.sim().help() == "lost", "reports `" + t.sim().help() + "`"), expect(t.world().on("LM2.S"), "went on")});
}

Finding tracks_flicker(const Setting& setting) {
  Trial t = route1(setting);
  t.disturb([](Simulation& sim, Readings& now) {
    if (sim.ticks() % 7 == 0) now.track.fill(-1.0f);
  });
  t.go();
  const Finding arrived = t.drove(kRoute1Way);
  const auto& trace = t.sim().trace();
  constexpr std::ptrdiff_t kAtTheStart = 15, kAtTheEnd = 6;  // where it stands for good reason
  const auto idle =
      std::count_if(trace.begin() + kAtTheStart, trace.end() - kAtTheEnd,
                    [](const Simulation::Step& step) { return step.tick.strategy == program::CellId::kNone; });
  return all_of({arrived, expect(idle <= 1, fmt::format("{} idle ticks", idle))});
}

Finding the_exit_line_never_comes(const Setting& setting) {
  Trial t = route1(setting);
  t.disturb([](Simulation& sim, Readings& now) {
    if (!sim.world.inside("LM3") || sim.world.position_m() <= 0.3) return;
    now.line = -1.0f;
    InCrossing& here = std::get<InCrossing>(sim.world.pose);
    here.p_m = std::min(here.p_m, 0.6);
  });
  t.go(1200);
  return all_of({expect(t.sim().strategy() == "Stop", fmt::format("runs `{}`, not `Stop`", t.sim().strategy())),
                 expect(t.sim().help() == "astray", "reports `" + t.sim().help() + "`, not `astray`")});
}

Finding no_track_at_all(const Setting& setting) {
  Trial t = route1(setting);
  t.road("LM2.S").length_m = 6.0;
  std::vector<std::string> reports;
  t.disturb([&reports](Simulation& sim, Readings&) {
    const std::string help = sim.help();
    if (!help.empty() && (reports.empty() || reports.back() != help)) reports.push_back(help);
  });
  t.disturb([dark = 0](Simulation& sim, Readings& now) mutable {
    if (!sim.world.on("LM2.S") || sim.world.position_m() <= 2.0 || dark >= 200) return;
    ++dark;
    now.track.fill(-1.0f);
  });
  t.go();
  return all_of({t.drove(kRoute1Way), expect(joined(reports) == "no_track", "reported `" + joined(reports) + "`")});
}

Finding a_line_flickers_once(const Setting& setting) {
  Trial t = route1(setting);
  t.disturb([on_line = 0](Simulation&, Readings& now) mutable {
    on_line = now.line > 0.5f ? on_line + 1 : 0;
    if (on_line == 2) now.line = -1.0f;
  });
  t.go();
  return t.drove(kRoute1Way);
}

}  // namespace

Scenarios road_scenarios() {
  return {
      {"when_the_marking_is_lost_walls_then_compass_serve", marking_lost},
      {"walls_that_come_back_are_followed_again", walls_asked_marking_seen},
      {"a_line_on_the_open_road_is_asked_about", a_line_on_the_open_road},
      {"tracks_that_flicker_do_not_stop_it", tracks_flicker},
      {"an_exit_line_that_never_comes_is_reported", the_exit_line_never_comes},
      {"no_track_at_all_is_reported", no_track_at_all},
      {"a_line_that_flickers_is_one_line", a_line_flickers_once},
      {"without_its_line_sensors_it_stands_before_the_stop_line", [](const Setting& setting) { return blind_for_a_while(setting, "line"); }},
      {"without_its_range_finders_it_stands", [](const Setting& setting) { return blind_for_a_while(setting, "ranges"); }},
      {"resume_leads_into_no_crossing_that_is_not_safe", resume_before_an_unsafe_crossing},
      {"resume_where_the_road_ends_changes_nothing", resume_where_the_road_ends},
  };
}

}  // namespace kb::world
