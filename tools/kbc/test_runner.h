// Runs cases of `kbc test` on several threads. Results are reported in the order of cases and do not depend on the threads.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "tools/kbc/support.h"
#include "tools/kbc/trace/coverage.h"
#include "tools/kbc/trace/test_cases.h"

namespace kb::cli {

class TestRunner {
 public:
  struct How {
    trace::EngineKind engine = trace::EngineKind::kTables;
    bool update = false;
    bool coverage = false;
    unsigned jobs = 1;
  };
  /// Called with each finished case, in order, on any thread, one at a time; messages about the case have been passed on by then.
  using Tell = std::function<void(const trace::TestCase&, trace::CaseResult&)>;

  /// `cases`, ordered by knowledge base, and `session` must outlive it.
  TestRunner(const How& how, const std::vector<trace::TestCase>& cases, Session& session);

  /// Runs all cases. False if it was interrupted: then some cases were not reported, and their files are not written.
  [[nodiscard]] bool run(const Tell& tell);
  /// After `run`: one for each case reported.
  [[nodiscard]] std::vector<trace::CaseResult>& results() { return results_; }
  /// After `run`: one for each knowledge base that compiles, if coverage was asked for.
  [[nodiscard]] const std::vector<trace::CoverageReport>& coverage() const { return coverage_; }

 private:
  /// A knowledge base: compiled by the first thread that needs it, freed when the last of its cases has been reported.
  struct Knowledge {
    std::size_t end = 0;   // after its last case
    std::once_flag once;
    std::unique_ptr<driver::Compilation> compiled;
    std::vector<diagnostics::Diagnostic> messages;
    std::optional<trace::Coverage> coverage;
  };
  struct Running {
    Knowledge* knowledge = nullptr;
    source::Sources sources;
    std::vector<diagnostics::Diagnostic> messages;
    std::optional<trace::Coverage> coverage;
    trace::CaseResult result;
    bool compiled = false, ended = false;
  };

  void run_case(std::size_t number);
  void tell_of(std::size_t number, const Tell& tell);
  void summarise(const std::string& path, const Knowledge& knowledge);

  How how_;
  const std::vector<trace::TestCase>& cases_;
  Session& session_;
  std::deque<Knowledge> knowledge_;
  std::vector<std::unique_ptr<Running>> running_;   // by case; null once reported
  std::vector<trace::CaseResult> results_;
  std::vector<trace::CoverageReport> coverage_;
};

}  // namespace kb::cli
