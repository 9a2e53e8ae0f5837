// What a fuzzy controller costs: the 72 rules of std.go_to_goal, as emitted C++ and by walking the tables, beside fuzzylite 6
// with the same 72 rules, terms and inputs.
//
// fuzzylite knows no circles: there the word `back` is a list of points with both ends of the range, and outputs are plain
// weighted averages, with neither `winner` nor `within`. Where one word alone holds (bearings that are multiples of 45
// degrees) both must give the same direction; that is checked before anything is timed. Of the timed inputs they differ at 115.
//
// The first lines of the output are the ratios, from many short rounds in which all take turns over the same inputs.
#include <benchmark/benchmark.h>
#include <fl/Headers.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include <time.h>

#include "bench/allocations.h"
#include "goal.kb.h"

namespace {

using bench::allocations;

/// Time of the processor that this thread has had: a long round would else be charged more often with what others do meanwhile.
double now_ns() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

constexpr const char* kDirections[] = {"ahead", "front_left", "left", "back_left", "back", "back_right", "right", "front_right"};

int centre(int direction) { return direction > 4 ? 45 * direction - 360 : 45 * direction; }

std::string joined(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : " and ") + part;
  return out;
}

/// The rules of std.go_to_goal for one direction of the goal, as FLL.
std::string rules_for(int goal) {
  const auto free = [](int k, const char* term) { return "free_" + std::to_string(k & 7) + " is " + term; };
  const std::string word = kDirections[goal];
  std::string out;
  const auto rule = [&](std::vector<std::string> parts, int direction) {
    parts.insert(parts.begin(), "bearing is " + word);
    out += "  rule: if " + joined(parts) + " then speed is " + (direction == 0 ? "full" : "stop");
    out += direction < 0 ? "\n" : " and turn is " + std::string(kDirections[direction]) + "\n";
  };
  std::vector<std::string> blocked = {free(goal, "no")};
  rule({free(goal, "yes")}, goal);
  for (int k = 1; k <= 3; ++k) {
    for (const int side : {1, -1}) {
      std::vector<std::string> parts = blocked;
      parts.push_back(free(goal + side * k, "yes"));
      parts.push_back(std::string("( bearing is ") + (side > 0 ? "" : "not ") + "past_" + word + " or " + free(goal - side * k, "no") + " )");
      rule(parts, (goal + side * k) & 7);
    }
    blocked.push_back(free(goal + k, "no"));
    blocked.push_back(free(goal - k, "no"));
  }
  std::vector<std::string> back = blocked, none = blocked;
  back.push_back(free(goal + 4, "yes"));
  none.push_back(free(goal + 4, "no"));
  rule(back, (goal + 4) & 7);
  rule(none, -1);
  return out;
}

std::string engine_text() {
  std::string out = "Engine: goal\nInputVariable: bearing\n  enabled: true\n  range: -180 180\n  lock-range: false\n";
  for (int d = 0; d < 8; ++d) {
    const int c = centre(d);
    out += std::string("  term: ") + kDirections[d];
    out += d == 4 ? " Discrete -180 1 -135 0 135 0 180 1\n"
                  : " Triangle " + std::to_string(c - 45) + " " + std::to_string(c) + " " + std::to_string(c + 45) + "\n";
    const int from = d == 4 ? -180 : c;
    out += std::string("  term: past_") + kDirections[d] + " Rectangle " + std::to_string(from) + " " + std::to_string(from + 45) + "\n";
  }
  for (int k = 0; k < 8; ++k) {
    out += "InputVariable: free_" + std::to_string(k) + "\n  enabled: true\n  range: 0 1\n  lock-range: false\n  term: yes Ramp 0.4 0.6\n  term: no Ramp 0.6 0.4\n";
  }
  out += "OutputVariable: speed\n  enabled: true\n  range: 0 1\n  lock-range: false\n  aggregation: none\n  defuzzifier: WeightedAverage TakagiSugeno\n  default: 0\n  lock-previous: false\n  term: stop Constant 0\n  term: full Constant 1\n";
  out += "OutputVariable: turn\n  enabled: true\n  range: -180 180\n  lock-range: false\n  aggregation: none\n  defuzzifier: WeightedAverage TakagiSugeno\n  default: 0\n  lock-previous: false\n";
  for (int d = 0; d < 8; ++d) out += std::string("  term: ") + kDirections[d] + " Constant " + std::to_string(centre(d)) + "\n";
  out += "RuleBlock: all\n  enabled: true\n  conjunction: AlgebraicProduct\n  disjunction: Maximum\n  implication: none\n  activation: General\n";
  for (int goal = 0; goal < 8; ++goal) out += rules_for(goal);
  return out;
}

using Input = goal::GoToGoal::Inputs;

