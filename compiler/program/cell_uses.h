// What the rules of a program have to do with some of its cells: for `kbc expand --cell`.
#pragma once

#include <cstddef>
#include <vector>

#include "compiler/program/program.h"

namespace kb::program {

/// Each list in the order of the rules it was made from.
struct CellUses {
  std::vector<RuleId> writers;      ///< their effects name one of the cells
  std::vector<RuleId> readers;      ///< their condition asks for one; writers are not repeated
  std::vector<RuleId> silencers;    ///< only raise another member of an exclusive group of one
  std::vector<RuleId> resetters;    ///< only say `reset`
  std::size_t reading_writers = 0;  ///< writers that also ask for one

  [[nodiscard]] bool empty() const { return writers.empty() && readers.empty() && silencers.empty() && resetters.empty(); }
};

/// Sorts those of `rules` that have to do with `cells`, which ascend. Net effects count: a write that a later effect of its rule overrides
/// is none. O(conditions + cells + rules times their writes).
[[nodiscard]] CellUses uses_of(const Program& program, const std::vector<CellId>& cells, const std::vector<RuleId>& rules);

}  // namespace kb::program
