// Demands on the results of a batch: `arrived>=95%,collisions=0`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/batch/batch.h"

namespace kb::sim::batch {

/// How many runs in a row of the table must be of a kind, or which share of them.
struct Demand {
  enum class Sign : std::uint8_t { kAtLeast, kAtMost, kAbove, kBelow, kExactly } sign{};
  std::string text;         ///< as written
  std::size_t kind = 0;     ///< index into what can be counted: outcomes, and other things that happen to a run
  std::uint64_t number = 0, scale = 1;   ///< runs, or percent of them times `scale`, which is 10 for one decimal place
  bool share = false;
};

/// Reads demands separated by commas. Nothing if one is malformed; `why` then says what is wrong.
[[nodiscard]] std::optional<std::vector<Demand>> read_demands(std::string_view text, std::string& why);

/// A demand that a row of the table does not meet.
struct Unmet {
  std::size_t scenario = 0;      ///< index
  std::string demand, found;     ///< `arrived>=95%`, `59 of 160 runs (36.9 %)`
};
/// In the order of the rows, then of the demands. O(runs * demands).
[[nodiscard]] std::vector<Unmet> unmet(const std::vector<Demand>& demands, const Batch& batch, const std::vector<Run>& runs);

}  // namespace kb::sim::batch
