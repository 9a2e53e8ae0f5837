// Recordings of closed loops as files: facts CSV and trace, in the forms that `kbc run` and `kbc test` read and write.
#pragma once

#include <string>

#include "tests/world/trial.h"

namespace kb::world {

/// `t` in seconds and a column for each fact that ever has data; a row a tick, an empty field is "no data".
[[nodiscard]] std::string facts_csv(const Recording& recording);
/// A line of JSON a tick.
[[nodiscard]] std::string trace_jsonl(const Recording& recording);

}  // namespace kb::world
