// The status of a tick. A tick never fails; its status names the worst thing that happened on it.
#pragma once

#include <cstdint>

#include "cpp20.h"

namespace mts {

/// In order of severity: a tick has the highest status that applies. A single sensor that gives NaN therefore hides an expired hold. If
/// you must not miss a condition, ask the decision for it directly: `holding()`, `hold_expired()`, `bad_facts()`, `conflicts()`.
enum class Status : std::uint8_t {
  kOk,             ///< a strategy runs
  kNoStrategy,     ///< no strategy is active: the robot stops, or the named idle strategy runs
  kHolding,        ///< no strategy is active; the last one goes on (idle = hold)
  kHoldExpired,    ///< ... and has gone on for as long as it may: the robot stops
  kBadFact,        ///< some fact was NaN (taken as 0) or outside [-1, 1] (clamped)
  kConflict,       ///< rules of one level contradicted each other; they stay armed
  kTwoStrategies,  ///< more than one strategy was active: the one of highest priority runs
};

// The switch has no default, so that -Wswitch finds a forgotten name. -Wswitch-default, which some firmware turns on, would demand one.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wswitch-default"
/// A word for logs: "ok", "no_strategy", ... The string is static.
[[nodiscard]] constexpr const char* text(Status status) {
  switch (status) {
    case Status::kOk: return "ok";
    case Status::kNoStrategy: return "no_strategy";
    case Status::kHolding: return "holding";
    case Status::kHoldExpired: return "hold_expired";
    case Status::kBadFact: return "bad_fact";
    case Status::kConflict: return "conflict";
    case Status::kTwoStrategies: return "two_strategies";
  }
  return "unknown";
}
#pragma GCC diagnostic pop

}  // namespace mts
