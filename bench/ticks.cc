// What a tick costs: Route1 as emitted C++, fed with what the sensors of a robot said that drove it in closed loop, ten
// times a second.
//
//   Idle     nothing has changed since the last tick
//   Event    a tick on which something happens: a fact changes, a `when` rule fires, or a cell changes. All of the decision is
//            read: strategy, status, events, fired rules, changed cells. `after` is the tick that follows an event and has
//            nothing to do but to forget it
//   Masks    the yardstick: a bare loop that tests every rule's condition as a mask over the truth bits, once
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "bench/allocations.h"
#include "bench/mission.h"
#include "route1.kb.h"

namespace {

using bench::allocations;
using bench::Change;
using bench::Step;

std::vector<Step> mission() { return bench::read_mission(MISSION); }

std::uint64_t read_all(const route1::Decision& decision) {
  std::uint64_t sum = static_cast<std::uint64_t>(decision.status());
  if (decision.drives()) sum += static_cast<std::uint64_t>(decision.strategy());
  for (const auto rule : decision.fired()) sum += static_cast<std::uint64_t>(rule);
  for (const auto fact : decision.events()) sum += static_cast<std::uint64_t>(fact);
  for (const auto& change : decision.changed()) sum += change.cell;
  return sum;
}

using Clock = std::chrono::steady_clock;

/// By nearest rank: of two in the middle the lower.
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// What it takes to look at the clock, which is in every tick that is timed by itself.
double clock_seconds() {
  std::vector<double> values(10'001);
  for (double& value : values) {
    const auto begin = Clock::now();
    value = std::chrono::duration<double>(Clock::now() - begin).count();
  }
  return median(values);
}

/// One step of the mission in all the runs.
struct Timing {
  bool event = false, after = false;
  std::size_t fired = 0, changed = 0;
  std::vector<double> seconds;
};

/// Drives one mission and times each tick by itself.
void drive(const std::vector<Step>& steps, route1::Mind& mind, route1::Facts& facts, std::vector<Timing>& timings) {
  bool after = false;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto begin = Clock::now();
    for (const Change& change : steps[i].changes) facts.set(change.fact, change.value);
    const auto decision = mind.tick(facts, mts::microseconds(steps[i].dt_us));
    benchmark::DoNotOptimize(read_all(decision));
    Timing& timing = timings[i];
    timing.seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
    const bool acted = decision.fired().size() > (decision.drives() ? 1u : 0u) || !decision.changed().empty();
    timing.event = acted || !steps[i].changes.empty();
    timing.after = after && !timing.event;
    timing.fired = decision.fired().size();
    timing.changed = decision.changed().size();
    after = timing.event;
  }
}

/// The mean over the events of a mission, of each the median over many missions: other work on the machine does not count.
void Event(benchmark::State& state) {
  constexpr int kMissions = 4'000;
  const auto steps = mission();
  const double clock_s = clock_seconds();
  const route1::Mind fresh;
  route1::Mind mind;
  route1::Facts facts;
  std::vector<Timing> timings(steps.size());
  for (Timing& timing : timings) timing.seconds.reserve(kMissions);
  std::size_t allocated = 0;
  for (auto _ : state) {
    for (Timing& timing : timings) timing.seconds.clear();
    for (int i = 0; i < kMissions; ++i) {
      mind = fresh;
      facts.clear();
      mind.tick(facts, mts::milliseconds(100));
      const std::size_t before = allocations;
      drive(steps, mind, facts, timings);
      allocated += allocations - before;
    }
    double events = 0, after = 0, fired = 0, changed = 0, event_s = 0, after_s = 0;
    for (Timing& timing : timings) {
      const double time_s = median(timing.seconds) - clock_s;
      events += timing.event;
      after += timing.after;
      event_s += timing.event ? time_s : 0.0;
      after_s += timing.after ? time_s : 0.0;
      fired += timing.event ? static_cast<double>(timing.fired) : 0.0;
      changed += static_cast<double>(timing.changed);
    }
    state.SetIterationTime(event_s / events);
    state.counters["events"] = events;
    state.counters["ticks"] = static_cast<double>(steps.size());
    state.counters["fired_an_event"] = fired / events;
    state.counters["changed_an_event"] = changed / events;
    state.counters["after_ns"] = 1e9 * after_s / after;
  }
  state.counters["allocations"] = static_cast<double>(allocated);
}
BENCHMARK(Event)->UseManualTime()->Iterations(1);

void Idle(benchmark::State& state) {
  route1::Mind mind;
  route1::Facts facts;
  facts.set(route1::Fact::Track_mark, 1.0f);
  for (int i = 0; i < 100; ++i) mind.tick(facts, mts::milliseconds(200));
  const std::size_t before = allocations;
  for (auto _ : state) {
    const auto decision = mind.tick(facts, mts::milliseconds(20));
    benchmark::DoNotOptimize(decision.status());
  }
  state.counters["allocations"] = static_cast<double>(allocations - before);
}
BENCHMARK(Idle);

/// As many rules and truth bits as Route1 has; each rule needs some bits set and some clear.
void Masks(benchmark::State& state) {
  constexpr std::size_t kRules = route1::Knowledge::kShape.rules;
  constexpr std::size_t kWords = (route1::Knowledge::kShape.atoms + 63) / 64;
  static std::uint64_t mask[kRules][kWords], want[kRules][kWords], truth[kWords];
  std::uint64_t random = 88172645463325252u;
  const auto next = [&random] {
    random ^= random << 13;
    random ^= random >> 7;
    return random ^= random << 17;
  };
  for (auto& word : truth) word = next();
  for (std::size_t r = 0; r < kRules; ++r) {
    for (int i = 0; i < 4; ++i) {
      const std::uint64_t bit = next() % route1::Knowledge::kShape.atoms;
      mask[r][bit / 64] |= std::uint64_t{1} << (bit % 64);
      want[r][bit / 64] |= (next() & 1u) << (bit % 64);
    }
  }
  for (auto _ : state) {
    std::uint32_t fired = 0;
    benchmark::DoNotOptimize(truth);
    for (std::size_t r = 0; r < kRules; ++r) {
      std::uint64_t wrong = 0;
      for (std::size_t w = 0; w < kWords; ++w) wrong |= (truth[w] ^ want[r][w]) & mask[r][w];
      fired += wrong == 0;
    }
    benchmark::DoNotOptimize(fired);
  }
}
BENCHMARK(Masks);

}  // namespace

BENCHMARK_MAIN();
