// Patterns of names, as in a shell.
#pragma once

#include <string_view>

namespace kb::trace {

/// True if `pattern` (`*` any characters, `?` any one, all others themselves) matches all of `text`. O(pattern * text).
[[nodiscard]] bool matches_glob(std::string_view pattern, std::string_view text);

}  // namespace kb::trace
