// Text and numbers in output.
#pragma once

#include <string>
#include <string_view>

namespace kb::sim::report {

/// JSON for a `<script>` or a file: whatever could end the script (`<`, `>`, `&`) or a line of it (U+2028, U+2029) as an
/// escape. `json` is well-formed JSON; outside its strings it has none of these.
[[nodiscard]] std::string safe_in_script(std::string_view json);

/// At most `decimals` places, no trailing zeros, no minus before zero. `value` is finite.
[[nodiscard]] std::string fixed(double value, int decimals);

}  // namespace kb::sim::report
