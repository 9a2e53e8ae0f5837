// What a tick costs a robot of a fleet: Route1, every robot fed with what the sensors of a robot said that drove it in closed
// loop, ten times a second, from a place of its own in the mission on.
//
//   Fleet/N      N robots on one core, scattered: no two neighbours are at the same place, so something happens in every word
//   Profiled/N   the same, compiled with recordings of two other missions as profile
//   Together/N   as Fleet, but the 512 robots of a block are within two seconds of each other, as in a convoy
//   Scalar/N     a mts::Mind for each of N robots, with the same facts
//   Cores/N/T    N scattered robots on T threads
//   Read, Update memory bandwidth: a pass over as many bytes as a million robots have, reading, and reading and writing
//
// Times are of the tick alone, a robot, on the processor (Cores: by the clock on the wall); `give_ns` is what it takes to give a robot its news, a word at a time
// (Scalar: robot by robot). Each tick of the mission is timed in several missions and the least taken, so that other work on the machine does not
// count; the mean of those is told, without the time it takes to look at the clock.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <map>
#include <tuple>

#include "bench/mission.h"
#include "bench_fleet_profiled.kb/route1.kb.fleet.h"
#include "bench_fleet_route1.kb/route1.kb.fleet.h"

namespace {

using bench::Step;
using Clock = std::chrono::steady_clock;
using route1::Fleet;

double seconds_since(Clock::time_point begin) { return std::chrono::duration<double>(Clock::now() - begin).count(); }

/// Of this thread on the processor: a tick of a million robots is longer than the turns that a busy machine gives.
double processor_s() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// How long it takes to look at that clock: as long as a tick of some hundred robots.
double clock_s() {
  static const double least_s = [] {
    double least = 1.0;
    for (int i = 0; i < 1'000; ++i) {
      const double begin = processor_s();
      least = std::min(least, processor_s() - begin);
    }
    return least;
  }();
  return least_s;
}

/// The mission over and over: its first step also takes back what the last one left behind.
const std::vector<Step>& mission() {
  static const std::vector<Step> steps = [] {
    std::vector<Step> read = bench::read_mission(MISSION);
    std::map<route1::Fact, float> left;
    for (const Step& step : read) {
      for (const bench::Change& c : step.changes) left[c.fact] = c.value;
    }
    for (const bench::Change& c : read.front().changes) left.erase(c.fact);
    for (const auto& [fact, value] : left) {
      if (value != 0.0f) read.front().changes.push_back({fact, 0.0f});
    }
    return read;
  }();
  return steps;
}

/// Where in the mission the robots of a block are: so many different blocks that no branch predictor learns them.
constexpr std::size_t kPatterns = 13;

struct News { std::uint32_t word; route1::Fact fact; std::uint64_t robots; float value; };

/// What the robots of a block learn on each tick of a mission, as words.
class Pattern {
 public:
  Pattern(std::uint64_t seed, std::size_t spread) : at_(mts::kBlockRobots), news_(mission().size()) {
    const std::size_t first = random(seed) % mission().size();
    for (std::size_t& at : at_) at = (first + random(seed) % spread) % mission().size();
    for (std::size_t tick = 0; tick < news_.size(); ++tick) {
      std::map<std::tuple<std::uint32_t, route1::Fact, float>, std::uint64_t> words;
      for (std::uint32_t robot = 0; robot < mts::kBlockRobots; ++robot) {
        for (const bench::Change& c : step(robot, tick).changes) words[{robot / 64, c.fact, c.value}] |= std::uint64_t{1} << (robot % 64);
      }
      for (const auto& [key, robots] : words) news_[tick].push_back({std::get<0>(key), std::get<1>(key), robots, std::get<2>(key)});
    }
  }
  [[nodiscard]] const Step& step(std::uint32_t robot, std::size_t tick) const { return mission()[(tick + at_[robot]) % mission().size()]; }
  [[nodiscard]] const std::vector<News>& news(std::size_t tick) const { return news_[tick % news_.size()]; }

