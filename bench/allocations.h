// How often a benchmark has asked for memory: what runs on the robot must not.
#pragma once

#include <cstddef>

namespace bench {

/// Counted by every `operator new` of the program: allocations.cc replaces it.
extern std::size_t allocations;

}  // namespace bench
