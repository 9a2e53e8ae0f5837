// The results of an experiment: a table for people, and two pictures.
#pragma once

#include <string>
#include <vector>

#include "sim/experiment/runs.h"

namespace kb::sim::experiment {

/// The runs of one method, with one combination of what is set, with one class of disturbance. Shares
/// are of all its runs, ratios of those that arrived.
struct Share : batch::Tally {
  Class what{};
  std::string method;
  std::size_t set = 0;                              ///< see Row
};
/// By class (each has all methods and settings that occur), then by method, then by what is set. `times` and `lengths` are multiples of
/// the shortest. O(rows log methods).
[[nodiscard]] std::vector<Share> summarise(const std::vector<Row>& rows);

/// A table in Markdown; if nothing is set, also one for each knowledge base of the runs that did not arrive, by kind of disturbance.
[[nodiscard]] std::string print_table(const std::vector<Share>& shares, const Combinations& set);
[[nodiscard]] std::string print_kinds(const std::vector<Row>& rows, const Combinations& set);
/// `mts 0.1 0.2`: a method and what is set.
[[nodiscard]] std::string label(const std::string& method, const std::vector<Setting>& settings);

/// Bars: how the runs ended, for each class and method, distinguished by hatching as well as by colour.
[[nodiscard]] std::string draw_outcomes(const std::vector<Share>& shares, const Combinations& set);
/// Curves: the share of runs that arrived within a multiple of the shortest possible time. `shares` is everything that `summarise` returned.
[[nodiscard]] std::string draw_times(const std::vector<Share>& shares, const Combinations& set);

}  // namespace kb::sim::experiment
