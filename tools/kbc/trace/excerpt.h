// One line of a file that is read as a stream, as a place that messages can point to.
#pragma once

#include <cstdint>
#include <string>

#include "compiler/source/source.h"
#include "tools/kbc/trace/stream.h"

namespace kb::trace {

/// The bytes [begin, end) of `line` in the file `path`, as a span. The line is added to `sources` under its own number,
/// so that the message shows it as it would in a file that is held in memory. The same line twice in a row is added
/// once. For mistakes only: costs memory.
[[nodiscard]] source::Span excerpt(source::Sources& sources, const std::string& path, const LineReader::Line& line,
                                   std::uint32_t begin, std::uint32_t end);

}  // namespace kb::trace
