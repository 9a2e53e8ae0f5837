#include <fmt/format.h>

#include "tools/kbc/completion.h"

namespace kb::cli {
namespace {

std::string zsh_quoted(std::string_view text) { return quoted(text, "'\\''"); }

/// `text` with a backslash before each character that ends a part of a specification.
std::string zsh_escaped(std::string_view text, std::string_view special) {
  std::string out;
  for (const char c : text) {
    if (c == '\\' || special.find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// What `_arguments` does for a value.
std::string zsh_action(const CLI::Option& option) {
  const Completion completion = completion_of(option);
  switch (completion.kind) {
    case Completion::Kind::kUnknown: break;
    case Completion::Kind::kWords: return "(" + spaced(completion.words) + ")";
    case Completion::Kind::kFolders: return "_files -/";
    case Completion::Kind::kFiles: return "_files";
    case Completion::Kind::kInputs: return "_kbc_inputs";
    case Completion::Kind::kCodes: return "_kbc_codes";
  }
  return " ";
}

std::string zsh_argument(const CLI::Option& option) {
  const char* const how_often = option.get_items_expected_max() > 1 ? "*:" : option.get_required() ? ":" : "::";
  return zsh_quoted(how_often + zsh_escaped(option.get_name(true), ":") + ":" + zsh_action(option));
}

/// A specification for each name of an option; the names exclude each other and themselves, unless the option may be repeated.
std::string zsh_options(const CLI::Option& option) {
  const std::string help = "[" + zsh_escaped(option.get_description(), "[]") + "]";
  if (names_warnings(option)) return zsh_quoted("*-W-" + help + ":WARNING:_kbc_warnings");
  const std::vector<std::string> names = typed_names(option);
  const bool takes_value = option.get_items_expected_max() > 0;
  const std::string what = option_choices(option).empty() ? option_value(option) : names.back().substr(names.back().find_first_not_of('-'));
  const std::string value = takes_value ? ":" + zsh_escaped(what, ":") + ":" + zsh_action(option) : "";
  const std::string how_often = option.get_items_expected_max() > 1 ? "*" : "(" + spaced(names) + ")";
  std::string text;
  for (const std::string& name : names) {
    const char* const value_follows = !takes_value ? "" : name.starts_with("--") ? "=" : "+";
    text += (text.empty() ? "" : " ") + zsh_quoted(how_often + name + value_follows + help + value);
  }
  return text;
}

std::string zsh_branch(const CommandLine::Entry& entry) {
  std::string text = fmt::format("        {})\n          _arguments", entry.app->get_name());
  for (const CLI::Option* option : shown_options(*entry.app)) {
    text += " \\\n            " + (is_positional(*option) ? zsh_argument(*option) : zsh_options(*option));
  }
  return text + " ;;\n";
}

std::string zsh_helpers() {
  std::string out =
      "#compdef kbc\n"
      "# Completion of kbc for zsh; printed by `kbc completion zsh`.\n"
      "_kbc_warnings() { compadd \"$@\" -- error $flags no-${^flags} }\n"
      "_kbc_codes() { compadd \"$@\" -- $codes $flags }\n"
      "_kbc_inputs() {\n"
      "  local ends=kb\n"
      "  case $words[1]:$words[2] in\n";
  for (const FileEndings& one : file_endings()) {
    out += fmt::format("    {}:{}) ends='{}' ;;\n", one.command, one.first.empty() ? "*" : one.first, fmt::join(one.endings, "|"));
  }
  return out + "  esac\n  _files \"$@\" -g \"*.($ends)(-.)\"\n}\n";
}

}  // namespace

std::string zsh_completion(const CommandLine& line) {
  std::string out = zsh_helpers();
  out += fmt::format("_kbc() {{\n  local curcontext=$curcontext state line\n  local -a flags=({})\n  local -a codes=({})\n",
                     fmt::join(diagnostics::flags(), " "), spaced(message_codes()));
  out += "  _arguments -C \\\n";
  for (const CLI::Option* option : shown_options(line.app)) {
    for (const std::string& name : typed_names(*option)) {
      out += "    " + zsh_quoted("(- *)" + name + "[" + zsh_escaped(option->get_description(), "[]") + "]") + " \\\n";
    }
  }
  out += "    '1:command:->command' '*::argument:->argument'\n  case $state in\n    command)\n      local -a commands=(\n";
  for (const CommandLine::Entry& entry : line.entries) {
    out += "        " + zsh_quoted(entry.app->get_name() + ":" + std::string(entry.command->help)) + "\n";
  }
  out += "      )\n      _describe command commands ;;\n    argument)\n      case $words[1] in\n";
  for (const CommandLine::Entry& entry : line.entries) out += zsh_branch(entry);
  out += "      esac ;;\n  esac\n}\n";
  // The file may lie in $fpath, or be sourced.
  return out + "if [[ $funcstack[1] == _kbc ]]; then _kbc \"$@\"; else compdef _kbc kbc; fi\n";
}

}  // namespace kb::cli
