// What can be written in control lines: the known controllers and their arguments.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/syntax/syntax.h"
#include "tools/kbc/lsp/answers.h"

namespace kb::lsp {

struct ControllerArgument {
  std::string name;
  std::string takes;   ///< `0.05 to 1 m/s`, `left, right or both`
  std::string about;   ///< one line; empty if there is none
  std::vector<std::string_view> words;   ///< the words that it takes, if it takes words
};
struct KnownController {
  std::string name;
  std::string about;   ///< one line; empty for a fuzzy block
  std::vector<ControllerArgument> arguments;
};
/// One of Waymark's controllers, or a fuzzy block; nothing for one that only the user's program has.
[[nodiscard]] std::optional<KnownController> known_controller(const Knowledge& knowledge, std::string_view name);
/// `speed: 0.05 to 1 m/s`.
[[nodiscard]] std::string label(const ControllerArgument& argument);
/// `follow_line(speed: 0.05 to 1 m/s, ...)`.
[[nodiscard]] std::string label(const KnownController& controller);

/// The parentheses of a control line in which the user is writing.
struct ControlLine {
  std::string_view controller;
  std::string_view argument;             ///< the argument whose value the place is in; empty if none
  std::vector<std::string_view> given;   ///< the arguments before it
};
[[nodiscard]] std::optional<ControlLine> control_line_at(const OpenFile& file, std::span<const syntax::Lexeme> lexemes, std::uint32_t offset);

}  // namespace kb::lsp
