// Demands on counts of runs: `arrived>=95%,collisions=0`.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kb::sim::batch {

/// How many of some runs must be of a kind, or which share of them.
struct Demand {
  enum class Sign : std::uint8_t { kAtLeast, kAtMost, kAbove, kBelow, kExactly } sign{};
  std::string text;         ///< as written
  std::size_t kind = 0;     ///< index into the names of what can be counted
  std::uint64_t number = 0, scale = 1;   ///< runs, or percent of them times `scale`, which is 10 for one decimal place
  bool share = false;
};

/// Reads demands separated by commas, on what `names` can be counted. Nothing if one is malformed; `why` then says what is wrong.
[[nodiscard]] std::optional<std::vector<Demand>> read_demands(std::string_view text, std::span<const std::string_view> names, std::string& why);

/// Whether `count` of `runs` meets it; `runs` is at most kMostRuns (batch.h).
[[nodiscard]] bool holds(const Demand& demand, std::size_t count, std::size_t runs);

/// A demand that a row of a table does not meet.
struct Unmet {
  std::size_t row = 0;           ///< index
  std::string demand, found;     ///< `arrived>=95%`, `59 of 160 runs (36.9 %)`
};
[[nodiscard]] Unmet unmet_by(const Demand& demand, std::size_t row, std::size_t count, std::size_t runs);

}  // namespace kb::sim::batch
