#include "tools/kbc/trace/tidy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "compiler/program/text.h"
#include "compiler/source/numbers.h"
#include "tools/kbc/json/json.h"
#include "tools/kbc/trace/csv_fields.h"
#include "tools/kbc/trace/facts_options.h"

namespace kb::trace {
namespace {

struct Row {
  std::string before;                   // the comments and blank lines before it
  std::string bytes;                    // with a line end; empty if it is left out
  std::uint64_t line = 0;
  bool whole = true;                    // with a line end of its own, and all its fields
  std::optional<std::int64_t> t_us = {};
  std::size_t t_begin = 0, t_end = 0;   // the bytes of the time
};

std::optional<std::int64_t> microseconds(double time_s) {
  return std::abs(time_s) <= kMaxTimeS ? std::optional<std::int64_t>(std::llround(time_s * 1e6)) : std::nullopt;
}

/// Which column of a header is the time, and how many there are.
struct Header {
  std::size_t columns = 0, time = 0;
  bool timed = false;
};

Header read_header(std::string_view line) {
  Header header;
  std::string scratch;
  for (FieldCursor fields(line, scratch, true); fields.more(); ++header.columns) {
    if (fields.next().text != "t" || header.timed) continue;
    header.timed = true;
    header.time = header.columns;
  }
  return header;
}

void read_csv(const Header& header, std::string_view text, Row& row) {
  std::string scratch;
  std::size_t count = 0;
  for (FieldCursor fields(text, scratch); fields.more(); ++count) {
    const Field field = fields.next();
    row.whole = row.whole && field.fault == Field::Fault::kNone;
    if (!header.timed || count != header.time) continue;
    double time_s = 0.0;
    if (source::read_number(source::without_plus(field.text), time_s)) row.t_us = microseconds(time_s);
    row.t_begin = field.begin, row.t_end = field.end;
  }
  row.whole = row.whole && count == header.columns;
}

void read_json(std::string_view text, Row& row) {
  json::Fault fault;
  const auto object = json::parse(text, source::FileId::kNone, fault);
  row.whole = row.whole && object.has_value();
  if (!object) return;
  for (std::size_t i = 0; i < object->keys.size(); ++i) {
    const json::Json& part = object->parts[i];
    if (object->keys[i] != "t" || part.kind != json::Json::Kind::kNumber) continue;
    row.t_us = microseconds(part.number);
    row.t_begin = part.span.begin, row.t_end = part.span.end;
  }
}

class Tidier {
 public:
  Tidier(const TidyOptions& options, const std::function<bool(std::string_view)>& write) : options_(options), write_(write) {
    for (const std::string_view what : {"half written, at the end: left out", "the same as the row before: left out", "earlier than a row before it: left out",
                                        "earlier than a row before it: put where its time belongs", "made later"}) {
      out_.changes.push_back({what, 0, {}});
    }
  }

  Tidied mend(ByteStream& bytes) {
    LineReader lines(bytes);
    for (auto line = lines.next(); line && out_.fault == Tidied::Fault::kNone && wanted_; line = lines.next()) take(*line);
    if (!begun_) fail(Tidied::Fault::kNoHeader, LineReader::Line());
    if (half_) drop(*half_, kHalf), pass(*std::exchange(half_, {}));
    for (; !sorted_.empty(); sorted_.erase(sorted_.begin())) put(sorted_.begin()->second);
    say(before_);
    std::erase_if(out_.changes, [](const TidyChange& change) { return change.rows == 0; });
    out_.timed = json_ || header_.timed;
    return std::move(out_);
  }

 private:
  using Clock = TidyOptions::Clock;
  enum Change : std::uint8_t { kHalf, kSame, kEarlier, kPlaced, kLater };   // of `out_.changes`

  void fail(Tidied::Fault fault, const LineReader::Line& line) {
    if (out_.fault == Tidied::Fault::kNone) out_.fault = fault, out_.line = line.number, out_.text = line.text;
  }
  static std::string_view text_of(const Row& row) { return std::string_view(row.bytes).substr(0, row.bytes.find_last_not_of("\r\n") + 1); }
  void fail(Tidied::Fault fault, const Row& row) { fail(fault, {.text = text_of(row), .number = row.line}); }

