// What the robot's sensors say, tick by tick, as changes of facts: the same for every mind that is measured or compared.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "paper.kb.h"

namespace peers {

/// A fact's certainty factor in [-1, 1] from this tick on.
struct Change { paper::Fact fact; float value; };

/// One tick: the facts that differ from the tick before, and the time since then in microseconds.
struct Step { std::vector<Change> changes; std::uint32_t dt_us; };

/// A mission from the first tick on. A mind that is fed with it begins fresh.
struct Trace { std::string name; std::vector<Step> steps; };

/// A recording in the form of `kbc run --facts`: `t` in seconds, then a column for each fact; an empty field is 0, no data.
/// Columns of facts that the knowledge base does not have are left out. Throws std::runtime_error if there is no such file.
[[nodiscard]] Trace read_trace(const std::string& path);

/// The same mission with worse sensors: facts drop out, waver round the thresholds, and come up where nothing is, each
/// change for a random time. `seed` says how; the same seed gives the same trace. Facts of exclusive groups are left alone.
[[nodiscard]] Trace disturbed(const Trace& trace, std::uint64_t seed);

/// The paper's Table 1, the recorded missions, and each of them disturbed in `disturbances` ways, seeds 1, 2, ...
/// `sources` is the root of the project.
[[nodiscard]] std::vector<Trace> all_traces(const std::string& sources, int disturbances);

}  // namespace peers
