#include "tools/kbc/command_line.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <span>

#include "compiler/diagnostics/display.h"
#include "compiler/source/reason.h"
#include "tools/kbc/named_files.h"
#include "tools/kbc/run_kbc.h"
#include "tools/kbc/usage_words.h"

namespace kb::cli {
namespace {

constexpr std::size_t kNameColumns = 34, kHelpColumns = 66;

/// Replaces blanks by line breaks so that no line is wider than `columns`; a longer word has a line of its own.
std::string wrap(std::string_view text, std::size_t columns) {
  std::string out;
  std::size_t used = 0;
  for (const std::string& word : CLI::detail::split(std::string(text), ' ')) {
    const bool fits = used == 0 || used + 1 + word.size() <= columns;
    if (used > 0) out += fits ? ' ' : '\n';
    used = fits ? used + (used > 0 ? 1 : 0) + word.size() : word.size();
    out += word;
  }
  return out;
}

/// Lays out `--help` in the same way for all commands: usage, arguments, options, description, examples.
class Formatter final : public CLI::Formatter {
 public:
  Formatter() {
    column_width(kNameColumns);
    label("Positionals", "Arguments");
  }
  std::string make_usage(const CLI::App* app, std::string) const override {
    const bool whole = app->get_parent() == nullptr;
    return "\nUsage: " + (whole ? std::string("kbc COMMAND [OPTIONS] ...") : usage_line(*app)) + "\n";
  }
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string text = option_value(*option);
    if (!text.empty()) text = " " + text;
    if (!option->get_default_str().empty()) text += " [" + option->get_default_str() + "]";
    return text;
  }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrap(option->get_description(), kHelpColumns);
  }
  // One blank line between paragraphs, not two.
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    std::string text = CLI::Formatter::make_help(app, std::move(name), mode);
    for (auto at = text.find("\n\n\n"); at != std::string::npos; at = text.find("\n\n\n")) text.erase(at, 1);
    return text;
  }
  std::string make_option_name(const CLI::Option* option, bool positional) const override {
    std::string name = positional ? option->get_name(true) : option->get_name(false, true);
    const auto value = name.find('{');   // `--coverage{text}`: the value of a flag, which may be given with `=`
    if (value == std::string::npos) return name;
    const auto choices = option_choices(*option);
    return fmt::format("{}[={}]", name.substr(0, value), choices.empty() ? "VALUE" : fmt::format("{}", fmt::join(choices, "|")));
  }
};

std::string footer(const Command& command) {
  std::string text;
  if (!command.about.empty()) text += wrap(command.about, kNameColumns + kHelpColumns) + "\n\n";
  text += "Examples:\n";
  std::string_view rest = command.examples;
  while (!rest.empty()) {
    const auto end = rest.find('\n');
    text += "  " + std::string(rest.substr(0, end)) + "\n";
    rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  }
  return text;
}

constexpr std::string_view kFooter =
    "`kbc COMMAND --help` describes a command, with examples. `kbc explain CODE` describes a message.\n\n"
    "Examples:\n"
    "  kbc new robot                                   # a project that builds\n"
    "  kbc check robot/robot.kb                        # is it sound?\n"
    "  kbc run robot.kb --facts drive.csv --table      # what would it decide?\n"
    "  kbc why robot.kb --facts drive.csv --tick 14    # and why?\n"
    "  kbc compile robot.kb --out generated            # as C++ for the robot\n\n"
    "Exit codes: 0 clean, 1 errors reported, 2 the command line cannot be understood, 70 a bug of kbc, 71 out of memory, 130 interrupted.\n";

/// `command`: the command that was typed; null if there is none.
int usage_error(const std::string& message, const CommandLine::Entry* command) {
  std::string text = "kbc: error: " + diagnostics::visible(message) + "\n";   // it may quote the command line
  text += command == nullptr ? "Try `kbc --help`.\n" : "Try `kbc " + command->app->get_name() + " --help`.\n";
  std::fputs(text.c_str(), stderr);
  return kUsage;
}

