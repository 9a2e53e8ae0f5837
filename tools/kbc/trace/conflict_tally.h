// Which rules contradicted each other in a run, on which cell, and how often.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"

namespace kb::trace {

/// Counts pairs of rules as written. Memory: one entry for each pair of rules and cell on which they disagreed, however long the run is.
class ConflictTally {
 public:
  /// `program` must outlive it.
  explicit ConflictTally(const program::Program& program);
  void add(const program::Tick& tick);
  /// A table, the most frequent pair first; of equally frequent ones the earlier, then by cell and rules. A rule is named by its instance if it
  /// was always the same one.
  [[nodiscard]] std::string print() const;

 private:
  /// A rule of a pair: the instance that was seen first.
  struct Side {
    program::RuleId rule = program::RuleId::kNone;
    bool several = false;   ///< instances
  };
  struct Pair {
    Side one, other;
    std::uint64_t ticks = 0, first = 0, last = 0;
    std::int64_t first_us = 0;
  };
  using Key = std::tuple<program::CellId, std::uint32_t, std::uint32_t>;   // the cell, and the first rules of the two that are written alike

  void add(const program::Tick& tick, program::CellId cell, program::RuleId one, program::RuleId other);
  [[nodiscard]] std::string name(const Side& side) const;

  const program::Program& program_;
  std::vector<std::uint32_t> group_of_;   // by cell
  std::vector<std::uint32_t> written_;    // by rule: the first one of the same rule as written
  std::map<Key, Pair> pairs_;
};

}  // namespace kb::trace
