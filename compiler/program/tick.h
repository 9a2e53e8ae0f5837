// What one tick did, in the program's own ids: the same record from the interpreter, the tables, and emitted C++.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/program/program.h"

namespace kb::program {

/// The worst thing that can be said of a tick; the order is that of severity. Mirrors mts::Status (runtime/status.h).
enum class Status : std::uint8_t {
  kOk,             ///< a strategy runs
  kNoStrategy,     ///< no strategy is active; the robot stops (or the named idle strategy runs)
  kHolding,        ///< no strategy is active; the last one goes on (idle = hold)
  kHoldExpired,    ///< ... and its time to go on is over: the robot stops
  kBadFact,        ///< some fact was NaN (taken as 0) or outside [-1, 1] (clamped)
  kConflict,       ///< rules of one level contradicted each other
  kTwoStrategies,  ///< more than one strategy was active: the one of highest priority runs
};
[[nodiscard]] const char* status_text(Status status);  ///< "ok", "no_strategy", "holding", ...

struct CellValue {
  CellId cell = CellId::kNone;
  float value = 0.0f;
  friend bool operator==(const CellValue&, const CellValue&) = default;
};
/// Whether a fact may be given so. NaN may not.
[[nodiscard]] constexpr bool is_certainty(float given) { return given >= -1.0f && given <= 1.0f; }

struct Conflict {
  CellId cell = CellId::kNone;
  std::vector<RuleId> rules;  ///< all rules that wrote the cell in that level, ascending
  friend bool operator==(const Conflict&, const Conflict&) = default;
};

struct Tick {
  std::uint64_t number = 0;          ///< the first tick is 1
  std::int64_t time_us = 0;          ///< since the first tick
  std::vector<CellId> events, lost;  ///< ascending
  std::vector<RuleId> fired;         ///< by level, ascending (Program::rules is ordered by level: ascending throughout)
  std::vector<CellValue> set;        ///< satellites whose value after the tick differs from that before it, ascending
  std::vector<Conflict> conflicts;   ///< by level, then by cell
  CellId strategy = CellId::kNone;   ///< what is dispatched (after idle and hold)
  std::vector<CellId> active;        ///< strategies with cf >= firing, by priority; more than one is a fault
  std::vector<CellValue> perceived;  ///< perceived facts whose certainty differs from the last tick's, ascending
  std::uint32_t bad_facts = 0;       ///< facts that were NaN or out of range on this tick
  Status status = Status::kOk;
  friend bool operator==(const Tick&, const Tick&) = default;
};

/// One line of JSON as `kbc run --trace` writes it, without line break.
[[nodiscard]] std::string print_json(const Program& program, const Tick& tick);

}  // namespace kb::program
