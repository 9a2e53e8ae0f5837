// Prints and parses rows of results as CSV.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/source/numbers.h"
#include "sim/batch/fields.h"
#include "sim/experiment/runs.h"

namespace kb::sim::experiment {
namespace {

constexpr std::size_t kFields = 13;   // after the values that were set

std::string values_of(const std::vector<Setting>& settings) {
  std::string values;
  for (const Setting& setting : settings) values += setting.value + ",";
  return values;
}

}  // namespace

std::string row_header(const Combinations& set) {
  std::string keys;
  for (const Setting& setting : set.front()) keys += setting.key + ",";
  return "scenario,method," + keys +
         "labyrinth,route,class,kinds,outcome,reports,time_s,length_m,shortest_s,shortest_m,collisions,bans_broken,lost_unaware";
}

std::string print(const Row& row, const Combinations& set) {
  return fmt::format("{},{},{}{},{},{},{},{},{},{:.1f},{:.2f},{:.1f},{:.2f},{},{},{}", row.scenario, row.method, values_of(set[row.set]), row.labyrinth, row.route, kClassNames[static_cast<std::size_t>(row.what)], row.kinds, row.outcome, row.reports, row.time_s, row.length_m, row.shortest_s,
                     row.shortest_m, row.collisions, row.bans_broken, row.lost_unaware ? 1 : 0);
}

std::optional<Row> parse_row(std::string_view line, const Combinations& set) {
  Row row;
  const std::size_t scenario = std::min(line.find(','), line.size()), method = std::min(line.find(',', scenario + 1), line.size());
  if (method == line.size() || !source::read_number(line.substr(0, scenario), row.scenario)) return std::nullopt;
  row.method = line.substr(scenario + 1, method - scenario - 1);
  line.remove_prefix(method + 1);
  const auto found = std::find_if(set.begin(), set.end(), [&](const auto& settings) { return line.starts_with(values_of(settings)); });
  std::array<std::string_view, kFields> fields;
  if (found == set.end() || !batch::split(line.substr(values_of(*found).size()), fields)) return std::nullopt;
  row.set = static_cast<std::size_t>(found - set.begin());
  row.kinds = fields[3];
  row.outcome = fields[4];
  row.reports = fields[5];
  std::uint32_t unaware = 0;
  std::size_t outcome = 0;
  using batch::read_name, source::read_number;
  const bool good = read_number(fields[0], row.labyrinth) && read_number(fields[1], row.route) && read_name(fields[2], kClassNames, row.what) &&
                    read_name(fields[4], batch::kOutcomes, outcome) && read_number(fields[6], row.time_s) && read_number(fields[7], row.length_m) &&
                    read_number(fields[8], row.shortest_s) && read_number(fields[9], row.shortest_m) && read_number(fields[10], row.collisions) &&
                    read_number(fields[11], row.bans_broken) && read_number(fields[12], unaware) && unaware < 2;
  if (!good || row.shortest_s < 0.1 || row.shortest_m < 0.01) return std::nullopt;   // the summary divides by these
  row.lost_unaware = unaware == 1;
  return row;
}

}  // namespace kb::sim::experiment
