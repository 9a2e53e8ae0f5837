// MUST NOT COMPILE: tick
#include "bumper.kb.h"

int main() {
  bumper::Mind mind;
  bumper::Facts facts;
#ifdef FIXED
  const auto decision = mind.tick(facts, mts::milliseconds(20));
#else
  const auto decision = mind.tick(facts, 20);
#endif
  return decision.drives() ? 0 : 1;
}