// The command of this name; null if there is none.
const CommandLine::Entry* find(const CommandLine& line, std::string_view name) {
  const auto found = std::find_if(line.entries.begin(), line.entries.end(), [&](const CommandLine::Entry& entry) { return entry.command->name == name; });
  return found == line.entries.end() ? nullptr : &*found;
}

// Flushes what CLI11 has printed, and tells the user if it could not be written.
int printed(int code) {
  std::cout.flush();
  if ((std::fflush(stdout) == 0 && std::cout) || errno == EPIPE) return code;
  std::fprintf(stderr, "kbc: error: cannot write `standard output`: %s\n", source::reason(errno).c_str());
  return kErrors;
}

int unknown_command(std::string_view word) {
  std::vector<std::string_view> names;
  for (const Command& command : commands()) names.push_back(command.name);
  std::string message = "there is no command " + diagnostics::quoted_code(word);
  if (const auto better = diagnostics::closest(word, names)) message += "; did you mean `" + *better + "`?";
  return usage_error(message, nullptr);
}

std::string unknown_option(const CLI::App& command, std::string_view name) {
  std::string message = "there is no option " + diagnostics::quoted_code(name);
  std::vector<std::string> options;
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& known : option->get_lnames()) options.push_back("--" + known);
  }
  if (name.starts_with("error") || name.starts_with("-error")) options.emplace_back("-Werror");   // what is left of `-werror`
  if (const auto better = diagnostics::closest(name, std::vector<std::string_view>(options.begin(), options.end()))) message += "; did you mean `" + *better + "`?";
  return message;
}

/// What to say of the words that there is no place for: something of the first. Behind `--` nothing is an option.
std::string unexpected(const CLI::App& command, const std::vector<std::string>& words) {
  const auto first = std::find_if(words.begin(), words.end(), [](const std::string& word) { return word != "--"; });
  if (first == words.end()) return "`--` is one argument too many";
  for (const std::string_view dash : {"\u2013", "\u2014"}) {   // a text editor makes one dash of two
    if (first->starts_with(dash)) return fmt::format("{} begins with a long dash; write `--{}`", diagnostics::quoted_code(*first), first->substr(dash.size()));
  }
  if (first->ends_with(".toml") && command.get_option_no_throw("--scenario") != nullptr) {
    return fmt::format("a scenario stands behind `--scenario`: `--scenario {}`", *first);
  }
  if (first == words.begin() && first->starts_with('-')) return unknown_option(command, first->substr(0, first->find('=')));
  return diagnostics::quoted_code(*first) + " is one argument too many";
}

// `kbc help` and `kbc help COMMAND`, as users of git may write it.
int help(const CommandLine& line, int argc, char** argv) {
  if (argc < 3 || argv[2][0] == '-') {
    std::fputs(line.app.help().c_str(), stdout);
    return printed(kClean);
  }
  const CommandLine::Entry* entry = find(line, argv[2]);
  if (entry == nullptr) return unknown_command(argv[2]);
  std::fputs(entry->app->help().c_str(), stdout);
  return printed(kClean);
}

/// If a standard stream is closed, the next file that is opened would take its place, and output would end up in that file. So a closed stream
/// is replaced by one that can neither be read nor written.
void hold_standard_streams() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) < 0) static_cast<void>(::open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

}  // namespace

CommandLine::CommandLine(std::string_view only) : app(std::string(kAbout), "kbc") {
  app.formatter(std::make_shared<Formatter>());
  app.set_version_flag("--version", "kbc " KB_VERSION, "Print the version and exit");
  app.set_help_flag("-h,--help", "Print this help and exit");
  app.require_subcommand(0, 1);
  app.footer(std::string(kFooter));
  const bool all = std::ranges::find(commands(), only, &Command::name) == commands().end();
  for (const Command& command : commands()) {
    CLI::App* sub = app.add_subcommand(std::string(command.name), std::string(command.help))->group("Commands");
    entries.push_back({&command, sub, {}});
    if (!all && command.name != only) continue;
    sub->footer(footer(command));
    entries.back().run = command.setup(*sub);
    add_shared_options(*sub, shared, command.shared);
  }
}

