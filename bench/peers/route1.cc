// Route1 in every form over the same facts.
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <stdexcept>

#include <waymark/runtime/image_mind.h>
#include "bench/peers/by_switch.h"
#include "bench/peers/by_tree.h"
#include "bench/peers/clips_mind.h"
#include "bench/peers/measure.h"
#include "bench/peers/trace.h"

namespace peers {
namespace {

constexpr int kDisturbances = 10;

/// The emitted C++.
class Emitted {
 public:
  void give(Fact fact, float value) { facts_.set(fact, value); }
  Strategy tick(std::uint32_t dt_us) {
    const auto decision = mind_.tick(facts_, mts::microseconds(dt_us));
    return decision.drives() ? decision.strategy() : kNoStrategy;
  }
  void reset() {
    mind_.reset();
    facts_.clear();
  }
  [[nodiscard]] auto decision() const { return mind_.decision(); }

 private:
  paper::Mind mind_;
  paper::Facts facts_;
};

/// The same by its image, as a running robot takes it.
class FromImage {
 public:
  explicit FromImage(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("cannot read " + path);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    image_.resize(bytes.size() / 8 + 1);
    std::copy(bytes.begin(), bytes.end(), reinterpret_cast<char*>(image_.data()));
    size_ = bytes.size();
    block_.resize(1 << 16);
    reset();
  }
  void give(Fact fact, float value) { mind_.set_fact(static_cast<std::uint32_t>(fact), value); }
  Strategy tick(std::uint32_t dt_us) {
    mind_.tick(mts::microseconds(dt_us));
    return mind_.drives() ? static_cast<Strategy>(mind_.strategy()) : kNoStrategy;
  }
  void reset() {
    mts::SwapReport report;
    mind_ = mts::ImageMind();
    const auto status = mind_.take(image_.data(), size_, reinterpret_cast<std::byte*>(block_.data()), 8 * block_.size(), report, [](const auto&) {});
    if (status != mts::ImageStatus::kOk) throw std::runtime_error("the image of Route1 is refused");
  }

 private:
  std::vector<std::uint64_t> image_, block_;
  std::size_t size_ = 0;
  mts::ImageMind mind_;
};

class Switch : public SwitchMind {
 public:
  void reset() { static_cast<SwitchMind&>(*this) = SwitchMind(); }
};

class Tree {
 public:
  void give(Fact fact, float value) { mind_->give(fact, value); }
  Strategy tick(std::uint32_t dt_us) { return mind_->tick(dt_us); }
  void reset() { mind_ = std::make_unique<TreeMind>(); }

