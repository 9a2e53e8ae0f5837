// What a tick costs against the size of the knowledge base: cities and warehouses of 100 to 1,000,000 roads, compiled to
// images and run by mts::ImageMind. The argument is the number of roads.
//
//   Reach/city, Reach/warehouse   the tick at which a landmark comes into view that the tour waits for
//   Idle/city                     a tick at which nothing happens
//   Flip/...                      the worst that was thought of: see docs/large.md
//
// A million roads take a minute to compile before they are measured: --benchmark_filter=/1000000 runs them alone.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

#include <waymark/runtime/image_mind.h>
#include "bench/clock.h"
#include "bench/compile.h"
#include "bench/maps/road_map.h"

namespace {

using kb::bench::RoadMap;
using kb::bench::Tour;

constexpr std::uint32_t kLegs = 1'000;
constexpr mts::Duration kStep = mts::milliseconds(400);

std::string image_of(const std::string& text) {
  kb::driver::Options options;
  options.library = LIBRARY;
  options.analyse = options.keep_model = false;
  const auto compiled = bench::compile_text(text, options);
  return kb::tables::write_image(compiled->tables, compiled->program);
}

/// A mind on an image of its own.
class Robot {
 public:
  explicit Robot(std::string image) : image_(std::move(image)) {
    mts::ImageInfo info;
    if (mts::peek_image(image_.data(), image_.size(), info) != mts::ImageStatus::kOk) std::abort();
    memory_.resize(info.state_bytes / 8 + 1);
    mts::SwapReport report;
    const auto ignore = [](const mts::SwapLoss&) {};
    const auto status = mind_.take(image_.data(), image_.size(), reinterpret_cast<std::byte*>(memory_.data()), memory_.size() * 8, report, ignore);
    if (status != mts::ImageStatus::kOk) std::abort();
    for (int i = 0; i < 10; ++i) mind_.tick(kStep);
  }
  [[nodiscard]] std::uint32_t fact(const std::string& name) const {
    const std::uint32_t found = mind_.find(mts::ImageKind::kFact, name.c_str());
    if (found == mind_.count(mts::ImageKind::kFact)) std::abort();
    return found;
  }
  mts::ImageMind& mind() { return mind_; }

 private:
  std::string image_;
  std::vector<std::uint64_t> memory_;
  mts::ImageMind mind_;
};

/// The tour, and what is sensed on the way. Between two landmarks all that happens is played, but only the tick at which a
/// landmark comes into view is measured.
class Drive {
 public:
  Drive(const RoadMap& map, const Tour& tour) : robot_(image_of(kb_text(map, tour))) {
    for (const char* name : {"Line", "Safe", "CrossBy.mark", "MoveBy.mark", "Track.mark", "In.S", "Go"}) facts_.push_back(robot_.fact(name));
    std::uint32_t at = tour.start;
    stops_.push_back(robot_.fact(map.landmark_name(at)));
    for (const kb::bench::Side exit : tour.exits) {
      at = map.across({at, exit}).landmark;
      stops_.push_back(robot_.fact(map.landmark_name(at)));
    }
    set(kTrack, 1.0f);
  }

  Robot& robot() { return robot_; }
  /// The next landmark comes into view. What happened since the last one is done before, untimed.
  template <class Timed>
  void reach(Timed&& timed) {
    if (next_ == 0) begin();
    else cross();
    robot_.mind().set_fact(stops_[next_], 0.9f);
    set(kIn, 0.9f);
    timed([&] { robot_.mind().tick(kStep); });
    fired_ += robot_.mind().fired().size();
    if (++next_ == stops_.size()) end();
  }
  [[nodiscard]] std::uint64_t fired() const { return fired_; }

 private:
  enum Sense : std::size_t { kLine, kSafe, kCross, kMove, kTrack, kIn, kGo };
  void set(Sense sense, float value) { robot_.mind().set_fact(facts_[sense], value); }
  void tick(int times = 1) {
    for (int i = 0; i < times; ++i) robot_.mind().tick(kStep);
  }
  void begin() {
    set(kGo, 1.0f);
    tick();
    set(kGo, 0.0f);
    tick(3);
  }
  /// From a landmark: over the crossing, and on along the road until it is out of view.
  void cross() {
    set(kLine, 0.9f), set(kSafe, 0.9f), set(kCross, 0.9f);
    tick(2);
    set(kLine, -0.9f), set(kSafe, 0.0f), set(kCross, 0.0f), set(kIn, 0.0f);
    tick(2);
    set(kLine, 0.9f), set(kMove, 0.9f);
    robot_.mind().set_fact(stops_[next_ - 1], -0.9f);
    tick();
    set(kLine, -0.9f), set(kMove, 0.0f);
    tick(3);
  }
  void end() {
    robot_.mind().set_fact(stops_.back(), -0.9f);
    set(kIn, 0.0f);
    tick(3);
    next_ = 0;
  }

