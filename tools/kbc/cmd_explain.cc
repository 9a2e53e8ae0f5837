// kbc explain: a message at length.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "compiler/diagnostics/consumers.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct ExplainOptions {
  std::vector<std::string> codes, warnings;
  bool list = false;
  bool markdown = false;
};

// Finds a message by its code, or by the name of its warning, perhaps with the `-W` that stands before it and with `no-` or `error=`.
std::optional<Kind> find_message(std::string_view word) {
  if (const auto kind = diagnostics::find_code(word)) return kind;
  for (const std::string_view prefix : {"-", "W", "error=", "no-"}) {
    if (word.starts_with(prefix)) word.remove_prefix(prefix.size());
  }
  return diagnostics::find_flag(word);
}

std::string describe(Kind kind) {
  const auto& about = diagnostics::info(kind);
  const bool warning = about.severity == diagnostics::Severity::kWarning;
  std::string text =
      diagnostics::code_text(kind) + (warning ? " (warning -W" + std::string(about.flag) + "): " : " (error): ");
  text += diagnostics::general_text(kind) + "\n\n";
  return text + std::string(diagnostics::explanation(kind)) + "\n";
}

int explain(const ExplainOptions& options, Session& session) {
  if (options.list) session.print(diagnostics::print_list());
  if (options.markdown) session.print(diagnostics::print_markdown());
  bool first = true;
  std::vector<std::string> words = options.codes;
  words.insert(words.end(), options.warnings.begin(), options.warnings.end());
  for (const std::string& code : words) {
    const auto kind = find_message(code);
    if (!kind) {
      const source::Sources none;
      session.diagnostics(none).report(Kind::kUnknownCode, {}, {code}).suggest(diagnostics::closest(code, diagnostics::flags()));
      continue;
    }
    session.print((first ? "" : "\n") + describe(*kind));
    first = false;
  }
  return session.exit_code();
}

}  // namespace

Run setup_explain(CLI::App& app) {
  auto options = std::make_shared<ExplainOptions>();
  auto* code = app.add_option("CODE", options->codes, "Codes such as KB0101, or names of warnings");
  auto* warning = app.add_option("-W", options->warnings, "The name of a warning, as messages have it")->type_name("NAME");
  auto* list = app.add_flag("--list", options->list, "All messages, a line each")->excludes(code)->excludes(warning);
  auto* page = app.add_flag("--markdown", options->markdown, "All messages as a page in Markdown")
                   ->excludes(code)
                   ->excludes(warning)
                   ->excludes(list);
  app.callback([code, warning, list, page] {
    if (code->count() + warning->count() + list->count() + page->count() == 0) throw CLI::RequiredError("CODE, --list or --markdown");
  });
  return [options](Session& session) { return explain(*options, session); };
}

}  // namespace kb::cli
