// kbc import: fuzzy controllers from other programs.
#include <CLI/CLI.hpp>

#include <memory>
#include <string>

#include "tools/kbc/fll/fll.h"
#include "tools/kbc/fuzzy_support.h"

namespace kb::cli {
namespace {

struct Options {
  std::string format, file, output;
};

int run_import(const Options& options, Session& session) {
  source::Sources sources;
  const auto file = session.open(options.file, sources);
  if (!file) return kErrors;
  auto diagnostics = session.diagnostics(sources);
  auto text = fll::import_engine(sources, *file, diagnostics);
  return text ? deliver(session, options.output, std::move(*text)) : kErrors;
}

}  // namespace

Run setup_import(CLI::App& app) {
  auto options = std::make_shared<Options>();
  app.add_option("FORMAT", options->format, "What the file is written in: fll")->required()->check(CLI::IsMember({"fll"}));
  app.add_option("FILE", options->file, "The file; `-` is standard input")->required();
  app.add_option("-o,--output", options->output, "Write to this file")->type_name("FILE");
  return [options](Session& session) { return run_import(*options, session); };
}

}  // namespace kb::cli
