#include "tools/kbc/recorded_input.h"

#include <CLI/CLI.hpp>

#include "tools/kbc/checks.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/trace/facts_options.h"

namespace kb::cli {

void add_recorded_options(CLI::App& app, RecordedOptions& options) {
  auto* facts = app.add_option("--facts", options.facts,
                               "The facts, CSV: a header of names, a row a tick; - for standard input")
                    ->type_name("FILE");
  auto* readings = app.add_option("--readings", options.readings,
                                  "Readings of the sensors instead, from which facts are perceived; an empty field is "
                                  "nothing new, `-` a sensor that is silent")
                       ->type_name("FILE");
  facts->excludes(readings);
  app.callback([facts, readings] {
    if (facts->empty() && readings->empty()) throw CLI::RequiredError("--facts");
  });
  app.add_option("--dt", options.dt, "How long a tick is if the recording has no column t (100ms)")
      ->type_name("TIME")
      ->check(is_duration());
}

RecordedInput open_recorded(const RecordedOptions& options, const program::Program& program, source::Sources& sources,
                            diagnostics::Diagnostics& diagnostics) {
  using Columns = trace::FactsReader::Columns;
  std::string error;
  RecordedInput input;
  input.bytes = trace::open_stream(options.path(), error, Interrupts::came);
  if (!input.bytes) {
    diagnostics.report(diagnostics::Kind::kCannotRead, {}, {options.path(), error});
    return {};
  }
  input.reader = std::make_unique<trace::FactsReader>(options.path(), *input.bytes, program, sources, diagnostics,
                                                      options.has_readings() ? Columns::kReadings : Columns::kFacts);
  if (!input.reader->open(trace::parse_duration(options.dt))) return {};
  return input;
}

RecordedInput open_recorded(const RecordedOptions& options, const std::string& file, driver::Compilation& loaded,
                            diagnostics::Diagnostics& diagnostics) {
  if (!loaded.image || !options.has_readings()) return open_recorded(options, loaded.program, loaded.sources, diagnostics);
  report_no_sensors(file, diagnostics);
  return {};
}

void report_no_sensors(const std::string& image, diagnostics::Diagnostics& diagnostics) {
  using diagnostics::Kind;
  diagnostics.report(Kind::kImageNotSource, {}, {image}).note(Kind::kImageHasNoSensors, {});
}

std::unique_ptr<trace::Engine> make_engine(trace::EngineKind kind, const driver::Compilation& loaded) {
  return loaded.image ? trace::make_engine(kind, loaded.program, *loaded.image) : trace::make_engine(kind, loaded.program, loaded.tables);
}

}  // namespace kb::cli
