// kbc import: fuzzy controllers from other programs.
#include <CLI/CLI.hpp>

#include <memory>
#include <string>

#include "compiler/syntax/syntax.h"
#include "tools/kbc/fll/fll.h"
#include "tools/kbc/fuzzy_support.h"

namespace kb::cli {
namespace {

struct ImportOptions {
  std::string format, file, output;
};

int run_import(const ImportOptions& options, Session& session) {
  source::Sources sources;
  const auto file = session.open(options.file, sources);
  if (!file) return kErrors;
  auto diagnostics = session.diagnostics(sources);
  auto text = fll::import_engine(sources, *file, diagnostics);
  if (!text) return kErrors;
  const source::FileId made = sources.add(options.file + ".kb", std::move(*text));
  return deliver(session, options.output, syntax::format(sources, made));
}

}  // namespace

Run setup_import(CLI::App& app) {
  auto options = std::make_shared<ImportOptions>();
  app.add_option("FORMAT", options->format, "What the file is written in: fll")->required()->check(CLI::IsMember({"fll"}));
  app.add_option("FILE", options->file, "The file; `-` is standard input")->required();
  app.add_option("-o,--output", options->output, "Write to this file")->type_name("FILE");
  return [options](Session& session) { return run_import(*options, session); };
}

}  // namespace kb::cli
