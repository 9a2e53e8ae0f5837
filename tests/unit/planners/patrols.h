// Moving obstacles for tests: each walks a shortest way between two random cells, to and fro.
#pragma once

#include <cstdint>

#include "planners/dice.h"
#include "planners/movers.h"

namespace kb::planners::testing {

/// A free cell of the grid, drawn; it must have one.
[[nodiscard]] Cell free_cell(const Grid& grid, Dice& dice);

/// `count` movers with a common period (even), each somewhere on its way at step 0; none is at `spared` then. The same seed
/// gives the same movers.
[[nodiscard]] Movers make_patrols(const Grid& grid, int count, std::uint32_t period, Cell spared, std::uint64_t seed);

}  // namespace kb::planners::testing
