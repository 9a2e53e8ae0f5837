// Summarises a batch for people, as Markdown tables.
#include <fmt/format.h>

#include <map>
#include <utility>

#include "sim/batch/batch.h"

namespace kb::sim::batch {
namespace {

/// The first cells of a row, which say the runs of which scenario it counts.
std::string cells(std::string_view name, const std::vector<std::string>& values) {
  std::string out(name);
  for (const std::string& value : values) out += " | " + value;
  return out;
}

std::string share_row(std::string_view name, const Tally& t) {
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", name, t.runs, percent_between(t.arrived, t.runs), percent(t.says_why, t.runs),
                     percent(t.silent, t.runs), quantiles(t.times, 1), quantiles(t.lengths, 2), t.collided, t.broke_bans, t.lost_unaware);
}

}  // namespace

std::string summarise(const Batch& batch, const std::vector<Run>& runs) {
  std::vector<Tally> tallies(batch.scenarios().size());
  Tally all;
  std::map<std::pair<std::size_t, std::string>, std::size_t> ends;
  for (const Run& run : runs) {
    tallies[run.scenario].add(run, run.time_s, run.length_m);
    all.add(run, run.time_s, run.length_m);
    ++ends[{run.scenario, run.reports.empty() ? run.outcome : run.outcome + ": " + run.reports}];
  }
  const std::string which = cells("scenario", batch.keys());
  std::string rules;
  for (std::size_t i = 0; i < batch.keys().size(); ++i) rules += "---|";
  const auto about = [&](std::size_t i) { return cells(batch.scenarios()[i].name, batch.scenarios()[i].values); };
  std::string out = "| " + which +
      " | runs | arrives (95 % interval) | stops and says why | neither | time, s: 5 % / median / 95 % | length, m: 5 % / median / 95 % | runs with collisions | bans broken "
      "| lost without knowing it |\n|---|" + rules + "---:|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (std::size_t i = 0; i < tallies.size(); ++i) out += share_row(about(i), tallies[i]);
  if (tallies.size() > 1) out += share_row(cells("all", std::vector<std::string>(batch.keys().size())), all);
  out += "\nTimes and lengths are of the runs that arrived. How they ended:\n\n| " + which + " | end | runs |\n|---|" + rules + "---|---:|\n";
  for (const auto& [end, count] : ends) out += fmt::format("| {} | {} | {} |\n", about(end.first), end.second, count);
  return out;
}

}  // namespace kb::sim::batch
