// A* through space and time: the reference for planners among moving obstacles.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/grid.h"
#include "planners/movers.h"

namespace kb::planners {

struct TimedQuestion {
  Cell from = {}, to = {};
  std::uint32_t earliest_arrival = 0;   ///< steps; before, the goal is not free for good
  std::uint32_t horizon = 1024;         ///< the most steps of a walk
};

/// Steps to the goal without moving obstacles, by index; `kNoWay` if there is no path. A diagonal is one step. O(cells).
inline constexpr std::uint32_t kNoWay = 0xFFFFFFFFu;
[[nodiscard]] std::vector<std::uint32_t> steps_to(const Grid& grid, Cell goal);

/// The cells, one a step, of a walk of legal moves and waits that arrives as early as possible without meeting a mover or changing places
/// with one. Of equally early walks it is not necessarily the shortest. Empty if there is none within the horizon. `distances` are
/// `steps_to(grid, question.to)`; one array serves all robots with the same goal. Takes O(cells * steps) time at worst, and as memory a bit
/// for each cell and step that the search reaches, and 12 bytes for each state.
[[nodiscard]] std::vector<Cell> search_space_time(const Grid& grid, const Movers& movers, const TimedQuestion& question,
                                                  const std::vector<std::uint32_t>& distances);

}  // namespace kb::planners
