// Rows of results as CSV.
#include <fmt/format.h>

#include "sim/batch/fields.h"
#include "sim/experiment/runs.h"

namespace kb::sim::experiment {
namespace {

constexpr std::size_t kFields = 15;

}  // namespace

std::string print(const Row& row) {
  return fmt::format("{},{},{},{},{},{},{},{},{:.1f},{:.2f},{:.1f},{:.2f},{},{},{}", row.scenario, kMethodNames[static_cast<std::size_t>(row.method)], row.labyrinth,
                     row.route, kClassNames[static_cast<std::size_t>(row.what)], row.kinds, row.outcome, row.reports, row.time_s, row.length_m, row.shortest_s,
                     row.shortest_m, row.collisions, row.bans_broken, row.lost_unaware ? 1 : 0);
}

std::optional<Row> parse_row(std::string_view line) {
  std::array<std::string_view, kFields> fields;
  if (!batch::split(line, fields)) return std::nullopt;
  Row row;
  row.kinds = fields[5];
  row.outcome = fields[6];
  row.reports = fields[7];
  std::uint32_t unaware = 0;
  std::size_t outcome = 0;
  using batch::read_name, batch::read_number;
  const bool good = read_number(fields[0], row.scenario) && read_name(fields[1], kMethodNames, row.method) && read_number(fields[2], row.labyrinth) &&
                    read_number(fields[3], row.route) && read_name(fields[4], kClassNames, row.what) && read_name(fields[6], batch::kOutcomes, outcome) &&
                    read_number(fields[8], row.time_s) && read_number(fields[9], row.length_m) && read_number(fields[10], row.shortest_s) &&
                    read_number(fields[11], row.shortest_m) && read_number(fields[12], row.collisions) && read_number(fields[13], row.bans_broken) &&
                    read_number(fields[14], unaware) && unaware < 2;
  if (!good) return std::nullopt;
  row.lost_unaware = unaware == 1;
  return row;
}

}  // namespace kb::sim::experiment
