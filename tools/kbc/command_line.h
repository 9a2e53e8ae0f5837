// The command line as CLI11 knows it, made from the table of commands. Included by .cc files of this folder only.
#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "tools/kbc/commands.h"
#include "tools/kbc/support.h"

namespace kb::cli {

struct CommandLine {
  struct Entry {
    const Command* command;
    CLI::App* app;
    Run run;
  };

  /// Declares all commands with all options, or, if `only` names a command, with its options only: all of them take a millisecond.
  /// Nothing is parsed yet.
  explicit CommandLine(std::string_view only = {});
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  CLI::App app;
  SharedOptions shared;
  std::vector<Entry> entries;   ///< in the order of the table; without options `app` is bare, and `run` empty
};

/// The description of kbc as a whole, for `--help` and the man page.
inline constexpr std::string_view kAbout = "The compiler of Waymark, a rule language: the mind of a mobile robot";

/// Whether it is an argument, known by its position instead of a name.
[[nodiscard]] inline bool is_positional(const CLI::Option& option) { return option.get_positional() && !option.nonpositional(); }
/// How an option is written: `-o, --output FILE`, `FILE...`; its choices, if they are few: `{text,json,sarif}`.
[[nodiscard]] std::string option_names(const CLI::Option& option);
[[nodiscard]] std::string option_value(const CLI::Option& option);
/// The words that an option accepts; empty if it accepts any.
[[nodiscard]] std::vector<std::string> option_choices(const CLI::Option& option);
/// `kbc check [OPTIONS] FILE...`
[[nodiscard]] std::string usage_line(const CLI::App& command);

}  // namespace kb::cli
