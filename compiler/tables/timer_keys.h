// Keys that identify timers across knowledge bases.
#pragma once

#include <vector>

#include <waymark/runtime/image_layout.h>
#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// note [keys of timers]
/// A timer is the same in two knowledge bases if its level has the same name, its duration is the same, and its condition is built
/// in the same way from terms and sightings of cells with the same names; the order of parts of an `and` or `or` does not count.
/// The key is a 64-bit hash of that. Among a thousand timers of a robot, two different ones share a key with a probability below
/// 10^-13.
///
/// The keys of all timers, by timer. O(tables).
[[nodiscard]] std::vector<mts::TimerKey> timer_keys(const Tables& tables, const program::Program& program);

}  // namespace kb::tables
