// From the size of things to a grid: the step of the grid, blocked cells of shapes, and room for the robot.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "planners/grid.h"

namespace kb::planners {

/// The safety coefficient of the step of the grid: 1.1 to 1.5 in the paper; the middle, where it says nothing.
inline constexpr double kDefaultEta = 1.25;

/// The step of the grid, dS = eta * L_min (Darintsev and Migranov 2012, who number no equations): L_min is the smallest overall dimension among
/// robots and obstacles, m. Nothing for an eta below 1, or for a dimension that is not positive and finite. A square robot that turns on
/// the spot stays within its cell with an eta of at least sqrt(2).
struct GridStep {
  double cell_m = 0.0;
  bool eta_unusual = false;   ///< outside of the paper's 1.1 to 1.5
};
[[nodiscard]] std::optional<GridStep> grid_step(double least_dimension_m, double eta = kDefaultEta);

/// How many cells obstacles must grow so that the centre of a robot of this radius may be anywhere in a free cell's centre:
/// max(0, ceil((R - dS/2) / dS)). Wanted where L_min was an obstacle's and the robot is larger than a cell.
[[nodiscard]] std::int32_t inflation_cells(double robot_radius_m, double cell_m);

enum class InflationShape : std::uint8_t {
  kSquare,     ///< by whole cells in all eight directions
  kEuclidean,  ///< cells whose centre is nearer than the radius to a blocked cell's square
  kWhole,      ///< cells of which any point is: wherever within free cells a path leads, along their rims too, it keeps the radius
};
/// How near any point of a cell comes to a blocked cell's square, m; 0 for those that touch one, and for blocked ones. The border
/// counts as blocked. Entries by index. O(cells).
[[nodiscard]] std::vector<float> room_of_cells(const Grid& grid);
/// The grid with obstacles grown by a robot's radius. The edge of the map counts as an obstacle. O(cells).
[[nodiscard]] Grid inflate(const Grid& grid, double robot_radius_m, InflationShape shape = InflationShape::kEuclidean);

/// Blocks every cell that a convex polygon covers a part of (corners in order, either way; m). Touching a cell's edge covers
/// nothing. Conservative: a shape smaller than a cell blocks the cells that it lies in.
void block_polygon(Grid& grid, std::span<const Point> corners);
/// The same for a disc.
void block_disc(Grid& grid, Point centre, double radius_m);

/// Distance from each cell's centre to the nearest blocked cell's centre, in cells; 0 for blocked cells. The border counts as
/// blocked. Entries by index. Exact (two passes of parabolas: Felzenszwalb and Huttenlocher, Theory of Computing 8, 2012).
/// O(cells).
[[nodiscard]] std::vector<float> distance_to_blocked(const Grid& grid);

}  // namespace kb::planners
