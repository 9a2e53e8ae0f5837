// The independent checker: says whether a path is valid on the map. It shares nothing with the planners but the grid, and a result may
// say `kReached` only if its path has passed.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "planners/grid.h"
#include "planners/movers.h"

namespace kb::planners {

/// How near to obstacles a path may come.
enum class Touch : std::uint8_t {
  kApart,    ///< touches no blocked cell, not even at a corner: no corner is cut
  kContact,  ///< may run along boundaries and round corners, as bug methods do (a point robot that feels its way), but
             ///< may not slip through between two blocked cells that touch at a corner
};

/// Why a path is not valid, and from which of its points on.
struct Objection {
  std::string_view what;
  std::size_t point = 0;
};

/// Checks that every point of the polyline lies in free space. The tolerance is 1e-9 of a cell, or four units in the last place of the
/// grid's origin if that is more, but at most 1e-3 of a cell. A path without points is not valid. O(cells that it crosses).
[[nodiscard]] std::optional<Objection> check_path(const Grid& grid, const std::vector<Point>& path, Touch touch);

/// Also checks that the path leads from within `tolerance_m` of the start to within `tolerance_m` of the goal.
[[nodiscard]] std::optional<Objection> check_path(const Grid& grid, const std::vector<Point>& path, Touch touch, Point start,
                                                  Point goal, double tolerance_m);

/// Checks a walk through space and time: each step is one legal move or a wait, and the walk never enters a mover's cell nor passes
/// through a mover. The robot is in cells[i] at step i.
[[nodiscard]] std::optional<Objection> check_walk(const Grid& grid, const Movers* movers, const std::vector<Cell>& cells);

}  // namespace kb::planners
