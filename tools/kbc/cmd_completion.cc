// kbc completion: made from the table of commands and what CLI11 knows of their options, so that it cannot drift.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <string>

#include "planners/method.h"
#include "tools/kbc/command_line.h"

namespace kb::cli {
namespace {

// `--coverage{text}` says what the option means by itself; that is not written.
std::vector<std::string> names(const CLI::Option& option) {
  std::vector<std::string> names = CLI::detail::split(option_names(option), ',');
  for (std::string& name : names) name.resize(std::min(name.find('{'), name.size()));
  return names;
}

// What files a command reads, if they are no knowledge bases; `first`: its first argument, if it goes by that.
struct Reads {
  std::string_view command, first, ends;
};
constexpr Reads kReads[] = {
    {"budget", "*", "kb|kbt"},   {"diff", "*", "kb|kbt"},       {"dump", "*", "kb|kbt"},          {"expand", "*", "kb|kbt"},
    {"run", "*", "kb|kbt"},      {"why", "*", "kb|kbt"},        {"plan", "*", "map|yaml|yml"},    {"import", "fll", "fll"},
    {"import", "lif", "json"},   {"import", "nav2", "geojson|json"}, {"import", "opentcs", "xml"},
};

std::string all_methods() {
  std::vector<std::string_view> names;
  for (const planners::Method& method : planners::methods()) names.push_back(method.name);
  return fmt::format("{}", fmt::join(names, " "));
}

/// What completes an argument: a bash command that prints the candidates.
std::string candidates(const CLI::Option& option) {
  const auto choices = option_choices(option);
  if (!choices.empty()) return fmt::format("compgen -W '{}'", fmt::join(choices, " "));
  const std::string word = is_positional(option) ? option.get_name(true) : option.get_type_name();
  if (word == "DIR") return "compgen -d";
  if (word == "FILE" && is_positional(option)) return "_kbc_files";
  if (word == "METHOD") return "compgen -W '" + all_methods() + "'";
  if (word == "CODE") return "compgen -W \"$codes $flags\"";
  return word == "TEXT" || word == "FILE" || word == "PREFIX" ? "compgen -f" : "";
}

// `case` branches for the values of options, and one for the rest of the command.
std::string branches(const CommandLine::Entry& entry) {
  std::string values, options, arguments;
  for (const CLI::Option* option : entry.app->get_options()) {
    if (is_positional(*option)) {
      const std::string how = candidates(*option);
      if (!how.empty()) arguments += fmt::format("{} -- \"$cur\"; ", how);
      continue;
    }
    if (option_names(*option) == "-W") continue;
    for (const std::string& name : names(*option)) options += (options.empty() ? "" : " ") + name;
    if (option->get_items_expected_max() == 0) continue;
    std::vector<std::string> patterns;
    for (const std::string& name : names(*option)) patterns.push_back(entry.app->get_name() + ":" + name);
    const std::string how = candidates(*option);
    values += fmt::format("    {}) _kbc_reply < <({}); return ;;\n", fmt::join(patterns, "|"),
                          how.empty() ? ":" : how + " -- \"$cur\"");
  }
  const bool warnings = entry.command->shared == Shared::kCompiles;
  values += fmt::format("    {}:*)\n      if [[ $cur == -* ]]; then _kbc_reply < <(compgen -W \"{}{}\" -- \"$cur\")\n",
                        entry.app->get_name(), options, warnings ? " -Werror $warnings" : "");
  return values + fmt::format("      else _kbc_reply < <({}:); fi ;;\n", arguments);
}

std::string all_codes() {
  std::string text;
  for (std::size_t i = 0; i < static_cast<std::size_t>(diagnostics::Kind::kCount_); ++i) {
    const auto kind = static_cast<diagnostics::Kind>(i);
    if (diagnostics::info(kind).code != 0) text += (text.empty() ? "" : " ") + diagnostics::code_text(kind);
  }
  return text;
}

constexpr std::string_view kHead = R"(# Completion of kbc for bash; printed by `kbc completion bash`.
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

std::string print_bash() {
  const CommandLine line;
  std::string out(kHead);
  std::string names;
  for (const CommandLine::Entry& entry : line.entries) names += entry.app->get_name() + " ";
  out += fmt::format("  local flags='{}'\n  local codes='{}'\n", fmt::join(diagnostics::flags(), " "), all_codes());
  out += "  local warnings=\"-W${flags// / -W} -Wno-${flags// / -Wno-}\"\n";
  out += fmt::format(
      "  if [[ $COMP_CWORD -eq 1 ]]; then _kbc_reply < <(compgen -W '{}--help --version' -- \"$cur\"); return; fi\n",
      names);
  out += "  local ends=kb\n  case ${COMP_WORDS[1]}:${COMP_WORDS[2]} in\n";
  for (const Reads& one : kReads) out += fmt::format("    {}:{}) ends='{}' ;;\n", one.command, one.first, one.ends);
  out += "  esac\n  compopt -o filenames 2>/dev/null\n  case ${COMP_WORDS[1]}:$prev in\n";
  for (const CommandLine::Entry& entry : line.entries) out += branches(entry);
  return out + "  esac\n}\ncomplete -F _kbc kbc\n";
}

}  // namespace

Run setup_completion(CLI::App& app) {
  auto shell = std::make_shared<std::string>();
  app.add_option("SHELL", *shell, "Which shell")->required()->check(CLI::IsMember({"bash"}));
  return [shell](Session& session) {
    session.print(print_bash());
    return session.exit_code();
  };
}

}  // namespace kb::cli
