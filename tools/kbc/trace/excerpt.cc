#include "tools/kbc/trace/excerpt.h"

#include <algorithm>
#include <cstdint>

#include "compiler/source/encoding.h"

namespace kb::trace {
namespace {

// How much of a long line is shown after the place that a message is about.
constexpr std::size_t kShownAfter = 200;

// The beginning of `line` up to some way after `end`, cut between characters.
std::string_view shown(std::string_view line, std::size_t end) {
  std::size_t size = std::min(line.size(), end + kShownAfter);
  while (size < line.size() && !source::begins_code_point(line[size])) ++size;
  return line.substr(0, size);
}

}  // namespace

source::Span excerpt(source::Sources& sources, const std::string& path, const LineReader::Line& line,
                     std::uint32_t begin, std::uint32_t end) {
  const auto number = static_cast<std::uint32_t>(std::min<std::uint64_t>(line.number, UINT32_MAX));
  const std::string_view bytes = shown(line.text, end);
  if (sources.size() > 0) {
    const auto last = static_cast<source::FileId>(sources.size() - 1);
    if (sources.path(last) == path && sources.bytes(last) == bytes && sources.locate(last, 0).line == number) return {last, begin, end};
  }
  return {sources.add_lines(path, std::string(bytes), number), begin, end};
}

}  // namespace kb::trace
