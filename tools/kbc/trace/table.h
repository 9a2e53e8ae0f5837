// A run as a table: cells down, ticks across, as papers print it. If at some tick the strategy that runs is not the one with a high
// certainty (none is wanted and the setting `idle` decides, or two are wanted), a last line `runs` names it.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"

namespace kb::trace {

/// First and last tick, both shown. Ticks begin at 1.
struct TickRange {
  std::uint64_t first = 1, last = UINT64_MAX;
};
/// Reads `7`, `7-19`, `7-` or `-19`; nothing if it is none of these, or the range is empty.
[[nodiscard]] std::optional<TickRange> parse_ticks(std::string_view text);

/// What a table shows. By default: the cells that change, on the first tick too, at the ticks at which one of them
/// does.
struct TableOptions {
  std::string cells{};  ///< patterns (see `matches`) of the cells to take; one that a pattern names in full is shown, changed or not. Empty: all
  std::optional<TickRange> ticks{};  ///< every tick of the range is shown. None: those at which something changes
  bool all = false;                  ///< all cells and all ticks, except those that the filters leave out
};

/// Collects the ticks of a run. Memory: four bytes for each cell at each kept tick, at most `kMaxValues` values.
class Table {
 public:
  static constexpr std::size_t kMaxValues = std::size_t{1} << 24;

  /// `program` must outlive it.
  Table(const program::Program& program, TableOptions options);
  /// Takes a tick and the cells after it. False, and nothing more is taken, once the table is too large.
  [[nodiscard]] bool add(const program::Tick& tick, const std::function<float(program::CellId)>& value);
  [[nodiscard]] std::string print() const;

 private:
  struct Column {
    std::uint64_t tick;
    std::int64_t time_us;
    program::CellId runs;
    bool unsaid;  // the strategy that runs does not follow from certainties
  };
  [[nodiscard]] float at(std::size_t column, std::size_t cell) const { return values_[column * cells_.size() + cell]; }
  [[nodiscard]] bool changed_at_once(std::size_t cell) const;
  [[nodiscard]] std::vector<std::size_t> shown_cells() const;
  [[nodiscard]] bool changed(const Column& now, std::size_t before) const;
  [[nodiscard]] std::vector<std::string> entries(std::size_t column, const std::vector<std::size_t>& cell_of_line) const;

  const program::Program& program_;
  TableOptions options_;
  std::vector<program::CellId> cells_;
  bool has_strategies_ = false;  // among the cells
  std::vector<Column> columns_;
  std::vector<float> values_;  // column by column
};

}  // namespace kb::trace
