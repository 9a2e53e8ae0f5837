// Shared by the commands that play a recording (`run`, `why`, `diff`): the options that name it, opening it, and the engine that runs on it.
#pragma once

#include <memory>
#include <string>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/driver/compile.h"
#include "compiler/program/program.h"
#include "compiler/source/source.h"
#include "tools/kbc/commands.h"
#include "tools/kbc/trace/engine.h"
#include "tools/kbc/trace/facts_csv.h"
#include "tools/kbc/trace/stream.h"

namespace kb::cli {

/// As given on the command line; exactly one of `facts` and `readings` is not empty.
struct RecordedOptions {
  std::string facts, readings, dt;
  [[nodiscard]] bool has_readings() const { return !readings.empty(); }
  [[nodiscard]] const std::string& path() const { return has_readings() ? readings : facts; }
};

/// Declares --facts, --readings and --dt; `options` must outlive the app.
void add_recorded_options(CLI::App& app, RecordedOptions& options);

/// An open recording: the reader stands before the first row.
struct RecordedInput {
  std::unique_ptr<trace::ByteStream> bytes;
  std::unique_ptr<trace::FactsReader> reader;
};

/// Null members if it cannot be read, or its header is wrong (reported). `program`, `sources` and `diagnostics` must outlive
/// what comes back.
[[nodiscard]] RecordedInput open_recorded(const RecordedOptions& options, const program::Program& program,
                                          source::Sources& sources, diagnostics::Diagnostics& diagnostics);
/// The same for what was loaded from `file`; an image takes no readings (reported).
[[nodiscard]] RecordedInput open_recorded(const RecordedOptions& options, const std::string& file, driver::Compilation& loaded,
                                          diagnostics::Diagnostics& diagnostics);
/// Reports that an image takes no readings.
void report_no_sensors(const std::string& image, diagnostics::Diagnostics& diagnostics);

/// An engine; on the image in place, if one was loaded. `loaded` must outlive the engine.
[[nodiscard]] std::unique_ptr<trace::Engine> make_engine(trace::EngineKind kind, const driver::Compilation& loaded);

}  // namespace kb::cli
