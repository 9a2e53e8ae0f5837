#include "tools/kbc/trace/tidy.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

#include "compiler/program/text.h"
#include "compiler/source/numbers.h"
#include "tools/kbc/json/json.h"
#include "tools/kbc/trace/csv_fields.h"
#include "tools/kbc/trace/facts_options.h"
#include "tools/kbc/trace/stream.h"

namespace kb::trace {
namespace {

struct Row {
  std::string_view text;
  std::string before;                   // the comments and blank lines before it
  std::uint64_t line = 0;
  std::optional<std::int64_t> t_us;
  std::size_t t_begin = 0, t_end = 0;   // the bytes of the time
  bool whole = true;                    // with a line end, and all its fields
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

  bool read(std::string_view bytes) {
    MemoryStream stream(bytes);
    LineReader lines(stream);
    std::string before;
    while (const auto line = lines.next()) {
      if (line->too_long) return false;
      const std::string_view text = keep(line->text);
      const std::size_t first = text.find_first_not_of(" \t");
      if (first == std::string_view::npos || text[first] == '#') {
        before.append(text) += '\n';
      } else if (!begun_ && text[first] != '{') {
        head_ = std::move(before) + std::string(text) + "\n";
        header_ = read_header(text);
        begun_ = true;
        before.clear();
      } else {
        json_ = json_ || !begun_;
        begun_ = true;
        Row row{text, std::move(before), line->number, std::nullopt, 0, 0, line->ended};
        before.clear();
        if (json_) read_json(row);
        else read_csv(header_, row);
        rows_.push_back(std::move(row));
      }
    }
    tail_ = std::move(before);
    out_.rows = rows_.size();
    return begun_;
  }

  Tidied mend() {
    if (options_.drop_last && !rows_.empty() && !rows_.back().whole) {
      note("half written, at the end: left out", rows_.back().line);
      rows_.pop_back();
    }
    if (options_.drop_duplicates) drop_duplicates();
    using Clock = TidyOptions::Clock;
    if (options_.clock == Clock::kDrop) drop_earlier();
    else if (options_.clock == Clock::kSort) sort();
    out_.bytes = head_;
    std::int64_t before_us = 0, step_us = 0, shift_us = 0;
    bool timed = false;
    for (const Row& row : rows_) {
      out_.bytes += row.before;
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
    out_.kept = rows_.size();
    return std::move(out_);
  }

 private:
  /// `text` is the reader's, and gone with the next line.
  std::string_view keep(std::string_view text) { return texts_.emplace_back(text); }
  [[nodiscard]] bool goes_back(std::int64_t t_us, std::int64_t before_us) const { return json_ ? t_us <= before_us : t_us < before_us; }

  void note(std::string_view what, std::uint64_t line) {
    auto& changes = out_.changes;
    auto change = std::find_if(changes.begin(), changes.end(), [&](const TidyChange& one) { return one.what == what; });
    if (change == changes.end()) change = changes.insert(change, {std::string(what), {}});
    change->lines.push_back(line);
  }

  void drop_duplicates() {
    std::vector<Row> kept;
    for (Row& row : rows_) {
      if (kept.empty() || kept.back().text != row.text) kept.push_back(std::move(row));
      else note("the same as the row before: left out", row.line);
    }
    rows_ = std::move(kept);
  }

  void drop_earlier() {
    std::vector<Row> kept;
    std::optional<std::int64_t> before_us;
    for (Row& row : rows_) {
      const bool earlier = row.t_us && before_us && goes_back(*row.t_us, *before_us);
      if (earlier) note("earlier than a row before it: left out", row.line);
      if (earlier) continue;
      if (row.t_us) before_us = row.t_us;
      kept.push_back(std::move(row));
    }
    rows_ = std::move(kept);
  }

  void sort() {
    std::optional<std::int64_t> before_us;
    for (Row& row : rows_) {
      if (!row.t_us) row.t_us = before_us;   // it stays behind the row that it stands behind
      else if (before_us && *row.t_us < *before_us) note("earlier than a row before it: put where its time belongs", row.line);
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
    out_.bytes += '\n';
  }

  TidyOptions options_;
  Tidied out_;
  std::string head_, tail_;
  Header header_;
  std::deque<std::string> texts_;
  std::vector<Row> rows_;
  bool json_ = false, begun_ = false;
};

}  // namespace

std::optional<Tidied> tidied(std::string_view bytes, const TidyOptions& options) {
  Tidier tidier(options);
  return tidier.read(bytes) ? std::optional(tidier.mend()) : std::nullopt;
}

}  // namespace kb::trace
