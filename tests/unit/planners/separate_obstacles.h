// Worlds of obstacles that stand apart, as the papers on bug methods assume them: random rectangles, ells, cups and discs,
// no two of which touch, nor the border.
#pragma once

#include <cstdint>

#include "planners/grid.h"

namespace kb::planners::testing {

struct SeparateObstacles {
  std::int32_t side = 100;        ///< of the world, cells
  int count = 40;
  std::int32_t least = 4, most = 14;  ///< extent of an obstacle, cells
};

struct ObstacleWorld {
  Grid grid;
  Cell start, goal;   ///< free, and at least 0.6 sides apart
  int placed = 0;     ///< fewer than asked for if there was no room
};
/// The same seed gives the same world on every machine.
[[nodiscard]] ObstacleWorld make_separate_obstacles(const SeparateObstacles& kind, std::uint64_t seed);

}  // namespace kb::planners::testing
