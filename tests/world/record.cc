#include "tests/world/record.h"

#include <fmt/format.h>

#include <algorithm>

namespace kb::world {
namespace {

/// Microseconds as seconds, without zeros that say nothing.
std::string seconds(std::int64_t time_us) {
  std::string text = fmt::format("{}.{:06}", time_us / 1'000'000, time_us % 1'000'000);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::vector<std::size_t> columns_with_data(const Recording& recording) {
  std::vector<std::size_t> columns;
  for (std::size_t fact = 0; fact < recording.knowledge->program().facts; ++fact) {
    const bool data = std::any_of(recording.rows.begin(), recording.rows.end(),
                                  [&](const Recording::Row& row) { return row.facts[fact] != 0.0f; });
    if (data) columns.push_back(fact);
  }
  return columns;
}

}  // namespace

std::string facts_csv(const Recording& recording) {
  const auto columns = columns_with_data(recording);
  std::string csv = "t";
  for (const std::size_t fact : columns) csv.append(",").append(recording.knowledge->program().cells[fact].name);
  csv += '\n';
  for (const Recording::Row& row : recording.rows) {
    csv += seconds(row.time_us);
    for (const std::size_t fact : columns) {
      csv += ',';
      if (row.facts[fact] != 0.0f) csv += fmt::format("{}", row.facts[fact]);
    }
    csv += '\n';
  }
  return csv;
}

std::string trace_jsonl(const Recording& recording) {
  std::string trace;
  for (const program::Tick& tick : recording.ticks)
    trace += program::print_json(recording.knowledge->program(), tick) + "\n";
  return trace;
}

}  // namespace kb::world
