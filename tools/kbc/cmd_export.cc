// kbc export: fuzzy controllers for other programs.
#include <CLI/CLI.hpp>

#include <memory>
#include <string>

#include "tools/kbc/fll/fll.h"
#include "tools/kbc/fuzzy_support.h"

namespace kb::cli {
namespace {

struct ExportOptions {
  std::string format, file, controller, output;
};

int run_export(const ExportOptions& options, Session& session) {
  const auto compiled = session.compile(options.file, driver::Stage::kProgram);
  if (!compiled->ok()) return kErrors;
  auto diagnostics = session.diagnostics(compiled->sources);
  const fuzzy::Controller* controller = find_fuzzy(compiled->program.fuzzy, options.file, options.controller, diagnostics);
  if (controller == nullptr) return kErrors;
  auto text = fll::export_engine(*controller, diagnostics);
  return text ? session.deliver(options.output, std::move(*text)) : kErrors;
}

}  // namespace

Run setup_export(CLI::App& app) {
  auto options = std::make_shared<ExportOptions>();
  app.add_option("FORMAT", options->format, "What to write: fll")->required()->check(CLI::IsMember({"fll"}));
  app.add_option("FILE", options->file, "The knowledge base")->required();
  app.add_option("CONTROLLER", options->controller, "Which fuzzy controller; needed if there are several");
  app.add_option("-o,--output", options->output, "Write to this file")->type_name("FILE");
  return [options](Session& session) { return run_export(*options, session); };
}

}  // namespace kb::cli
