// FLL, the language of fuzzylite (version 6), to and from `fuzzy` blocks. Takagi-Sugeno engines of order zero and one.
//
// Nothing is dropped silently. What Waymark's language cannot express is an error at its line (KB1148); what it expresses in another
// way, with the same result, is a warning (KB1158, -Wfll-adapted).
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/fuzzy/controller.h"
#include "compiler/source/source.h"

namespace kb::fll {

/// A line `key: value`; both without blanks at their ends.
struct Line {
  source::Span span;   ///< the whole line
  std::string_view key, value;
};

/// The words of a text, separated by blanks.
[[nodiscard]] std::vector<std::string_view> words(std::string_view text);

/// The engine in `file` as a knowledge base with one `fuzzy` block. Nothing if any part could not be converted.
[[nodiscard]] std::optional<std::string> import_engine(const source::Sources& sources, source::FileId file,
                                                       diagnostics::Diagnostics& diagnostics);

/// The controller as an FLL engine. Nothing if FLL cannot express all of it (KB1157, once for each thing).
[[nodiscard]] std::optional<std::string> export_engine(const fuzzy::Controller& controller, diagnostics::Diagnostics& diagnostics);

}  // namespace kb::fll
