// Emitted perception sees what the plain reading of the program says, for random programs. See perception_make_units.cc.
#include <cstdio>

#define KB_CASE(name) bool run_##name();
#include "perception_cases.inc"
#undef KB_CASE

int main() {
  int passed = 0, failed = 0;
#define KB_CASE(name) (run_##name() ? passed : failed) += 1;
#include "perception_cases.inc"
#undef KB_CASE
  std::printf("emitted perception: %d passed, %d failed\n", passed, failed);
  return failed == 0 && passed > 0 ? 0 : 1;
}
