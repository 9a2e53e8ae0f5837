// The fairway method (Filimonov and Filimonov 2019): of the lines of force that end at the goal, take the one nearest to the start, go to
// it, and let the field do the rest. The paper gives no algorithm; on the grid there is a simple one, which differs in its third step:
//
//  1. Every free cell points to the legal neighbour with the steepest descent of U; neighbours of the goal point to the goal.
//  2. The basin B of the goal is the set of cells whose pointers lead there: a search backwards from the goal, O(cells).
//  3. The approach leads from the start to the first cell of B on it, such that approach and pointers together are shortest. (The cell
//     of B that is nearest to the start, which is the paper's choice, can be one from which the pointers lead a long way round.)
//
// The method is complete on the grid, since the goal is in B. If B is small, it is a shortest-path search under another name; the share
// of the approach says to what degree.
#pragma once

#include <limits>

#include "planners/potential.h"

namespace kb::planners {

/// The potential (1) of potential.h, conic, with default parameters, in cells. Distances to obstacles are counted in moves (chamfer), which
/// is good enough for pointers at a tenth of the cost of exact distances. Entries by index; infinite for blocked cells. A `watch` that
/// says stop ends this and the computations below, and then what they return is no answer.
[[nodiscard]] std::vector<float> cell_potential(const Grid& grid, Cell goal, Watch* watch = nullptr);

struct Basin {
  std::vector<std::uint8_t> pointer;   ///< by index: direction of the steepest descent, or kNoPointer
  std::vector<float> rest;             ///< by index: length of the way by the pointers to the goal, in cells; infinite if they do not lead there
  std::size_t cells = 0;               ///< how many are inside
  [[nodiscard]] bool has(CellIndex at) const { return rest[at] < std::numeric_limits<float>::infinity(); }
  static constexpr std::uint8_t kNoPointer = 255;
};
[[nodiscard]] Basin find_basin(const Grid& grid, Cell goal, const std::vector<float>& potential, Watch* watch = nullptr);

/// Approach and chain of pointers, as cells; the first `approach` moves are the approach. Empty if there is no path.
struct Fairway {
  std::vector<Cell> cells;
  std::size_t approach = 0;
  std::size_t basin_cells = 0;
};
[[nodiscard]] Fairway find_fairway(const Grid& grid, Cell start, Cell goal, Watch* watch = nullptr);

}  // namespace kb::planners
