// Names of scenarios and minds in rows of results, which programs of all kinds read.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace kb::cli {

/// `FILE=NAME`, or a FILE alone, whose name is empty then. A file whose own name has a `=` needs no name if it is there.
[[nodiscard]] std::pair<std::string, std::string> file_and_name(const std::string& option);

/// Why this cannot be a name in results; empty if it can.
[[nodiscard]] std::string_view refused_name(std::string_view name);

/// The name with `_` for each character that is no letter, digit, `_`, `-` or `.`: it may have a meaning in CSV or Markdown, or not be shown.
[[nodiscard]] std::string plain_name(std::string_view name);

}  // namespace kb::cli
