// Facts at random, for what a quiet mission does not reach: rules that contradict each other, timers cut short, facts that
// are out of range. The same numbers on every machine.
#pragma once

#include <cstdint>

#include "paper.kb.h"
#include "trace_hash.h"

namespace mission {

/// Random numbers by a linear congruence (Numerical Recipes, 1992); its upper bits are the good ones.
class Random {
 public:
  /// In [0, n), n at most 65,536.
  std::uint32_t below(std::uint32_t n) {
    state_ = state_ * 1'664'525u + 1'013'904'223u;
    return (state_ >> 16) % n;
  }

 private:
  std::uint32_t state_ = 1;
};

inline constexpr std::uint32_t kStormTicks = 2'000;

/// Three facts change before each tick, and up to 0.8 s pass; the trace of it all goes into `trace`. Returns the number of
/// contradictions.
inline std::uint32_t storm(paper::Mind& mind, TraceHash& trace) {
  static constexpr float kCertainties[] = {-1.0f, 1.0f, 0.0f, 5.0f, 0.9f, 0.8f, 0.7f, 0.6f, 0.55f, -0.6f, 0.95f, 0.3f};
  Random random;
  std::uint32_t contradictions = 0;
  for (std::uint32_t tick = 0; tick < kStormTicks; ++tick) {
    for (int i = 0; i < 3; ++i) {
      const auto fact = static_cast<paper::Fact>(random.below(paper::Knowledge::kShape.facts));
      mind.give(fact, kCertainties[random.below(sizeof kCertainties / sizeof *kCertainties)]);
    }
    const auto decision = mind.tick(mts::milliseconds(random.below(800)));
    trace.add(decision);
    contradictions += static_cast<std::uint32_t>(decision.conflicts().size());
  }
  return contradictions;
}

}  // namespace mission
