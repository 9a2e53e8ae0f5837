// Uses everything that perception offers to a program, so that all of it is compiled without a standard library.
#include "senses.kb.h"

namespace {

senses::Mind mind;
senses::Readings readings;
senses::Perception perception;

}  // namespace

extern "C" int freestanding_probe_perception(float value, long long now_us) {
  const mts::Instant now{now_us};
  for (unsigned i = 0; i < 5; ++i) readings.line[i] = {value, now};
  readings.range[2].forget();
  readings.compass = {value, now};
  readings.tag = {"LM7", now};
  readings.memory.forget();
  const auto decision = mind.tick(perception.look(readings, now, mind), mts::milliseconds(20));
  int sum = static_cast<int>(perception.report().silent + perception.report().fits);
  if (sum < 0) perception.reset();
  perception.facts().Start1 = value;
  return sum + mts::text(perception.report().sight)[0] + static_cast<int>(decision.status());
}
