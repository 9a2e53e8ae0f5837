// The experiment's Table 1, replayed: 49 rows of cells by 17 columns of events.
//
// note [quiet ticks between the columns]
// The columns of the table are events, not consecutive ticks. Between two of them the robot drives on: what is
// momentary (a stop line, a button, an obstacle, what the memories on a line say) is gone, the rest stands. The replay
// puts one second of such quiet ticks after each column. Steps 6 to 13 (LM2 -> LM3 -> LM6 -> LM7) are not printed;
// before column 14 the replay drives them as a normal passage. The roads can be followed by every method throughout.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tests/world/mind.h"

namespace kb::table1 {

inline constexpr std::uint32_t kTickUs = 200'000;
inline constexpr int kQuietTicks = 5;

/// The printed table. Rows are the paper's names (`satfLine_in`), columns its steps (`14b`).
struct Table {
  std::vector<std::string> columns;
  struct Row { std::string name; std::vector<double> values; };
  std::vector<Row> rows;
};
/// Reads `row,0,1,...` lines. Throws std::runtime_error if a line has another number of fields than the first.
[[nodiscard]] Table read_table(std::string_view csv);

/// What a row of the paper is in the language. `kSatelliteOf` is the highest satellite of the fact or strategy.
struct Meaning {
  enum class Kind : std::uint8_t { kFact, kCell, kSatelliteOf, kStrategy };
  Kind kind = Kind::kCell;
  std::string cell;                 ///< `CrossBy.mark`, `Turn.left`, `Cross[left,mark]`
};
[[nodiscard]] Meaning meaning_of(std::string_view row);

/// One tick of the replay: the facts that are fed (all others: no data), and the column that it stands for, if any.
struct Feed {
  std::vector<std::pair<std::string, double>> facts;
  std::string column;
};
/// The whole sequence of ticks, `kTickUs` apart. It depends on the table only.
[[nodiscard]] std::vector<Feed> feed_of(const Table& table);

struct Cell { std::string row, column; double paper = 0.0, ours = 0.0; };
struct Result {
  std::vector<Cell> cells;          ///< row by row, in the order of the table
  int conflicts = 0;
  [[nodiscard]] std::vector<Cell> differences() const;
};
/// Feeds `mind` (fresh, of `knowledge`) and reads every cell of the table when its column has been fed.
[[nodiscard]] Result replay(std::string_view table_csv, const world::Knowledge& knowledge, world::Mind& mind);

/// The feed as a facts CSV (`t` in seconds, a column for each fact that ever has data), and which tick is which column.
[[nodiscard]] std::string facts_csv(const std::vector<Feed>& feed);
[[nodiscard]] std::string columns_csv(const std::vector<Feed>& feed);

}  // namespace kb::table1
