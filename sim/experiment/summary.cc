#include "sim/experiment/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace kb::sim::experiment {
namespace {

/// For each method and combination of settings, in order, a row in which only these two are filled in.
std::vector<Row> ways_of(const std::vector<Row>& rows) {
  std::vector<Row> ways;
  for (const Row& row : rows) {
    const auto at = std::lower_bound(ways.begin(), ways.end(), row, way_before);
    if (at != ways.end() && !way_before(row, *at)) continue;
    Row& way = *ways.insert(at, Row{});
    way.method = row.method;
    way.set = row.set;
  }
  return ways;
}

std::string kinds_of(const std::vector<Row>& rows, const Row& way) {
  struct Count { std::size_t runs = 0, arrived = 0; std::map<std::string, std::size_t> else_; };
  std::map<std::string, Count> kinds;
  for (const Row& row : rows) {
    if (row.method != way.method || row.set != way.set || row.kinds.empty() || row.kinds.find('+') != std::string::npos) continue;
    Count& count = kinds[row.kinds];
    ++count.runs;
    if (batch::arrives(row)) ++count.arrived;
    else ++count.else_[batch::says_why(row) ? row.reports : row.outcome];
  }
  std::string out = "| alone | runs | arrives (95 % interval) | else |\n|---|---:|---:|---|\n";
  for (const auto& [kind, count] : kinds) {
    std::string others;
    for (const auto& [report, n] : count.else_) others += fmt::format("{}{} {}", others.empty() ? "" : ", ", n, report);
    out += fmt::format("| {} | {} | {} | {} |\n", kind, count.runs, batch::percent_between(count.arrived, count.runs), others);
  }
  return out;
}

}  // namespace

std::vector<Share> summarise(const std::vector<Row>& rows) {
  const auto ways = ways_of(rows);
  std::vector<Share> shares;
  for (std::size_t c = 0; c < kClassNames.size(); ++c) {
    for (const Row& way : ways) {
      Share& share = shares.emplace_back();
      share.what = static_cast<Class>(c);
      share.method = way.method;
      share.set = way.set;
    }
  }
  for (const Row& row : rows) {
    const auto way = static_cast<std::size_t>(std::lower_bound(ways.begin(), ways.end(), row, way_before) - ways.begin());
    shares[static_cast<std::size_t>(row.what) * ways.size() + way].add(row, row.time_s / row.shortest_s, row.length_m / row.shortest_m);
  }
  return shares;
}

std::string label(const std::string& method, const std::vector<Setting>& settings) {
  std::string text = method;
  for (const Setting& setting : settings) text += " " + setting.value;
  return text;
}

std::string print_table(const std::vector<Share>& shares, const Combinations& set) {
  std::string keys, rules;
  for (const Setting& setting : set.front()) {
    keys += setting.key + " | ";
    rules += "---|";
  }
  std::string out = "| disturbance | method | " + keys +
      "runs | arrives (95 % interval) | stops and says why | neither | time, median (95 %) | length, median (95 %) | runs with collisions | bans broken | lost without "
      "knowing it |\n|---|---|" + rules + "---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Share& s : shares) {
    if (s.runs == 0) continue;
    const auto ratio = [&](const std::vector<double>& of) {
      return s.arrived == 0 ? std::string("-") : fmt::format("{:.2f} ({:.2f})", batch::quantile(of, 0.5), batch::quantile(of, 0.95));
    };
    std::string values;
    for (const Setting& setting : set[s.set]) values += setting.value + " | ";
    out += fmt::format("| {} | {} | {}{} | {} | {} | {} | {} | {} | {} | {} | {} |\n", kClassNames[static_cast<std::size_t>(s.what)],
                       s.method, values, s.runs, batch::percent_between(s.arrived, s.runs), batch::percent(s.says_why, s.runs), batch::percent(s.silent, s.runs),
                       ratio(s.times), ratio(s.lengths), s.collided, s.broke_bans, s.lost_unaware);
  }
  return out;
}

std::string print_kinds(const std::vector<Row>& rows, const Combinations& set) {
  std::string out;
  if (set.size() > 1) return out;   // a table for each combination would be too many to help anybody
  for (const Row& way : ways_of(rows)) {
    if (way.method == "programmed" || way.method == "bug2") continue;
    out += fmt::format("\nOf `{}`'s runs, those in which one thing alone went wrong:\n\n{}", way.method, kinds_of(rows, way));
  }
  return out;
}

}  // namespace kb::sim::experiment
