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

  /// Declares all commands with all options. Nothing is parsed yet.
  CommandLine();
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;

  CLI::App app;
  SharedOptions shared;
  std::vector<Entry> entries;   ///< in the order of the table
};

/// What is said of kbc as a whole; for `--help` and the man page.
inline constexpr std::string_view kAbout = "The compiler of Waymark, a rule language: the mind of a mobile robot";

/// An argument: told by its place, not by a name.
[[nodiscard]] inline bool is_positional(const CLI::Option& option) { return option.get_positional() && !option.nonpositional(); }
/// How an option is written: `-o, --output FILE`, `FILE...`; its choices, if it has a few: `{text,json,sarif}`.
[[nodiscard]] std::string option_names(const CLI::Option& option);
[[nodiscard]] std::string option_value(const CLI::Option& option);
/// The words between which an option chooses; empty if any word will do.
[[nodiscard]] std::vector<std::string> option_choices(const CLI::Option& option);
/// `kbc check [OPTIONS] FILE...`
[[nodiscard]] std::string usage_line(const CLI::App& command);

}  // namespace kb::cli
