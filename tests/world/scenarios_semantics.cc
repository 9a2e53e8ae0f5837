// Attention, thresholds, periods, values that no sensor should give.
#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "tests/world/dice.h"
#include "tests/world/scenario.h"

namespace kb::world {
namespace {

/// Ticks the mind of Route1 by hand.
class Bench {
 public:
  explicit Bench(const Setting& setting) : trial_(route1(setting)) {}
  program::Tick tick(std::initializer_list<std::pair<std::string_view, float>> facts) {
    std::vector<float> values(trial_.knowledge().program().facts);
    for (const auto& [name, value] : facts) values[program::index(cell(name))] = value;
    return trial_.mind().tick(values, 50'000);
  }
  void poke(std::string_view satellite, float value) { trial_.mind().poke(cell(satellite), value); }
  [[nodiscard]] program::CellId cell(std::string_view name) const { return trial_.knowledge().cell(name); }

 private:
  Trial trial_;
};

struct Sighting {
  const char* what;
  std::vector<float> cf;            ///< of LM5, tick by tick, after one tick without data
  int attended_from;                ///< the tick (1 is that of cf[0]) from which `sat LM5` is held high; 0: never
  std::vector<std::size_t> events;  ///< the ticks that must have an event
};

constexpr int kNever = 0, kAlways = 1;

Finding sees(const Setting& setting, const Sighting& sighting) {
  Bench bench(setting);
  bench.poke("sat LM5", sighting.attended_from == kAlways ? 1.0f : -1.0f);
  bench.tick({});
  std::vector<std::size_t> events;
  for (std::size_t i = 0; i < sighting.cf.size(); ++i) {
    const std::size_t tick = i + 1;
    const bool attended = sighting.attended_from != kNever && static_cast<int>(tick) >= sighting.attended_from;
    bench.poke("sat LM5", attended ? 1.0f : -1.0f);
    const program::Tick done = bench.tick({{"LM5", sighting.cf[i]}});
    if (std::count(done.events.begin(), done.events.end(), bench.cell("LM5")) > 0) events.push_back(tick);
  }
  return expect(events == sighting.events, sighting.what);
}

Finding attention_lowers_the_threshold(const Setting& setting) {
  const std::vector<Sighting> sightings{
      {"0.60 attended: one event", {0.6f}, kAlways, {1}},
      {"0.60 unattended: none", {0.6f}, kNever, {}},
      {"0.4 0.6 0.8 unattended: at 0.8", {0.4f, 0.6f, 0.8f}, kNever, {3}},
      {"0.4 0.6 0.8 attended: at 0.6", {0.4f, 0.6f, 0.8f}, kAlways, {2}},
      {"attention that comes while it stands at 0.60: one", {0.6f, 0.6f, 0.6f, 0.6f}, 3, {3}},
      {"exactly 0.50 attended: none", {0.5f}, kAlways, {}},
      {"exactly 0.75 unattended: none", {0.75f}, kNever, {}},
      {"chatter round 0.75: one in all", {0.74f, 0.76f, 0.74f, 0.76f, 0.74f, 0.76f}, kNever, {2}},
      {"chatter, then down to 0.50: a second one", {0.76f, 0.74f, 0.5f, 0.76f}, kNever, {1, 4}},
  };
  Finding found;
  for (const Sighting& sighting : sightings) found = all_of({found, sees(setting, sighting)});
  return found;
}

Finding attention_withdrawn_is_not_a_loss(const Setting& setting) {
  Bench bench(setting);
  bench.tick({});
  bench.poke("sat LM5", 1.0f);
  bench.tick({{"LM5", 0.6f}});
  bench.poke("sat LM5", -1.0f);
  return expect(bench.tick({{"LM5", 0.6f}}).lost.empty(), "lost, though its cf did not change");
}

Finding bad_values_do_no_harm(const Setting& setting) {
  Trial t = route1(setting);
  t.disturb([](Simulation& sim, Readings& now) {
    if (sim.ticks() % 2 == 0) {
      now.obstacle = std::numeric_limits<float>::quiet_NaN();
    } else if (now.safe > 0.0f) {
      now.safe = 7.0f;
    }
  });
  t.go();
  const auto& trace = t.sim().trace();
  const bool counted = std::all_of(trace.begin(), trace.end(), [](const Simulation::Step& step) {
    return step.tick.number % 2 == 0 || step.tick.bad_facts == 1;
  });
  return all_of({t.drove(kRoute1Way), expect(counted, "bad values were not counted")});
}

Finding a_satellite_at_exactly_one_half(const Setting& setting) {
  // At 0.5 a cell is high: it must not be `not high` as well, else two strategies would run.
  Bench bench(setting);
  bench.tick({});
  bench.poke("sat Avoid", 0.5f);
  bench.poke("sat Move.mark", 1.0f);
  return expect(bench.tick({{"Track.mark", 1.0f}, {"Track.azimuth", 1.0f}}).active.size() <= 1, "two strategies");
}

Finding any_period(const Setting& setting) {
  Finding found;
  for (const int dt_ms : {10, 20, 50, 100, 150, 200}) {
    Trial t = route1(setting);
    t.sim().dt_ms = dt_ms;
    t.go(70'000 / dt_ms);
    const Finding driven = t.drove(kRoute1Way);
    if (!driven.empty()) found = all_of({found, fmt::format("{} ms: {}", dt_ms, driven)});
  }
  return found;
}

Finding chatter_of_all_sensors(const Setting& setting) {
  Finding found;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Trial t = route1(setting);
    t.disturb([dice = Dice(seed)](Simulation&, Readings& now) mutable {
      now.each([&](float& value, bool is_landmark) {
        if (value > 0.5f && dice.chance(0.1)) value = is_landmark ? 0.45f : kSureNot;
      });
    });
    t.go(4000);
    const Finding driven = t.drove(kRoute1Way);
    if (!driven.empty()) found = all_of({found, fmt::format("seed {}: {}", seed, driven)});
  }
  return found;
}

}  // namespace

Scenarios semantics_scenarios() {
  return {
      {"attention_lowers_the_threshold", attention_lowers_the_threshold},
      {"attention_withdrawn_is_not_a_loss", attention_withdrawn_is_not_a_loss},
      {"values_that_are_none_or_out_of_range_do_no_harm", bad_values_do_no_harm},
      {"a_satellite_at_exactly_one_half_is_high_and_not_both", a_satellite_at_exactly_one_half},
      {"ticks_of_10_to_200_ms_make_no_difference", any_period},
      {"chatter_of_all_sensors_does_no_harm", chatter_of_all_sensors},
  };
}

}  // namespace kb::world
