#include "tools/kbc/lsp/places.h"

#include <algorithm>
#include <charconv>

#include "compiler/source/encoding.h"

namespace kb::lsp {
namespace {

constexpr std::string_view kMark = source::kByteOrderMark;   // it takes no column

/// Whether a character of two units of UTF-16 begins here.
constexpr bool begins_pair(char c) { return (static_cast<unsigned char>(c) & 0xF8u) == 0xF0u; }

}  // namespace

Places::Places(const source::Sources& sources) : sources_(&sources), pairs_(sources.size()) {
  for (std::uint32_t file = 0; file < sources.size(); ++file) {
    const std::string_view bytes = sources.bytes(source::FileId{file});
    for (std::uint32_t at = 0; at < bytes.size(); ++at) {
      if (begins_pair(bytes[at])) pairs_[file].push_back(at);
    }
  }
}

Position Places::position(source::FileId file, std::uint32_t offset, Encoding encoding) const {
  const auto [line, begin] = sources_->line_of(file, offset);
  offset = std::min(offset, static_cast<std::uint32_t>(begin + line.size()));   // not within the line break
  const source::Location place = sources_->locate(file, offset);
  if (encoding == Encoding::kUtf8) return {place.line - 1, offset - begin};
  const auto& pairs = pairs_[static_cast<std::size_t>(file)];
  const auto wide = std::ranges::lower_bound(pairs, offset) - std::ranges::lower_bound(pairs, begin);
  const bool mark = place.line == 1 && offset > 0 && sources_->bytes(file).starts_with(kMark);
  return {place.line - 1, place.column - 1 + static_cast<std::uint32_t>(wide) + (mark ? 1 : 0)};
}

std::uint32_t Places::units(source::Span span, Encoding encoding) const {
  return position(span.file, span.end, encoding).character - position(span.file, span.begin, encoding).character;
}

std::uint32_t offset(std::string_view bytes, Position at, Encoding encoding) {
  std::size_t begin = 0;
  for (; at.line > 0; --at.line) {
    begin = bytes.find('\n', begin);
    if (begin == std::string_view::npos) return static_cast<std::uint32_t>(bytes.size());
    ++begin;
  }
  std::size_t end = std::min(bytes.find('\n', begin), bytes.size());
  if (end > begin && bytes[end - 1] == '\r') --end;
  while (begin < end && at.character > 0) {
    std::size_t next = begin + 1;
    while (next < end && !source::begins_code_point(bytes[next])) ++next;
    const std::string_view character = bytes.substr(begin, next - begin);
    const std::size_t width = encoding == Encoding::kUtf8 ? character.size() : begins_pair(character.front()) ? 2u : source::begins_code_point(character.front()) ? 1u : 0u;
    at.character -= std::min(at.character, static_cast<std::uint32_t>(width));
    begin = next;
  }
  return static_cast<std::uint32_t>(begin);
}

std::optional<std::string> path_of(std::string_view uri) {
  for (const std::string_view scheme : {"file://localhost/", "file:///"}) {
    if (!uri.starts_with(scheme)) continue;
    uri.remove_prefix(scheme.size() - 1);
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
      unsigned byte = 0;
      const char* const digits = uri.data() + i + 1;
      const bool coded = uri[i] == '%' && i + 2 < uri.size() && std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2;
      path += coded ? static_cast<char>(byte) : uri[i];
      i += coded ? 2 : 0;
    }
    return path;
  }
  return std::nullopt;
}

}  // namespace kb::lsp
