#include "compiler/source/source.h"

#include <algorithm>
#include <iterator>

#include "compiler/source/encoding.h"

namespace kb::source {
namespace {

/// note [columns of long lines]
/// A column is counted from the beginning of its line. In a program on a single long line (line breaks mean nothing) each place would
/// cost as much as the program is long. So the code points before each piece of so many bytes are counted once.
constexpr std::size_t kPiece = 4096;

}  // namespace

Span join(Span a, Span b) {
  if (!a.known()) return b;
  if (a.file != b.file) return a;
  return {a.file, std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

FileId Sources::add(std::string path, std::string bytes, bool standard, std::string label, Span imported_at) {
  auto file = std::make_unique<File>();
  file->label = label.empty() ? path : std::move(label);
  file->path = std::move(path);
  file->bytes = std::move(bytes);
  file->standard = standard;
  file->imported_at = imported_at;
  file->line_begins.push_back(0);
  for (std::size_t at = file->bytes.find('\n'); at != std::string::npos; at = file->bytes.find('\n', at + 1)) {
    file->line_begins.push_back(static_cast<std::uint32_t>(at + 1));
  }
  for (std::size_t at = 0, count = 0; at < file->bytes.size(); at += kPiece) {
    file->code_points_before.push_back(static_cast<std::uint32_t>(count));
    count += code_points(std::string_view(file->bytes).substr(at, kPiece));
  }
  files_.push_back(std::move(file));
  return FileId{static_cast<std::uint32_t>(files_.size() - 1)};
}

FileId Sources::add_lines(std::string path, std::string bytes, std::uint32_t first) {
  const FileId file = add(std::move(path), std::move(bytes));
  files_.back()->first_line = first;
  return file;
}

// See note [columns of long lines].
std::uint32_t Sources::File::code_points_in(std::size_t begin, std::size_t end) const {
  const std::string_view text = bytes;
  if (end - begin <= kPiece) return static_cast<std::uint32_t>(code_points(text.substr(begin, end - begin)));
  const std::size_t first = begin / kPiece, last = (end - 1) / kPiece;
  return static_cast<std::uint32_t>(code_points_before[last] - code_points_before[first] - code_points(text.substr(first * kPiece, begin - first * kPiece)) +
                                    code_points(text.substr(last * kPiece, end - last * kPiece)));
}

// The place after `count` code points from `begin` on, at most `end`. See note [columns of long lines].
std::size_t Sources::File::after_code_points(std::size_t begin, std::size_t end, std::size_t count) const {
  std::size_t at = begin;
  if (count >= kPiece) {
    const std::size_t first = begin / kPiece;
    const std::size_t wanted = count + code_points_before[first] + code_points(std::string_view(bytes).substr(first * kPiece, begin - first * kPiece));
    const auto piece = std::prev(std::upper_bound(code_points_before.begin(), code_points_before.end(), wanted));
    at = static_cast<std::size_t>(piece - code_points_before.begin()) * kPiece;
    count = wanted - *piece;
  }
  for (; at < end; ++at) {
    if (begins_code_point(bytes[at]) && count-- == 0) return at;
  }
  return end;
}

const Sources::File& Sources::at(FileId file) const { return *files_[static_cast<std::size_t>(file)]; }
std::string_view Sources::path(FileId file) const { return at(file).path; }
std::string_view Sources::label(FileId file) const { return at(file).label; }
std::string_view Sources::bytes(FileId file) const { return at(file).bytes; }
bool Sources::standard(FileId file) const { return at(file).standard; }

Span Sources::brought_in_at(FileId file) const {
  Span import;
  while (at(file).standard && at(file).imported_at.known()) {
    import = at(file).imported_at;
    file = import.file;
  }
  return at(file).standard ? Span{} : import;
}

std::string_view Sources::text(Span span) const {
  if (!span.known()) return {};
  return std::string_view(at(span.file).bytes).substr(span.begin, span.end - span.begin);
}

Sources::Line Sources::line_of(FileId file, std::uint32_t offset) const {
  const File& f = at(file);
  const auto next = std::upper_bound(f.line_begins.begin(), f.line_begins.end(), offset);
  const std::uint32_t begin = *(next - 1);
  std::uint32_t end = next == f.line_begins.end() ? static_cast<std::uint32_t>(f.bytes.size()) : *next - 1;
  if (end > begin && f.bytes[end - 1] == '\r') --end;
  return {std::string_view(f.bytes).substr(begin, end - begin), begin};
}

Location Sources::locate(FileId file, std::uint32_t offset) const {
  const File& f = at(file);
  const auto next = std::upper_bound(f.line_begins.begin(), f.line_begins.end(), offset);
  const bool bom = next == f.line_begins.begin() + 1 && f.first_line == 1 && f.bytes.starts_with(kByteOrderMark);
  const std::size_t end = std::min<std::size_t>(offset, f.bytes.size());
  const std::size_t begin = std::min<std::size_t>(*(next - 1) + (bom ? 3u : 0u), end);
  return {f.first_line - 1 + static_cast<std::uint32_t>(next - f.line_begins.begin()), 1 + f.code_points_in(begin, end)};
}

std::uint32_t Sources::offset_of(FileId file, Location place) const {
  const File& f = at(file);
  if (place.line > f.line_begins.size()) return static_cast<std::uint32_t>(f.bytes.size());
  const std::size_t end = place.line < f.line_begins.size() ? f.line_begins[place.line] - 1u : f.bytes.size();
  const bool bom = place.line == 1 && f.bytes.starts_with(kByteOrderMark);
  const std::size_t begin = f.line_begins[place.line - 1u] + (bom ? 3u : 0u);
  return static_cast<std::uint32_t>(f.after_code_points(begin, end, place.column - 1u));
}

namespace {

std::string with_location(std::string_view name, Location place) {
  return std::string(name) + ":" + std::to_string(place.line) + ":" + std::to_string(place.column);
}

}  // namespace

std::string Sources::describe(Span span) const {
  return span.known() ? with_location(path(span.file), locate(span.file, span.begin)) : "-";
}

std::string Sources::origin(Span span) const {
  return span.known() ? with_location(label(span.file), locate(span.file, span.begin)) : "-";
}

}  // namespace kb::source
