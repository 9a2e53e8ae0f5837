// Whether the minds written by hand decide what the compiled mind decides, on every tick of every trace: Table 1, the recorded
// missions, and missions with bad sensors. Fails on the first difference and on a contradiction, which these minds do not know.
#include <cstdio>
#include <cstdlib>
#include <exception>

#include "bench/peers/by_switch.h"
#include "bench/peers/by_tree.h"
#include "bench/peers/trace.h"

namespace {

const char* show(peers::Strategy strategy) { return strategy == peers::kNoStrategy ? "none" : paper::name(strategy); }

/// Ticks, events, and ticks at which something drives differently from the tick before.
struct Seen { std::size_t ticks = 0, events = 0, turns = 0, skipped = 0; };

template <class Peer>
bool agrees(const char* who, const peers::Trace& trace, Seen& seen) {
  paper::Mind mind;
  Peer peer;
  peers::Strategy before = peers::kNoStrategy;
  for (const peers::Step& step : trace.steps) {
    for (const peers::Change& change : step.changes) {
      mind.give(change.fact, change.value);
      peer.give(change.fact, change.value);
    }
    const auto decision = mind.tick(mts::microseconds(step.dt_us));
    const peers::Strategy ours = decision.drives() ? decision.strategy() : peers::kNoStrategy;
    const peers::Strategy theirs = peer.tick(step.dt_us);
    if (!decision.conflicts().empty()) {
      seen.skipped += trace.steps.size() - decision.tick() + 1;
      return true;   // the rest of the trace belongs to another state
    }
    if (ours != theirs) {
      std::fprintf(stderr, "%s differs at tick %llu of %s: %s, the compiled mind %s\n", who,
                   static_cast<unsigned long long>(decision.tick()), trace.name.c_str(), show(theirs), show(ours));
      return false;
    }
    ++seen.ticks;
    seen.events += decision.events().size();
    seen.turns += ours != before;
    before = ours;
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) try {
  const auto traces = peers::all_traces(argc > 1 ? argv[1] : ".", argc > 2 ? std::atoi(argv[2]) : 40);
  Seen seen;
  for (const peers::Trace& trace : traces) {
    if (!agrees<peers::SwitchMind>("the switch", trace, seen)) return 1;
    if (!agrees<peers::TreeMind>("the behaviour tree", trace, seen)) return 1;
  }
  std::printf("%zu traces, %zu ticks, %zu events, %zu changes of strategy; %zu ticks after a contradiction left out\n", traces.size(),
              seen.ticks, seen.events, seen.turns, seen.skipped);
  return seen.ticks > 10 * seen.skipped && seen.turns > 500 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "agree: %s\n", error.what());
  return 1;
}
