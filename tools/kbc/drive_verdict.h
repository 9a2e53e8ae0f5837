// What came of one drive, in words and as JSON, and whether it is what was expected.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "sim/drive/judge.h"

namespace kb::cli {

/// For people. `scale`: metres of the floor for a metre of the map.
[[nodiscard]] std::string print_summary(const sim::Summary& summary, double scale, double limit_s);
/// The same for programs, with a line's end; the form is told in docs/simulator.md.
[[nodiscard]] std::string summary_json(const sim::Summary& summary, double scale);

/// What --expect and --allow say.
struct Expectation {
  std::string ending;                  ///< `arrived`, `arrived at Shelf`, `stopped: Help.lost`
  std::vector<std::string> allowed;    ///< of the words that `blemishes` knows
};
/// What --allow takes.
[[nodiscard]] std::vector<std::string> blemishes();
/// Reports another ending (KB1357), what no drive should do (KB1359), and events that never happened (KB1360).
void compare(const sim::Summary& summary, const Expectation& expected, diagnostics::Diagnostics& messages);

}  // namespace kb::cli
