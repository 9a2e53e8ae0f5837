// Draws with Graphviz, if it is installed.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace kb::trace {

struct Drawing {
  enum class Outcome : std::uint8_t { kDrawn, kNotInstalled, kFailed };
  Outcome outcome = Outcome::kFailed;
  std::string svg;    ///< if drawn
  std::string error;  ///< if it failed: the beginning of its error message
};

/// Runs `dot -Tsvg` on `graph` and waits for it. No shell is involved, and no file is left behind.
[[nodiscard]] Drawing draw_svg(std::string_view graph);

}  // namespace kb::trace
