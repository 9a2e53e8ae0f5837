// Files that a command line names: no two of its options may name one, unless both read it.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace CLI { class App; }

namespace kb::cli {

/// A file, or what will be one, by the one name that all its names lead to; nothing for standard input, a device, a pipe.
[[nodiscard]] std::optional<std::string> file_named(const std::string& path);

/// What is wrong if two options of a command line that was read name one file, or one of them a file of `derived`: what the
/// command writes under names that it makes of its options. Empty if all is well. Two arguments may name one file, as both are read.
[[nodiscard]] std::string named_twice(const CLI::App& command, const std::vector<std::string>& derived = {});

}  // namespace kb::cli
