// What is installed and emitted, after macros that come with headers of others. They are defined after the standard library's headers,
// as theirs are.
#include <algorithm>
#include <atomic>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <functional>
#include <initializer_list>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <thread>
#include <type_traits>
#include <utility>
#include <vector>

#define I 1   // <complex.h>

#define _B 1   // newlib's <ctype.h>
#define _C 1
#define _N 1
#define _P 1
#define _S 1
#define _X 1

#define A0 1   // Arduino
#define B0 0
#define B1 1
#define DEFAULT 1
#define EULER 2.7
#define F(text) (text)
#define HIGH 1
#define INPUT 0
#define LOW 0
#define OUTPUT 1
#define PI 3.1
#define abs(x) ((x) > 0 ? (x) : -(x))
#define bit(b) (1 << (b))
#define constrain(x, low, high) ((x) < (low) ? (low) : (x))
#define degrees(x) ((x) * 57.3)
#define max(a, b) ((a) > (b) ? (a) : (b))
#define min(a, b) ((a) < (b) ? (a) : (b))
#define radians(x) ((x) / 57.3)
#define round(x) ((long)(x))
#define sq(x) ((x) * (x))
#define word(...) (__VA_ARGS__)

#define DELETE 1   // <windows.h>
#define ERROR 0
#define IN
#define OUT
#define far
#define interface struct
#define near
#define small char

#define emit   // Qt
#define foreach for
#define signals public
#define slots

#include <waymark/controllers/any_controller.h>
#include <waymark/controllers/lookout.h>
#include <waymark/runtime/compact_mind.h>
#include <waymark/runtime/image_mind.h>
#include "pace.kb.h"
#include "route1.kb.h"
#include "senses.kb.h"

#undef bit   // an Arduino has no fleets
#undef word
#include "bumper.kb.fleet.h"
