// The two ends of a span for people, as JSON and SARIF want them.
#pragma once

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

}  // namespace kb::diagnostics
