// Text and numbers in output.
#pragma once

#include <string>
#include <string_view>

namespace kb::sim::report {

/// `text` with U+FFFD for each byte that belongs to no UTF-8 sequence.
[[nodiscard]] std::string valid_utf8(std::string_view text);

/// Valid UTF-8 with `& < > "` as entities, for XML text and for attributes in double quotes; control characters that XML
/// does not allow become `?`.
[[nodiscard]] std::string markup(std::string_view text);

/// JSON for a `<script>` or a file: whatever could end the script (`<`, `>`, `&`) or a line of it (U+2028, U+2029) as an
/// escape. `json` is well-formed JSON; outside its strings it has none of these.
[[nodiscard]] std::string safe_in_script(std::string_view json);

/// At most `decimals` places, no trailing zeros, no minus before zero. `value` is finite.
[[nodiscard]] std::string fixed(double value, int decimals);

}  // namespace kb::sim::report
