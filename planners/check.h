// The independent checker: says whether a path holds against the map. It shares nothing with the planners but the grid, and
// no result may say `kReached` that it has not passed.
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
  kContact,  ///< may run along boundaries and round corners (bug methods: a point robot that feels its way); may not
             ///< slip through between two blocked cells that touch at a corner
};

/// Why a path does not hold, and from which of its points on.
struct Objection {
  std::string_view what;
  std::size_t point = 0;
};

/// Every point of the polyline lies in free space. Tolerance: 1e-9 of a cell, or four units in the last place of the grid's origin
/// where that is more, but at most 1e-3. A path of no point does not hold.
/// O(cells that it crosses).
[[nodiscard]] std::optional<Objection> check_path(const Grid& grid, const std::vector<Point>& path, Touch touch);

/// The same, and that it leads from within `tolerance_m` of the start to within `tolerance_m` of the goal.
[[nodiscard]] std::optional<Objection> check_path(const Grid& grid, const std::vector<Point>& path, Touch touch, Point start,
                                                  Point goal, double tolerance_m);

/// A walk through space and time: one legal move (or a wait) each step, never in a mover's cell, never through one. The
/// robot is in cells[i] at step first + i.
[[nodiscard]] std::optional<Objection> check_walk(const Grid& grid, const Movers* movers, const std::vector<Cell>& cells,
                                                  std::uint64_t first = 0);

}  // namespace kb::planners
