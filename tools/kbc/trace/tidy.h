// Mends recordings as robots leave them behind: a clock that was set back, rows that came twice, a last row that was half written when the
// battery was pulled out. Facts and readings in CSV, and the JSON lines of `kbc drive`. Knows no knowledge base: names and values are
// left to the reader.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kb::trace {

struct TidyOptions {
  enum class Clock : std::uint8_t {
    kDrop,    ///< a row that is earlier than one before it is left out
    kShift,   ///< it and all after it become later, so that it comes as long after the row before it as that after its own
    kSort,    ///< rows are put in the order of their times; those of one time stay as they are
  } clock = Clock::kDrop;
  bool drop_duplicates = false;   ///< a row with the same bytes as the row before is left out
  bool drop_last = true;          ///< the last row is left out if it has no line end, or another number of fields than the header
};

/// What was done to rows, in the order of their lines.
struct TidyChange {
  std::string what;                      ///< `earlier than a row before it: left out`
  std::vector<std::uint64_t> lines;      ///< from 1; at least one
};

struct Tidied {
  std::string bytes;                     ///< the recording as it is now; its last row ends
  std::vector<TidyChange> changes;
  std::uint64_t rows = 0, kept = 0;
  bool timed = false;                    ///< it has times
  std::optional<std::uint64_t> needed;   ///< the first row that was left out or moved though empty fields of others mean what it says (`# empty: as before`)
};

/// Mends a recording. Comments stay before the row that they stand before, also if that is left out; line ends stay what they are. A row that is wrong in another way, or has no time, stays as it is.
/// In JSON lines a time must grow, in CSV it must not go back, as their readers want it. Nothing if there is no row to look at:
/// neither a header nor an object. O(bytes), and O(rows log rows) to sort.
[[nodiscard]] std::optional<Tidied> tidied(std::string_view bytes, const TidyOptions& options);

}  // namespace kb::trace
