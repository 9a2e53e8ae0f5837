// What is wrong with a line or an answer, as a value: who read it decides whom to tell.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/source/source.h"

namespace kb::wire {

struct Mistake {
  diagnostics::Kind kind{};
  std::array<std::string, 3> arguments;   ///< of the kind's text; those that it has no room for are empty
  std::string field;                      ///< `tag.exit`; empty: the line as a whole
  source::Span span{};                    ///< bytes of the line
  std::optional<std::string> better{};    ///< what was probably meant
};

/// To whoever listens; `at`: where the line stands.
void report(const Mistake& mistake, source::Span at, diagnostics::Diagnostics& diagnostics);
/// The message as it would be printed, in one line: `there is no field \`rnage_m\`; did you mean \`range_m\`?`
[[nodiscard]] std::string message_of(const Mistake& mistake);

}  // namespace kb::wire