/// Bearings and patterns of free directions, the same on every run.
std::vector<Input> make_inputs() {
  std::vector<Input> all(1'024);
  std::uint32_t state = 1;
  for (Input& in : all) {
    state = state * 1'664'525u + 1'013'904'223u;
    in.bearing_deg = static_cast<float>(state >> 8) / static_cast<float>(1u << 24) * 360.0f - 180.0f;
    state = state * 1'664'525u + 1'013'904'223u;
    for (int k = 0; k < 8; ++k) in.free[k] = static_cast<float>(state >> (16 + k) & 1u);
  }
  return all;
}

class Peer {
 public:
  Peer() : engine_(fl::FllImporter().fromString(engine_text())) {
    bearing_ = engine_->getInputVariable("bearing");
    for (int k = 0; k < 8; ++k) free_[k] = engine_->getInputVariable("free_" + std::to_string(k));
    turn_ = engine_->getOutputVariable("turn");
  }
  double turn(const Input& in) {
    bearing_->setValue(static_cast<double>(in.bearing_deg));
    for (int k = 0; k < 8; ++k) free_[k]->setValue(static_cast<double>(in.free[k]));
    engine_->process();
    return turn_->getValue();
  }
  [[nodiscard]] std::size_t rules() const { return engine_->getRuleBlock(0)->numberOfRules(); }

 private:
  std::unique_ptr<fl::Engine> engine_;
  fl::InputVariable* bearing_ = nullptr;
  fl::InputVariable* free_[8] = {};
  fl::OutputVariable* turn_ = nullptr;
};

/// Where one word alone holds, both give the same direction.
bool agree(Peer& peer) {
  for (int direction = 0; direction < 8; ++direction) {
    for (unsigned pattern = 1; pattern < 256; ++pattern) {
      Input in;
      in.bearing_deg = direction == 4 ? -180.0f : static_cast<float>(centre(direction));
      for (int k = 0; k < 8; ++k) in.free[k] = static_cast<float>(pattern >> k & 1u);
      const double ours = static_cast<double>(goal::GoToGoal::evaluate(in).turn_deg);
      if (std::fabs(std::remainder(ours - peer.turn(in), 360.0)) < 1e-3) continue;
      std::printf("at %g, pattern %u: %g, fuzzylite %g\n", static_cast<double>(in.bearing_deg), pattern, ours, peer.turn(in));
      return false;
    }
  }
  return true;
}

/// Both ways to evaluate give the same, on all inputs that are timed.
bool same(const std::vector<Input>& inputs) {
  return std::all_of(inputs.begin(), inputs.end(), [](const Input& in) {
    const auto a = goal::GoToGoal::evaluate(in), b = goal::GoToGoal::evaluate_tables(in);
    return a.speed == b.speed && a.turn_deg == b.turn_deg && a.status == b.status;
  });
}

template <class Evaluate>
double nanoseconds(const std::vector<Input>& inputs, int rounds, Evaluate evaluate) {
  double sum = 0.0;
  const double begin = now_ns();
  for (int r = 0; r < rounds; ++r) {
    for (const Input& in : inputs) sum += evaluate(in);
  }
  benchmark::DoNotOptimize(sum);
  return (now_ns() - begin) / (static_cast<double>(rounds) * static_cast<double>(inputs.size()));
}

/// Times of many short rounds, in which the three take turns, so that other work on the machine meets all of them.
struct Times {
  std::vector<double> straight, tables, fuzzylite;
  std::size_t allocations = 0;
};
Times take_turns(Peer& peer, const std::vector<Input>& inputs) {
  Times times;
  for (int round = 0; round < 41; ++round) {
    const std::size_t before = allocations;
    const double straight = nanoseconds(inputs, 20, [](const Input& in) { return static_cast<double>(goal::GoToGoal::evaluate(in).turn_deg); });
    const double tables = nanoseconds(inputs, 5, [](const Input& in) { return static_cast<double>(goal::GoToGoal::evaluate_tables(in).turn_deg); });
    times.allocations += allocations - before;
    times.straight.push_back(straight);
    times.tables.push_back(tables);
    times.fuzzylite.push_back(nanoseconds(inputs, 1, [&](const Input& in) { return peer.turn(in); }));
  }
  for (auto* list : {&times.straight, &times.tables, &times.fuzzylite}) std::sort(list->begin(), list->end());
  return times;
}

void report(const char* name, const std::vector<double>& ours, const std::vector<double>& theirs) {
  const std::size_t middle = ours.size() / 2;
  std::printf("%s: %.0f times as fast as fuzzylite in the median (%.1f ns against %.0f ns), %.0f times in the minimum (%.1f ns against %.0f ns)\n", name,
              theirs[middle] / ours[middle], ours[middle], theirs[middle], theirs[0] / ours[0], ours[0], theirs[0]);
}

void emitted(benchmark::State& state) {
  const std::vector<Input> inputs = make_inputs();
  std::size_t i = 0;
  const std::size_t before = allocations;
  for (auto _ : state) benchmark::DoNotOptimize(goal::GoToGoal::evaluate(inputs[i++ % inputs.size()]));
  state.counters["allocations"] = static_cast<double>(allocations - before);
}
BENCHMARK(emitted);

void tables(benchmark::State& state) {
  const std::vector<Input> inputs = make_inputs();
  std::size_t i = 0;
  const std::size_t before = allocations;
  for (auto _ : state) benchmark::DoNotOptimize(goal::GoToGoal::evaluate_tables(inputs[i++ % inputs.size()]));
  state.counters["allocations"] = static_cast<double>(allocations - before);
}
BENCHMARK(tables);

void fuzzylite(benchmark::State& state) {
  const std::vector<Input> inputs = make_inputs();
  Peer peer;
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(peer.turn(inputs[i++ % inputs.size()]));
}
BENCHMARK(fuzzylite);

}  // namespace

int main(int argc, char** argv) {
  Peer peer;
  if (!agree(peer)) return 1;
  const std::vector<Input> inputs = make_inputs();
  if (!same(inputs)) return 1;
  const Times times = take_turns(peer, inputs);
  report("emitted C++", times.straight, times.fuzzylite);
  report("tables", times.tables, times.fuzzylite);
  std::printf("%zu rules, %zu allocations\n", peer.rules(), times.allocations);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
