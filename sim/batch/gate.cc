#include "sim/batch/gate.h"

#include <array>

namespace kb::sim::batch {
namespace {

/// What a run can be counted for besides its outcome; computed from the columns of its row.
constexpr std::array kCounted{
    Happening{"says_why", says_why},
    Happening{"silent", [](const Ending& run) { return !arrives(run) && !says_why(run); }},
    kHappenings[1],
    kHappenings[2],
    kHappenings[3],
    kHappenings[4],
    Happening{"missed", [](const Ending& run) { return run.missed > 0; }},
};

bool is(const Run& run, std::size_t kind) { return kind < kOutcomes.size() ? run.outcome == kOutcomes[kind] : kCounted[kind - kOutcomes.size()].is(run); }

constexpr std::array kNames = [] {
  std::array<std::string_view, kOutcomes.size() + kCounted.size()> names{};
  std::size_t next = 0;
  for (const std::string_view outcome : kOutcomes) names[next++] = outcome;
  for (const Happening& counted : kCounted) names[next++] = counted.name;
  return names;
}();

}  // namespace

std::span<const std::string_view> countable() { return kNames; }

std::vector<Unmet> unmet(const std::vector<Demand>& demands, const Batch& batch, const std::vector<Run>& runs) {
  const std::size_t scenarios = batch.scenarios().size();
  std::vector<std::size_t> of(scenarios, 0), counts(scenarios * demands.size(), 0);   // by scenario, then by demand
  for (const Run& run : runs) {
    ++of[run.scenario];
    for (std::size_t d = 0; d < demands.size(); ++d) counts[run.scenario * demands.size() + d] += is(run, demands[d].kind) ? 1 : 0;
  }
  std::vector<Unmet> all;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const Demand& demand = demands[i % demands.size()];
    const std::size_t scenario = i / demands.size(), runs_there = of[scenario];
    if (!holds(demand, counts[i], runs_there)) all.push_back(unmet_by(demand, scenario, counts[i], runs_there));
  }
  return all;
}

}  // namespace kb::sim::batch
