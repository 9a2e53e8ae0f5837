// The compiler as a table of contents: bytes -> trees -> model -> program -> analysis -> tables -> image.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "compiler/analysis/analysis.h"
#include "compiler/diagnostics/diagnostics.h"
#include "compiler/model/model.h"
#include "compiler/program/program.h"
#include "compiler/source/source.h"
#include "compiler/tables/image.h"
#include "compiler/tables/tables.h"

namespace kb::driver {

/// How far to go. Each stage needs those before it; a stage with errors is the last. (A warning that -Werror
/// made an error fails the compilation but does not stop it: the later stages still run.)
enum class Stage : std::uint8_t { kTrees, kModel, kProgram, kAnalysis, kTables, kImage };

struct Options {
  std::string library;                      ///< folder that holds `std/`
  diagnostics::WarningOptions warnings;
  analysis::KnownArguments known = {};      ///< the arguments of controllers that are not the user's own
  Stage until = Stage::kTables;
  bool analyse = true;                      ///< false: skip the warnings that need the whole program
  bool keep_model = true;                   ///< false: forget it when it is not needed any more, which halves the memory
  std::size_t first_leg = 0;                ///< number of each route's first leg: above 0 if its beginning was driven already
};

/// Everything that one run of the compiler made. `ok` if no error was reported up to the stage asked for; the forms
/// after the stage that failed are empty.
struct Compilation {
  source::Sources sources;
  model::Forest forest;                     ///< the model's prototypes refer to it
  model::Model model;
  program::Program program;
  tables::Tables tables;
  std::string image_bytes;                  ///< empty if it would be too large
  std::unique_ptr<tables::LoadedImage> image;   ///< the image that program and tables were recalled from, if any
  std::size_t errors = 0, warnings = 0;

  Compilation() = default;
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;
  ~Compilation();                           ///< out of line: it is long, and every user would compile it again
  [[nodiscard]] bool ok() const { return errors == 0; }
};

/// `make_consumer` is called once with the (still empty) sources, so that consumers can print source lines.
using MakeConsumer = std::unique_ptr<diagnostics::Consumer> (*)(const source::Sources&, void*);

/// Compiles the knowledge base whose main file is `path`. The result is on the heap because trees point into its sources.
/// Throws std::logic_error if a phase breaks an invariant, which is a bug of the compiler.
[[nodiscard]] std::unique_ptr<Compilation> compile(std::string_view path, const source::FileSystem& files,
                                                   const Options& options, MakeConsumer make_consumer, void* context);

}  // namespace kb::driver
