#include "tools/kbc/expected_ending.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/display.h"
#include "sim/drive/judge.h"
#include "tools/kbc/drive_verdict.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

constexpr std::string_view kEndingForms =
    "a drive ends as `arrived`, `arrived at LANDMARK`, `stopped: REPORT`, `gave up on the way to LANDMARK`, `believes to be at LANDMARK, and is not`, `aborted`, "
    "`stands without saying why`, `still driving when the time was up` or `never started`";
constexpr std::string_view kWithReports[] = {"stopped: ", "still driving when the time was up: "};
constexpr std::string_view kWithLandmark[] = {"arrived at ", "gave up on the way to ", "believes to be at "};

std::vector<std::string> reports_of(const sim::Knowledge& knowledge) {
  std::vector<std::string> reports{"Help.power"};   // of the host, see Drive::reports
  for (const program::CellId report : knowledge.reports) reports.emplace_back(knowledge.program->cells[program::index(report)].name);
  return reports;
}

/// All that sim::describe may say, each report alone; the short ones first, since of several equally near names the first is suggested.
std::vector<std::string> endings(const sim::Labyrinth& labyrinth, const sim::Knowledge& knowledge) {
  using Outcome = sim::Summary::Outcome;
  std::vector<std::string> all{"arrived"};   // wherever
  const auto add = [&all](Outcome outcome, const std::string& landmark = {}, const std::vector<std::string>& reports = {}, const std::string& running = {}) {
    sim::Summary summary;
    summary.outcome = outcome;
    summary.landmark = landmark;
    summary.reports = reports;
    summary.running = running;
    all.push_back(sim::describe(summary));
  };
  for (const Outcome outcome : {Outcome::kAborted, Outcome::kStuck, Outcome::kTimeUp, Outcome::kNeverStarted}) add(outcome);
  for (const auto& crossing : labyrinth.crossings) {
    for (const Outcome outcome : {Outcome::kArrived, Outcome::kGivenUp, Outcome::kAstray}) add(outcome, crossing.name);
  }
  for (const std::string& report : reports_of(knowledge)) {
    for (const Outcome outcome : {Outcome::kStopped, Outcome::kTimeUp}) add(outcome, {}, {report});
  }
  for (const auto& strategy : knowledge.strategies) add(Outcome::kStuck, {}, {}, strategy.name);
  return all;
}

/// The first of several reports that is not known; empty if all are.
std::string unknown_report(std::string_view reports, const std::vector<std::string>& known) {
  while (true) {
    const std::size_t end = std::min(reports.find(", "), reports.size());
    const std::string_view one = reports.substr(0, end);
    if (std::find(known.begin(), known.end(), one) == known.end()) return std::string(one);
    if (end == reports.size()) return {};
    reports.remove_prefix(end + 2);
  }
}

}  // namespace

bool can_be_expected(const std::string& expected, const sim::Labyrinth& labyrinth, const sim::Knowledge& knowledge, bool any_report,
                     diagnostics::Diagnostics& messages) {
  const auto refuse = [&](const std::string& why, const std::string& word, const std::vector<std::string>& known) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    messages.report(Kind::kFleetExpect, {}, {expected, why}).suggest(diagnostics::closest(word, names));
    return false;
  };
  for (const std::string_view words : kWithReports) {
    if (!expected.starts_with(words)) continue;
    const std::vector<std::string> known = reports_of(knowledge);
    const std::string unknown = unknown_report(std::string_view(expected).substr(words.size()), known);
    return any_report || unknown.empty() || refuse(fmt::format("nothing reports {}", diagnostics::quoted_code(unknown)), unknown, known);
  }
  const std::vector<std::string> all = endings(labyrinth, knowledge);
  if (std::any_of(all.begin(), all.end(), [&](const std::string& one) { return ends_as(one, expected); })) return true;
  std::string why(kEndingForms);
  for (const std::string_view words : kWithLandmark) {
    if (!expected.starts_with(words)) continue;
    const std::string landmark = expected.substr(words.size(), expected.find(',') - words.size());
    if (!labyrinth.by_name.contains(landmark)) why = fmt::format("there is no landmark {}", diagnostics::quoted_code(landmark));
  }
  return refuse(why, expected, all);
}

}  // namespace kb::cli
