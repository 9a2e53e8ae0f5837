// Where robots of a group are in each other's way, by a map of who is where that no planner shares.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/grid.h"

namespace kb::planners::testing {

/// Looks at one step of all robots after the other. Keep one for many steps: it has four bytes a cell, and a step costs O(robots).
class Meetings {
 public:
  /// The grid must outlive the object.
  explicit Meetings(const Grid& grid) : grid_(&grid), holders_(grid.size(), 0) {}
  /// Counts robots that go into a blocked cell or one that another goes into as well, that change places with another, or whose diagonal
  /// crosses another's. Of two that change places or cross each counts. Cells by number of the robot.
  [[nodiscard]] std::uint64_t between(const std::vector<Cell>& before, const std::vector<Cell>& now);

 private:
  const Grid* grid_;
  std::vector<std::uint32_t> holders_;   // by cell: robot + 1
};

/// The same for all steps of walks. Robots stay where their walks end; an empty walk is no robot.
[[nodiscard]] std::uint64_t count_conflicts(const Grid& grid, const std::vector<std::vector<Cell>>& walks);

}  // namespace kb::planners::testing
