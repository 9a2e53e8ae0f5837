// Many robots that follow the 72 rules (fuzzy_rules.h), each to a goal of its own, without seeing each other. For random runs, and for
// measuring what a decision costs. For robots that must not meet, use `Swarm`.
//
// A step first computes the directions of all goals, several robots at once. Then each robot looks up the free moves of its cell, and
// the decision in the rules.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "planners/grid.h"

namespace kb::planners {

class FuzzyCrowd {
 public:
  /// The grid must outlive the crowd and must not change.
  explicit FuzzyCrowd(const Grid& grid);

  /// `add` adds a robot; `place` gives an old one a new start and goal. Both cells must be free cells of the grid.
  void add(Cell at, Cell goal);
  void place(std::size_t robot, Cell at, Cell goal);

  /// Moves each robot once. A robot that is at its goal or cannot move stays. O(robots), whatever the size of the map.
  void step();

  [[nodiscard]] std::size_t size() const { return at_.size(); }
  /// Where a robot is, as an index of the grid.
  [[nodiscard]] CellIndex index(std::size_t robot) const { return at_[robot]; }
  [[nodiscard]] Cell cell(std::size_t robot) const { return grid_->cell(at_[robot]); }
  [[nodiscard]] bool arrived(std::size_t robot) const { return to_goal_[robot] == kThere; }

 private:
  // From robot to goal, both coordinates in one word: dy 2^16 + dx + 2^15. The lower half never overflows, so a move is one addition.
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
