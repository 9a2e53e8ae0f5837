// A mistake in a line or an answer, as a value: its reader decides where to report it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"

namespace kb::wire {

struct Mistake {
  diagnostics::Kind kind{};
  std::array<std::string, 3> arguments;   ///< for the kind's text; unused ones are empty
  std::string field;                      ///< `tag.exit`; empty: the line as a whole
  source::Span span{};                    ///< bytes of the line
  std::optional<std::string> better{};    ///< what was probably meant
};

/// Reports a mistake; `at`: the place of the line.
void report(const Mistake& mistake, source::Span at, diagnostics::Diagnostics& diagnostics);
/// The message as it would be printed, in one line: `there is no field \`rnage_m\`; did you mean \`range_m\`?`
[[nodiscard]] std::string message_of(const Mistake& mistake);

}  // namespace kb::wire
