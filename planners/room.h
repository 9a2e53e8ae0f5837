// Room for a robot: how far it is to what is blocked, and obstacles that have grown by its radius.
#pragma once

#include <vector>

#include "planners/grid.h"

namespace kb::planners {

/// Distance from each cell's centre to the nearest blocked cell's centre, in cells; 0 for blocked cells. The border counts as
/// blocked. Entries by index. Exact (two passes of parabolas: Felzenszwalb and Huttenlocher, Theory of Computing 8, 2012).
/// O(cells).
[[nodiscard]] std::vector<float> distance_to_blocked(const Grid& grid);

/// How near any point of a cell comes to a blocked cell's square, m; 0 for those that touch one, and for blocked ones. The border
/// counts as blocked. Entries by index. O(cells).
[[nodiscard]] std::vector<float> room_of_cells(const Grid& grid);

/// The grid without the cells any point of which is nearer than the radius, m, to a blocked one: wherever within free cells a path
/// leads, along their rims too, it keeps the radius. The edge of the map counts as an obstacle. O(cells).
[[nodiscard]] Grid inflate(const Grid& grid, double robot_radius_m);

}  // namespace kb::planners