 private:
  static std::uint64_t random(std::uint64_t& state) {
    state ^= state << 13;
    state ^= state >> 7;
    return state ^= state << 17;
  }
  std::vector<std::size_t> at_;
  std::vector<std::vector<News>> news_;
};

const std::vector<Pattern>& patterns(std::size_t spread) {
  static std::map<std::size_t, std::vector<Pattern>> all;
  std::vector<Pattern>& made = all[spread];
  for (std::uint64_t seed = 1; made.size() < kPatterns; ++seed) made.emplace_back(seed * 0x9E3779B97F4A7C15u, spread);
  return made;
}

template <class F>
void give(F& fleet, std::size_t tick, const std::vector<Pattern>& all) {
  const std::size_t blocks = fleet.words() / mts::kPlaneWords;
  for (std::size_t block = 0; block < blocks; ++block) {
    for (const News& news : all[block % kPatterns].news(tick)) {
      fleet.set_word(block * mts::kPlaneWords + news.word, static_cast<typename F::Fact>(news.fact), news.robots, news.value);
    }
  }
}

/// Least seconds of each tick of the mission, over the missions that were driven.
struct Least {
  std::vector<double> of = std::vector<double>(mission().size(), 1e9);
  void take(std::size_t tick, double s) { of[tick % of.size()] = std::min(of[tick % of.size()], s); }
  [[nodiscard]] double mean(std::size_t robots) const {
    double sum = 0.0;
    std::size_t count = 0;
    for (const double s : of) {
      if (s < 1e9) sum += s;
      count += s < 1e9 ? 1 : 0;
    }
    return sum / static_cast<double>(count) / static_cast<double>(robots);
  }
};

template <class F>
void run_fleet(benchmark::State& state, std::size_t spread, unsigned threads, bool on_processor = true) {
  const auto robots = static_cast<std::size_t>(state.range(0));
  const std::vector<Pattern>& all = patterns(spread);
  F fleet(robots);
  mts::Crew crew(threads);
  Least ticks, gives;
  // A first mission that is not timed: all robots have begun, timers have as many bits as they need.
  const std::size_t missions = robots > 500'000 ? 2 : 5;
  for (auto _ : state) {
    for (std::size_t tick = 0; tick < (missions + 1) * mission().size(); ++tick) {
      const double begin_s = processor_s();
      give(fleet, tick, all);
      const double give_s = processor_s() - begin_s, middle_s = processor_s();
      const auto middle = Clock::now();
      if (on_processor) fleet.tick(mts::milliseconds(100));
      else fleet.tick(mts::milliseconds(100), crew);
      if (tick < mission().size()) continue;
      ticks.take(tick, on_processor ? processor_s() - middle_s - clock_s() : seconds_since(middle));
      gives.take(tick, give_s);
    }
    state.SetIterationTime(ticks.mean(robots));
  }
  state.counters["give_ns"] = 1e9 * gives.mean(robots);
  state.counters["bits"] = fleet.width();
  state.counters["bytes_a_robot"] = static_cast<double>(fleet.bytes()) / static_cast<double>(robots);
  state.counters["resting"] = static_cast<double>(fleet.resting());
  state.counters["alone"] = static_cast<double>(fleet.alone());
}

void FleetScattered(benchmark::State& state) { run_fleet<Fleet>(state, mission().size(), 1); }
BENCHMARK(FleetScattered)->Name("Fleet")->Arg(4'096)->Arg(65'536)->Arg(1'000'448)->UseManualTime()->Iterations(1)->Unit(benchmark::kNanosecond);

void Profiled(benchmark::State& state) { run_fleet<profiled::Fleet>(state, mission().size(), 1); }
BENCHMARK(Profiled)->Arg(4'096)->Arg(65'536)->Arg(1'000'448)->UseManualTime()->Iterations(1)->Unit(benchmark::kNanosecond);

void Together(benchmark::State& state) { run_fleet<Fleet>(state, 20, 1); }
BENCHMARK(Together)->Arg(65'536)->Arg(1'000'448)->UseManualTime()->Iterations(1);

void Cores(benchmark::State& state) { run_fleet<Fleet>(state, mission().size(), static_cast<unsigned>(state.range(1)), false); }
BENCHMARK(Cores)->ArgsProduct({{65'536, 1'000'448}, {1, 2}})->UseManualTime()->Iterations(1);

/// The same robots, one by one.
void Scalar(benchmark::State& state) {
  const auto robots = static_cast<std::size_t>(state.range(0));
  const std::vector<Pattern>& all = patterns(mission().size());
  std::vector<route1::Mind> minds(robots);
  Least ticks, sets;
  for (auto _ : state) {
    for (std::size_t tick = 0; tick < (robots > 10'000 ? 1u : 3u) * mission().size(); ++tick) {
      const double begin_s = processor_s();
      for (std::size_t r = 0; r < robots; ++r) {
        for (const bench::Change& c : all[r / mts::kBlockRobots % kPatterns].step(static_cast<std::uint32_t>(r % mts::kBlockRobots), tick).changes) {
          minds[r].give(c.fact, c.value);
        }
      }
      const double set_s = processor_s() - begin_s, middle_s = processor_s();
      for (route1::Mind& mind : minds) benchmark::DoNotOptimize(mind.tick(mts::milliseconds(100)).drives());
      ticks.take(tick, processor_s() - middle_s - clock_s());
      sets.take(tick, set_s);
    }
    state.SetIterationTime(ticks.mean(robots));
  }
  state.counters["give_ns"] = 1e9 * sets.mean(robots);
}
BENCHMARK(Scalar)->Arg(4'096)->Arg(65'536)->UseManualTime()->Iterations(1);

/// A robot's news given robot by robot.
void SetOne(benchmark::State& state) {
  Fleet fleet(static_cast<std::size_t>(state.range(0)));
  std::size_t robot = 0;
  float value = 0.0f;
  for (auto _ : state) {
    fleet.set(robot, route1::Fact::Line, value);
    robot = (robot + 7'919) % fleet.robots();
    value = 0.9f - value;
  }
}
BENCHMARK(SetOne)->Arg(4'096)->Arg(1'000'448);

constexpr std::size_t kBandwidthBytes = 64u << 20;

void Read(benchmark::State& state) {
  std::vector<std::uint64_t> memory(kBandwidthBytes / 8, 1);
  double least = 1e9;
  for (auto _ : state) {
    const double begin_s = processor_s();
    std::uint64_t a = 0, b = 0, c = 0, d = 0;
    for (std::size_t i = 0; i < memory.size(); i += 8) {   // a read of each cache line
      a += memory[i];
      b += memory[i + 2];
      c += memory[i + 4];
      d += memory[i + 6];
    }
    benchmark::DoNotOptimize(a + b + c + d);
    least = std::min(least, processor_s() - begin_s);
  }
  state.counters["GB_per_s"] = static_cast<double>(kBandwidthBytes) * 1e-9 / least;
}
BENCHMARK(Read)->Iterations(40);

void Update(benchmark::State& state) {
  std::vector<std::uint64_t> memory(kBandwidthBytes / 8, 1);
  double least = 1e9;
  for (auto _ : state) {
    const double begin_s = processor_s();
    for (std::uint64_t& word : memory) word += 1;
    benchmark::ClobberMemory();
    least = std::min(least, processor_s() - begin_s);
  }
  state.counters["GB_per_s"] = static_cast<double>(kBandwidthBytes) * 1e-9 / least;
}
BENCHMARK(Update)->Iterations(40);

}  // namespace

BENCHMARK_MAIN();
