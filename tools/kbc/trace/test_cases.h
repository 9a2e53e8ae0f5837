// Users' golden traces: `NAME.facts.csv` or `NAME.readings.csv` beside a `.kb` file, and the expected result,
// `NAME.trace.jsonl`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/program/program.h"
#include "compiler/source/source.h"
#include "compiler/tables/tables.h"
#include "tools/kbc/trace/coverage.h"
#include "tools/kbc/trace/engine.h"

namespace kb::trace {

struct TestCase {
  std::string name;   ///< the path without `.facts.csv` or `.readings.csv`
  std::string facts;  ///< paths as they are opened and printed
  std::string trace;
  std::string program;  ///< the `.kb` file
  bool readings = false;  ///< the columns are sensors
};

/// All cases at and below `roots` (folders, or single cases by their name or their file of facts or readings), ordered by program, then
/// by name. Reported as improper: a folder without cases, a trace without facts, two recordings of one name, a case whose `.kb` file
/// cannot be determined. Hidden folders are skipped. If there are `filters` (see matches_glob), only cases are taken of which one filter
/// matches the name, or the rest of the name after some `/`; nothing is reported about the others. A filter that matches no case is
/// reported.
[[nodiscard]] std::vector<TestCase> find_cases(const std::vector<std::string>& roots, const std::vector<std::string>& filters,
                                               diagnostics::Diagnostics& diagnostics);

/// False (reported, at the place where the facts name it) if the knowledge base of a case cannot be read.
[[nodiscard]] bool program_is_there(const TestCase& test, source::Sources& sources, diagnostics::Diagnostics& diagnostics);

struct CaseResult {
  enum class Outcome : std::uint8_t {
    kPassed,
    kFailed,   ///< the trace differs: `report` says how
    kUpdated,  ///< it differed or was missing, and has been written
    kBroken,   ///< the case could not be run: reported as diagnostics
    kStopped,  ///< stopped on request (CaseOptions::stop): there is no result, and no file is changed
  };
  Outcome outcome = Outcome::kBroken;
  std::uint64_t ticks = 0;
  std::string report;
};

/// How cases are run.
struct CaseOptions {
  EngineKind engine = EngineKind::kTables;
  bool update = false;           ///< write the actual trace if it differs from the expected one
  Coverage* coverage = nullptr;  ///< if not null, counts (the interpreter then runs as well)
  bool (*stop)() = nullptr;      ///< asked before each tick
};

/// Runs one case. Memory does not depend on the number of ticks.
[[nodiscard]] CaseResult run_case(const TestCase& test, const program::Program& program, const tables::Tables& tables,
                                  const CaseOptions& options, source::Sources& sources,
                                  diagnostics::Diagnostics& diagnostics);

/// The results in the form that build servers read (JUnit XML), without times, so that the same run gives the same bytes.
[[nodiscard]] std::string print_junit(const std::vector<TestCase>& cases, const std::vector<CaseResult>& results);

}  // namespace kb::trace
