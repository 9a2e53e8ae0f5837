#include "compiler/diagnostics/allowed.h"

#include <algorithm>

#include "compiler/source/encoding.h"

namespace kb::diagnostics {
namespace {

constexpr std::string_view kWord = "allow:";

/// The comment of a line, without its `#`; empty if it has none.
std::string_view comment_of(std::string_view line) {
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (line[i] == '"') quoted = !quoted;
    if (line[i] == '#' && !quoted) return source::trimmed(line.substr(i + 1));
  }
  return {};
}

/// The names that a line's comment allows: the first word of each item.
void add_names(std::string_view line, std::vector<std::string_view>& names) {
  if (line.find(kWord) == std::string_view::npos) return;
  const std::string_view comment = comment_of(line);
  if (!comment.starts_with(kWord)) return;
  for (const std::string_view part : source::split(comment.substr(kWord.size()), ',')) {
    const std::string_view item = source::trimmed(part);
    names.push_back(item.substr(0, item.find_first_of(" \t;:")));
  }
}

bool is_comment(std::string_view line) { return source::trimmed(line).starts_with('#'); }
bool is_blank(std::string_view line) { return source::trimmed(line).empty(); }
bool is_indented(std::string_view line) { return is_blank(line) || line[0] == ' ' || line[0] == '\t' || line[0] == '}'; }

}  // namespace

Allowances::Allowances(std::string_view bytes, std::optional<std::span<const std::uint32_t>> statements) {
  if (bytes.find(kWord) == std::string_view::npos) return;
  std::vector<std::string_view> above, own;   // of the comment lines right above; and of the line itself
  for (std::size_t begin = 0; begin < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
    const std::string_view line = bytes.substr(begin, end - begin);
    if (is_comment(line)) {
      add_names(line, above);
    } else {
      own = above;
      add_names(line, own);
      above.clear();
      if (is_blank(line)) own.clear();
      add(lines_, begin, own);
      const auto next = statements ? std::ranges::lower_bound(*statements, begin) : std::span<const std::uint32_t>::iterator();
      if (statements ? next != statements->end() && *next < end : !is_indented(line)) add(statements_, begin, own);
    }
    begin = end + 1;
  }
}

/// What was added last ends where this begins.
void Allowances::add(std::vector<Range>& to, std::size_t begin, const std::vector<std::string_view>& names) {
  if (!to.empty()) to.back().end = std::min(to.back().end, begin);
  if (!names.empty()) to.push_back({begin, std::string_view::npos, names});
}

bool Allowances::allow(const std::vector<Range>& ranges, std::uint32_t offset, std::string_view flag, std::string_view code) {
  const auto next = std::upper_bound(ranges.begin(), ranges.end(), offset, [](std::uint32_t at, const Range& range) { return at < range.begin; });
  if (next == ranges.begin() || offset >= std::prev(next)->end) return false;
  return std::any_of(std::prev(next)->names.begin(), std::prev(next)->names.end(), [&](std::string_view name) { return name == flag || name == code; });
}

bool Allowances::allow(std::uint32_t offset, std::string_view flag, std::string_view code) const {
  return allow(lines_, offset, flag, code) || allow(statements_, offset, flag, code);
}

void AllowancesOfFiles::know(const source::Sources& sources, source::FileId file, std::span<const std::uint32_t> statements) {
  files_.insert_or_assign(file, Allowances(sources.bytes(file), statements));
}

bool AllowancesOfFiles::allow(const source::Sources& sources, source::Span at, std::string_view flag, std::string_view code) {
  if (!at.known()) return false;
  const auto known = files_.find(at.file);
  const auto& file = known != files_.end() ? known->second : files_.emplace(at.file, Allowances(sources.bytes(at.file))).first->second;
  return file.allow(at.begin, flag, code);
}

source::Sources::Line line_to_allow(const source::Sources& sources, source::Span at, std::uint32_t statement) {
  const source::Sources::Line line = sources.line_of(at.file, statement);
  const std::string_view code = source::trimmed(line.text.substr(0, line.text.find('#')));
  return code.ends_with('{') ? sources.line_of(at.file, at.begin) : line;
}

}  // namespace kb::diagnostics
