// MUST NOT COMPILE: Waymark needs C++20
#ifndef FIXED   // as -std=c++17 does
#undef __cplusplus
#define __cplusplus 201703L
#endif
#include "bumper.kb.h"

int main() {
  bumper::Mind mind;
  return mind.decision().drives() ? 1 : 0;
}