std::string option_names(const CLI::Option& option) {
  return is_positional(option) ? option.get_name(true) : option.get_name(false, true);
}

std::vector<std::string> option_choices(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const auto begin = type.find('{'), end = type.find('}');
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos) return choices;
  for (const std::string& word : CLI::detail::split(type.substr(begin + 1, end - begin - 1), ',')) choices.push_back(word);
  return choices;
}

std::string option_value(const CLI::Option& option) {
  const bool positional = is_positional(option);
  const bool many = option.get_items_expected_max() > 1;
  if (option.get_items_expected_max() == 0) return "";
  const auto choices = option_choices(option);
  std::string text;
  if (!choices.empty()) {
    for (const std::string& choice : choices) text += (text.empty() ? "{" : "|") + choice;
    text += "}";
  } else if (!positional) {
    text = option.get_type_name();
    if (const auto colon = text.find(':'); colon != std::string::npos) text.resize(colon);
  }
  if (many && positional) text += text.empty() ? "..." : " ...";
  return text;
}

std::string usage_line(const CLI::App& command) {
  std::string text = "kbc " + command.get_name() + " [OPTIONS]";
  for (const CLI::Option* option : command.get_options()) {
    if (!option->get_positional()) continue;
    const bool many = option->get_items_expected_max() > 1;
    const std::string name = option->get_name(true) + (many ? "..." : "");
    text += option->get_required() ? " " + name : " [" + name + "]";
  }
  return text;
}

int run_kbc(int argc, char** argv, Ranks* ranks) {
  CommandLine line(argc >= 2 ? argv[1] : "");
  if (argc >= 2 && std::string_view(argv[1]) == "help") return help(line, argc, argv);
  const CommandLine::Entry* const begun = argc >= 2 ? find(line, argv[1]) : nullptr;
  const std::span<char* const> words(argv, static_cast<std::size_t>(argc));
  if (argc >= 2 && begun == nullptr && argv[1][0] != '-') return unknown_command(argv[1]);
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    return usage_error(unexpected(begun == nullptr ? line.app : *begun->app, line.app.remaining(true)), begun);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return printed(line.app.exit(error));   // --help, --version
    const std::string empty = begun == nullptr ? "" : left_empty(*begun->app, words);   // being empty is why it is no duration, no number, ...
    return usage_error(empty.empty() ? usage_words(error) : empty, begun);
  }
  for (CommandLine::Entry& entry : line.entries) {
    if (!entry.app->parsed()) continue;
    if (const std::string empty = left_empty(*entry.app, words); !empty.empty()) return usage_error(empty, &entry);
    if (const std::string twice = named_twice(*entry.app); !twice.empty()) return usage_error(twice, &entry);
    Session session(line.shared, {argv, ranks});
    if (!session.take_warning_options()) return session.finish(kUsage);
    return session.finish(entry.run(session));
  }
  std::fputs(line.app.help().c_str(), stdout);
  return printed(kUsage);   // a script whose command has got lost must not go on
}

int run_kbc_guarded(int argc, char** argv, Ranks* ranks) {
  hold_standard_streams();
  std::signal(SIGXFSZ, SIG_IGN);   // a file beyond the limit of the user is an output that cannot be written
  std::signal(SIGCHLD, SIG_DFL);   // where it was ignored, nobody would learn how a driver ended
  return guarded([&] { return run_kbc(argc, argv, ranks); });
}

int guarded(const std::function<int()>& run) {
  try {
    return run();
  } catch (const std::bad_alloc&) {
    std::fputs("kbc: error: out of memory\n", stderr);
    return kOutOfMemory;
  } catch (const std::exception& bug) {
    std::fprintf(stderr,
                 "kbc: a bug of kbc " KB_VERSION ": %s\n"
                 "This is no mistake of yours. Please report it, with the command line and the files that it names.\n",
                 bug.what());
  }
  return kBug;
}

}  // namespace kb::cli
