// What the command line sets in a scenario: `sensors.range.noise=0.01,0.1` is the key with each of two values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"

namespace kb::sim {

struct Setting {
  std::string key;      ///< the way to it: `sensors.range.noise`; a number is a place in a list, from 0: `event.0.for`
  std::string value;    ///< as it was written, and as it stands in results: no comma, no quotes
  /// `key = value`; what is no value of TOML is a text.
  [[nodiscard]] std::string toml() const;
};

/// What is set in one row, in the next, and so on; all have the same keys.
using Combinations = std::vector<std::vector<Setting>>;

/// One key and the values that are tried.
struct Sweep {
  std::string key;
  std::vector<std::string> values;
};
/// Reads `KEY=V1,V2,...`. Nothing if it is not that, or names a value twice; `why` then says what is wrong.
[[nodiscard]] std::optional<Sweep> read_sweep(std::string_view text, std::string& why);
/// Each value of each sweep with each of the others, the last one first to change; one empty row of no sweep.
[[nodiscard]] Combinations rows_of(const std::vector<Sweep>& sweeps);
/// As texts that the reader of scenarios takes.
[[nodiscard]] std::vector<source::FileId> add_settings(const std::vector<Setting>& settings, source::Sources& sources);

}  // namespace kb::sim
