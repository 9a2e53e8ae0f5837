// The files of one scenario of an experiment, to be driven with `kbc sim`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "sim/experiment/runs.h"
#include "tools/kbc/support.h"

namespace kb::cli {

/// The method whose mission is to be written: the one that `named` names, else the first of the user's minds, else `mts`. Null (reported) if they
/// are several, or if it drives by no knowledge base.
[[nodiscard]] const sim::experiment::Method* method_to_show(const sim::experiment::Setup& setup, const std::vector<std::string>& named, Session& session);

/// Writes `mission.kb` and `scenario.toml` into the folder. A file that is there with other contents is left alone. The exit code.
[[nodiscard]] int show_scenario(const sim::experiment::Setup& setup, const sim::experiment::Method& method, std::uint32_t scenario, const std::string& folder,
                                Session& session);

}  // namespace kb::cli
