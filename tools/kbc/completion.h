// What completes the words of a command line, from the table of commands and what CLI11 knows of their options. Every shell is offered the
// same; only how it is written differs. Included by .cc files of this folder only.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/kbc/command_line.h"

namespace kb::cli {

/// What an argument or the value of an option may be, as far as a shell can know.
struct Completion {
  enum class Kind : std::uint8_t {
    kUnknown,   ///< a number, a name, ...
    kWords,     ///< one of `words`
    kFolders,
    kFiles,     ///< any file
    kInputs,    ///< a file that the command reads: see file_endings
    kCodes,     ///< the code of a message, or the name of a warning
  };
  Kind kind = Kind::kUnknown;
  std::vector<std::string> words;
};
[[nodiscard]] Completion completion_of(const CLI::Option& option);

/// The options and arguments of a command that its help shows.
[[nodiscard]] std::vector<const CLI::Option*> shown_options(const CLI::App& command);
/// The names of an option as they are typed: `-o`, `--output`.
[[nodiscard]] std::vector<std::string> typed_names(const CLI::Option& option);
/// Whether it is `-W`, whose values are the names of warnings.
[[nodiscard]] bool names_warnings(const CLI::Option& option);

/// The endings of the files that a command reads, without dots. Commands that are not listed read `kb`.
struct FileEndings {
  std::string_view command;
  std::string_view first;   ///< only if the command's first argument is this; empty: whatever it is
  std::vector<std::string_view> endings;
};
[[nodiscard]] std::span<const FileEndings> file_endings();

/// The codes of all messages.
[[nodiscard]] std::vector<std::string> message_codes();
/// `a b c` for `words`.
[[nodiscard]] std::string spaced(const std::vector<std::string>& words);
/// `text` in single quotes, which shells do not look into; `quote` stands for a single quote in it.
[[nodiscard]] std::string quoted(std::string_view text, std::string_view quote);

[[nodiscard]] std::string bash_completion(const CommandLine& line);
[[nodiscard]] std::string zsh_completion(const CommandLine& line);
[[nodiscard]] std::string fish_completion(const CommandLine& line);

}  // namespace kb::cli
