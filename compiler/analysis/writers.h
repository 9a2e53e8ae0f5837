// Which rules may write a cell, for analyses that ask it of many cells.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/source/texts.h"

namespace kb::analysis {

/// Lists of rules, each ascending and so by level. Built in O(writes).
struct Writers {
  explicit Writers(const program::Program& program) : by_name(program.cells.size()), by_clear(program.exclusive.size()) {
    for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
      const program::Rule& rule = program.rules[i];
      for (const program::Write& write : rule.writes) by_name[program::index(write.cell)].push_back(program::RuleId{i});
      for (const std::uint32_t group : rule.clears) by_clear[group].push_back(program::RuleId{i});
      if (rule.reset) by_reset.push_back(program::RuleId{i});
    }
  }

  std::vector<source::Few<program::RuleId, 4>> by_name;   ///< by cell
  std::vector<std::vector<program::RuleId>> by_clear;     ///< by exclusive group
  std::vector<program::RuleId> by_reset;
};

/// Those of such a list that are of one level.
[[nodiscard]] inline std::span<const program::RuleId> of_level(const program::Program& program, std::span<const program::RuleId> rules, std::uint32_t level) {
  const auto first_from = [&](std::uint32_t from) {
    return std::lower_bound(rules.begin(), rules.end(), from, [&](program::RuleId id, std::uint32_t limit) { return program[id].level < limit; });
  };
  return {first_from(level), first_from(level + 1)};
}

}  // namespace kb::analysis
