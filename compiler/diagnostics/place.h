// Places as other programs want them: the two ends of a span, and files as URIs.
#pragma once

#include <string>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::diagnostics {

struct Place {
  source::Location begin;
  source::Location end;   ///< that of the first code point after the span
};

/// `span` must be known.
[[nodiscard]] inline Place place(const source::Sources& sources, source::Span span) {
  return {sources.locate(span.file, span.begin), sources.locate(span.file, span.end)};
}

/// The path as a URI reference (RFC 3986), with `file://` if it is absolute; all but letters, digits and `-._~/` is percent-encoded.
[[nodiscard]] std::string uri(std::string_view path);

}  // namespace kb::diagnostics
