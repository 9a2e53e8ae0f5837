// The same runs before and after a change: which of them end otherwise, and whether that can be chance.
//
// note [pairs of runs]
// Two results are compared run by run: the columns before `outcome`, and `noise`, say which run a row is, and runs of the same scenario with the same
// noise differ only by what was changed. So a few hundred pairs show a difference that the two shares with their intervals do not. Of the pairs only those
// count in which one of the two arrives; if neither were better, each would be the one with the same chance. The probability of a division at
// least as uneven as the one found is that of McNemar's test in its exact form (Q. McNemar, Note on the sampling error of the difference between
// correlated proportions or percentages, Psychometrika 12, 1947).
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "sim/batch/demands.h"
#include "sim/batch/results.h"

namespace kb::sim::batch {

/// A column that does not say which run a row is, but which side it is on: rows with the first value are old, those with the second new.
struct Between {
  std::string column, before, after;   ///< no column: each of the two results is one side
};

/// What can be demanded of pairs, in the order of kHappenings: `lost` arrive in OLD only, `collisions` and the others happen in NEW only; `gained`
/// arrive in NEW only.
inline constexpr std::array<std::string_view, kHappenings.size() + 1> kPairDemands{"lost", kHappenings[1].name, kHappenings[2].name, kHappenings[3].name, kHappenings[4].name, "gained"};

struct Pair {
  const ResultRow* before = nullptr;
  const ResultRow* after = nullptr;
  std::size_t row = 0;                 ///< of the table: index into Comparison::rows
};

/// Runs that are counted together: those of one scenario, or of one class of an experiment, with the same settings.
struct ComparedRow {
  struct Count { std::size_t before = 0, after = 0, only_before = 0, only_after = 0; };

  std::vector<std::string> values;             ///< of Comparison::columns
  std::size_t pairs = 0;
  std::array<Count, kHappenings.size()> counts;   ///< of kHappenings
  std::vector<double> times, lengths;          ///< of pairs in which both arrive: new divided by old

  void add(const Pair& pair);
};

inline constexpr std::size_t kNoColumn = static_cast<std::size_t>(-1);

struct Comparison {
  std::vector<std::string> which, measured;    ///< of the runs: see Results. `which` has no Between::column
  std::size_t between = kNoColumn;             ///< the number of that column in the old results
  std::vector<std::string> columns;            ///< of `which`, those whose values name a row of the table
  std::vector<ComparedRow> rows;               ///< in the order in which they come in the old results
  std::vector<Pair> pairs;                     ///< in the order of the old results
  std::size_t only_before = 0, only_after = 0; ///< runs that have no partner
  std::vector<std::string> differ;             ///< what the first comments of the two say differs
};

/// Both results must outlive the comparison. A sentence if they cannot be compared. O(n) in the runs, at some 400 bytes for each.
[[nodiscard]] std::variant<Comparison, std::string> compare(const Results& before, const Results& after, const Between& between);

/// The probability that pairs of which one arrives are divided at least as unevenly by chance. 1 if there are none.
[[nodiscard]] double chance_of(std::size_t only_before, std::size_t only_after);

/// Tables in Markdown: the counts, and the runs that end otherwise, at most `most` of each kind.
[[nodiscard]] std::string summarise(const Comparison& comparison, std::size_t most);
/// A row of CSV for each pair, with the measured columns of both: `old_outcome`, ... `new_outcome`, ...
[[nodiscard]] std::string print_pairs(const Comparison& comparison);
/// Which run a pair is: the fields of Comparison::which, with commas.
[[nodiscard]] std::string which_of(const Comparison& comparison, const Pair& pair);
/// The values of a row: `crate, event.0.for=10`.
[[nodiscard]] std::string name_of(const Comparison& comparison, const ComparedRow& row);
/// What the rows of the table do not meet. The names are kPairDemands.
[[nodiscard]] std::vector<Unmet> unmet(const std::vector<Demand>& demands, const Comparison& comparison);

}  // namespace kb::sim::batch
