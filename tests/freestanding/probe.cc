// Uses everything that a knowledge base offers to a program, so that all of it is compiled without a standard library.
#include "goal.kb.h"
#include "paper.kb.h"

namespace {

route1::Mind mind;
route1::Facts facts;

}  // namespace

extern "C" int freestanding_probe(float line, unsigned elapsed_us) {
  facts.Line = line;
  facts.In.N = -line;
  facts.set(route1::Fact::Safe, 1.0f);
  const auto decision = mind.tick(facts, mts::microseconds(elapsed_us));
  int sum = static_cast<int>(decision.status()) + static_cast<int>(decision.bad_facts());
  for (const route1::Rule rule : decision.fired()) sum += static_cast<int>(rule);
  for (const route1::Fact fact : decision.events()) sum += route1::name(fact)[0];
  for (const auto& change : decision.changed()) sum += static_cast<int>(change.value);
  for (const auto& conflict : decision.conflicts()) sum += static_cast<int>(conflict.level);
  if (decision.drives()) sum += static_cast<int>(decision.strategy());
  if (mind.high(route1::Satellite::Astride)) mind.set(route1::Satellite::Astride, -1.0f);
  const auto way = goal::GoToGoal::evaluate({.bearing_deg = line, .free = {1.0f, line}});
  sum += static_cast<int>(way.turn_deg) + static_cast<int>(goal::GoToGoal::evaluate_tables({.bearing_deg = line, .free = {}}).turn_deg);
  sum += mts::text(way.status)[0];
  if (sum < 0) mind.reset();
  return sum + mts::text(decision.status())[0];
}
