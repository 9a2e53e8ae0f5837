#include <fmt/format.h>

#include "tools/kbc/completion.h"

namespace kb::cli {
namespace {

/// A bash command that prints the candidates; empty if there are none.
std::string bash_generator(const CLI::Option& option) {
  const Completion completion = completion_of(option);
  switch (completion.kind) {
    case Completion::Kind::kUnknown: break;
    case Completion::Kind::kWords: return "compgen -W '" + spaced(completion.words) + "'";
    case Completion::Kind::kFolders: return "compgen -d";
    case Completion::Kind::kFiles: return "compgen -f";
    case Completion::Kind::kInputs: return "_kbc_files";
    case Completion::Kind::kCodes: return "compgen -W \"$codes $flags\"";
  }
  return {};
}

/// The `case` branches for the values of a command's options, and one for its options and arguments.
std::string bash_branches(const CommandLine::Entry& entry) {
  std::string values, options, arguments;
  for (const CLI::Option* option : shown_options(*entry.app)) {
    const std::string how = bash_generator(*option);
    if (is_positional(*option)) {
      if (!how.empty()) arguments += fmt::format("{} -- \"$cur\"; ", how);
      continue;
    }
    if (names_warnings(*option)) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : typed_names(*option)) {
      options += (options.empty() ? "" : " ") + name;
      patterns.push_back(entry.app->get_name() + ":" + name);
    }
    if (option->get_items_expected_max() == 0) continue;
    values += fmt::format("    {}) _kbc_reply < <({}); return ;;\n", fmt::join(patterns, "|"), how.empty() ? ":" : how + " -- \"$cur\"");
  }
  const bool warnings = takes_warnings(entry.command->shared);
  values += fmt::format("    {}:*)\n      if [[ $cur == -* ]]; then _kbc_reply < <(compgen -W \"{}{}\" -- \"$cur\")\n",
                        entry.app->get_name(), options, warnings ? " -Werror $warnings" : "");
  return values + fmt::format("      else _kbc_reply < <({}:); fi ;;\n", arguments);
}

constexpr std::string_view kBashHead = R"(# Completion of kbc for bash; printed by `kbc completion bash`.
_kbc_reply() { mapfile -t COMPREPLY; }
_kbc_files() { compgen -f -X '!*.@('$ends')' "$@"; compgen -d "$@"; }
_kbc() {
  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]} extglob
  if [[ $cur == = ]]; then cur=; elif [[ $prev == = ]]; then prev=${COMP_WORDS[COMP_CWORD-2]}; fi
  extglob=$(shopt -p extglob)
  shopt -s extglob
  _kbc_candidates
  $extglob
}
_kbc_candidates() {
)";

}  // namespace

std::string bash_completion(const CommandLine& line) {
  std::string out(kBashHead), names;
  for (const CommandLine::Entry& entry : line.entries) names += entry.app->get_name() + " ";
  out += fmt::format("  local flags='{}'\n  local codes='{}'\n", fmt::join(diagnostics::flags(), " "), spaced(message_codes()));
  out += "  local warnings=\"-W${flags// / -W} -Wno-${flags// / -Wno-}\"\n";
  out += fmt::format(
      "  if [[ $COMP_CWORD -eq 1 ]]; then _kbc_reply < <(compgen -W '{}--help --version' -- \"$cur\"); return; fi\n",
      names);
  out += "  local ends=kb\n  case ${COMP_WORDS[1]}:${COMP_WORDS[2]} in\n";
  for (const FileEndings& one : file_endings()) {
    out += fmt::format("    {}:{}) ends='{}' ;;\n", one.command, one.first.empty() ? "*" : one.first, fmt::join(one.endings, "|"));
  }
  out += "  esac\n  compopt -o filenames 2>/dev/null\n  case ${COMP_WORDS[1]}:$prev in\n";
  for (const CommandLine::Entry& entry : line.entries) out += bash_branches(entry);
  return out + "  esac\n}\ncomplete -F _kbc kbc\n";
}

}  // namespace kb::cli