  Robot robot_;
  std::vector<std::uint32_t> facts_;   // by Sense
  std::vector<std::uint32_t> stops_;   // the landmarks of the tour
  std::size_t next_ = 0;
  std::uint64_t fired_ = 0;
};

using Make = RoadMap (*)(std::uint32_t, std::uint64_t);

/// The last map, kept: benchmarks of one size follow one another.
Drive& drive(Make make, std::uint32_t roads) {
  static Make last_make = nullptr;
  static std::uint32_t last_roads = 0;
  static std::unique_ptr<Drive> last;
  if (last_make != make || last_roads != roads) {
    last.reset();
    const RoadMap map = make(roads, 1);
    last = std::make_unique<Drive>(map, make_tour(map, kLegs, 1));
    last_make = make;
    last_roads = roads;
  }
  return *last;
}

void reach(benchmark::State& state, Make make) {
  Drive& on = drive(make, static_cast<std::uint32_t>(state.range(0)));
  static const double kClock = bench::clock_ns();
  const std::uint64_t fired = on.fired();
  std::vector<double> all;
  for (auto _ : state) {
    on.reach([&](auto&& tick) {
      const auto begin = bench::Clock::now();
      tick();
      all.push_back(std::max(0.0, bench::ns_since(begin) - kClock));
      state.SetIterationTime(all.back() * 1e-9);
    });
  }
  // The quarters leave out what other work on the machine adds to some ticks.
  std::sort(all.begin(), all.end());
  state.counters["median_ns"] = all[all.size() / 2];
  state.counters["quarter_ns"] = all[all.size() / 4];
  state.counters["fired"] = static_cast<double>(on.fired() - fired) / static_cast<double>(all.size());
}
void reach_city(benchmark::State& state) { reach(state, kb::bench::make_city); }
void reach_warehouse(benchmark::State& state) { reach(state, kb::bench::make_warehouse); }

void idle_city(benchmark::State& state) {
  mts::ImageMind& mind = drive(kb::bench::make_city, static_cast<std::uint32_t>(state.range(0))).robot().mind();
  mind.tick(kStep);
  mind.tick(kStep);
  for (auto _ : state) {
    mind.tick(mts::milliseconds(0));
    benchmark::DoNotOptimize(mind.status());
  }
}

// ---- the worst cases: a million rules of one shape, and one fact that flips

/// `rules` rules with this condition over the group X and the facts A and B, and the satellite S.
std::string shape(std::int64_t rules, const std::string& condition) {
  std::string text = "levels think > act\nnames All { ";
  for (std::int64_t i = 0; i < rules; ++i) text += (i == 0 ? "i" : ", i") + std::to_string(i);
  return text + " }\nfacts X[All]\nfacts A, B\nsatellites Y[All]\nrule one[i in All] at think when " + condition + " then +Y[i]\n";
}

void flip(benchmark::State& state, const char* condition, const char* fact, const char* high) {
  static std::string last_text;
  static std::unique_ptr<Robot> robot;
  std::string text = shape(state.range(0), condition);
  if (text != last_text) {
    robot = std::make_unique<Robot>(image_of(text));
    last_text = std::move(text);
  }
  mts::ImageMind& mind = robot->mind();
  if (*high != '\0') mind.set_fact(robot->fact(high), 0.9f);
  const std::uint32_t flipped = robot->fact(fact);
  float value = 0.9f;
  mind.tick(kStep);
  for (auto _ : state) {
    mind.set_fact(flipped, value);
    mind.tick(kStep);
    value = -value;
  }
}

/// A million rules read A; each sleeps under an X of its own. A flips.
void flip_shared(benchmark::State& state) { flip(state, "seen X[i] and A", "A", ""); }
/// The same rules; an X flips.
void flip_own(benchmark::State& state) { flip(state, "seen X[i] and A", "X.i7", "A"); }
/// No rule can sleep: all are awake. An X flips, which one rule reads.
void flip_awake(benchmark::State& state) { flip(state, "not X[i] and not A", "X.i7", "A"); }
/// The same; A flips, which all of them read. No index can help here: all of them change.
void flip_all(benchmark::State& state) { flip(state, "not X[i] and not A", "A", ""); }

constexpr std::int64_t kSmall = 100, kLarge = 1'000'000;
BENCHMARK(reach_city)->Name("Reach/city")->RangeMultiplier(10)->Range(kSmall, kLarge)->UseManualTime()->Iterations(20'000);
BENCHMARK(idle_city)->Name("Idle/city")->RangeMultiplier(10)->Range(kSmall, kLarge);
BENCHMARK(reach_warehouse)->Name("Reach/warehouse")->RangeMultiplier(10)->Range(kSmall, kLarge)->UseManualTime()->Iterations(20'000);
BENCHMARK(flip_shared)->Name("Flip/a_fact_that_all_read")->RangeMultiplier(10)->Range(kSmall, kLarge);
BENCHMARK(flip_own)->Name("Flip/a_fact_that_one_reads")->RangeMultiplier(10)->Range(kSmall, kLarge);
BENCHMARK(flip_awake)->Name("Flip/a_fact_that_one_reads_all_awake")->RangeMultiplier(10)->Range(kSmall, kLarge);
BENCHMARK(flip_all)->Name("Flip/a_fact_that_all_read_all_awake")->RangeMultiplier(10)->Range(kSmall, kLarge);

}  // namespace

BENCHMARK_MAIN();
