// What a simulated second costs: Route1 through its labyrinth, from the button to LM15, with all sensors.
//
//   Drive       the whole drive; `times_real` is how many simulated seconds go into a second of one core
//   Recorded    the same, with a frame written for each tick
//   Physics     Box2D alone: a step of 10 ms, the robot on a road
//   Sense       all sensors for 10 ms at their rates, rays included
//   Control     perception and controllers, a period of 20 ms
//   Think       a tick of the mind, facts included
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"
#include "sim/drive/drive.h"

namespace {

using namespace kb;

/// Route1, compiled and laid out once.
struct Route1 {
  Route1() {
    const source::RealFileSystem files;
    driver::Options options;
    options.library = LIBRARY;
    compiled = driver::compile(MISSION, files, options, diagnostics::CountingConsumer::make, nullptr);
    diagnostics::Diagnostics messages(compiled->sources, consumer);
    labyrinth = sim::lay_out(compiled->model, {}, messages);
    knowledge = sim::prepare(compiled->model, compiled->program, compiled->tables, messages);
    scenario = sim::plain_scenario(*labyrinth, *knowledge, compiled->model, messages);
  }
  diagnostics::CountingConsumer consumer;
  std::unique_ptr<driver::Compilation> compiled;
  std::optional<sim::Labyrinth> labyrinth;
  std::optional<sim::Knowledge> knowledge;
  std::optional<sim::Scenario> scenario;
};

const Route1& route1() {
  static const Route1 made;
  return made;
}

void drive(benchmark::State& state, bool recorded) {
  const Route1& r = route1();
  double simulated_s = 0.0;
  std::string outcome;
  for (auto _ : state) {
    sim::Recording recording;
    sim::Drive run(*r.labyrinth, *r.knowledge, *r.scenario, {100'000, recorded ? &recording : nullptr, {}});
    outcome = describe(run.run());
    simulated_s += run.time_s();
  }
  state.counters["times_real"] = benchmark::Counter(simulated_s, benchmark::Counter::kIsRate);
  state.SetLabel(outcome);
}
void Drive(benchmark::State& state) { drive(state, false); }
void Recorded(benchmark::State& state) { drive(state, true); }
BENCHMARK(Drive)->Unit(benchmark::kMillisecond);
BENCHMARK(Recorded)->Unit(benchmark::kMillisecond);

/// The parts of a robot on the road from LM1 to LM5.
struct Parts {
  Parts() : arena(*route1().labyrinth, route1().scenario->start), floor(*route1().labyrinth), wheels({}, 1), sensors({}, 1),
            driver(*route1().knowledge, *route1().labyrinth, sim::kRobot) {}
  sim::Arena arena;
  sim::Floor floor;
  sim::DriveTrain wheels;
  sim::Sensors sensors;
  sim::Driver driver;
};

void Physics(benchmark::State& state) {
  Parts p;
  for (auto _ : state) p.arena.push(0.0, 0.1, 0.01);
}
BENCHMARK(Physics);

void Sense(benchmark::State& state) {
  Parts p;
  std::int64_t now_us = 0;
  for (auto _ : state) p.sensors.sample(now_us += 10'000, p.arena, p.floor, p.wheels, 0.01);
}
BENCHMARK(Sense);

void Control(benchmark::State& state) {
  Parts p;
  mts::Senses senses;
  sim::TagHeard tag;
  for (int i = 1; i < 20; ++i) p.sensors.sample(i * 10'000, p.arena, p.floor, p.wheels, 0.01);
  p.driver.mind().press(route1().knowledge->missions.front().command, sim::Mind::kHeld);
  for (int i = 1; i < 3; ++i) static_cast<void>(p.driver.tick(i * 100'000, 100'000));
  for (auto _ : state) {
    p.sensors.hear(200'000, senses);
    p.sensors.hear_tag(200'000, tag);
    benchmark::DoNotOptimize(p.driver.hear(senses, tag, 0.02f));
  }
}
BENCHMARK(Control);

void Think(benchmark::State& state) {
  Parts p;
  std::int64_t now_us = 0;
  for (auto _ : state) benchmark::DoNotOptimize(&p.driver.tick(now_us += 100'000, 100'000));
}
BENCHMARK(Think);

}  // namespace

BENCHMARK_MAIN();
