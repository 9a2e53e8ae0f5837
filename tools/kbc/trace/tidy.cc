#include "tools/kbc/trace/tidy.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "compiler/program/text.h"
#include "compiler/source/encoding.h"
#include "compiler/source/numbers.h"
#include "tools/kbc/json/json.h"
#include "tools/kbc/trace/csv_fields.h"
#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/trace/stream.h"

namespace kb::trace {
namespace {

struct Row {
  std::string_view text, end;           // without its line end, and that
  std::string_view before;              // the comments and blank lines before it
  std::uint64_t line = 0;
  std::optional<std::int64_t> t_us;
  std::size_t t_begin = 0, t_end = 0;   // the bytes of the time
  bool whole = true;                    // with a line end, and all its fields
  bool kept = true;
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

void read_csv(const Header& header, Row& row) {
  std::string scratch;
  std::size_t count = 0;
  for (FieldCursor fields(row.text, scratch); fields.more(); ++count) {
    const Field field = fields.next();
    row.whole = row.whole && field.fault == Field::Fault::kNone;
    if (!header.timed || count != header.time) continue;
    double time_s = 0.0;
    if (source::read_number(source::without_plus(field.text), time_s)) row.t_us = microseconds(time_s);
    row.t_begin = field.begin, row.t_end = field.end;
  }
  row.whole = row.whole && count == header.columns;
}

void read_json(Row& row) {
  json::Fault fault;
  const auto object = json::parse(row.text, source::FileId::kNone, fault);
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
  explicit Tidier(const TidyOptions& options) : options_(options) {}

  /// The bytes must outlive it.
  bool read(std::string_view bytes) {
    std::size_t before = 0;   // where the comments begin that stand before the next row
    std::uint64_t number = 0;
    for (std::size_t at = bytes.starts_with(source::kByteOrderMark) ? source::kByteOrderMark.size() : 0; at < bytes.size();) {
      const std::size_t begin = at, feed = std::min(bytes.find('\n', at), bytes.size());
      at = std::min(feed + 1, bytes.size());
      const std::size_t size = feed - begin - (feed > begin && bytes[feed - 1] == '\r' ? 1 : 0);
      const std::string_view text = bytes.substr(begin, size), end = bytes.substr(begin + size, at - begin - size);
      if (number++ == 0 && end.size() == 2) line_end_ = end;
      const std::size_t first = text.find_first_not_of(" \t");
      if (size > LineReader::kMaxLineBytes) return false;
      if (first == std::string_view::npos || text[first] == '#') {
        if (!begun_ && first != std::string_view::npos) read_option_comment(text, said_);
        continue;
      }
      if (!begun_ && text[first] != '{') {
        head_ = bytes.substr(0, at);
        header_ = read_header(text);
      } else {
        json_ = json_ || !begun_;
        Row row{text, end, bytes.substr(before, begin - before), number, std::nullopt, 0, 0, feed < bytes.size()};
        if (json_) read_json(row);
        else read_csv(header_, row);
        rows_.push_back(row);
      }
      begun_ = true;
      before = at;
    }
    tail_ = bytes.substr(before);
    out_.rows = rows_.size();
    out_.timed = json_ || header_.timed;
    return begun_;
  }

  Tidied mend() {
    if (options_.drop_last && !rows_.empty() && !rows_.back().whole) drop(rows_.back(), "half written, at the end: left out");
    if (options_.drop_duplicates) drop_duplicates();
    using Clock = TidyOptions::Clock;
    if (options_.clock == Clock::kDrop) drop_earlier();
    else if (options_.clock == Clock::kSort) sort();
    out_.bytes = head_;
    std::int64_t before_us = 0, step_us = 0, shift_us = 0;
    bool timed = false;
    for (const Row& row : rows_) {
      out_.bytes += row.before;
      if (!row.kept) continue;
      ++out_.kept;
      if (row.t_us && options_.clock == Clock::kShift) {
        if (timed && goes_back(*row.t_us + shift_us, before_us)) shift_us = before_us + std::max<std::int64_t>(step_us, json_ ? 1 : 0) - *row.t_us;
        const std::int64_t now_us = *row.t_us + shift_us;
        if (timed) step_us = now_us - before_us;
        before_us = now_us;
        timed = true;
      }
      write(row, shift_us);
    }
    out_.bytes += tail_;
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool goes_back(std::int64_t t_us, std::int64_t before_us) const { return json_ ? t_us <= before_us : t_us < before_us; }

  void note(std::string_view what, std::uint64_t line) {
    auto& changes = out_.changes;
    auto change = std::find_if(changes.begin(), changes.end(), [&](const TidyChange& one) { return one.what == what; });
    if (change == changes.end()) change = changes.insert(change, {std::string(what), {}});
    change->lines.push_back(line);
  }

  void drop(Row& row, std::string_view why) {
    note(why, row.line);
    row.kept = false;
  }
  /// A row that is left out for its time, or put elsewhere, changes what the empty fields of others mean.
  void leaves(const Row& row) {
    if (said_.steady.value_or(false) && !out_.needed) out_.needed = row.line;
  }

  void drop_duplicates() {
    const Row* last = nullptr;
    for (Row& row : rows_) {
      if (last != nullptr && last->text == row.text) drop(row, "the same as the row before: left out");
      else last = &row;
    }
  }

  void drop_earlier() {
    std::optional<std::int64_t> before_us;
    for (Row& row : rows_) {
      if (!row.kept || !row.t_us) continue;
      if (before_us && goes_back(*row.t_us, *before_us)) {
        leaves(row);
        drop(row, "earlier than a row before it: left out");
      } else {
        before_us = row.t_us;
      }
    }
  }

  void sort() {
    std::optional<std::int64_t> before_us;
    for (Row& row : rows_) {
      if (!row.kept || !row.t_us) row.t_us = before_us;   // it stays behind the row that it stands behind
      else if (before_us && *row.t_us < *before_us) leaves(row), note("earlier than a row before it: put where its time belongs", row.line);
      before_us = std::max(before_us, row.t_us);
    }
    std::stable_sort(rows_.begin(), rows_.end(), [](const Row& a, const Row& b) { return a.t_us < b.t_us; });
  }

  void write(const Row& row, std::int64_t shift_us) {
    const bool moves = shift_us != 0 && row.t_us.has_value();
    if (moves) {
      note("made later", row.line);
      out_.bytes += row.text.substr(0, row.t_begin);
      program::append_seconds(out_.bytes, *row.t_us + shift_us);
      out_.bytes += row.text.substr(row.t_end);
    } else {
      out_.bytes += row.text;
    }
    out_.bytes += row.end.empty() ? line_end_ : row.end;
  }

  TidyOptions options_;
  Tidied out_;
  std::string_view head_, tail_;
  std::string_view line_end_ = "\n";
  FactsOptions said_;
  Header header_;
  std::vector<Row> rows_;
  bool json_ = false, begun_ = false;
};

}  // namespace

std::optional<Tidied> tidied(std::string_view bytes, const TidyOptions& options) {
  Tidier tidier(options);
  return tidier.read(bytes) ? std::optional(tidier.mend()) : std::nullopt;
}

}  // namespace kb::trace
