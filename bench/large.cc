// What size costs: a city of 10,201 landmarks and 40,200 roads in eight directions, with a route of 1,000 legs, beside
// Route1. Both are driven by the same script along their route: sign, stop line, crossing, stop line, road.
//
//   Compile/large      from text to tables, with all checks
//   Tick/route1, Tick/large     the mean of the ticks of the script, on the same engine over tables in memory
//   Idle/large
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <sstream>
#include <string>

#include <waymark/runtime/engine.h>
#include "bench/compile.h"

namespace {

using kb::driver::Compilation;
using State = mts::DynamicState<kb::tables::I>;

constexpr int kSide = 101;
constexpr int kLegs = 1'000;

std::string landmark(int x, int y) { return "L" + std::to_string(x) + "_" + std::to_string(y); }

std::string city() {
  std::ostringstream out;
  out << "import std.navigation\nimport std.compass8\nmap City {\n";
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) out << "landmark " << landmark(x, y) << " at (" << x << ", " << y << ")\n";
  }
  const auto road = [&out](int x, int y, const char* exit, int u, int v, const char* approach) {
    if (u < 0 || v < 0 || u >= kSide || v >= kSide) return;
    out << "road " << landmark(x, y) << '.' << exit << " -- " << landmark(u, v) << '.' << approach << " by mark\n";
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      road(x, y, "E", x + 1, y, "W");
      road(x, y, "N", x, y + 1, "S");
      road(x, y, "NE", x + 1, y + 1, "SW");
      road(x, y, "SE", x + 1, y - 1, "NW");
    }
  }
  out << "}\ncommand Go\nroute R on City by Go:\n";
  int x = 0, y = 0, step = 1;
  for (int i = 0; i <= kLegs; ++i) {  // boustrophedon
    out << (i == 0 ? "  " : " -> ") << landmark(x, y);
    if (x + step < 0 || x + step >= kSide) {
      ++y;
      step = -step;
    } else {
      x += step;
    }
  }
  out << '\n';
  return out.str();
}

kb::driver::Options options() {
  kb::driver::Options options;
  options.library = LIBRARY;
  return options;
}

/// A mind over tables in memory, and the script that drives it along the legs of its route, again and again.
class Drive {
 public:
  explicit Drive(const Compilation& c) : program_(c.program), tables_(kb::tables::view(c.tables)) {
    memory_.resize(State::bytes(tables_.shape) / 8 + 1);
    state_.attach(tables_.shape, reinterpret_cast<std::byte*>(memory_.data()));
    engine().reset();
    script(c);
    for (int i = 0; i < 10; ++i) engine().advance(200'000);
  }

  struct Change { std::uint32_t fact; float value; };
  using Step = std::vector<Change>;

  mts::Engine<State, mts::DynamicTables<kb::tables::I>> engine() {
    return {mts::DynamicTables<kb::tables::I>(tables_), state_};
  }
  const std::vector<Step>& steps() const { return steps_; }
  State& state() { return state_; }

 private:
  std::uint32_t fact(const std::string& name) const {
    for (std::uint32_t i = 0; i < program_.facts; ++i) {
      if (program_.cells[i].name == name) return i;
    }
    std::abort();
  }

  void script(const Compilation& c) {
    const std::uint32_t line = fact("Line"), safe = fact("Safe"), cross = fact("CrossBy.mark"), move = fact("MoveBy.mark");
    const std::uint32_t track = fact("Track.mark"), start = fact(command(c));
    steps_.push_back({{track, 1.0f}});
    steps_.push_back({{start, 1.0f}});
    steps_.push_back({{start, 0.0f}});
    for (const auto id : c.model.rows_of("Leg")) {
      const auto& row = c.model[id];
      if (row.name.find(".d") != std::string::npos) continue;   // only the route itself
      const std::uint32_t here = fact(std::string(c.model[c.model.row_in(row, "to")->cell].name));
      const std::uint32_t in = fact("In.S");
      steps_.push_back({{here, 0.9f}, {in, 0.9f}});
      steps_.push_back({{line, 0.9f}, {safe, 0.9f}, {cross, 0.9f}});
      steps_.push_back({});
      steps_.push_back({{line, -0.9f}, {safe, 0.0f}, {cross, 0.0f}, {in, 0.0f}});
      steps_.push_back({});
      steps_.push_back({{line, 0.9f}, {move, 0.9f}, {here, -0.9f}});
      steps_.push_back({{line, -0.9f}, {move, 0.0f}});
      steps_.push_back({});
    }
  }
  static std::string command(const Compilation& c) {
    for (const auto& cell : c.program.cells) {
      if (cell.command) return std::string(cell.name);
    }
    std::abort();
  }

  const kb::program::Program& program_;
  mts::Tables<kb::tables::I> tables_;
  std::vector<std::uint64_t> memory_;
  State state_;
  std::vector<Step> steps_;
};

void tick(benchmark::State& state, const Compilation& compilation) {
  Drive drive(compilation);
  std::uint64_t ticks = 0, fired = 0;
  for (auto _ : state) {
    for (const Drive::Step& step : drive.steps()) {
      for (const auto& change : step) drive.engine().take_fact(change.fact, change.value);
      drive.engine().advance(400'000);
      fired += drive.state().fired;
      ++ticks;
    }
  }
  state.counters["ns_per_tick"] =
      benchmark::Counter(static_cast<double>(ticks) / 1e9, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["fired"] = static_cast<double>(fired) / static_cast<double>(ticks);
  state.counters["rules"] = static_cast<double>(compilation.program.rules.size());
}

const Compilation& route1() {
  static const auto compilation = bench::compile(ROUTE1, kb::source::RealFileSystem{}, options());
  return *compilation;
}
const Compilation& large() {
  static const auto compilation = bench::compile_text(city(), options());
  return *compilation;
}

void CompileLarge(benchmark::State& state) {
  const std::string text = city();
  for (auto _ : state) benchmark::DoNotOptimize(bench::compile_text(text, options())->tables.atoms.size());
}
BENCHMARK(CompileLarge)->Name("Compile/large")->Unit(benchmark::kMillisecond);

void TickRoute1(benchmark::State& state) { tick(state, route1()); }
BENCHMARK(TickRoute1)->Name("Tick/route1");
void TickLarge(benchmark::State& state) { tick(state, large()); }
BENCHMARK(TickLarge)->Name("Tick/large");

void IdleLarge(benchmark::State& state) {
  Drive drive(large());
  for (auto _ : state) {
    drive.engine().advance(1'000);
    benchmark::DoNotOptimize(drive.state().fired);
  }
}
BENCHMARK(IdleLarge)->Name("Idle/large");

}  // namespace

BENCHMARK_MAIN();
