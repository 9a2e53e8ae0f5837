#include <fmt/format.h>

#include "tools/kbc/completion.h"

namespace kb::cli {
namespace {

std::string fish_quoted(std::string_view text) {
  std::string doubled;
  for (const char c : text) doubled += c == '\\' ? "\\\\" : std::string(1, c);
  return quoted(doubled, "\\'");
}

/// The options of `complete` that say what a value or an argument may be.
std::string fish_candidates(const CLI::Option& option) {
  const Completion completion = completion_of(option);
  switch (completion.kind) {
    case Completion::Kind::kUnknown: break;
    case Completion::Kind::kWords: return " -a " + fish_quoted(spaced(completion.words));
    case Completion::Kind::kFolders: return " -a '(__fish_complete_directories)'";
    case Completion::Kind::kFiles: return " -F";
    case Completion::Kind::kInputs: return " -a '(__kbc_inputs)'";
    case Completion::Kind::kCodes: return " -a '(__kbc_codes; __kbc_flags)'";
  }
  return {};
}

std::string fish_line(std::string_view condition, const CLI::Option& option) {
  std::string line = "complete -c kbc -n " + fish_quoted(condition);
  if (is_positional(option)) {
    const std::string what = fish_candidates(option);
    return what.empty() ? "" : line + what + "\n";
  }
  for (const std::string& name : typed_names(option)) {
    line += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  }
  const bool file = completion_of(option).kind == Completion::Kind::kFiles;   // else no files are offered
  if (option.get_items_expected_max() > 0) line += (file ? " -r" : " -x") + fish_candidates(option);
  return line + " -d " + fish_quoted(option.get_description()) + "\n";
}

std::string fish_helpers() {
  std::string out =
      "# Completion of kbc for fish; printed by `kbc completion fish`.\n"
      "function __kbc_command\n"
      "    set -l words (commandline -opc)\n"
      "    contains -- \"$words[2]\" $argv\n"
      "end\n"
      "function __kbc_no_command\n"
      "    test (count (commandline -opc)) -eq 1\n"
      "end\n"
      "function __kbc_inputs\n"
      "    set -l words (commandline -opc)\n"
      "    set -l ends kb\n"
      "    switch \"$words[2]:$words[3]\"\n";
  for (const FileEndings& one : file_endings()) {
    out += fmt::format("        case '{}:{}'\n            set ends {}\n", one.command, one.first.empty() ? "*" : one.first, fmt::join(one.endings, " "));
  }
  out +=
      "    end\n"
      "    complete -C \"'' \"(commandline -ct) | string match -r '^[^\\t]*(?:/|\\.(?:'(string join '|' $ends)'))(?:\\t.*)?$'\n"
      "end\n";
  out += fmt::format("function __kbc_flags\n    string split ' ' '{}'\nend\n", fmt::join(diagnostics::flags(), " "));
  out += fmt::format("function __kbc_codes\n    string split ' ' '{}'\nend\n", spaced(message_codes()));
  return out + "function __kbc_warnings\n    printf '%s\\n' -Werror -W(__kbc_flags) -Wno-(__kbc_flags)\nend\n";
}

}  // namespace

std::string fish_completion(const CommandLine& line) {
  std::string out = fish_helpers() + "complete -c kbc -f\n", compile;
  for (const CLI::Option* option : shown_options(line.app)) out += fish_line("__kbc_no_command", *option);
  for (const CommandLine::Entry& entry : line.entries) {
    const std::string& name = entry.app->get_name();
    if (takes_warnings(entry.command->shared)) compile += " " + name;
    out += fmt::format("complete -c kbc -n __kbc_no_command -a {} -d {}\n", name, fish_quoted(entry.command->help));
    for (const CLI::Option* option : shown_options(*entry.app)) {
      if (!names_warnings(*option)) out += fish_line("__kbc_command " + name, *option);
    }
  }
  return out + "complete -c kbc -n '__kbc_command" + compile + "; and string match -q -- \"-W*\" (commandline -ct)' -a '(__kbc_warnings)'\n";
}

}  // namespace kb::cli
