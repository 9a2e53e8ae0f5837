// The result of one drive, in words and as JSON, and whether it is as expected.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "sim/drive/judge.h"

namespace kb::cli {

/// For people. `scale`: metres of the floor for a metre of the map.
[[nodiscard]] std::string print_summary(const sim::Summary& summary, double scale, double limit_s);
/// The same for programs, with a line break; docs/outputs.md describes the form. `seed`: that of the noise of this drive.
[[nodiscard]] std::string summary_json(const sim::Summary& summary, double scale, std::uint64_t seed);

/// The values of --expect and --allow.
struct Expectation {
  std::string ending;                  ///< `arrived`, `arrived at Shelf`, `stopped: Help.lost`
  std::vector<std::string> allowed;    ///< of the words that `blemishes` knows
};
/// The words that --allow takes.
[[nodiscard]] std::vector<std::string> blemishes();
/// Whether a drive that ended like this ended as the words say: the last ones may be left out, `arrived` stands for `arrived at Shelf`,
/// but none of several reports.
[[nodiscard]] bool ends_as(std::string_view ending, std::string_view words);
/// Reports an ending that differs (KB1357), things that no drive should do (KB1359), and events that never happened (KB1360).
void compare(const sim::Summary& summary, const Expectation& expected, diagnostics::Diagnostics& messages);

}  // namespace kb::cli
