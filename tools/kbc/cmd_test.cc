// kbc test: golden traces.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tools/kbc/support.h"
#include "tools/kbc/trace/coverage.h"
#include "tools/kbc/trace/engine.h"
#include "tools/kbc/trace/test_cases.h"

namespace kb::cli {
namespace {

using trace::CaseResult;
using trace::TestCase;

struct TestOptions {
  std::vector<std::string> roots;
  bool update = false;
  std::string junit;
  std::string coverage;  // text, json, html; empty: none
  std::string coverage_out;
  std::string engine = "tables";

  /// Coverage takes standard output for itself; the results then go to standard error.
  [[nodiscard]] bool coverage_alone() const { return !coverage.empty() && coverage != "text" && coverage_out.empty(); }
};

constexpr std::array<std::string_view, 4> kOutcomes{"passed", "FAILED", "updated", "BROKEN"};

std::string counted(const std::vector<CaseResult>& results) {
  std::array<std::size_t, kOutcomes.size()> counts{};
  for (const CaseResult& result : results) ++counts[static_cast<std::size_t>(result.outcome)];
  constexpr std::array<std::string_view, kOutcomes.size()> words{"passed", "failed", "updated", "could not be run"};
  std::string out = diagnostics::counted(results.size(), "case");
  for (std::size_t i = 0; i < words.size(); ++i)
    if (counts[i] > 0) out += fmt::format(", {} {}", counts[i], words[i]);
  return out;
}

std::string print_coverage(const TestOptions& options, const std::vector<trace::CoverageReport>& reports) {
  if (options.coverage == "json") return trace::print_json(reports);
  if (options.coverage == "html") return trace::print_html(reports);
  std::string out;
  for (const trace::CoverageReport& report : reports) out += "\n" + trace::print_text(report);
  return out;
}

/// Runs the cases of one knowledge base after another; cases come ordered by it.
class Runner {
 public:
  Runner(const TestOptions& options, Session& session) : options_(options), session_(session), messages_(session.diagnostics(sources_)) {}

  CaseResult run(const TestCase& test) {
    if (!program_is_there(test, sources_, messages_))
      return {.outcome = CaseResult::Outcome::kBroken, .report = test.program + " cannot be read"};
    if (test.program != program_) {
      finish_program();
      program_ = test.program;
      compiled_ = session_.compile(program_, driver::Stage::kTables);
      if (!options_.coverage.empty() && compiled_->ok()) coverage_.emplace(compiled_->program);
    }
    if (!compiled_->ok()) return {.outcome = CaseResult::Outcome::kBroken, .report = program_ + " does not compile"};
    auto diagnostics = session_.diagnostics(compiled_->sources);
    return run_case(test, compiled_->program, compiled_->tables,
                    {.engine = *trace::find_engine(options_.engine),
                     .update = options_.update,
                     .coverage = coverage_ ? &*coverage_ : nullptr},
                    compiled_->sources, diagnostics);
  }
  std::vector<trace::CoverageReport> finish() {
    finish_program();
    return std::move(reports_);
  }

 private:
  void finish_program() {
    if (coverage_) reports_.push_back(trace::summarise(program_, compiled_->model, compiled_->program, *coverage_));
    coverage_.reset();
  }
  const TestOptions& options_;
  Session& session_;
  source::Sources sources_;   // what is said before there is a compilation
  diagnostics::Diagnostics messages_;
  std::string program_;
  std::unique_ptr<driver::Compilation> compiled_;
  std::optional<trace::Coverage> coverage_;
  std::vector<trace::CoverageReport> reports_;
};

int test(const TestOptions& options, Session& session) {
  const source::Sources none;
  auto diagnostics = session.diagnostics(none);
  const std::vector<TestCase> cases = trace::find_cases(options.roots, diagnostics);
  const auto tell = [&](const std::string& line) {
    options.coverage_alone() ? session.remark(line) : session.print(line + "\n");
  };

  for (const TestCase& one : cases) {
    session.note_input(one.facts);
    session.note_input(one.trace);
  }

  Runner runner(options, session);
  std::vector<CaseResult> results;
  bool all_well = !diagnostics.failed();
  for (const TestCase& one : cases) {
    const CaseResult& result = results.emplace_back(runner.run(one));
    const bool ran = result.outcome != CaseResult::Outcome::kBroken;
    tell(fmt::format("{:<7} {}{}", kOutcomes[static_cast<std::size_t>(result.outcome)], one.name,
                     ran ? fmt::format(" ({})", diagnostics::counted(result.ticks, "tick")) : ""));
    if (!result.report.empty()) tell(result.report.substr(0, result.report.find_last_not_of('\n') + 1));
    all_well =
        all_well && (result.outcome == CaseResult::Outcome::kPassed || result.outcome == CaseResult::Outcome::kUpdated);
  }
  if (!cases.empty()) tell(counted(results));

  std::vector<Session::OutputFile> files;
  if (!options.junit.empty()) files.push_back({options.junit, trace::print_junit(cases, results)});
  const auto reports = runner.finish();
  if (!options.coverage.empty()) {
    std::string coverage = print_coverage(options, reports);
    if (options.coverage_out.empty()) {
      session.print(coverage);
    } else {
      files.push_back({options.coverage_out, std::move(coverage)});
    }
  }
  if (!files.empty() && !session.write_files(files)) return kErrors;
  return all_well ? session.exit_code() : kErrors;
}

}  // namespace

Run setup_test(CLI::App& app) {
  auto options = std::make_shared<TestOptions>();
  app.add_option("DIR", options->roots, "Folders of cases, or single NAME.facts.csv and NAME.readings.csv files")->required();
  app.add_flag("--update", options->update, "Write what happens as what is expected, where they differ");
  app.add_option("--junit", options->junit, "Write the results for a build server, JUnit XML")->type_name("FILE");
  auto* coverage =
      app.add_flag("--coverage{text}", options->coverage, "What the cases exercise of the rules: text, json or html")
          ->check(CLI::IsMember({"text", "json", "html"}));
  app.add_option("--coverage-out", options->coverage_out, "Write the coverage to this file")->type_name("FILE")->needs(coverage);
  app.add_option("--engine", options->engine, "What decides: tables (as on the robot), interpreter, or both, compared")
      ->check(CLI::IsMember({"tables", "interpreter", "both"}))
      ->capture_default_str();
  return [options](Session& session) { return test(*options, session); };
}

}  // namespace kb::cli
