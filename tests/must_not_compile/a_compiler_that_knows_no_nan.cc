// MUST NOT COMPILE: -ffinite-math-only
#ifndef FIXED   // as that option does
#undef __FINITE_MATH_ONLY__
#define __FINITE_MATH_ONLY__ 1
#endif
#include "bumper.kb.h"

int main() {
  bumper::Mind mind;
  return mind.decision().drives() ? 1 : 0;
}
