// Rules of the user's own in `kbc experiment`: whether they fit, and what tells them from others.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/experiment/results.h"
#include "tools/kbc/support.h"

namespace kb::cli {

/// What `--mind FILE=NAME` and `--mind FILE` (whose name is the file's without its end) say, as methods. Nothing if a name cannot
/// stand in the results or is there already (reported).
[[nodiscard]] std::optional<std::vector<sim::experiment::Method>> read_minds(const std::vector<std::string>& options, Session& session);

/// Compiles the first mission of the experiment with each mind, and reads its scenario with all that is set. The fingerprint of each
/// mind by its name; nothing if something is wrong (reported, with warnings).
[[nodiscard]] std::optional<sim::experiment::Results::Minds> check_minds(const sim::experiment::Setup& setup, const std::vector<sim::experiment::Method>& minds,
                                                                       Session& session);

}  // namespace kb::cli
