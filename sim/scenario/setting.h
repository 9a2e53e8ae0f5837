// Settings of the command line for a scenario: `sensors.range.noise=0.01,0.1` gives a key each of two values.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/source/source.h"

namespace kb::sim {

struct Setting {
  std::string key;      ///< the path: `sensors.range.noise`; a number is an index into a list, from 0: `event.0.for`
  std::string value;    ///< as written, and as it appears in results: no comma, no quotes
  /// `key = value`; a value that is not TOML is taken as a text.
  [[nodiscard]] std::string toml() const;
};

/// The settings of each row; all rows have the same keys.
using Combinations = std::vector<std::vector<Setting>>;

/// One key and the values to try.
struct Sweep {
  std::string key;
  std::vector<std::string> values;
};
/// Reads `KEY=V1,V2,...`. Nothing if it is malformed or names a value twice, if in other digits; `why` then says what is wrong.
[[nodiscard]] std::optional<Sweep> read_sweep(std::string_view text, std::string& why);
/// All combinations of the sweeps' values; the last sweep changes fastest. Without sweeps, one empty row.
[[nodiscard]] Combinations rows_of(const std::vector<Sweep>& sweeps);
/// The settings as texts for the reader of scenarios.
[[nodiscard]] std::vector<source::FileId> add_settings(const std::vector<Setting>& settings, source::Sources& sources);

}  // namespace kb::sim
