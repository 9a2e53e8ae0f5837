// The rows that `kbc fleet` or `kbc experiment` wrote, read back without the knowledge base and the scenarios that led to them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "sim/batch/ending.h"

namespace kb::sim::batch {

inline constexpr std::size_t kNoNoise = static_cast<std::size_t>(-1);

struct ResultRow {
  std::string_view which, measured;    ///< of Results::which and Results::measured, with their commas
  Ending ending;
};

/// A file of results.
struct Results {
  std::vector<std::pair<std::string, std::string>> made_of;   ///< what its first comment says: `knowledge base` and its number
  std::vector<std::string> which;      ///< columns that say which run a row is: scenario, seed ... those before `outcome`
  std::size_t noise = kNoNoise;        ///< if the column `noise` is not one of them: its place among `measured`
  std::vector<std::string> measured;   ///< the columns from `outcome` on
  std::vector<ResultRow> rows;
};

/// Why a text holds no results: the bytes in question, and what is wrong with them.
struct ResultsFault {
  std::size_t begin = 0, end = 0;
  std::string what;
};

/// A field of `which` or `measured`.
[[nodiscard]] std::string_view field(std::string_view fields, std::size_t number);

/// The text must outlive the results. O(bytes).
[[nodiscard]] std::variant<Results, ResultsFault> read_results(std::string_view text);

}  // namespace kb::sim::batch
