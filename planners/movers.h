// Moving obstacles: which cells they occupy at each time step.
//
// Time goes in steps, and the motion repeats after `period` steps (Darintsev and Migranov: the time step of the genetic planner is a
// multiple of the period on which the obstacles' motion is defined). A mover occupies whole cells.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/grid.h"

namespace kb::planners {

class Movers {
 public:
  /// Without movers. `period` is at least 1; a lower value counts as 1.
  Movers(const Grid& grid, std::uint32_t period);

  /// Adds a mover that is at `route[t % period]` at step t. A route shorter than the period is repeated. Cells outside the grid are
  /// skipped. O(period).
  void add(const std::vector<Cell>& route);

  [[nodiscard]] std::uint32_t period() const { return period_; }
  /// Whether a mover is in the cell at step t.
  [[nodiscard]] bool taken(Cell cell, std::uint64_t t) const {
    return grid_->contains(cell) && bit(grid_->index(cell), t % period_);
  }
  /// Whether a robot that goes from `from` to `to` between t and t + 1 would meet a mover on the move: one that goes from `to` to
  /// `from`, or crosses the robot's diagonal.
  [[nodiscard]] bool swaps(Cell from, Cell to, std::uint64_t t) const;

 private:
  struct Step {
    CellIndex from, to;
  };
  [[nodiscard]] bool bit(CellIndex at, std::uint64_t phase) const {
    const std::uint64_t i = phase * grid_->size() + at;
    return (planes_[static_cast<std::size_t>(i / 64)] >> (i % 64) & 1u) != 0;
  }
  const Grid* grid_;
  std::uint32_t period_;
  std::vector<std::uint64_t> planes_;        // a bit for each cell and phase
  std::vector<std::vector<Step>> moves_;     // of each phase, sorted
};

}  // namespace kb::planners
