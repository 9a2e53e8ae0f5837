// kbc test: golden traces.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "planners/crew.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/interrupts.h"
#include "tools/kbc/support.h"
#include "tools/kbc/test_runner.h"
#include "tools/kbc/trace/coverage.h"
#include "tools/kbc/trace/engine.h"
#include "tools/kbc/trace/test_cases.h"

namespace kb::cli {
namespace {

using trace::CaseResult;
using trace::TestCase;

struct TestOptions {
  std::vector<std::string> roots, filters;
  bool update = false;
  unsigned jobs = 0;
  std::string junit;
  std::string coverage;  // text, json, html; empty: none
  bool coverage_library = false;
  std::string coverage_out;
  std::string engine = "tables";

  [[nodiscard]] bool prints_coverage() const { return !coverage.empty() && (coverage_out.empty() || coverage_out == "-"); }
  /// Whether a report has standard output for itself; then the results go to standard error.
  [[nodiscard]] bool report_alone() const { return junit == "-" || coverage_out == "-" || (prints_coverage() && coverage != "text"); }
};

constexpr std::array<const char*, 3> kReportForms{"text", "json", "html"};   // of coverage
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

std::string print_coverage(const TestOptions& options, std::vector<trace::CoverageReport> reports) {
  if (options.coverage == "json") return trace::print_json(reports);
  if (!options.coverage_library)
    for (trace::CoverageReport& report : reports) report = trace::without_library(std::move(report));
  if (options.coverage == "html") return trace::print_html(reports);
  std::string out;
  for (const trace::CoverageReport& report : reports) out += "\n" + trace::print_text(report);
  return out;
}

bool is_well(const CaseResult& result) { return result.outcome == CaseResult::Outcome::kPassed || result.outcome == CaseResult::Outcome::kUpdated; }

/// The report on a case, without the last line break.
std::string told(const TestCase& test, const CaseResult& result) {
  const bool ran = result.outcome != CaseResult::Outcome::kBroken;
  const std::string line = fmt::format("{:<7} {}{}", kOutcomes[static_cast<std::size_t>(result.outcome)], test.name,
                                       ran ? fmt::format(" ({})", diagnostics::counted(result.ticks, "tick")) : "");
  return result.report.empty() ? line : line + "\n" + result.report.substr(0, result.report.find_last_not_of('\n') + 1);
}

/// Writes the reports: JUnit to its file, the coverage to its file or else to standard output. False (reported) if a file cannot be written.
/// If no case could be run (reported), an older coverage file is kept.
bool write_reports(const TestOptions& options, const std::vector<TestCase>& cases, const std::vector<CaseResult>& results,
                   const std::vector<trace::CoverageReport>& coverage, Session& session) {
  std::vector<Session::OutputFile> files;
  if (!options.junit.empty()) files.push_back({options.junit, trace::print_junit(cases, results)});
  const bool ran = std::any_of(coverage.begin(), coverage.end(), [](const trace::CoverageReport& report) { return report.runs > 0; });
  if (options.coverage_out.empty() && !options.coverage.empty()) session.print(print_coverage(options, coverage));
  if (!options.coverage_out.empty() && ran) files.push_back({options.coverage_out, print_coverage(options, coverage)});
  return files.empty() || session.write_files(files);
}

int test(const TestOptions& options, Session& session) {
  const source::Sources none;
  std::vector<diagnostics::Diagnostic> not_found;
  diagnostics::Keeping keeping(not_found);
  diagnostics::Diagnostics diagnostics(none, keeping, session.warnings());
  std::vector<TestCase> cases = trace::find_cases(options.roots, options.filters, diagnostics);
  session.pass_on(none, not_found);
  for (const TestCase& one : cases) {
    session.note_input(one.facts);
    session.note_input(one.trace);
  }

  std::optional<Interrupts> interrupts;
  if (options.update) interrupts.emplace();   // so that an interrupt leaves no half of a trace behind
  const auto tell = [&](const std::string& line) {
    options.report_alone() ? session.remark(line) : session.print(line + "\n");
  };
  TestRunner runner({.engine = *trace::find_engine(options.engine),
                     .update = options.update,
                     .coverage = !options.coverage.empty(),
                     .jobs = options.jobs != 0 ? options.jobs : planners::cores()},
                    cases, session);
  const bool whole = runner.run([&](const TestCase& one, CaseResult& result) {
    tell(told(one, result));
    if (result.outcome == CaseResult::Outcome::kBroken && result.report.empty()) result.report = session.last_error();   // for JUnit
  });
  if (!whole) return kInterrupted;
  std::vector<CaseResult>& results = runner.results();
  if (!cases.empty()) tell(counted(results));
  for (const diagnostics::Diagnostic& message : not_found) {   // also in JUnit, which would otherwise show success
    if (message.severity != diagnostics::Severity::kError) continue;
    cases.emplace_back().name = "finding the cases";
    results.push_back({.outcome = CaseResult::Outcome::kBroken, .report = message.message});
  }
  if (!write_reports(options, cases, results, runner.coverage(), session)) return kErrors;
  return std::all_of(results.begin(), results.end(), is_well) ? session.exit_code() : static_cast<int>(kErrors);
}

}  // namespace

Run setup_test(CLI::App& app) {
  auto options = std::make_shared<TestOptions>();
  app.add_option("DIR", options->roots, "Folders of cases, or single cases: NAME, NAME.facts.csv or NAME.readings.csv")->required();
  app.add_option("--filter", options->filters, "Only cases whose name, or its part after some /, matches this, such as 'detour*'; may be given often: one has to match")
      ->allow_extra_args(false)
      ->type_name("GLOB");
  app.add_option("--jobs", options->jobs, "How many cases at once (all cores); the output does not depend on it")->transform(is_count(1, 1024));
  app.add_flag("--update", options->update, "Write the actual trace as the expected one if they differ");
  app.add_option("--junit", options->junit, "Write the results for a build server to this file, JUnit XML; - for standard output")->type_name("FILE");
  auto* coverage =
      app.add_flag("--coverage{text}", options->coverage, "What the cases exercise of your rules, as text; --coverage=json and --coverage=html in other forms")
          ->check(CLI::IsMember(std::vector<std::string>(kReportForms.begin(), kReportForms.end())));
  app.add_flag("--coverage-library", options->coverage_library, "List what the cases exercise of the standard library as well; JSON always has it")->needs(coverage);
  app.add_option("--coverage-out", options->coverage_out, "Write the coverage to this file")->type_name("FILE")->needs(coverage);
  add_engine_option(app, options->engine);
  app.parse_complete_callback([options] {
    const auto is_form = [](const std::string& root) { return std::find(kReportForms.begin(), kReportForms.end(), root) != kReportForms.end(); };
    const auto form = std::find_if(options->roots.begin(), options->roots.end(), is_form);
    if (!options->coverage.empty() && form != options->roots.end())
      throw CLI::ValidationError("`" + *form + "` may be meant as the form of the coverage, `--coverage=" + *form + "`, or as a folder, `./" + *form + "`");
    if (options->junit == "-" && options->prints_coverage()) throw CLI::ValidationError("standard output can take one of --junit and --coverage; name a file for the other");
  });
  return [options](Session& session) { return test(*options, session); };
}

}  // namespace kb::cli
