// One message to who compiles for an older standard, in place of hundreds. Included by the headers that include nothing else of ours.
#pragma once

#if __cplusplus < 202002L
#error "Waymark needs C++20: compile with -std=c++20 or later"
#include "Waymark needs C++20"   // there is no such file: where an #error does not end the compilation, this does
#endif
