// Answers many questions at once, and sums up the answers in figures and tables.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planners/maps/maps.h"
#include "planners/method.h"

namespace kb::planners {

/// The answer to one row of a scenario file.
struct Answer {
  Outcome outcome = Outcome::kInvalid;
  Fault fault = Fault::kNone;
  Trap::Kind trap = Trap::Kind::kNone;
  double length_cells = 0.0;
  double seconds = 0.0;          ///< on this machine; everything else is the same on every machine
  Statistics statistics;
};

/// Answers all rows on `threads` threads; order and answers do not depend on how many. `progress` is called on the calling thread. An
/// exception of the method is rethrown. A row's seed is run.seed plus its number, counted from 0.
[[nodiscard]] std::vector<Answer> answer_rows(const Method& method, const Grid& grid, const std::vector<Scenario>& rows,
                                              const RunOptions& run, unsigned threads,
                                              const std::function<void(std::size_t done)>& progress = {});

/// The percentile of the values, by nearest rank; NaN without values.
[[nodiscard]] double percentile(std::vector<double> values, double percent);

/// Length over optimum of the rows that were reached; 1 if the start is the goal. Rows that have the optimum 0 though start and goal differ
/// do not know their optimum, and are left out.
[[nodiscard]] std::vector<double> ratios(const std::vector<Scenario>& rows, const std::vector<Answer>& answers);

/// A header, then one line for each row: line, method, start, goal, outcome, trap, length, optimum, ratio, steps, cells, and what was used
/// up if the outcome is `limit`. There are no times, so the bytes are the same on every machine.
[[nodiscard]] std::string print_csv(const Method& method, const Grid& grid, const std::vector<Scenario>& rows,
                                    const std::vector<Answer>& answers);

/// A header, then one line for each point of a path: method, outcome, number, place as the map file counts, and the time if the method
/// knows it. If the method did not get to the goal, the path is written as far as it goes.
[[nodiscard]] std::string print_path(const Method& method, const Result& result, const Grid& grid, bool in_cells);

struct Summary {
  std::string_view method;
  Knowledge knowledge = Knowledge::kFullMap;
  std::size_t rows = 0, reached = 0, trapped = 0, unreachable = 0, limit = 0, other = 0;
  double mean_ratio = 0.0, median_ratio = 0.0, p95_ratio = 0.0, worst_ratio = 0.0;
  double median_us = 0.0;
};
[[nodiscard]] Summary summarise(const Method& method, const std::vector<Scenario>& rows, const std::vector<Answer>& answers);

/// A table for people, grouped by what the methods know. `times` adds the column that differs between machines.
[[nodiscard]] std::string print_table(const std::vector<Summary>& summaries, bool times);

}  // namespace kb::planners
