// MUST NOT COMPILE: Satellite
#include "bumper.kb.h"

int main() {
  bumper::Facts facts;
#ifdef FIXED
  facts.set(bumper::Fact::Wall, 0.9f);
#else
  facts.set(bumper::Satellite::sat_Wall, 0.9f);
#endif
  return 0;
}
