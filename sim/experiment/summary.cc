#include "sim/experiment/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace kb::sim::experiment {
namespace {

Share share_of(const std::vector<Row>& rows, Class what, const Row& like) {
  Share share;
  share.what = what;
  share.method = like.method;
  share.set = like.set;
  for (const Row& row : rows) {
    if (row.what == what && row.method == like.method && row.set == like.set) share.add(row, row.time_s / row.shortest_s, row.length_m / row.shortest_m);
  }
  share.median_time = batch::quantile(share.times, 0.5);
  share.worst_time = batch::quantile(share.times, 0.95);
  share.median_length = batch::quantile(share.lengths, 0.5);
  share.worst_length = batch::quantile(share.lengths, 0.95);
  return share;
}

std::string kinds_of(const std::vector<Row>& rows, const Row& way) {
  struct Count { std::size_t runs = 0, arrived = 0; std::map<std::string, std::size_t> else_; };
  std::map<std::string, Count> kinds;
  for (const Row& row : rows) {
    if (row.method != way.method || row.set != way.set || row.kinds.empty() || row.kinds.find('+') != std::string::npos) continue;
    Count& count = kinds[row.kinds];
    ++count.runs;
    if (row.outcome == "arrived") ++count.arrived;
    else ++count.else_[row.reports.empty() ? row.outcome : row.reports];
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

std::vector<Row> ways_of(const std::vector<Row>& rows) {
  std::vector<Row> ways;
  for (const Row& row : rows) {
    Row way;
    way.method = row.method;
    way.set = row.set;
    const auto at = std::lower_bound(ways.begin(), ways.end(), way, before);
    if (at == ways.end() || before(way, *at)) ways.insert(at, std::move(way));
  }
  return ways;
}

std::vector<Share> summarise(const std::vector<Row>& rows) {
  std::vector<Share> shares;
  const auto ways = ways_of(rows);
  for (std::size_t c = 0; c < kClassNames.size(); ++c) {
    for (const Row& way : ways) shares.push_back(share_of(rows, static_cast<Class>(c), way));
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
    const auto ratio = [&](double median, double worst) { return s.arrived == 0 ? std::string("-") : fmt::format("{:.2f} ({:.2f})", median, worst); };
    std::string values;
    for (const Setting& setting : set[s.set]) values += setting.value + " | ";
    out += fmt::format("| {} | {} | {}{} | {} | {} | {} | {} | {} | {} | {} | {} |\n", kClassNames[static_cast<std::size_t>(s.what)],
                       s.method, values, s.runs, batch::percent_between(s.arrived, s.runs), batch::percent(s.says_why, s.runs), batch::percent(s.silent, s.runs),
                       ratio(s.median_time, s.worst_time), ratio(s.median_length, s.worst_length), s.collided, s.broke_bans, s.lost_unaware);
  }
  return out;
}

std::string print_kinds(const std::vector<Row>& rows, const Combinations& set) {
  std::string out;
  if (set.size() > 1) return out;   // as many tables as combinations help nobody
  for (const Row& way : ways_of(rows)) {
    if (way.method == "programmed" || way.method == "bug2") continue;
    const std::string whose = way.method == "mts" ? "the knowledge base" : "`" + way.method + "`";
    out += fmt::format("\nOf {}'s runs, those in which one thing alone went wrong:\n\n{}", whose, kinds_of(rows, way));
  }
  return out;
}

}  // namespace kb::sim::experiment
