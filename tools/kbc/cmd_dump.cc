// kbc dump: what the compiler holds after each phase.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <string>

#include "compiler/model/known_names.h"
#include "compiler/syntax/syntax.h"
#include "tools/kbc/support.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct DumpOptions {
  std::string form, file;
  bool json = false;
};

// Tokens and tree are those of one file; its imports are not read. Both are printed even if there are errors.
int dump_syntax(const DumpOptions& options, Session& session) {
  if (!session.is_source(options.file)) return kErrors;
  source::Sources sources;
  const auto file = session.open(options.file, sources);
  if (!file) return kErrors;
  auto diagnostics = session.diagnostics(sources);
  if (options.form == "tokens")
    session.print(syntax::print_tokens(sources, syntax::lex(sources, *file, diagnostics)));
  else
    session.print(syntax::print_tree(sources, syntax::parse(sources, *file, diagnostics)));
  return session.exit_code();
}

// One line for each name, in alphabetical order; a group is one line, however many members it has.
std::string print_names(const driver::Compilation& c) {
  const std::vector<model::KnownName> names = model::known_names(c.model);
  std::size_t name = 4, kind = 4;
  for (const model::KnownName& one : names) {
    name = std::max(name, std::min<std::size_t>(one.name.size(), 32));
    kind = std::max(kind, one.kind.size());
  }
  std::string out;
  for (const model::KnownName& one : names) {
    fmt::format_to(std::back_inserter(out), "{:<{}}  {:<{}}  {}{}{}\n", one.name, name, one.kind, kind, c.sources.origin(one.declared), one.more.empty() ? "" : "  ", one.more);
  }
  return out;
}

struct Form {
  std::string_view name;
  driver::Stage stage;
  void (*print)(const driver::Compilation&, const program::Sink&);
};
constexpr std::array kForms = {
    Form{"model", driver::Stage::kModel, [](const driver::Compilation& c, const program::Sink& sink) { sink(model::print(c.model, c.sources)); }},
    Form{"names", driver::Stage::kModel, [](const driver::Compilation& c, const program::Sink& sink) { sink(print_names(c)); }},
    Form{"program", driver::Stage::kProgram, [](const driver::Compilation& c, const program::Sink& sink) { program::print(c.program, sink); }},
    Form{"tables", driver::Stage::kTables,
         [](const driver::Compilation& c, const program::Sink& sink) { sink(tables::print(c.tables, c.program)); }},
};

bool image_has(std::string_view form) { return form == "program" || form == "tables"; }

// Dumps an image, or the image that a knowledge base would become.
int dump_image(const DumpOptions& options, Session& session) {
  const auto loaded = session.load(options.file, driver::Stage::kTables);
  if (!loaded->ok()) return kErrors;
  if (!loaded->image) {
    const std::string image = session.make_image(*loaded);
    if (image.empty()) return kErrors;
    Session::require_sound_image(image);
    loaded->image = std::make_unique<tables::LoadedImage>(image);
  }
  session.print(tables::print_image(*loaded->image));
  return session.exit_code();
}

int dump(const DumpOptions& options, Session& session) {
  if (options.form == "image") return dump_image(options, session);
  for (const Form& form : kForms) {
    if (form.name != options.form) continue;
    const auto compiled = image_has(form.name) ? session.load(options.file, form.stage) : session.compile(options.file, form.stage);
    if (!compiled->ok()) return kErrors;
    const auto sink = [&session](std::string_view piece) { session.print(piece); };
    if (options.json) program::print_json(compiled->program, sink);
    else form.print(*compiled, sink);
    return session.exit_code();
  }
  return dump_syntax(options, session);
}

}  // namespace

Run setup_dump(CLI::App& app) {
  auto options = std::make_shared<DumpOptions>();
  app.add_option("FORM", options->form, "Which form")
      ->required()
      ->check(CLI::IsMember({"tokens", "tree", "names", "model", "program", "tables", "image"}));
  app.add_option("FILE", options->file, "The knowledge base; for program, tables and image also an image of it (.kbt)")->required();
  app.add_flag("--json", options->json, "The program as JSON");
  app.callback([options] {
    if (options->json && options->form != "program")
      throw CLI::ValidationError("--json", "only `program` has a form in JSON");
  });
  return [options](Session& session) { return dump(*options, session); };
}

}  // namespace kb::cli
