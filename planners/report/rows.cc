#include "planners/report/rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <ctime>
#include <iterator>
#include <limits>
#include <optional>

#include "planners/crew.h"

namespace kb::planners {
namespace {

// The processor time of this thread: other work on the machine does not count.
double thread_seconds() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Answer answer_row(const Method& method, const Grid& grid, const Scenario& row, RunOptions run) {
  Problem problem;
  problem.grid = &grid;
  problem.start = grid.centre(row.start);
  problem.goal = grid.centre(row.goal);
  const double begin = thread_seconds();
  Result result = plan(method, problem, run);
  Answer answer;
  answer.seconds = thread_seconds() - begin;
  answer.outcome = result.outcome;
  answer.fault = result.fault;
  answer.trap = result.trap.kind;
  answer.length_cells = result.length_m / grid.cell_m();
  answer.statistics = std::move(result.statistics);
  return answer;
}

// The length as a multiple of the optimum; nothing if the row has 0 for an optimum that is not known.
std::optional<double> ratio_of(const Scenario& row, const Answer& answer) {
  if (row.optimum > 0.0) return answer.length_cells / row.optimum;
  return row.start == row.goal ? std::optional(1.0) : std::nullopt;
}

std::string number(double value, int digits) { return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, digits); }

}  // namespace

std::vector<Answer> answer_rows(const Method& method, const Grid& grid, const std::vector<Scenario>& rows,
                                const RunOptions& run, unsigned threads,
                                const std::function<void(std::size_t done)>& progress) {
  std::vector<Answer> answers(rows.size());
  std::atomic<std::size_t> next = 0, done = 0;
  std::atomic<bool> stop = false;
  on_threads(threads, stop, [&](unsigned thread) {
    for (std::size_t i = next++; i < rows.size() && !stop; i = next++) {
      RunOptions own = run;
      own.seed = run.seed + i;
      own.progress = {};
      answers[i] = answer_row(method, grid, rows[i], own);
      ++done;
      if (thread == 0 && progress) progress(done);
    }
  });
  return answers;
}

double percentile(std::vector<double> values, double percent) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double rank = std::ceil(percent / 100.0 * static_cast<double>(values.size()));
  return values[static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(values.size()))) - 1];
}

std::vector<double> ratios(const std::vector<Scenario>& rows, const std::vector<Answer>& answers) {
  std::vector<double> out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto ratio = ratio_of(rows[i], answers[i]);
    if (ratio && answers[i].outcome == Outcome::kReached) out.push_back(*ratio);
  }
  return out;
}

std::string print_csv(const Method& method, const Grid& grid, const std::vector<Scenario>& rows,
                      const std::vector<Answer>& answers) {
  std::string out = "line,method,start_x,start_y,goal_x,goal_y,outcome,trap,length,optimum,ratio,steps,cells,limit\n";
  const auto down = [&](Cell cell) { return grid.height() - 1 - cell.y; };   // rows count from the top, as in the scenario file
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Scenario& row = rows[i];
    const Answer& answer = answers[i];
    const bool there = answer.outcome == Outcome::kReached;
    const auto ratio = ratio_of(row, answer);
    fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{:.8f},{},{},{},{}\n", row.line, method.name,
                   row.start.x, down(row.start), row.goal.x, down(row.goal), name(answer.outcome), name(answer.trap),
                   there ? fmt::format("{:.8f}", answer.length_cells) : "", row.optimum,
                   there && ratio ? fmt::format("{:.9f}", *ratio) : "", answer.statistics.steps,
                   answer.statistics.cells, answer.outcome == Outcome::kLimit ? name(answer.statistics.stop) : "");
  }
  return out;
}

std::string print_path(const Method& method, const Result& result, const Grid& grid, bool in_cells) {
  std::string out = "method,outcome,point,x,y,t\n";
  for (std::size_t i = 0; i < result.path.size(); ++i) {
    const Point place = place_in_file(result.path[i], grid, in_cells);
    fmt::format_to(std::back_inserter(out), "{},{},{},{:.6f},{:.6f},{}\n", method.name, name(result.outcome), i, place.x + 0.0, place.y + 0.0,
                   i < result.times_s.size() ? fmt::format("{:.6f}", result.times_s[i]) : "");
  }
  return out;
}

Summary summarise(const Method& method, const std::vector<Scenario>& rows, const std::vector<Answer>& answers) {
  Summary summary;
  summary.method = method.name;
  summary.knowledge = method.knowledge;
  summary.rows = rows.size();
  std::vector<double> times;
  for (const Answer& answer : answers) {
    switch (answer.outcome) {
      case Outcome::kReached: ++summary.reached; break;
      case Outcome::kTrapped: ++summary.trapped; break;
      case Outcome::kUnreachable: ++summary.unreachable; break;
      case Outcome::kLimit: ++summary.limit; break;
      default: ++summary.other;
    }
    times.push_back(1e6 * answer.seconds);
  }
  const std::vector<double> all = ratios(rows, answers);
  double sum = 0.0;
  for (const double ratio : all) sum += ratio;
  summary.mean_ratio = all.empty() ? std::numeric_limits<double>::quiet_NaN() : sum / static_cast<double>(all.size());
  summary.median_ratio = percentile(all, 50);
  summary.p95_ratio = percentile(all, 95);
  summary.worst_ratio = percentile(all, 100);
  summary.median_us = percentile(times, 50);
  return summary;
}

std::string print_table(const std::vector<Summary>& summaries, bool times) {
  std::string out = fmt::format("{:<22}{:>6}{:>9}{:>9}{:>9}{:>7}{:>7}{:>9}{:>9}{:>9}{:>9}{}\n", "method", "rows", "reached",
                                "trapped", "no way", "limit", "other", "mean", "median", "p95", "worst",
                                times ? fmt::format("{:>12}", "median us") : "");
  for (const Knowledge knowledge : {Knowledge::kFullMap, Knowledge::kLocalRange, Knowledge::kContact}) {
    bool begun = false;
    for (const Summary& s : summaries) {
      if (s.knowledge != knowledge) continue;
      if (!std::exchange(begun, true)) out += fmt::format("-- knows: {}\n", name(knowledge));
      out += fmt::format("{:<22}{:>6}{:>9}{:>9}{:>9}{:>7}{:>7}{:>9}{:>9}{:>9}{:>9}{}\n", s.method, s.rows, s.reached,
                         s.trapped, s.unreachable, s.limit, s.other, number(s.mean_ratio, 4), number(s.median_ratio, 4),
                         number(s.p95_ratio, 4), number(s.worst_ratio, 3),
                         times ? fmt::format("{:>12.1f}", s.median_us) : "");
    }
  }
  return out;
}

}  // namespace kb::planners
