// A batch: one knowledge base, driven by every robot with every seed through every scenario.
//
// note [numbers of runs]
// A run is a number: scenario by scenario, in each seed by seed, in each robot by robot. It depends on nothing but its own
// scenario, seed and robot. A shard is a block of consecutive runs whose size follows from the number of runs alone, so that
// the rows of a shard are the same bytes whoever drives it, and shards in order are the batch.
//
// Robots do not meet: each drives alone, with noise of its own. Robot 0 has the noise of the seed itself, so that
// `kbc sim --scenario S --seed N` is its drive.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/ending.h"
#include "sim/drive/drive.h"

namespace kb::sim::batch {

struct NamedScenario {
  std::string name;        ///< as it stands in the rows: no comma, no quotes
  std::vector<std::string> values;   ///< of BatchOptions::keys, as they stand in the rows: no comma
  Scenario scenario;       ///< its seed does not count
  std::unique_ptr<const Labyrinth> labyrinth;   ///< the floor that it happens on
};

struct BatchOptions {
  std::uint64_t first_seed = 1, last_seed = 1;   ///< both included
  std::uint32_t robots = 1;                      ///< for each scenario and seed
  std::uint32_t dt_us = 100'000;                 ///< see DriveOptions
  std::vector<std::string> keys;                 ///< what was set: a column of the rows each
};

inline constexpr std::uint64_t kMostRuns = 10'000'000;

/// One run and what came of it.
struct Run : Ending {
  std::size_t scenario = 0;      ///< index
  std::uint64_t seed = 0;
  std::uint32_t robot = 0;
  std::uint64_t noise = 0;       ///< the seed of its noise: `kbc sim --seed NOISE` is the same drive
};

class Batch {
 public:
  /// `knowledge` must outlive it. At least one scenario, and at most kMostRuns runs.
  Batch(const Knowledge& knowledge, std::vector<NamedScenario> scenarios, const BatchOptions& options);

  [[nodiscard]] const std::vector<NamedScenario>& scenarios() const { return scenarios_; }
  [[nodiscard]] const std::vector<std::string>& keys() const { return options_.keys; }
  [[nodiscard]] std::size_t runs() const { return runs_; }
  [[nodiscard]] std::size_t shards() const { return (runs_ + shard_runs_ - 1) / shard_runs_; }
  /// The numbers of its runs: [first, last).
  struct Block { std::size_t first = 0, last = 0; };
  [[nodiscard]] Block block(std::size_t shard) const;

  /// Which run a number is; nothing has come of it yet.
  [[nodiscard]] Run run(std::size_t number) const;
  /// Drives. Nothing if `go_on`, asked before each tick, said no. Any number of threads may drive at once.
  [[nodiscard]] std::optional<Run> drive(std::size_t number, const std::function<bool()>& go_on) const;
  /// A line of CSV without its end, and that of the columns' names.
  [[nodiscard]] std::string print(const Run& run) const;
  [[nodiscard]] std::string header() const;
  /// What `print` wrote of this number; nothing if it is not that.
  [[nodiscard]] std::optional<Run> parse(std::string_view line, std::size_t number) const;

 private:
  const Knowledge& knowledge_;
  std::vector<NamedScenario> scenarios_;
  BatchOptions options_;
  std::size_t runs_, shard_runs_;
};

/// A table in Markdown, a row a scenario and one for all; then how the runs ended, by scenario. `runs` in the order of numbers.
[[nodiscard]] std::string summarise(const Batch& batch, const std::vector<Run>& runs);

}  // namespace kb::sim::batch
