// The ending that `kbc sim --expect` demands.
#pragma once

#include <string>

#include "compiler/diagnostics/diagnostics.h"
#include "sim/mind/knowledge.h"
#include "sim/world/labyrinth.h"

namespace kb::cli {

/// Whether some drive could end as `expected`, or begin its ending with these words: see sim::describe. False (reported, KB1362) if not,
/// since such an expectation only ever fails. `any_report`: a driver of another program also reports what no knowledge base names.
[[nodiscard]] bool can_be_expected(const std::string& expected, const sim::Labyrinth& labyrinth, const sim::Knowledge& knowledge, bool any_report,
                                   diagnostics::Diagnostics& messages);

}  // namespace kb::cli
