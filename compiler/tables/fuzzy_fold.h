// Folding for straight code: `given`s that differ only in their words become one loop over rows of words, and an index tells for
// each part of the input's range which rows can hold there. Decided here, printed by compiler/emit.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "compiler/fuzzy/controller.h"
#include "compiler/tables/fuzzy.h"

namespace kb::tables {

/// A word that differs from row to row. A row holds either the place of a degree among those of groups, or a number of a term.
struct FoldColumn {
  bool of_group = false;
  std::uint32_t slot = 0;           ///< if it belongs to no group: the input; its terms are kLinear
};

/// Nests first_nest .. end_nest, none in another, one row each. end_nest == 0: nothing is folded.
struct FuzzyFold {
  std::uint32_t first_nest = 0, end_nest = 0;
  std::vector<FoldColumn> columns;
  std::vector<std::vector<std::uint16_t>> rows;
  std::vector<std::uint32_t> column_of_leaf;   ///< for the degrees of the first nest and its rules, in the order they are read
  std::uint32_t cells = 0;          ///< of the index; a power of two; 0: all rows are tried
  std::uint32_t slot = 0;           ///< the input that it is over
  float per_cell = 0.0f;            ///< see mts::cell_of
  std::vector<std::uint64_t> rows_in_cell;     ///< by cell: a bit for each row that can hold there
};

/// How straight code is laid out.
struct FuzzyLayout {
  std::vector<std::uint32_t> place_of_degree;  ///< among the degrees of groups; fuzzy::kNone: it is a variable of its own
  std::uint32_t places = 0;
  std::vector<bool> listed;                    ///< by output: read from the list of rules that fired
  FuzzyFold fold;

  /// How many outputs are listed.
  [[nodiscard]] std::size_t voices() const { return static_cast<std::size_t>(std::count(listed.begin(), listed.end(), true)); }
};

/// Pure; O(controller), and cells times nests evaluations of a term.
[[nodiscard]] FuzzyLayout lay_out(const fuzzy::Controller& controller, const FuzzyForm& form);

}  // namespace kb::tables
