// The fairway method (Filimonov and Filimonov 2019): among the lines of force that end at the goal take the one nearest to
// the start, go to it, and let the field do the rest. The paper gives no algorithm; on the grid there is a plain one:
//
//  1. Every free cell points to the legal neighbour with the steepest descent of U; neighbours of the goal point to it.
//  2. The basin B of the goal is what leads there by these pointers: a search backwards from the goal, O(cells).
//  3. The approach is a shortest path from the start to the nearest cell of B; then the pointers lead on.
//
// Complete on the grid, for the goal is in B. Where B is small the method is a shortest-path search under another name: the
// share of the approach says how much so.
#pragma once

#include "planners/potential.h"

namespace kb::planners {

/// The potential of (1), conic, with the parameters that potential.h has by itself, in cells, with the distance to obstacles counted in moves (chamfer): good enough for
/// pointers, and a tenth of the cost of exact distances. Entries by index; infinite for blocked cells.
[[nodiscard]] std::vector<float> cell_potential(const Grid& grid, Cell goal);

struct Basin {
  std::vector<std::uint8_t> pointer;   ///< by index: the direction of steepest descent, or kNoPointer
  std::vector<std::uint8_t> inside;    ///< 1: leads to the goal
  std::size_t cells = 0;               ///< how many do
  static constexpr std::uint8_t kNoPointer = 255;
};
[[nodiscard]] Basin find_basin(const Grid& grid, Cell goal, const std::vector<float>& potential);

/// Approach and chain of pointers as cells; `approach` is how many of its moves are approach. Empty: no way.
struct Fairway {
  std::vector<Cell> cells;
  std::size_t approach = 0;
  std::size_t basin_cells = 0;
};
[[nodiscard]] Fairway find_fairway(const Grid& grid, Cell start, Cell goal);

}  // namespace kb::planners
