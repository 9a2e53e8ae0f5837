#include "tools/kbc/completion.h"

#include <fmt/format.h>

#include <algorithm>

#include "planners/method.h"

namespace kb::cli {

Completion completion_of(const CLI::Option& option) {
  using Kind = Completion::Kind;
  if (auto choices = option_choices(option); !choices.empty()) return {Kind::kWords, std::move(choices)};
  const std::string word = is_positional(option) ? option.get_name(true) : option.get_type_name();
  if (word == "METHOD") {
    Completion methods{Kind::kWords, {}};
    for (const planners::Method& method : planners::methods()) methods.words.emplace_back(method.name);
    return methods;
  }
  if (word == "CODE") return {Kind::kCodes, {}};
  if (word == "DIR") return {Kind::kFolders, {}};
  if (word == "FILE" && is_positional(option)) return {Kind::kInputs, {}};
  return {word == "OLD" || word == "NEW" || word == "TEXT" || word == "FILE" || word == "FILE=NAME" || word == "PREFIX" ? Kind::kFiles : Kind::kUnknown, {}};
}

std::vector<const CLI::Option*> shown_options(const CLI::App& command) {
  return command.get_options([](const CLI::Option* option) { return !option->get_group().empty(); });
}

// `--coverage{text}` states the value of the option if none is given; that is not typed.
std::vector<std::string> typed_names(const CLI::Option& option) {
  std::vector<std::string> names = CLI::detail::split(option_names(option), ',');
  for (std::string& name : names) name.resize(std::min(name.find('{'), name.size()));
  return names;
}

bool names_warnings(const CLI::Option& option) { return option_names(option) == "-W"; }

std::span<const FileEndings> file_endings() {
  static const std::vector<FileEndings> kEndings{
      {"budget", "", {"kb", "kbt"}},  {"diff", "", {"kb", "kbt"}},       {"dump", "", {"kb", "kbt"}},
      {"expand", "", {"kb", "kbt"}},  {"run", "", {"kb", "kbt"}},        {"why", "", {"kb", "kbt"}},
      {"plan", "", {"map", "yaml", "yml"}}, {"import", "fll", {"fll"}},  {"import", "lif", {"json"}},
      {"import", "nav2", {"geojson", "json"}}, {"import", "opentcs", {"xml"}},
  };
  return kEndings;
}

std::vector<std::string> message_codes() {
  std::vector<std::string> codes;
  for (std::size_t i = 0; i < static_cast<std::size_t>(diagnostics::Kind::kCount_); ++i) {
    const auto kind = static_cast<diagnostics::Kind>(i);
    if (diagnostics::info(kind).code != 0) codes.push_back(diagnostics::code_text(kind));
  }
  return codes;
}

std::string spaced(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, " ")); }

std::string quoted(std::string_view text, std::string_view quote) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'') out += quote;
    else out += c;
  }
  return out + "'";
}

}  // namespace kb::cli
