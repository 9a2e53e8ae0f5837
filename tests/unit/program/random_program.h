// Random programs and random days for them: what tables, emitted code and the interpreter must agree about.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/program/program.h"

namespace kb::program::testing {

/// One tick of a trace.
struct Step {
  std::vector<float> facts;  ///< may hold NaN and values outside [-1, 1]
  std::uint32_t dt_us = 0;
};

/// What the variable says, if it is set. KB_RANDOM_SEED and KB_RANDOM_COUNT say which programs a test tries: more in a long run,
/// fewer where sanitizers slow it down.
[[nodiscard]] std::uint64_t count_from(const char* variable, std::uint64_t otherwise);

/// A sound program; the same for the same seed, on every machine. Most are small (a few dozen rules); some have an
/// exclusive group of up to 150 members, some hundreds of rules, a few more than 32 strategies. Every kind of
/// condition, effect, setting and threshold occurs; rules contradict each other often.
[[nodiscard]] Program random_program(std::uint64_t seed);

/// Facts that dwell and jump: on round values, on the program's exact thresholds and a float beside them, rarely no
/// number at all. Times between ticks vary and may be 0.
[[nodiscard]] std::vector<Step> random_trace(const Program& program, std::uint64_t seed, std::size_t ticks);

}  // namespace kb::program::testing
