// Emitted fuzzy controllers answer as the interpreter does, for random controllers. See fuzzy_make_units.cc.
#include <cstdio>

#define KB_CASE(name) bool run_##name();
#include "fuzzy_cases.inc"
#undef KB_CASE

int main() {
  int passed = 0, failed = 0;
#define KB_CASE(name) (run_##name() ? passed : failed) += 1;
#include "fuzzy_cases.inc"
#undef KB_CASE
  std::printf("emitted fuzzy controllers: %d passed, %d failed\n", passed, failed);
  return failed == 0 && passed > 0 ? 0 : 1;
}
