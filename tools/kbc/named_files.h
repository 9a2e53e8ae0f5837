// What a command line names: nothing without a name, and no file twice, unless both read it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace CLI { class App; }

namespace kb::cli {

/// A file, or what will be one, by the one name that all its names lead to; nothing for standard input, a device, a pipe.
[[nodiscard]] std::optional<std::string> file_named(const std::string& path);

/// What is wrong if two options of a command line that was read name one file, or one of them a file of `derived`: what the
/// command writes under names that it makes of its options. Empty if all is well. Two arguments may name one file, as both are read.
[[nodiscard]] std::string named_twice(const CLI::App& command, const std::vector<std::string>& derived = {});

/// What is wrong if an argument or the value of an option is the empty text. Empty if all is well. Commands may then take an empty text as
/// that of an option that was not given. `words` is the command line, as it is read: of `--dt=` the reader makes an option without a value.
[[nodiscard]] std::string left_empty(const CLI::App& command, std::span<char* const> words);

}  // namespace kb::cli
