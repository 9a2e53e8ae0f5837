// MUST NOT COMPILE: Strategy
#include "bumper.kb.h"

int main() {
  bumper::Mind mind;
#ifdef FIXED
  return mind.decision().strategy() == bumper::Strategy::Drive_back ? 0 : 1;
#else
  return mind.decision().strategy() == bumper::Fact::Wall ? 0 : 1;
#endif
}
