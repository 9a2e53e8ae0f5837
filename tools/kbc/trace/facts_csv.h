// The facts of a run, from CSV: a header of fact names, then one row for each tick.
//
//   # dt: 10 ms                         options, in comments before the header (see FactsOptions)
//   t,Line,Safe,In.N,"Near[left,far]"   names as in the program; a dot will do for brackets: Near.left.far
//   0.00,0.9,1,,-1                      an empty field is "no data": 0
//   0.01,nan,1,1,-1                     sensors do give nan and inf; the engine counts them
//
// With `# empty: as before` an empty field repeats the value of the row before, and with `# every: 100 ms` ticks are filled in between rows
// that lie farther apart. So a drive written by hand needs only a row for each change.
//
// `t` is the time in seconds: it never goes back, and may begin at any value. Without it all ticks are equally long.
// With readings instead of facts (`--readings`) columns name sensors, and facts that are not perceived:
//
//   t,line[0],line[1],compass,tag,Start1     an empty field is "nothing new": the last reading stays and grows old
//   0.00,0.1,0.1,88,,-1                      `-`: the sensor has fallen silent
//   0.01,nan,,89.5,LM7,0.9                   NaN, inf and numbers out of range are readings as well, bad ones
//
// With `# empty: measured again` an empty field of a sensor is its last reading, measured anew on this tick, and on those that `every` fills in.
//
// Lines that begin with `#` are comments; a blank line is no row (in a file of one column a row without data is `""`).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/program/program.h"
#include "compiler/source/source.h"
#include "tools/kbc/trace/csv_fields.h"
#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/trace/stream.h"

namespace kb::trace {

/// A field of a row with something new from a sensor.
struct ReadingUpdate {
  std::uint32_t reading = 0;
  float value = 0.0f;     ///< for a text: its number among those that the program asks for, from 1; 0 for any other text
  bool forget = false;    ///< the sensor has fallen silent
};

/// One tick's facts.
struct FactsRow {
  std::span<const float> facts;  ///< a value for each fact of the program; valid until the next row is read
  bool has_readings = false;     ///< `readings` holds what is new, `facts` only the facts that are not perceived
  std::span<const ReadingUpdate> readings;
  std::uint32_t dt_us = 0;       ///< time since the row before; 0 in the first
  std::uint64_t line = 0;        ///< in the file
};

/// Reads facts row by row in memory that does not depend on their number; over a million narrow rows a second.
///
/// Mistakes are reported at their place. The first wrong row is the end of the rows; the rest is still checked for further
/// mistakes, up to `kMaxWrongRows`.
class FactsReader {
 public:
  static constexpr std::size_t kMaxWrongRows = 20;

  /// What columns name.
  enum class Columns : std::uint8_t { kFacts, kReadings };

  /// All arguments must outlive the reader. `path` is the name for messages.
  FactsReader(std::string path, ByteStream& bytes, const program::Program& program, source::Sources& sources,
              diagnostics::Diagnostics& diagnostics, Columns named = Columns::kFacts);

  /// Reads up to the end of the header. False if it has errors (reported, all of them). `dt_us` overrides the file's length of
  /// ticks; with a column `t` there must be neither.
  [[nodiscard]] bool open(std::optional<std::uint32_t> dt_us = std::nullopt);

  /// The next row; null at the end, or if something is wrong (`failed`).
  [[nodiscard]] const FactsRow* next();

  /// By fact: it has a column.
  [[nodiscard]] std::vector<bool> given() const;

  [[nodiscard]] bool failed() const { return failed_; }
  [[nodiscard]] std::uint64_t rows() const { return rows_; }
  /// After `open`.
  [[nodiscard]] const FactsOptions& options() const { return options_; }

 private:
  static constexpr std::uint32_t kTimeColumn = 0xFFFFFFFFu;
  static constexpr std::uint32_t kReadingBit = 0x80000000u;  // of a column: the rest is a reading
  struct Mark {
    std::uint32_t begin = 0, end = 0;
  };
  struct Header;   // what columns can name

  std::optional<LineReader::Line> next_line();
  bool reject_encoding(const LineReader::Line& line);
  void read_comment(const LineReader::Line& line, bool below_header);
  bool read_header(const LineReader::Line& line);
  bool add_column(const Field& field, std::size_t number, const LineReader::Line& line, Header& header);
  bool reject_separator(const LineReader::Line& line);
  bool reject_numbers(const LineReader::Line& line);
  bool read_row(const LineReader::Line& line);
  bool take(const Field& field, std::uint32_t column, const LineReader::Line& line);
  bool take_reading(const Field& field, std::uint32_t reading, const LineReader::Line& line);
  bool take_number(const Field& field, float& value, const LineReader::Line& line);
  [[nodiscard]] std::optional<std::uint32_t> find_column(const Field& field, const Header& header, const LineReader::Line& line,
                                                         Mark mark);
  [[nodiscard]] std::optional<std::string> nearest_name(std::string_view name, const Header& header) const;
  void reject_name(const Field& field, std::string_view shown, const Header& header, const LineReader::Line& line, Mark mark);
  [[nodiscard]] const program::Sensor* find_sensor(std::string_view name) const;
  void warn_of_unperceived(const LineReader::Line& line);
  void reject_sensor(const program::Sensor& sensor, std::string_view shown, const LineReader::Line& line, Mark mark);
  bool take_time(const Field& field, const LineReader::Line& line);
  bool skips(const LineReader::Line& line);
  bool reject_bytes(const LineReader::Line& line, std::string_view text, std::size_t begin = 0);
  void reject_count(const LineReader::Line& line, std::size_t fields, FieldCursor& rest);
  void reject_field(const LineReader::Line& line, const Field& field);
  void read_on_for_mistakes();
  const FactsRow* fill();
  diagnostics::Builder report(diagnostics::Kind kind, const LineReader::Line& line, Mark mark,
                              std::initializer_list<std::string_view> arguments);
  [[nodiscard]] source::Span place(const LineReader::Line& line, Mark mark);

  std::string path_;
  ByteStream& stream_;
  LineReader lines_;
  const program::Program& program_;
  source::Sources& sources_;
  diagnostics::Diagnostics& diagnostics_;

  FactsOptions options_;
  Columns named_;
  std::vector<std::uint32_t> columns_;  // the fact or the reading (kReadingBit) of each column, or kTimeColumn
  std::vector<ReadingUpdate> updates_, updates_before_;   // of the row that was read; with `measured again` also those of rows before
  std::vector<float> facts_, before_;   // of the row that was read, and of the one before it
  std::string scratch_;  // holds a field with doubled quotes
  FactsRow row_, filled_;
  std::int64_t left_us_ = 0;    // time left up to the row that was read; ticks are filled in from it
  std::uint32_t dt_us_ = kDefaultTickUs;
  std::int64_t time_us_ = 0;
  std::uint64_t row_before_ = 0;  // its line; 0 before the first row
  std::uint64_t rows_ = 0;
  std::uint64_t blank_ = 0;       // the first blank line below the header; 0 before
  bool timed_ = false, failed_ = false, ended_ = false;
  bool sensor_told_ = false;  // a column of facts named a sensor
  bool blank_told_ = false;
};

}  // namespace kb::trace
