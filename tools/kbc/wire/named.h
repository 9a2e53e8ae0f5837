// What a line says of buttons, whatever is wrong with it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace kb::wire {

/// The names in `buttons`, and those in `facts` with a certainty above 0, as far as they can be read. The text need not be a line that
/// `read_line` takes, nor JSON at all: a line that is cut off, or has a NaN, still names them. They may be named twice, and need not exist. O(bytes).
[[nodiscard]] std::vector<std::string> named_in(std::string_view text);

}  // namespace kb::wire
