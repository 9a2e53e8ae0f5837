// What the runs of an experiment come to: a table for people, and two pictures.
#pragma once

#include <string>
#include <vector>

#include "sim/experiment/runs.h"

namespace kb::sim::experiment {

/// The runs of one method with one class of disturbance. Shares of all its runs; ratios of those that arrived.
struct Share : batch::Tally {
  Class what{};
  Method method{};
  double median_time = 0.0, worst_time = 0.0;       ///< times the shortest possible; worst: the 95th percentile
  double median_length = 0.0, worst_length = 0.0;
};
/// By class, then by method.
[[nodiscard]] std::vector<Share> summarise(const std::vector<Row>& rows);

/// A table in Markdown, then a table of what did not arrive, by kind of disturbance (of the knowledge base alone).
[[nodiscard]] std::string print_table(const std::vector<Share>& shares);
[[nodiscard]] std::string print_kinds(const std::vector<Row>& rows);

/// Bars: how the runs ended, for each class and method. Told apart by hatching as well as by colour.
[[nodiscard]] std::string draw_outcomes(const std::vector<Share>& shares);
/// Curves: the share of runs that arrived within so many times the shortest possible time.
[[nodiscard]] std::string draw_times(const std::vector<Row>& rows);

}  // namespace kb::sim::experiment
