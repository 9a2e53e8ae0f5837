#include "sim/batch/batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "compiler/source/numbers.h"
#include "sim/batch/fields.h"
#include "sim/random.h"

namespace kb::sim::batch {
namespace {

// There are enough shards for some hundred threads, but no more files than a folder holds well, and none for less than a few runs.
constexpr std::size_t kMostShards = 1024, kLeastRuns = 4;
constexpr std::uint64_t kRobotStream = 4u << 20;   // streams of the generator: see Random

std::string row_begin(const std::vector<NamedScenario>& scenarios, const Run& run) {
  const NamedScenario& scenario = scenarios[run.scenario];
  std::string begin = scenario.name + ",";
  for (const std::string& value : scenario.values) begin += value + ",";
  return begin + fmt::format("{},{},{},", run.seed, run.robot, run.noise);
}

std::string row_end(const Run& run) { return fmt::format("{},{},{:.1f},{:.2f},{}", run.outcome, run.reports, run.time_s, run.length_m, print_measures(run)); }

}  // namespace

Batch::Batch(const Knowledge& knowledge, std::vector<NamedScenario> scenarios, const BatchOptions& options)
    : knowledge_(knowledge),
      scenarios_(std::move(scenarios)),
      options_(options),
      runs_(scenarios_.size() * static_cast<std::size_t>(options.last_seed - options.first_seed + 1) * options.robots),
      shard_runs_(std::max(kLeastRuns, (runs_ + kMostShards - 1) / kMostShards)) {}

Batch::Block Batch::block(std::size_t shard) const { return {shard * shard_runs_, std::min(runs_, (shard + 1) * shard_runs_)}; }

Run Batch::run(std::size_t number) const {
  Run run;
  const auto seeds = static_cast<std::size_t>(options_.last_seed - options_.first_seed + 1);
  run.robot = static_cast<std::uint32_t>(number % options_.robots);
  run.seed = options_.first_seed + number / options_.robots % seeds;
  run.scenario = number / options_.robots / seeds;
  run.noise = run.robot == 0 ? run.seed : Random(run.seed, kRobotStream + run.robot).next() >> 12;   // 52 bits: a scenario file can hold them
  return run;
}

std::optional<Run> Batch::drive(std::size_t number, const std::function<bool()>& go_on) const {
  Run result = run(number);
  const NamedScenario& named = scenarios_[result.scenario];
  Scenario scenario = named.scenario;
  scenario.seed = result.noise;
  DriveOptions how;
  how.dt_us = options_.dt_us;
  Drive drive(*named.labyrinth, knowledge_, scenario, how);
  do {
    if (!go_on()) return std::nullopt;
  } while (drive.step());
  static_cast<Ending&>(result) = ending_of(drive.summary());
  return result;
}

std::string Batch::header() const {
  std::string header = "scenario,";
  for (const std::string& key : options_.keys) header += key + ",";
  return header + fmt::format("seed,robot,noise,outcome,reports,time_s,length_m,{}", kMeasures);
}

std::string Batch::print(const Run& run) const { return row_begin(scenarios_, run) + row_end(run); }

std::optional<Run> Batch::parse(std::string_view line, std::size_t number) const {
  Run result = run(number);
  const std::string begin = row_begin(scenarios_, result);
  if (!line.starts_with(begin)) return std::nullopt;
  constexpr std::size_t kBefore = 4;
  std::array<std::string_view, kBefore + kMeasureCount> fields;
  std::size_t outcome = 0;
  const bool good = split(line.substr(begin.size()), fields) && read_name(fields[0], kOutcomes, outcome) && source::read_number(fields[2], result.time_s) &&
                    source::read_number(fields[3], result.length_m) && read_measures(std::span(fields).last<kMeasureCount>(), result);
  if (!good) return std::nullopt;
  result.outcome = fields[0];
  result.reports = fields[1];
  const bool as_printed = line.substr(begin.size()) == row_end(result);
  const Scenario& scenario = scenarios_[result.scenario].scenario;
  return as_printed && is_possible(result, scenario.limit_s, scenario.events.size()) ? std::optional(std::move(result)) : std::nullopt;
}

}  // namespace kb::sim::batch
