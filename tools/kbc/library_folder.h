// Where the standard library is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace kb::cli {

/// The library that --library (`option`) names, or else $WAYMARK_LIBRARY; empty if neither does.
[[nodiscard]] std::string named_library(std::string_view option);
/// The folder of the standard library: the one asked for, else $WAYMARK_LIBRARY, else ../share/waymark/stdlib_rules
/// beside the program's folder. (A build folder has a link of that name to the source tree.) If there is none, the last
/// one tried.
[[nodiscard]] std::string find_library(std::string_view asked);
/// The file of the program that runs, all links followed.
[[nodiscard]] std::filesystem::path own_program();
/// A library that the user names must be one. The default library may be missing as long as nothing of it is imported.
[[nodiscard]] bool is_library(const std::string& folder);
/// The library that is meant by its own folder, `stdlib_rules/std`; nothing if none is.
[[nodiscard]] std::optional<std::string> library_above(const std::string& folder);

}  // namespace kb::cli
