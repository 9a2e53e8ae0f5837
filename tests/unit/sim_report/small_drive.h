// Recordings to test with: a drive through the labyrinth of the paper with a detour and an obstacle, and odd ones.
#pragma once

#include <cstdint>

#include "sim/recording.h"

namespace kb::sim::testing {

/// From LM1 by LM5, LM2, LM3, LM6, LM7 and, as the road is closed, LM11 and LM13 to LM15: the path is given, the mind real
/// (see small_mind.h), the senses drawn from the seed. About 27 s; `laps` times over for longer recordings.
[[nodiscard]] Recording small_drive(std::uint32_t seed = 1, int laps = 1, double period_s = 0.1);

/// Names, notes and a title that would break out of scripts, tables and markup.
[[nodiscard]] Recording nasty_drive();

/// One frame, nothing around it.
[[nodiscard]] Recording one_frame();

/// NaN and infinities wherever a number can stand.
[[nodiscard]] Recording not_finite();

}  // namespace kb::sim::testing
