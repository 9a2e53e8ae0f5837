// Many questions at once, and what came of them in figures.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "planners/maps/maps.h"
#include "planners/method.h"

namespace kb::planners {

/// What came of one row of a scenario file.
struct Answer {
  Outcome outcome = Outcome::kInvalid;
  Fault fault = Fault::kNone;
  Trap::Kind trap = Trap::Kind::kNone;
  double length_cells = 0.0;
  double seconds = 0.0;          ///< of this machine; everything else is the same everywhere
  Statistics statistics;
};

/// Answers all rows with `threads` threads; the order and the answers do not depend on their number. `progress` is called
/// from the calling thread. What the method throws is thrown on. A row's seed is run.seed plus its number.
[[nodiscard]] std::vector<Answer> answer_rows(const Method& method, const Grid& grid, const std::vector<Scenario>& rows,
                                              const RunOptions& run, unsigned threads,
                                              const std::function<void(std::size_t done)>& progress = {});

/// The share below which `percent` of the values lie (nearest rank). NaN of nothing.
[[nodiscard]] double percentile(std::vector<double> values, double percent);

/// Length over optimum of the rows that were reached: 1 where the start is the goal. Rows with the optimum 0 where it is not, which
/// do not know it, are left out.
[[nodiscard]] std::vector<double> ratios(const std::vector<Scenario>& rows, const std::vector<Answer>& answers);

/// A header, then a line a row: line, method, start, goal, outcome, trap, length, optimum, ratio, steps, cells, and of a `limit`
/// what was used up. No times: the same bytes on every machine.
[[nodiscard]] std::string print_csv(const Method& method, const Grid& grid, const std::vector<Scenario>& rows,
                                    const std::vector<Answer>& answers);

/// A header, then a line for each point of a path: method, outcome, number, place as the map file counts, and time where the
/// method knows one. Of a method that did not get there, as far as it came.
[[nodiscard]] std::string print_path(const Method& method, const Result& result, const Grid& grid, bool in_cells);

struct Summary {
  std::string_view method;
  Knowledge knowledge = Knowledge::kFullMap;
  std::size_t rows = 0, reached = 0, trapped = 0, unreachable = 0, limit = 0, other = 0;
  double mean_ratio = 0.0, median_ratio = 0.0, p95_ratio = 0.0, worst_ratio = 0.0;
  double median_us = 0.0;
};
[[nodiscard]] Summary summarise(const Method& method, const std::vector<Scenario>& rows, const std::vector<Answer>& answers);

/// A table for people, methods of one class of knowledge together. `times`: with the column that differs between machines.
[[nodiscard]] std::string print_table(const std::vector<Summary>& summaries, bool times);

}  // namespace kb::planners
