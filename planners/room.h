// Room for a robot: distances to blocked cells, and a grid whose obstacles have grown by the robot's radius.
#pragma once

#include <vector>

#include "planners/grid.h"

namespace kb::planners {

/// Distance from each cell's centre to the nearest blocked cell's centre, in cells; 0 for blocked cells. The border counts as
/// blocked. Entries by index. Exact (two passes of parabolas: Felzenszwalb and Huttenlocher, Theory of Computing 8, 2012).
/// O(cells).
[[nodiscard]] std::vector<float> distance_to_blocked(const Grid& grid);

/// The least distance of any point of a cell to the square of a blocked cell, m; 0 for blocked cells and those that touch one. The border
/// counts as blocked. Entries by index. O(cells).
[[nodiscard]] std::vector<float> room_of_cells(const Grid& grid);

/// Blocks every cell that has a point nearer than the radius, m, to a blocked cell. A path keeps the radius wherever it leads through
/// cells that stay free, even along their rims. The edge of the map counts as an obstacle. O(cells).
[[nodiscard]] Grid inflate(const Grid& grid, double robot_radius_m);

}  // namespace kb::planners
