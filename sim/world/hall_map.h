// The map of a hall, known before any robot drives through it: its walls, and what was built into it. The planners for halls find their
// way by it. Metres of the floor.
#pragma once

#include <memory>
#include <vector>

#include "planners/grid.h"
#include "sim/world/labyrinth.h"

namespace kb::sim {

struct HallMap {
  std::vector<Spot> along;                ///< its middle, from stop line to stop line
  double width_m = kHallWidth;
  double door_m = kHallDoor;              ///< how much of each end is still road
  std::vector<Picture::Wall> walls;       ///< round it, in it, and of the background
  std::vector<Pillar> pillars;

  /// The distance from `from` to the nearest surface in the direction `ahead` (of length 1), at most `most_m`. O(walls).
  [[nodiscard]] double ray(Spot from, Spot ahead, double most_m) const;
  /// The distance from a place to the nearest wall or pillar. O(walls).
  [[nodiscard]] double clearance(Spot at) const;
  /// An occupancy grid of it (Darintsev and Migranov 2012): a cell is blocked if its middle is nearer than `clearance_m` to
  /// something, or outside the hall. The doors are outside. O(cells * walls).
  [[nodiscard]] planners::Grid grid(double cell_m, double clearance_m) const;
};

/// The maps of the roads that are halls, by RoadId; null for others. O(n log n) in roads, walls and pillars, and what is on the maps.
[[nodiscard]] std::vector<std::shared_ptr<const HallMap>> maps_of_halls(const Labyrinth& labyrinth);

}  // namespace kb::sim
