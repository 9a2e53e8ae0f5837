#include "compiler/driver/compile.h"

#include <future>
#include <stdexcept>

#include "compiler/model/standard_names.h"

namespace kb::driver {
namespace {

/// Users' mistakes are reported before this. An unsound program is a bug of the compiler, and nothing may be made from it.
void require_sound(const program::Program& program) {
  const std::vector<std::string> faults = program::verify(program);
  if (!faults.empty()) throw std::logic_error("the program is not sound: " + faults.front());
}

// True if the work ends after the stage `done`.
bool ends(Stage done, const Options& options, const diagnostics::Diagnostics& diagnostics) {
  return diagnostics.broken() || options.until == done;
}

/// All that the analysis reports are warnings.
bool analyses(const Options& options) { return options.analyse && !options.warnings.none; }

struct Made {
  tables::Tables tables;
  std::string image;
};

/// Makes tables and image of a large program while it is analysed; all only read it. Those of a small program are made when asked for.
std::future<Made> begin_tables(const program::Program& program, const Options& options) {
  const bool beside = analyses(options) && options.until >= Stage::kTables && program.rules.size() >= tables::kWorthAThread;
  return std::async(beside ? std::launch::async : std::launch::deferred, [&program, image = options.until == Stage::kImage] {
    Made made{tables::build(program), {}};
    if (image) made.image = tables::write_image(made.tables, program);
    return made;
  });
}

void run(std::string_view path, const source::FileSystem& files, const Options& options, Compilation& to,
         diagnostics::Diagnostics& diagnostics) {
  to.forest = model::load(path, options.library, files, to.sources, diagnostics);
  if (options.until == Stage::kTrees) return;

  model::StandardNames standard(options.library, files);
  to.model = model::resolve(to.forest, diagnostics, &standard, options.first_leg);
  if (!options.keep_model) to.forest = {};
  if (ends(Stage::kModel, options, diagnostics)) return;

  if (!options.keep_model) model::forget_details(to.model);
  to.program = program::lower(to.model, to.sources);
  if (!options.keep_model) model::forget_rules(to.model);
  require_sound(to.program);
  if (ends(Stage::kProgram, options, diagnostics)) return;

  std::future<Made> made = begin_tables(to.program, options);
  if (analyses(options)) analysis::diagnose(to.model, to.program, options.known, diagnostics);
  if (ends(Stage::kAnalysis, options, diagnostics)) return;
  if (!options.keep_model) to.model = {};
  Made forms = made.get();
  to.tables = std::move(forms.tables);
  to.image_bytes = std::move(forms.image);
}

}  // namespace

Compilation::~Compilation() = default;

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
