// Checks the files on a command line: no empty names, and no file twice unless both uses read it.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace CLI { class App; }

namespace kb::cli {

/// The one name to which all names of an existing or future file lead; nothing for standard input, a device or a pipe.
[[nodiscard]] std::optional<std::string> file_named(const std::string& path);

/// Whether an output of this name goes to standard output: `-`, or the name that the system has for it.
[[nodiscard]] bool is_standard_output(std::string_view path);

/// A fault if two options of a parsed command line name one file, or one of them names a file of `derived`, which the command writes under
/// names made from its options. Empty if all is well. Two arguments may name one file, as both are only read.
[[nodiscard]] std::string named_twice(const CLI::App& command, const std::vector<std::string>& derived = {});

/// A fault if an argument, the value of an option or an item of a list is an empty text; empty if all is well. Commands may then take an empty text for an
/// option that was not given. `words` is the raw command line: the parser turns `--dt=` into an option without a value.
[[nodiscard]] std::string left_empty(const CLI::App& command, std::span<char* const> words);

}  // namespace kb::cli
