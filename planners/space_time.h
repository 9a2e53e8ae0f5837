// A* through space and time: the reference among moving obstacles.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/grid.h"
#include "planners/movers.h"

namespace kb::planners {

struct TimedQuestion {
  Cell from = {}, to = {};
  std::uint64_t first_step = 0;         ///< of time, at `from`
  std::uint32_t earliest_arrival = 0;   ///< steps; the goal is not free for good before
  std::uint32_t horizon = 1024;         ///< most steps
};

/// Steps to the goal without moving obstacles, for each index; `kNoWay` where there is none. A diagonal is one step. O(cells).
inline constexpr std::uint32_t kNoWay = 0xFFFFFFFFu;
[[nodiscard]] std::vector<std::uint32_t> steps_to(const Grid& grid, Cell goal);

/// The cells of a walk of legal moves and waits, one a step, that arrives as early as possible without meeting a mover or
/// changing places with one; of equally early ones no shortest is sought. Empty if there is none within the horizon.
/// `distances` are `steps_to(grid, question.to)`; one array serves all robots with the same goal.
/// Time O(cells * steps) at worst, memory a bit for each cell and step that the search gets to, and 12 bytes for each state.
[[nodiscard]] std::vector<Cell> search_space_time(const Grid& grid, const Movers& movers, const TimedQuestion& question,
                                                  const std::vector<std::uint32_t>& distances);

}  // namespace kb::planners
