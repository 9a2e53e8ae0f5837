// Rows of results as CSV.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "sim/experiment/runs.h"

namespace kb::sim::experiment {
namespace {

constexpr std::size_t kFields = 15;

template <class Number>
bool read_number(std::string_view text, Number& number) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  return !text.empty() && result.ec == std::errc() && result.ptr == text.data() + text.size();
}

template <class Id, std::size_t N>
bool read_name(std::string_view text, const std::array<std::string_view, N>& names, Id& id) {
  const auto found = std::find(names.begin(), names.end(), text);
  id = static_cast<Id>(found - names.begin());
  return found != names.end();
}

}  // namespace

std::string print(const Row& row) {
  return fmt::format("{},{},{},{},{},{},{},{},{:.1f},{:.2f},{:.1f},{:.2f},{},{},{}", row.scenario, kMethodNames[static_cast<std::size_t>(row.method)], row.labyrinth,
                     row.route, kClassNames[static_cast<std::size_t>(row.what)], row.kinds, row.outcome, row.reports, row.time_s, row.length_m, row.shortest_s,
                     row.shortest_m, row.collisions, row.bans_broken, row.lost_unaware ? 1 : 0);
}

std::optional<Row> parse_row(std::string_view line) {
  std::array<std::string_view, kFields> fields;
  std::size_t count = 0;
  for (;;) {
    const std::size_t comma = line.find(',');
    if (count == kFields) return std::nullopt;
    fields[count++] = line.substr(0, comma);
    if (comma == std::string_view::npos) break;
    line.remove_prefix(comma + 1);
  }
  if (count != kFields) return std::nullopt;
  Row row;
  row.kinds = fields[5];
  row.outcome = fields[6];
  row.reports = fields[7];
  std::uint32_t unaware = 0;
  std::size_t outcome = 0;
  const bool good = read_number(fields[0], row.scenario) && read_name(fields[1], kMethodNames, row.method) && read_number(fields[2], row.labyrinth) &&
                    read_number(fields[3], row.route) && read_name(fields[4], kClassNames, row.what) && read_name(fields[6], kOutcomes, outcome) &&
                    read_number(fields[8], row.time_s) && read_number(fields[9], row.length_m) && read_number(fields[10], row.shortest_s) &&
                    read_number(fields[11], row.shortest_m) && read_number(fields[12], row.collisions) && read_number(fields[13], row.bans_broken) &&
                    read_number(fields[14], unaware) && unaware < 2;
  if (!good) return std::nullopt;
  row.lost_unaware = unaware == 1;
  return row;
}

}  // namespace kb::sim::experiment
