// The same mission on the machine that compiles: prints the hash that the microcontroller has to come to.
#include <cinttypes>
#include <cstdio>

#include "mission.h"
#include "paper.kb.h"
#include "storm.h"
#include "trace_hash.h"

int main() {
  paper::Mind mind;
  mission::TraceHash trace;
  for (std::uint32_t tick = 0; tick < mission::kTicks; ++tick) {
    for (std::uint32_t i = mission::kBegin[tick]; i < mission::kBegin[tick + 1]; ++i) {
      mind.give(mission::kSamples[i].fact, mission::kSamples[i].certainty);
    }
    trace.add(mind.tick(mts::milliseconds(mission::kPeriodMs)));
  }
  std::printf("trace 0x%016" PRIx64 "\n", trace.value());
  mind.reset();
  const std::uint32_t contradictions = mission::storm(mind, trace);
  std::printf("storm 0x%016" PRIx64 " with %" PRIu32 " contradictions\n", trace.value(), contradictions);
}
