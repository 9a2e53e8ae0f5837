// Ten situations that a faithful system must get right, as recorded facts and the trace that must come of them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tests/world/trial.h"

namespace kb::world {

struct GoldenTrace {
  std::string folder;   ///< under tests/golden/traces/
  std::string says;     ///< what is tested: one sentence
  std::function<Finding(const Setting&)> run;   ///< drives the closed loop; the setting's recording is what is kept
};
[[nodiscard]] std::vector<GoldenTrace> golden_traces();

/// The files of a golden trace; `mission_kb` begins with what is tested, and binds the strategies to controllers.
struct GoldenFiles { std::string mission_kb, facts_csv, trace_jsonl, readme; };
/// Runs the closed loop and writes it down. Throws std::runtime_error if the run itself went wrong.
[[nodiscard]] GoldenFiles record(const GoldenTrace& golden, MindKind mind);

}  // namespace kb::world
