// Robots of emitted fleets decide as the interpreter does, for random programs. See fleet_make_units.cc.
#include <cstdio>

#define KB_CASE(name) bool run_##name();
#include "fleet_cases.inc"
#undef KB_CASE

int main() {
  int passed = 0, failed = 0;
#define KB_CASE(name) (run_##name() ? passed : failed) += 1;
#include "fleet_cases.inc"
#undef KB_CASE
  std::printf("emitted fleets: %d passed, %d failed\n", passed, failed);
  return failed == 0 && passed > 0 ? 0 : 1;
}
