// Mends recordings as robots leave them behind: a clock that was set back, rows that came twice, a last row that was half written when the
// battery was pulled out. Facts and readings in CSV, and the JSON lines of `kbc drive`. Knows no knowledge base: names and values are
// left to the reader.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kbc/trace/stream.h"

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

/// What was done to rows.
struct TidyChange {
  static constexpr std::size_t kMostLines = 5;
  std::string_view what;                 ///< `earlier than a row before it: left out`
  std::uint64_t rows = 0;
  std::vector<std::uint64_t> lines;      ///< of the first of them, from 1
};

struct Tidied {
  enum class Fault : std::uint8_t {
    kNone,
    kNoHeader,   ///< there is no row to look at: neither a header nor an object
    kTooLong,    ///< a line is longer than LineReader reads
    kNeeded,     ///< a row is to be left out or moved though empty fields of others mean what it says (`# empty: as before`)
    kTooFar,     ///< a row belongs before others that are no longer held
  } fault = Fault::kNone;
  std::uint64_t line = 0;                ///< where it is, but for `kNoHeader`
  std::string text;                      ///< that line
  std::vector<TidyChange> changes;       ///< those that were made
  std::uint64_t rows = 0, kept = 0;
  bool timed = false;                    ///< it has times
};

/// How much of a recording is held to sort it, in bytes.
inline constexpr std::size_t kMostSorted = std::size_t{32} << 20;

/// Mends a recording and hands it to `write` piece by piece, until that returns false; its last row ends. Comments stay before the row that they stand before, also if
/// that is left out; line ends stay what they are. A row that is wrong in another way, or has no time, stays as it is.
/// In JSON lines a time must grow, in CSV it must not go back, as their readers want it. After a fault what was written is worth nothing. O(bytes), and
/// O(rows log rows) to sort, in the memory of a few lines or of `kMostSorted`.
[[nodiscard]] Tidied mend(ByteStream& bytes, const TidyOptions& options, const std::function<bool(std::string_view)>& write);

}  // namespace kb::trace
