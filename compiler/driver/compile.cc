#include "compiler/driver/compile.h"

#include <stdexcept>

#include "compiler/analysis/analysis.h"

namespace kb::driver {
namespace {

/// What is reported is the user's; a program that is not sound is a mistake of ours, and nothing may be made of it.
void require_sound(const program::Program& program) {
  const std::vector<std::string> faults = program::verify(program);
  if (!faults.empty()) throw std::logic_error("the program is not sound: " + faults.front());
}

// True if there is nothing left to do after `done`.
bool ends(Stage done, const Options& options, const diagnostics::Diagnostics& diagnostics) {
  return diagnostics.broken() || options.until == done;
}

void run(std::string_view path, const source::FileSystem& files, const Options& options, Compilation& to,
         diagnostics::Diagnostics& diagnostics) {
  {
    const model::Forest forest = model::load(path, options.library, files, to.sources, diagnostics);
    if (ends(Stage::kTrees, options, diagnostics)) return;
    to.model = model::resolve(forest, diagnostics);
  }
  if (ends(Stage::kModel, options, diagnostics)) return;

  if (!options.keep_model) model::forget_details(to.model);
  to.program = program::lower(to.model, to.sources, diagnostics);
  if (diagnostics.broken()) return;
  if (!options.keep_model) model::forget_conditions(to.model);
  require_sound(to.program);
  if (ends(Stage::kProgram, options, diagnostics)) return;

  if (options.analyse) analysis::diagnose(to.model, to.program, diagnostics);
  if (ends(Stage::kAnalysis, options, diagnostics)) return;
  if (!options.keep_model) to.model = {};

  to.tables = tables::build(to.program);
}

}  // namespace

std::unique_ptr<Compilation> compile(std::string_view path, const source::FileSystem& files, const Options& options,
                                     MakeConsumer make_consumer, void* context) {
  auto result = std::make_unique<Compilation>();
  const std::unique_ptr<diagnostics::Consumer> consumer = make_consumer(result->sources, context);
  diagnostics::Diagnostics diagnostics(result->sources, *consumer, options.warnings);
  run(path, files, options, *result, diagnostics);
  result->errors = diagnostics.errors();
  result->warnings = diagnostics.warnings();
  return result;
}

}  // namespace kb::driver
