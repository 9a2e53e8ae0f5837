// The user's own rules in `kbc experiment`: whether they fit, and their fingerprints.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/experiment/results.h"
#include "tools/kbc/support.h"

namespace kb::cli {

/// The methods given with `--mind FILE=NAME` and `--mind FILE` (named after the file without its extension). Nothing if a name cannot
/// stand in the results or is taken already (reported).
[[nodiscard]] std::optional<std::vector<sim::experiment::Method>> read_minds(const std::vector<std::string>& options, Session& session);

/// Compiles the first mission of the experiment with each mind, and reads its scenario with all settings. Returns each mind's fingerprint
/// by name; nothing if something is wrong (reported, with warnings).
[[nodiscard]] std::optional<sim::experiment::Results::Minds> check_minds(const sim::experiment::Setup& setup, const std::vector<sim::experiment::Method>& minds,
                                                                       Session& session);

}  // namespace kb::cli
