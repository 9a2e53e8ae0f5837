// Runs the cases that a maker of units has written: emitted C++ beside the interpreter, for random programs.
#include <cstdio>

#define KB_CASE(name) bool run_##name();
#include "cases.inc"
#undef KB_CASE

int main() {
  int passed = 0, failed = 0;
#define KB_CASE(name) (run_##name() ? passed : failed) += 1;
#include "cases.inc"
#undef KB_CASE
  std::printf("emitted: %d passed, %d failed\n", passed, failed);
  return failed == 0 && passed > 0 ? 0 : 1;
}
