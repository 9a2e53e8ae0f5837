// What is known of a level's rules at compile time: which can fire together, and which disarm themselves.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// A rule's net writes: of one satellite each, ascending. See note [net effects].
struct CellWrite {
  std::uint32_t satellite;
  float value;
};

class FleetRules {
 public:
  FleetRules(const program::Program& program, const Tables& tables);

  [[nodiscard]] const std::vector<CellWrite>& writes(std::uint32_t rule) const { return writes_[rule]; }
  /// Whether both can fire on one tick of one robot. They cannot if one condition demands what the other denies, if they ask for
  /// different members of an exclusive group, or if one resets and silences the other.
  [[nodiscard]] bool compatible(std::uint32_t a, std::uint32_t b) const;
  /// Whether the rule's condition is false after its own writes, or on the next tick at the latest, whatever else happens.
  [[nodiscard]] bool disarms_itself(std::uint32_t rule) const;
  /// Whether the rules of its level can change what its condition reads, timers aside.
  [[nodiscard]] bool disturbed(std::uint32_t rule) const;
  /// The literals of the condition.
  [[nodiscard]] std::span<const I> literals(std::uint32_t rule) const;
  [[nodiscard]] const std::vector<I>& children(std::uint32_t node) const { return children_[node]; }
  [[nodiscard]] bool is_and(std::uint32_t node) const { return t_.nodes[node].need == children_[node].size(); }
  /// Groups of satellites of which at most one is high at any time.
  [[nodiscard]] const std::vector<std::vector<std::uint32_t>>& exclusive() const { return exclusive_; }
  /// Marks the facts whose certainty goes into the rule's strength.
  void weigh(std::uint32_t rule, std::vector<bool>& facts) const;

 private:
  void find_groups();
  [[nodiscard]] std::optional<bool> after_own_writes(I literal, const std::vector<CellWrite>& writes) const;
  [[nodiscard]] bool reads_written(I atom, const std::vector<bool>& written) const;

  const program::Program& p_;
  const Tables& t_;
  std::vector<std::vector<I>> children_;              // by node
  std::vector<std::vector<bool>> written_;            // by level and satellite: some rule writes it
  std::vector<std::vector<CellWrite>> writes_;        // by rule
  std::vector<std::vector<std::uint32_t>> exclusive_;
  std::vector<std::uint32_t> group_;                  // by satellite: its exclusive group + 1, or 0
};

}  // namespace kb::tables