  void take(const LineReader::Line& line) {
    if (line.too_long) return fail(Tidied::Fault::kTooLong, line);
    const std::size_t mark = static_cast<std::size_t>(line.text.data() - line.bytes.data()), first = line.text.find_first_not_of(" \t");
    const std::string_view bytes = line.bytes.substr(mark);
    if (line.number == 1) {
      say(line.bytes.substr(0, mark));
      if (bytes.ends_with("\r\n")) line_end_ = "\r\n";
    }
    if (first == std::string_view::npos || line.text[first] == '#') {
      if (!begun_ && first != std::string_view::npos) read_option_comment(line.text, said_);
      if (options_.clock == Clock::kSort || half_) before_ += bytes;   // else nothing will come before it
      else say(bytes);
    } else if (!std::exchange(begun_, true) && !(json_ = line.text[first] == '{')) {
      header_ = read_header(line.text);
      say(std::exchange(before_, {}));
      say(bytes);
    } else {
      take_row(line, bytes);
    }
  }

  void take_row(const LineReader::Line& line, std::string_view bytes) {
    if (half_) pass(*std::exchange(half_, {}));
    Row row{std::exchange(before_, {}), std::string(line.ended ? bytes : line.text), line.number, line.ended};
    if (!line.ended) row.bytes += line_end_;
    if (json_) read_json(line.text, row);
    else read_csv(header_, line.text, row);
    ++out_.rows;
    if (row.whole || !options_.drop_last) pass(std::move(row));
    else half_ = std::move(row);   // until it is known whether it is the last
  }

  /// All rows come here in the order of their lines.
  void pass(Row row) {
    if (options_.drop_duplicates && !row.bytes.empty()) {
      if (text_of(row) == last_) drop(row, kSame);
      else last_ = text_of(row);
    }
    if (row.t_us && !row.bytes.empty()) mend_clock(row);
    if (options_.clock == Clock::kSort) sort(std::move(row));
    else put(row);
  }

  void mend_clock(Row& row) {
    const std::int64_t t_us = *row.t_us + shift_us_;
    const std::int64_t least_us = before_us_.value_or(t_us) + (before_us_ && json_ && options_.clock != Clock::kSort ? 1 : 0);
    const bool back = t_us < least_us;
    if (back && options_.clock == Clock::kShift) {
      shift_us_ += std::max(*before_us_ + step_us_, least_us) - t_us;
    } else if (back) {
      if (said_.steady.value_or(false)) fail(Tidied::Fault::kNeeded, row);
      if (options_.clock == Clock::kDrop) return drop(row, kEarlier);
      return note(kPlaced, row.line);
    }
    const std::int64_t now_us = *row.t_us + shift_us_;
    if (before_us_) step_us_ = now_us - *before_us_;
    before_us_ = now_us;
    if (shift_us_ == 0) return;
    note(kLater, row.line);
    row.bytes.replace(row.t_begin, row.t_end - row.t_begin, program::seconds_text(now_us));
  }

  void sort(Row row) {
    if (!row.t_us || row.bytes.empty()) row.t_us = before_us_;   // it stays behind the row that it stands behind
    if (sorted_up_to_us_ && row.t_us < sorted_up_to_us_) return fail(Tidied::Fault::kTooFar, row);
    const auto size = [](const Row& one) { return sizeof one + one.before.size() + one.bytes.size(); };
    held_ += size(row);
    sorted_.emplace_hint(sorted_.end(), row.t_us, std::move(row));
    for (; held_ > kMostSorted; sorted_.erase(sorted_.begin())) {
      const Row& first = sorted_.begin()->second;
      put(first);
      held_ -= size(first);
      sorted_up_to_us_ = first.t_us;
    }
  }

  void put(const Row& row) {
    say(row.before);
    say(row.bytes);
    out_.kept += row.bytes.empty() ? 0 : 1;
  }

  void say(std::string_view bytes) { wanted_ = wanted_ && write_(bytes); }
  void note(Change what, std::uint64_t line) {
    TidyChange& change = out_.changes[what];
    if (++change.rows <= TidyChange::kMostLines) change.lines.push_back(line);
  }
  void drop(Row& row, Change why) {
    note(why, row.line);
    row.bytes.clear();
  }

  TidyOptions options_;
  const std::function<bool(std::string_view)>& write_;
  Tidied out_;
  FactsOptions said_;
  Header header_;
  std::string_view line_end_ = "\n";
  std::string before_, last_;   // what stands before the next row; the row before
  std::optional<Row> half_;
  std::optional<std::int64_t> before_us_, sorted_up_to_us_;
  std::int64_t step_us_ = 0, shift_us_ = 0;
  std::multimap<std::optional<std::int64_t>, Row> sorted_;
  std::size_t held_ = 0;
  bool json_ = false, begun_ = false, wanted_ = true;
};

}  // namespace

Tidied mend(ByteStream& bytes, const TidyOptions& options, const std::function<bool(std::string_view)>& write) { return Tidier(options, write).mend(bytes); }

}  // namespace kb::trace
