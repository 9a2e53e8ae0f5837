// Many robots that go by the 72 rules (fuzzy_rules.h), each to a goal of its own, and do not see each other: runs of chance, and what a
// decision costs. Robots that must not meet are a `Swarm`.
//
// A step of all: the directions of the goals first, several robots at once; then for each robot one look at the moves that are free in
// its cell, and one at the rules.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planners/grid.h"

namespace kb::planners {

class FuzzyCrowd {
 public:
  /// The grid must outlive it, and stay as it is.
  explicit FuzzyCrowd(const Grid& grid);

  /// One more robot, or another question to an old one. Both cells must be free cells of the grid.
  void add(Cell at, Cell goal);
  void place(std::size_t robot, Cell at, Cell goal);

  /// One move of each. Who is at its goal, or has no way to go, stays. O(robots), whatever the size of the map.
  void step();

  [[nodiscard]] std::size_t size() const { return at_.size(); }
  /// Where a robot is, as an index of the grid.
  [[nodiscard]] CellIndex index(std::size_t robot) const { return at_[robot]; }
  [[nodiscard]] Cell cell(std::size_t robot) const { return grid_->cell(at_[robot]); }
  [[nodiscard]] bool arrived(std::size_t robot) const { return to_goal_[robot] == kThere; }

 private:
  // From robot to goal, both coordinates in one word: dy 2^16 + dx + 2^15. The lower half never overflows, so that one addition is
  // a move.
  static constexpr std::int32_t kThere = 1 << 15;
  struct Move {
    std::int32_t to_goal;   // what a move adds to that word
    std::int32_t index;     // ... and to the index
  };
  const Grid* grid_;
  std::array<Move, 9> moves_{};
  std::vector<std::int32_t> to_goal_;
  std::vector<CellIndex> at_;
};

}  // namespace kb::planners
