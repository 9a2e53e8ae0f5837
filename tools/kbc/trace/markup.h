// Text inside HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace kb::trace {

/// `text` with `& < > "` as entities, for text and for attributes in double quotes; control characters that XML does
/// not allow, and bytes that are not UTF-8, become `?`.
[[nodiscard]] std::string escape_markup(std::string_view text);

}  // namespace kb::trace
