// What all headers need of the compiler. Who compiles for an older standard gets one message in place of hundreds. Included by the headers that
// include nothing else of ours.
#pragma once

#if __cplusplus < 202002L
#error "Waymark needs C++20: compile with -std=c++20 or later"
#include "Waymark needs C++20"   // there is no such file: where an #error does not end the compilation, this does
#endif

// Decisions compare floats. Where these are kept with more bits than a float has, as in the x87 registers of 32-bit x86, `1 - x >= 0.6` may be true of
// one number and false of the same number once it is stored. 0: no more bits; 16: that of half floats, which nothing here uses.
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0 && __FLT_EVAL_METHOD__ != 16
#error "floats are computed with more bits than they have, so decisions would depend on the optimisation: on 32-bit x86 add -msse2 -mfpmath=sse"
#endif
