// kbc man: the man pages in roff, made from the table of commands and what CLI11 knows of their options.
#include <fmt/format.h>

#include <memory>
#include <string>

#include "tools/kbc/command_line.h"
#include "tools/kbc/trace/output_file.h"

namespace kb::cli {
namespace {

using Out = std::back_insert_iterator<std::string>;

/// Escapes a text so that roff prints it as it is: no dash becomes a hyphen, and no line is taken for a command.
std::string roff(std::string_view text) {
  std::string out;
  bool first = true;
  for (const char c : text) {
    if (first && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    first = c == '\n';
  }
  return out;
}

std::string upper(std::string text) {
  for (char& c : text) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

std::string head(const std::string& name) {
  return fmt::format(".TH {} 1 \"\" \"Waymark {}\" \"Waymark\"\n.nh\n.ad l\n", roff(upper(name)), KB_VERSION);
}

std::string section(std::string_view title) { return fmt::format(".SH {}\n", title); }

std::string option_entry(const CLI::Option& option) {
  std::string names = option_names(option);
  std::string text;
  for (const char c : names) text += c == ',' ? ", " : std::string(1, c);
  const std::string value = option_value(option);
  std::string entry = ".TP\n\\fB" + roff(text) + "\\fR" + (value.empty() ? "" : " \\fI" + roff(value) + "\\fR") + "\n";
  entry += roff(option.get_description());
  if (!option.get_default_str().empty()) entry += roff(" [" + option.get_default_str() + "]");
  return entry + "\n";
}

std::string options_of(const CLI::App& app) {
  std::string arguments, options;
  for (const CLI::Option* option : app.get_options()) {
    (is_positional(*option) ? arguments : options) += option_entry(*option);
  }
  return (arguments.empty() ? "" : section("ARGUMENTS") + arguments) + section("OPTIONS") + options;
}

std::string examples(std::string_view lines) { return section("EXAMPLES") + ".nf\n" + roff(lines) + ".fi\n"; }

constexpr std::string_view kEnd =
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBWAYMARK_LIBRARY\\fR\nThe folder that holds the standard library \\fBstd\\fR, unless "
    "\\fB\\-\\-library\\fR names one.\n"
    ".TP\n\\fBNO_COLOR\\fR\nIf set and not empty, messages have no colours.\n"
    ".SH EXIT STATUS\n"
    ".TP\n\\fB0\\fR\nClean.\n.TP\n\\fB1\\fR\nErrors were reported.\n"
    ".TP\n\\fB2\\fR\nThe command line cannot be understood.\n.TP\n\\fB70\\fR\nA bug of kbc.\n.TP\n\\fB71\\fR\nOut of memory.\n.TP\n\\fB130\\fR\nInterrupted.\n";

std::string page(const CommandLine::Entry& entry) {
  const std::string name = "kbc-" + entry.app->get_name();
  std::string out = head(name) + section("NAME") + roff(name) + " \\- " + roff(entry.command->help) + "\n";
  out += section("SYNOPSIS") + ".B " + roff(usage_line(*entry.app)) + "\n";
  out +=
      section("DESCRIPTION") + roff(entry.command->about.empty() ? entry.command->help : entry.command->about) + "\n";
  out += options_of(*entry.app) + examples(entry.command->examples) + std::string(kEnd);
  return out + section("SEE ALSO") + ".BR kbc (1)\n";
}

std::string main_page(const CommandLine& line) {
  std::string out = head("kbc") + section("NAME") + "kbc \\- " + roff(kAbout) + "\n";
  out += section("SYNOPSIS") + ".B kbc\n.I COMMAND\n.RI [ OPTIONS \"] ...\"\n";
  out += section("DESCRIPTION") +
         "A knowledge base (\\fI.kb\\fR) says what a robot knows about its world, what it is after, and which of its "
         "abilities "
         "runs when. kbc checks it, runs it on recorded facts, explains what it does, and compiles it to C++ tables "
         "for the "
         "robot.\n";
  out += section("COMMANDS");
  for (const CommandLine::Entry& entry : line.entries) {
    const std::string name = roff(entry.app->get_name());
    fmt::format_to(Out(out), ".TP\n\\fB{}\\fR\n{}; see \\fBkbc\\-{}\\fR(1).\n", name, roff(entry.command->help), name);
  }
  return out + std::string(kEnd);
}

int print_pages(const std::string& folder, Session& session) {
  const CommandLine line;
  if (folder.empty()) {
    session.print(main_page(line));
    return session.exit_code();
  }
  if (const auto refused = trace::make_folders(folder)) {
    session.report(diagnostics::Kind::kCannotMakeFolder, {folder, *refused});
    return kErrors;
  }
  std::vector<Session::OutputFile> pages{{folder + "/kbc.1", main_page(line)}};
  for (const CommandLine::Entry& entry : line.entries) {
    pages.push_back({folder + "/kbc-" + entry.app->get_name() + ".1", page(entry)});
  }
  return session.write_files(pages) ? session.exit_code() : kErrors;
}

}  // namespace

Run setup_man(CLI::App& app) {
  auto folder = std::make_shared<std::string>();
  app.add_option("--out", *folder, "Write all pages to this folder, which is made if need be")->type_name("DIR");
  return [folder](Session& session) { return print_pages(*folder, session); };
}

}  // namespace kb::cli
