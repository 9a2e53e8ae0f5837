// A batch: one knowledge base, driven by every robot with every seed through every scenario.
//
// note [numbers of runs]
// Runs are numbered by scenario, then by seed, then by robot. A run depends only on its own scenario, seed and robot. A shard is a
// block of consecutive runs whose size follows from the number of runs alone. So the rows of a shard are the same bytes
// whichever process drives it, and the shards in order are the batch.
//
// Robots do not meet: each drives alone, with its own noise. Robot 0 has the noise of the seed itself, so its drive is that of
// `kbc sim --scenario S --seed N`.
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
  Scenario scenario;       ///< its seed is ignored
  std::unique_ptr<const Labyrinth> labyrinth;   ///< the floor that it happens on
};

struct BatchOptions {
  std::uint64_t first_seed = 1, last_seed = 1;   ///< both included
  std::uint32_t robots = 1;                      ///< for each scenario and seed
  std::uint32_t dt_us = 100'000;                 ///< see DriveOptions
  std::vector<std::string> keys;                 ///< what was set; each is a column of the rows
};

inline constexpr std::uint64_t kMostRuns = 10'000'000;

/// One run and its result.
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

  /// The run of a number, without a result yet.
  [[nodiscard]] Run run(std::size_t number) const;
  /// Drives the run of a number. Nothing if `go_on`, asked before each tick, returned false. Any number of threads may drive at once.
  [[nodiscard]] std::optional<Run> drive(std::size_t number, const std::function<bool()>& go_on) const;
  /// A line of CSV without its line break, and the line of column names.
  [[nodiscard]] std::string print(const Run& run) const;
  [[nodiscard]] std::string header() const;
  /// Reads back the line that `print` wrote for this number; nothing if it is another line, or one that no drive can have led to.
  [[nodiscard]] std::optional<Run> parse(std::string_view line, std::size_t number) const;

 private:
  const Knowledge& knowledge_;
  std::vector<NamedScenario> scenarios_;
  BatchOptions options_;
  std::size_t runs_, shard_runs_;
};

/// A table in Markdown with a row for each scenario and one for all; then how the runs ended, by scenario. `runs` must be in order of
/// numbers.
[[nodiscard]] std::string summarise(const Batch& batch, const std::vector<Run>& runs);

}  // namespace kb::sim::batch
