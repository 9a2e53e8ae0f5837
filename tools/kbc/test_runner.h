// Cases of `kbc test` on several threads. What is said of them comes in their order and is the same whatever the threads do.
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
  /// Gets each case that has been run, in order, on any thread but one at a time; messages about it have been passed on before.
  using Tell = std::function<void(const trace::TestCase&, trace::CaseResult&)>;

  /// `cases`, ordered by knowledge base, and `session` must outlive it.
  TestRunner(const How& how, const std::vector<trace::TestCase>& cases, Session& session);

  /// Runs all cases. False if it was interrupted: then some were not told of, and what those would have written is not written.
  [[nodiscard]] bool run(const Tell& tell);
  /// After `run`: one for each case that was told of.
  [[nodiscard]] std::vector<trace::CaseResult>& results() { return results_; }
  /// After `run`: one for each knowledge base that compiles, if coverage was asked for.
  [[nodiscard]] const std::vector<trace::CoverageReport>& coverage() const { return coverage_; }

 private:
  /// A knowledge base: compiled by the first thread that needs it, let go when the last of its cases has been told of.
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

  How how_;
  const std::vector<trace::TestCase>& cases_;
  Session& session_;
  std::deque<Knowledge> knowledge_;
  std::vector<std::unique_ptr<Running>> running_;   // by case; null when it has been told of
  std::vector<trace::CaseResult> results_;
  std::vector<trace::CoverageReport> coverage_;
};

}  // namespace kb::cli
