// Warnings that the source itself allows.
//
// note [allowed warnings]
// `# allow: conflicting-rules` says that somebody has looked at a warning and wants the text as it is; behind a comma other warnings may follow, and
// behind a name the reason. It counts for the line in which it stands, and for the statement below it; of a message that names several places, one is
// enough. A name that is none allows nothing, so the warning is still there.
#pragma once

#include <string_view>

#include "compiler/source/source.h"

namespace kb::diagnostics {

/// Whether a comment allows the warning `flag`, or `code` (`KB1011`), at this place: in its line, in the comment lines right above it, in the
/// line where its statement begins (the nearest that is not indented), or in the comment lines above that. O(bytes of at most 1,000 lines).
[[nodiscard]] bool is_allowed(const source::Sources& sources, source::Span at, std::string_view flag, std::string_view code);

/// Where a comment that allows a warning at this known place belongs: the beginning of the line above which to write it. That is the line where its
/// statement begins; of a block in braces, its own.
[[nodiscard]] source::Sources::Line line_to_allow(const source::Sources& sources, source::Span at);

}  // namespace kb::diagnostics
