// What tells timers apart across knowledge bases.
#pragma once

#include <vector>

#include <waymark/runtime/image_layout.h>
#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// note [keys of timers]
/// A timer is the same in two knowledge bases if its level has the same name, its duration is the same, and its condition
/// is put together in the same way of terms and sightings of cells of the same names; the order of the parts of an `and` or
/// `or` does not count. The key is 64 bits of that, so that two different timers of a robot share one with a probability
/// below 10^-13 for a thousand timers.
///
/// The key of every timer, by timer. O(tables).
[[nodiscard]] std::vector<mts::TimerKey> timer_keys(const Tables& tables, const program::Program& program);

}  // namespace kb::tables
