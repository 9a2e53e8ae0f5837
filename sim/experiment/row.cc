// Prints and parses rows of results as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <span>

#include <waymark/controllers/similarity.h>
#include "compiler/source/numbers.h"
#include "sim/batch/fields.h"
#include "sim/experiment/runs.h"

namespace kb::sim::experiment {
namespace {

constexpr std::size_t kBefore = 10;                                // fields after the values that were set, and before the measures
constexpr std::size_t kFields = kBefore + batch::kMeasureCount + 1;   // the noise is behind these
constexpr std::size_t kMostEvents = 16;                            // of a scenario that is drawn

std::string values_of(const std::vector<Setting>& settings) {
  std::string values;
  for (const Setting& setting : settings) values += setting.value + ",";
  return values;
}

/// How long a run may take at the most whose shortest time is that of the row.
double limit_of(const Row& row, const std::vector<Setting>& settings) {
  for (const Setting& setting : settings) {
    double limit_s = 0.0;
    if (setting.key == "limit") return source::read_number(setting.value, limit_s) ? limit_s : 1e9;   // TOML has other ways to write a number
  }
  // Twice, because the limit follows from the shortest way without bans, and that of the row may be another that takes less time.
  return kPatience * static_cast<double>(mts::Similarity(size_of(settings)).of("s")) + 2.0 * kTimes * row.shortest_s;
}

/// Reports are names or words, `Help.lost` or `no way`, that are joined by `+`.
bool are_reports(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '"'; });
}

/// Whether the run of that number can have led to this row.
bool is_possible(const Row& row, const Setup& setup) {
  const Place place = place_of(setup, row.scenario);
  const bool there = row.scenario < setup.scenarios && row.labyrinth == place.labyrinth && row.route == place.route && row.what == place.what;
  const bool measured = row.shortest_s >= 0.1 && row.shortest_s < 1e6 && row.shortest_m >= 0.01 && row.shortest_m < 1e6;   // the summary divides by these
  return there && measured && are_kinds_of(row.what, row.kinds) && are_reports(row.reports) &&
         batch::is_possible(row, limit_of(row, setup.set[row.set]), kMostEvents);
}

}  // namespace

std::string row_header(const Combinations& set) {
  std::string keys;
  for (const Setting& setting : set.front()) keys += setting.key + ",";
  return fmt::format("scenario,method,{}labyrinth,route,class,kinds,outcome,reports,time_s,length_m,shortest_s,shortest_m,{},noise", keys, batch::kMeasures);
}

std::string print(const Row& row, const Combinations& set) {
  return fmt::format("{},{},{}{},{},{},{},{},{},{:.1f},{:.2f},{:.1f},{:.2f},{},{}", row.scenario, row.method, values_of(set[row.set]), row.labyrinth, row.route,
                     kClassNames[static_cast<std::size_t>(row.what)], row.kinds, row.outcome, row.reports, row.time_s, row.length_m, row.shortest_s,
                     row.shortest_m, batch::print_measures(row), row.noise);
}

std::optional<Row> parse_row(std::string_view line, const Setup& setup) {
  Row row;
  const std::string_view whole = line;
  const std::size_t scenario = std::min(line.find(','), line.size()), method = std::min(line.find(',', scenario + 1), line.size());
  if (method == line.size() || !source::read_number(line.substr(0, scenario), row.scenario)) return std::nullopt;
  row.method = line.substr(scenario + 1, method - scenario - 1);
  line.remove_prefix(method + 1);
  const auto found = std::find_if(setup.set.begin(), setup.set.end(), [&](const auto& settings) { return line.starts_with(values_of(settings)); });
  std::array<std::string_view, kFields> fields;
  if (found == setup.set.end() || !batch::split(line.substr(values_of(*found).size()), fields)) return std::nullopt;
  row.set = static_cast<std::size_t>(found - setup.set.begin());
  row.kinds = fields[3];
  row.outcome = fields[4];
  row.reports = fields[5];
  std::size_t outcome = 0;
  using batch::read_name, source::read_number;
  const bool good = read_number(fields[0], row.labyrinth) && read_number(fields[1], row.route) && read_name(fields[2], kClassNames, row.what) &&
                    read_name(fields[4], batch::kOutcomes, outcome) && read_number(fields[6], row.time_s) && read_number(fields[7], row.length_m) &&
                    read_number(fields[8], row.shortest_s) && read_number(fields[9], row.shortest_m) &&
                    batch::read_measures(std::span(fields).subspan<kBefore, batch::kMeasureCount>(), row) && read_number(fields.back(), row.noise);
  if (!good || print(row, setup.set) != whole || !is_possible(row, setup)) return std::nullopt;
  return row;
}

}  // namespace kb::sim::experiment
