#include "sim/experiment/summary.h"

#include <fmt/format.h>

#include <map>

namespace kb::sim::experiment {
namespace {

Share share_of(const std::vector<Row>& rows, Class what, Method method) {
  Share share;
  share.what = what;
  share.method = method;
  for (const Row& row : rows) {
    if (row.what == what && row.method == method) share.add(row, row.time_s / row.shortest_s, row.length_m / row.shortest_m);
  }
  share.median_time = batch::quantile(share.times, 0.5);
  share.worst_time = batch::quantile(share.times, 0.95);
  share.median_length = batch::quantile(share.lengths, 0.5);
  share.worst_length = batch::quantile(share.lengths, 0.95);
  return share;
}

}  // namespace

std::vector<Share> summarise(const std::vector<Row>& rows) {
  std::vector<Share> shares;
  for (std::size_t c = 0; c < kClassNames.size(); ++c) {
    for (std::size_t m = 0; m < kMethodNames.size(); ++m) shares.push_back(share_of(rows, static_cast<Class>(c), static_cast<Method>(m)));
  }
  return shares;
}

std::string print_table(const std::vector<Share>& shares) {
  std::string out =
      "| disturbance | method | runs | arrives (95 % interval) | stops and says why | neither | time, median (95 %) | length, median (95 %) | runs with collisions | bans broken | lost without "
      "knowing it |\n|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Share& s : shares) {
    if (s.runs == 0) continue;
    const auto ratio = [&](double median, double worst) { return s.arrived == 0 ? std::string("-") : fmt::format("{:.2f} ({:.2f})", median, worst); };
    out += fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", kClassNames[static_cast<std::size_t>(s.what)],
                       kMethodNames[static_cast<std::size_t>(s.method)], s.runs, batch::percent_between(s.arrived, s.runs), batch::percent(s.says_why, s.runs), batch::percent(s.silent, s.runs),
                       ratio(s.median_time, s.worst_time), ratio(s.median_length, s.worst_length), s.collided, s.broke_bans, s.lost_unaware);
  }
  return out;
}

std::string print_kinds(const std::vector<Row>& rows) {
  struct Count { std::size_t runs = 0, arrived = 0; std::map<std::string, std::size_t> else_; };
  std::map<std::string, Count> kinds;
  for (const Row& row : rows) {
    if (row.method != Method::kMts || row.kinds.empty() || row.kinds.find('+') != std::string::npos) continue;
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

}  // namespace kb::sim::experiment