 private:
  std::unique_ptr<TreeMind> mind_ = std::make_unique<TreeMind>();
};

template <class Peer>
Strategy step_of(Peer& peer, const Step& step) {
  for (const Change& change : step.changes) peer.give(change.fact, change.value);
  return peer.tick(step.dt_us);
}

/// What the ticks of all traces are, as the emitted mind says.
struct Tick { bool event; Strategy strategy; std::vector<std::string> fired; };

std::vector<Tick> decide(const std::vector<Trace>& traces) {
  std::vector<Tick> ticks;
  for (const Trace& trace : traces) {
    Emitted mind;
    for (const Step& step : trace.steps) {
      const Strategy strategy = step_of(mind, step);
      const auto decision = mind.decision();
      if (!decision.conflicts().empty()) throw std::runtime_error(trace.name + " has a contradiction: take other seeds");
      const bool acted = decision.fired().size() > (decision.drives() ? 1u : 0u) || !decision.changed().empty();
      ticks.push_back({acted || !step.changes.empty(), strategy, {}});
      for (const auto rule : decision.fired()) ticks.back().fired.emplace_back(paper::name(rule));
    }
  }
  return ticks;
}

/// Holds the strategy of every tick against that of the emitted mind; `fired(peer)` the rules as well, where a peer has them.
template <class Peer, class Fired>
void check(const char* name, Peer& peer, const std::vector<Trace>& traces, const std::vector<Tick>& ticks, Fired&& fired) {
  std::size_t i = 0;
  for (const Trace& trace : traces) {
    peer.reset();
    std::size_t n = 0;
    for (const Step& step : trace.steps) {
      ++n;
      const Strategy strategy = step_of(peer, step);
      if (strategy != ticks[i].strategy || !fired(peer, ticks[i].fired)) {
        throw std::runtime_error(std::string(name) + " decides differently at tick " + std::to_string(n) + " of " + trace.name);
      }
      ++i;
    }
  }
}

constexpr auto kHasNoRules = [](const auto&, const std::vector<std::string>&) { return true; };

/// A peer's ticks: of each the least time over all rounds; and the least time of each trace as a whole.
struct Timing { std::vector<double> ns, trace_ns; };

template <class Peer>
void time_round(Peer& peer, const std::vector<Trace>& traces, Timing& timing) {
  for (std::size_t t = 0; t < traces.size(); ++t) {   // once as a whole
    peer.reset();
    const auto begin = Clock::now();
    for (const Step& step : traces[t].steps) keep(step_of(peer, step));
    timing.trace_ns[t] = std::min(timing.trace_ns[t], ns_since(begin));
  }
  std::size_t i = 0;
  for (const Trace& trace : traces) {   // and once tick by tick
    peer.reset();
    for (const Step& step : trace.steps) {
      const auto begin = Clock::now();
      keep(step_of(peer, step));
      timing.ns[i] = std::min(timing.ns[i], ns_since(begin));
      ++i;
    }
  }
}

nlohmann::json figures(const char* name, const Timing& timing, const std::vector<Tick>& ticks, double clock) {
  double event_ns = 0, other_ns = 0, worst_ns = 0;
  std::size_t events = 0;
  for (std::size_t i = 0; i < timing.ns.size(); ++i) {
    (ticks[i].event ? event_ns : other_ns) += timing.ns[i] - clock;
    events += ticks[i].event;
    worst_ns = std::max(worst_ns, timing.ns[i] - clock);
  }
  const double others = static_cast<double>(timing.ns.size() - events);
  return {{"name", name}, {"event_ns", event_ns / static_cast<double>(events)}, {"other_ns", other_ns / others},
          {"worst_ns", worst_ns}, {"mean_ns", std::accumulate(timing.trace_ns.begin(), timing.trace_ns.end(), 0.0) / static_cast<double>(timing.ns.size())}};
}

}  // namespace

nlohmann::json compare_route1(const std::string& program_json, const std::string& image, const std::string& sources, int rounds) {
  const ClipsProgram program = clips_program(program_json);
  Emitted emitted;
  FromImage from_image(image);
  Switch by_switch;
  Tree by_tree;
  ClipsMind by_clips(program);
  const auto all = all_traces(sources, kDisturbances);
  const auto all_ticks = decide(all);
  check("the image", from_image, all, all_ticks, kHasNoRules);
  check("the switch", by_switch, all, all_ticks, kHasNoRules);
  check("the behaviour tree", by_tree, all, all_ticks, kHasNoRules);
  check("CLIPS", by_clips, all, all_ticks, [&program](const ClipsMind& mind, const std::vector<std::string>& fired) {
    return !mind.contradicted() && std::equal(mind.fired().begin(), mind.fired().end(), fired.begin(), fired.end(),
                                             [&program](std::uint32_t rule, const std::string& name) { return program.rules[rule].name == name; });
  });

  const auto traces = all_traces(sources, 0);
  const auto ticks = decide(traces);
  Timing timings[5];
  for (Timing& timing : timings) {
    timing.ns.assign(ticks.size(), std::numeric_limits<double>::max());
    timing.trace_ns.assign(traces.size(), std::numeric_limits<double>::max());
  }
  for (int round = 0; round < rounds; ++round) {
    time_round(emitted, traces, timings[0]);
    time_round(from_image, traces, timings[1]);
    time_round(by_switch, traces, timings[2]);
    time_round(by_tree, traces, timings[3]);
    if (round % 2 == 0) time_round(by_clips, traces, timings[4]);   // it takes nearly all of the time
  }
  const double clock = clock_ns();
  nlohmann::json result{{"checked_ticks", all_ticks.size()}, {"ticks", ticks.size()}, {"rules", program.rules.size()}, {"rounds", rounds}};
  result["events"] = std::count_if(ticks.begin(), ticks.end(), [](const Tick& tick) { return tick.event; });
  const char* const names[] = {"Waymark, emitted C++", "Waymark, image", "switch by hand", "behaviour tree by hand", "CLIPS"};
  for (std::size_t i = 0; i < std::size(names); ++i) result["peers"].push_back(figures(names[i], timings[i], ticks, clock));
  return result;
}

}  // namespace peers
