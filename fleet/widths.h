// Compiles the file KB_FLEET_SOURCE once for each width of words that a processor may have. Included by emitted sources only, which
// include themselves through it.
//
// note [one source, several widths]
// A function can be compiled for wider registers than the rest of a program (a `target`), but then everything that it is made of must be,
// templates included. So the kernel is one source that is included several times, each time in its own namespace and with another target.
// Processors other than x86-64 take 64 bits at a time in plain C++.
#include "kernel.h"

#define KB_FLEET_WIDTH 64
#include KB_FLEET_SOURCE
#undef KB_FLEET_WIDTH

#ifdef MTS_FLEET_X86
#include <immintrin.h>
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif
#define KB_FLEET_WIDTH 256
#include KB_FLEET_SOURCE
#undef KB_FLEET_WIDTH
#ifdef __clang__
#pragma clang attribute pop
#pragma clang attribute push(__attribute__((target("avx512f"))), apply_to = function)
#else
#pragma GCC pop_options
#pragma GCC push_options
#pragma GCC target("avx512f")
#endif
#define KB_FLEET_WIDTH 512
#include KB_FLEET_SOURCE
#undef KB_FLEET_WIDTH
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
