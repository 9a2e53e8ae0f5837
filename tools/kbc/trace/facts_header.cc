// The header of a file of facts, and what is said about places in its lines.
#include <fmt/format.h>

#include <algorithm>

#include "tools/kbc/trace/excerpt.h"
#include "tools/kbc/trace/facts_csv.h"

namespace kb::trace {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::CellKind;

std::string counted(std::size_t n, const char* thing) { return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s"); }

}  // namespace

bool FactsReader::read_header(const LineReader::Line& line) {
  if (std::size_t fault = 0; !is_utf8(line.text, fault)) {
    reject_bytes(line, fault);
    return false;
  }
  if (reject_separator(line)) return false;
  const CellNames names(program_);
  std::vector<Mark> marks;
  bool good = true;
  std::size_t number = 0;
  for (FieldCursor fields(line.text, scratch_, true); fields.more();) {
    const Field field = fields.next();
    if (field.fault != Field::Fault::kNone) {
      reject_field(line, field);
      return false;
    }
    good = add_column(field, ++number, line, names, marks) && good;
  }
  return good;
}

bool FactsReader::add_column(const Field& field, std::size_t number, const LineReader::Line& line,
                             const CellNames& names, std::vector<Mark>& marks) {
  const Mark mark{field.begin, std::max(field.end, field.begin + 1)};
  const std::string shown = printable(field.text);
  const auto reject = [&](Kind kind, std::initializer_list<std::string_view> arguments) {
    return report(kind, line, mark, arguments);
  };
  if (field.text.empty()) {
    reject(Kind::kFactsNoName, {fmt::format("{}", number)});
    return false;
  }
  std::uint32_t column = kTimeColumn;
  if (field.text != "t") {
    const CellId cell = names.find(field.text);
    const bool known = cell != CellId::kNone;
    if (!known) {
      reject(Kind::kFactsUnknownName, {shown}).suggest(names.closest(field.text, CellKind::kFact));
    } else if (program_[cell].kind != CellKind::kFact) {
      reject(Kind::kFactsNotAFact, {shown, program_[cell].kind == CellKind::kStrategy ? "strategy" : "satellite"});
    }
    if (!known || program_[cell].kind != CellKind::kFact) return false;
    column = static_cast<std::uint32_t>(program::index(cell));
  }
  if (const auto first = std::find(columns_.begin(), columns_.end(), column); first != columns_.end()) {
    const Mark before = marks[static_cast<std::size_t>(first - columns_.begin())];
    const source::Span note = excerpt(sources_, path_, line, before.begin, before.end);
    reject(Kind::kFactsTwice, {shown}).note(Kind::kFactsFirstColumn, note);
    return false;
  }
  timed_ = timed_ || column == kTimeColumn;
  columns_.push_back(column);
  marks.push_back(mark);
  return true;
}

// Spreadsheets of half the world write semicolons; without a word of its own that would be one long unknown name.
bool FactsReader::reject_separator(const LineReader::Line& line) {
  if (line.text.find(',') != std::string_view::npos) return false;
  const std::size_t at = line.text.find_first_of(";\t", line.text.find_first_not_of(" \t"));
  if (at == std::string_view::npos) return false;
  const auto place = static_cast<std::uint32_t>(at);
  report(Kind::kFactsSeparator, line, {place, place + 1}, {line.text[at] == ';' ? "`;`" : "a tab"});
  return true;
}

void FactsReader::reject_bytes(const LineReader::Line& line, std::size_t fault) {
  const auto place = static_cast<std::uint32_t>(fault);
  report(Kind::kFactsNotUtf8, line, {place, place + 1}, {});
  failed_ = true;
}

void FactsReader::reject_field(const LineReader::Line& line, const Field& field) {
  const Mark mark{field.begin, field.end};
  if (field.fault == Field::Fault::kOpenQuote) {
    report(Kind::kFactsOpenQuote, line, {mark.begin, mark.begin + 1}, {});
  } else {
    report(Kind::kFactsAfterQuote, line, mark, {printable(field.text)});
  }
}

// Called with the fields that were read and those that are left; one of the two numbers is wrong.
void FactsReader::reject_count(const LineReader::Line& line, std::size_t fields, FieldCursor& rest) {
  Mark mark{static_cast<std::uint32_t>(line.text.size()), static_cast<std::uint32_t>(line.text.size() + 1)};
  for (bool first = true; rest.more(); ++fields, first = false) {
    const Field surplus = rest.next();
    if (first) mark = {surplus.begin, std::max(surplus.end, surplus.begin + 1)};
  }
  report(Kind::kFactsFieldCount, line, mark, {counted(fields, "field"), counted(columns_.size(), "column")});
}

diagnostics::Builder FactsReader::report(Kind kind, const LineReader::Line& line, Mark mark,
                                         std::initializer_list<std::string_view> arguments) {
  return diagnostics_.report(kind, excerpt(sources_, path_, line, mark.begin, mark.end), arguments);
}

}  // namespace kb::trace
