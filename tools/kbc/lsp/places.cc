#include "tools/kbc/lsp/places.h"

#include <algorithm>
#include <charconv>

#include "compiler/diagnostics/display.h"

namespace kb::lsp {
namespace {

struct Character { std::size_t bytes; std::uint32_t units; };

Character character(std::string_view text, Encoding encoding) {
  const std::size_t bytes = diagnostics::code_point(text).bytes;
  if (bytes == 0) return {1, 1};
  return {bytes, encoding == Encoding::kUtf8 ? static_cast<std::uint32_t>(bytes) : bytes == 4 ? 2u : 1u};
}

}  // namespace

std::uint32_t units(std::string_view text, Encoding encoding) {
  std::uint32_t count = 0;
  while (!text.empty()) {
    const Character next = character(text, encoding);
    count += next.units;
    text.remove_prefix(next.bytes);
  }
  return count;
}

Position position(const source::Sources& sources, source::FileId file, std::uint32_t offset, Encoding encoding) {
  const source::Sources::Line line = sources.line_of(file, offset);
  return {sources.locate(file, offset).line - 1, units(line.text.substr(0, offset - line.begin), encoding)};
}

std::uint32_t offset(std::string_view bytes, Position at, Encoding encoding) {
  std::size_t begin = 0;
  for (; at.line > 0; --at.line) {
    begin = bytes.find('\n', begin);
    if (begin == std::string_view::npos) return static_cast<std::uint32_t>(bytes.size());
    ++begin;
  }
  std::string_view line = bytes.substr(begin, std::min(bytes.find('\n', begin), bytes.size()) - begin);
  while (!line.empty() && at.character > 0) {
    const Character next = character(line, encoding);
    at.character -= std::min(at.character, next.units);
    line.remove_prefix(next.bytes);
    begin += next.bytes;
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
