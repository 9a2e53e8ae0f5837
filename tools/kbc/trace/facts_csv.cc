#include "tools/kbc/trace/facts_csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <system_error>
#include <utility>

#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "compiler/source/utf8.h"

namespace kb::trace {
namespace {

using diagnostics::Kind;

// The longest gap that `# every` fills with ticks: a night in the dock is meant, a clock that was changed is not.
constexpr std::int64_t kMaxFilledUs = 86'400'000'000;
// The most ticks that it fills in between two rows: a day of milliseconds.
constexpr std::int64_t kMaxFilledTicks = 86'400'000;

enum class Parsed : std::uint8_t { kNumber, kNotANumber, kTooLarge };

template <class Number>
Parsed parse(std::string_view text, Number& number) {
  text = source::without_plus(text);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (end != text.data() + text.size() || error == std::errc::invalid_argument) return Parsed::kNotANumber;
  if (error == std::errc()) return Parsed::kNumber;
  // Out of range; from_chars does not say on which side. A value too close to zero counts as zero.
  const double wide = std::strtod(std::string(text).c_str(), nullptr);
  if (!(std::abs(wide) < 1.0)) return Parsed::kTooLarge;
  number = static_cast<Number>(wide);
  return Parsed::kNumber;
}

// A float. Values that only fit a double become infinite, as they would on the robot.
Parsed parse_value(std::string_view text, float& value) {
  const Parsed parsed = parse(text, value);
  if (parsed != Parsed::kTooLarge) return parsed;
  double wide = 0.0;
  const Parsed again = parse(text, wide);
  constexpr float infinity = std::numeric_limits<float>::infinity();
  if (again == Parsed::kNumber) {
    value = std::abs(wide) > std::numeric_limits<float>::max()
                ? std::copysign(infinity, static_cast<float>(wide < 0 ? -1 : 1))
                : static_cast<float>(wide);
  }
  return again;
}

std::string seconds(std::int64_t us) { return fmt::format("{}", static_cast<double>(us) / 1e6); }

}  // namespace

FactsReader::FactsReader(std::string path, ByteStream& bytes, const program::Program& program, source::Sources& sources,
                         diagnostics::Diagnostics& diagnostics, Columns named)
    : path_(std::move(path)),
      stream_(bytes),
      lines_(bytes),
      program_(program),
      sources_(sources),
      diagnostics_(diagnostics),
      named_(named),
      facts_(program.facts, 0.0f) {
  row_.facts = facts_;
  row_.has_readings = named == Columns::kReadings;
}

bool FactsReader::open(std::optional<std::uint32_t> dt_us) {
  for (;;) {
    const auto line = next_line();
    if (failed_) return false;
    if (!line) {
      diagnostics_.report(Kind::kFactsNoHeader, {}, {path_});
      return !(failed_ = true);
    }
    const std::size_t first = line->text.find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    if (line->text[first] == '#') {
      read_comment(*line, false);
      continue;
    }
    if (!read_header(*line)) failed_ = true;
    break;
  }
  if (timed_ && !failed_ && (dt_us || options_.dt_us)) {
    diagnostics_.report(Kind::kFactsTimeTwice, {}, {dt_us ? "`--dt`" : "the comment `# dt:`"});
    failed_ = true;
  }
  if (!failed_ && !timed_ && options_.every_us) {
    diagnostics_.report(Kind::kFactsBadOption, {}, {"# every:", "for a file without a column `t`, where each row is a tick"});
    failed_ = true;
  }
  dt_us_ = dt_us ? *dt_us : options_.dt_us.value_or(kDefaultTickUs);
  return !failed_;
}

// The next line that can be examined. Failures to read, and what later steps cannot notice, are reported here.
std::optional<LineReader::Line> FactsReader::next_line() {
  if (ended_) return std::nullopt;
  auto line = lines_.next();
  if (!line) {
    ended_ = true;
    if (const std::string error = stream_.error(); !error.empty()) {
      diagnostics_.report(Kind::kCannotRead, {}, {path_, error});
      failed_ = true;
    }
    return std::nullopt;
  }
  if (line->too_long) {
    const std::string limit = fmt::format("{}", LineReader::kMaxLineBytes);
    report(Kind::kFactsLineTooLong, *line, {0, 1}, {limit});
    failed_ = ended_ = true;
    return std::nullopt;
  }
  if (reject_encoding(*line)) return std::nullopt;
  return line;
}

// A file that an editor has saved in another encoding gets one message, and none of its rows is read.
bool FactsReader::reject_encoding(const LineReader::Line& line) {
  const std::string_view text = line.text;
  const bool utf16 = line.number == 1 && source::is_utf16(text);
  const std::size_t lone = text.find('\r');
  if (!utf16 && lone == std::string_view::npos) return false;
  const auto at = static_cast<std::uint32_t>(utf16 ? 0 : lone);
  report(utf16 ? Kind::kUtf16 : Kind::kLoneReturn, line, {at, at + (utf16 ? 2 : 1)}, {});
  return failed_ = ended_ = true;
}

void FactsReader::read_comment(const LineReader::Line& line, bool below_header) {
  if (reject_bytes(line, line.text)) return;
  FactsOptions misplaced;
  for (const OptionItem& item : read_option_comment(line.text, below_header ? misplaced : options_)) {
    if (item.good && !below_header) continue;
    report(Kind::kFactsBadOption, line, {item.begin, std::max(item.end, item.begin + 1)},
           {source::printable(line.text.substr(item.begin, item.end - item.begin)),
            below_header ? "above the header, where options stand" : item.wanted});
    failed_ = true;
  }
}

// True if a line is not a row but blank or a comment.
bool FactsReader::skips(const LineReader::Line& line) {
  const std::size_t first = line.text.find_first_not_of(" \t");
  if (first == std::string_view::npos) {
    if (blank_ == 0) blank_ = line.number;
    return true;
  }
  if (line.text[first] == '#') {
    read_comment(line, true);
    return true;
  }
  // Blank lines at the end of a file are none that anybody misses.
  const bool single = columns_.size() == 1 && !timed_;
  if (single && blank_ != 0 && !std::exchange(blank_told_, true)) report(Kind::kFactsEmptyLine, {"", blank_}, {0, 1}, {});
  return false;
}

const FactsRow* FactsReader::next() {
  if (!failed_ && left_us_ > 0) return fill();
  if (options_.every_us) {
    before_ = facts_;
    if (options_.again) updates_before_ = updates_;
  }
  while (!failed_) {
    const auto line = next_line();
    if (!line) return nullptr;
    if (skips(*line)) continue;
    if (read_row(*line)) {
      row_.line = row_before_ = line->number;
      if (options_.every_us && left_us_ > *options_.every_us) return fill();
      row_.dt_us = static_cast<std::uint32_t>(std::exchange(left_us_, 0));
      ++rows_;
      return &row_;
    }
    failed_ = true;
    read_on_for_mistakes();
  }
  return nullptr;
}

// A tick between two rows, or finally the row that has been read.
const FactsRow* FactsReader::fill() {
  filled_ = row_;
  filled_.dt_us = static_cast<std::uint32_t>(std::min<std::int64_t>(left_us_, *options_.every_us));
  left_us_ -= filled_.dt_us;
  ++rows_;
  if (left_us_ > 0) {
    filled_.facts = before_;
    filled_.readings = updates_before_;   // none, but with `measured again`
  }
  return &filled_;
}

// Reads on after a mistake, so that mistakes further down are also reported before the file is corrected and run again.
void FactsReader::read_on_for_mistakes() {
  for (std::size_t wrong = 1; wrong < kMaxWrongRows;) {
    const auto line = next_line();
    if (!line) return;
    if (skips(*line)) continue;
    if (!read_row(*line)) ++wrong;
    row_before_ = line->number;
  }
}

bool FactsReader::read_row(const LineReader::Line& line) {
  FieldCursor fields(line.text, scratch_);
  std::size_t count = 0;
  if (!options_.again) updates_.clear();
  left_us_ = row_before_ == 0 ? 0 : dt_us_;
  for (; count < columns_.size() && fields.more(); ++count) {
    const Field field = fields.next();
    if (field.fault != Field::Fault::kNone) {
      reject_field(line, field);
      return false;
    }
    if (!take(field, columns_[count], line)) return false;
  }
  row_.readings = updates_;
  if (count == columns_.size() && !fields.more()) {
    const auto end = static_cast<std::uint32_t>(line.text.size());
    if (!line.ended && path_ != "-") report(Kind::kFactsCutOff, line, {end - 1, end}, {});   // who writes to a pipe may leave it out
    return true;
  }
  reject_count(line, count, fields);
  return false;
}

bool FactsReader::take(const Field& field, std::uint32_t column, const LineReader::Line& line) {
  if (column == kTimeColumn) return take_time(field, line);
  if ((column & kReadingBit) != 0) return take_reading(field, column & ~kReadingBit, line);
  float& value = facts_[column];
  if (field.text.empty()) {
    if (!options_.steady.value_or(false)) value = 0.0f;
    return true;
  }
  return take_number(field, value, line);
}

bool FactsReader::take_reading(const Field& field, std::uint32_t reading, const LineReader::Line& line) {
  if (field.text.empty()) return true;
  const program::Sensor& sensor = program_.perception.sensor_of(reading);
  // In quotes, `-` may be the text of a sign; for a sensor of numbers it can only mean silence.
  ReadingUpdate update{reading, 0.0f, field.text == "-" && !(sensor.text && field.quoted)};
  if (sensor.text) {
    const auto text = std::find(sensor.texts.begin(), sensor.texts.end(), field.text);
    if (text != sensor.texts.end()) update.value = static_cast<float>(text - sensor.texts.begin() + 1);
  } else if (!update.forget && !take_number(field, update.value, line)) {
    return false;
  }
  const auto earlier = options_.again ? std::ranges::find(updates_, reading, &ReadingUpdate::reading) : updates_.end();
  if (earlier != updates_.end()) *earlier = update;
  else updates_.push_back(update);
  return true;
}

bool FactsReader::take_number(const Field& field, float& value, const LineReader::Line& line) {
  const Parsed parsed = parse_value(field.text, value);
  if (parsed == Parsed::kNumber) return true;
  value = 0.0f;
  const Kind kind = parsed == Parsed::kTooLarge ? Kind::kFactsTooLarge : Kind::kFactsNotANumber;
  if (!reject_bytes(line, field.text, field.begin)) report(kind, line, {field.begin, field.end}, {source::printable(field.text)});
  return false;
}

bool FactsReader::take_time(const Field& field, const LineReader::Line& line) {
  const Mark mark{field.begin, std::max(field.end, field.begin + 1)};
  if (field.text.empty()) {
    report(Kind::kFactsNoTime, line, mark, {});
    return false;
  }
  double time_s = 0.0;
  if (parse(field.text, time_s) != Parsed::kNumber || !(std::abs(time_s) <= kMaxTimeS)) {
    report(Kind::kFactsNotATime, line, mark, {source::printable(field.text)});
    return false;
  }
  // The clock continues from the wrong row, so that one jump gets one message.
  const std::int64_t before_us = std::exchange(time_us_, std::llround(time_s * 1e6));
  const std::int64_t step_us = time_us_ - before_us;
  left_us_ = 0;
  if (row_before_ == 0) return true;
  const std::int64_t most_us = options_.every_us ? std::min(kMaxFilledUs, kMaxFilledTicks * *options_.every_us) : kMaxStepUs;
  left_us_ = std::clamp<std::int64_t>(step_us, 0, most_us);
  if (left_us_ == step_us) return true;
  const std::string line_before = fmt::format("{}", row_before_);
  if (step_us < 0) {
    report(Kind::kFactsTimeOrder, line, mark, {source::printable(field.text), seconds(before_us)})
        .note(Kind::kFactsRowBefore, {}, {line_before})
        .note(Kind::kFactsTidy, {}, {path_});
    return false;
  }
  const bool fatal = options_.every_us.has_value();   // else it counts as it does on a robot that is not switched off meanwhile
  if (fatal || !diagnostics_.full(Kind::kFactsLongPause)) {
    report(fatal ? Kind::kFactsStepTooLong : Kind::kFactsLongPause, line, mark, {seconds(step_us), seconds(most_us)})
        .note(Kind::kFactsRowBefore, {}, {line_before});
  }
  return !fatal;
}

}  // namespace kb::trace
