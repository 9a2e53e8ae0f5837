// Rules that never fire on the same tick because of when they can.
#pragma once

#include "compiler/analysis/subject.h"

namespace kb::analysis {

/// Whether one of two rules of a level has always fired before the other can: on the tick before, since the other waits for what it asks for, or
/// on the first tick, which makes no events. `false` means only that this is no reason. O(parts of both conditions).
[[nodiscard]] bool apart_in_time(const Subject& subject, const program::Rule& a, const program::Rule& b);

}  // namespace kb::analysis
