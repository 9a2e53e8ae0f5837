#include "sim/batch/gate.h"

#include <array>

namespace kb::sim::batch {
namespace {

/// What a run can be counted for besides its outcome; computed from the columns of its row.
struct Counted {
  std::string_view name;
  bool (*is)(const Run& run);
};
constexpr std::array kCounted{
    Counted{"says_why", [](const Run& run) { return says_why(run); }},
    Counted{"silent", [](const Run& run) { return run.outcome != kOutcomes[0] && !says_why(run); }},
    Counted{"collisions", [](const Run& run) { return run.collisions > 0; }},
    Counted{"bans_broken", [](const Run& run) { return run.bans_broken > 0; }},
    Counted{"lost_unaware", [](const Run& run) { return run.lost_unaware; }},
    Counted{"standing_contacts", [](const Run& run) { return run.standing_contacts > 0; }},
    Counted{"missed", [](const Run& run) { return run.missed > 0; }},
};

bool is(const Run& run, std::size_t kind) { return kind < kOutcomes.size() ? run.outcome == kOutcomes[kind] : kCounted[kind - kOutcomes.size()].is(run); }

constexpr std::array kNames = [] {
  std::array<std::string_view, kOutcomes.size() + kCounted.size()> names{};
  std::size_t next = 0;
  for (const std::string_view outcome : kOutcomes) names[next++] = outcome;
  for (const Counted& counted : kCounted) names[next++] = counted.name;
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
