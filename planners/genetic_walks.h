// Walks of the genetic planner, and the operators that make walks from walks. Every operator gives a legal walk from the same start to
// the same goal.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/dice.h"
#include "planners/genetic.h"
#include "planners/grid.h"

namespace kb::planners {

using Walk = std::vector<CellIndex>;

class WalkOperators {
 public:
  /// With `waits` a walk may stay in a cell and come back to it; `erase_loops` removes both.
  WalkOperators(const Grid& grid, bool waits);

  /// A random walk through cells that it has not visited: to the one nearest to `to` with the chance `greed`, otherwise to any, and one
  /// step back if there is none. Loops are erased. False if it takes more than `cap` steps. (The paper says only "trajectories that join
  /// start and goal". A walk that remembers where it was finds a path if there is one.)
  bool walk(CellIndex from, CellIndex to, double greed, std::uint32_t cap, Dice& dice, Walk& out);

  /// Cuts every loop, and every stretch between two nodes that one legal move joins ("smoothing" drops node i if nodes i - 1 and i + 1 are
  /// neighbours; this does so for any number of nodes at once). True if the walk became shorter.
  bool erase_loops(Walk& walk);

  /// Replaces the stretch between two random nodes at most 40 apart by a straight digital line, if the line is legal and not longer.
  void straighten(Walk& walk, Dice& dice);

  /// Makes a child from the head of one walk up to a cell that both visit, and the tail of the other from there. The cell is random, or the
  /// one that makes the child shortest. Without a common cell, two nodes at most 3 cells apart are joined by a digital line. If that fails
  /// too, the child is a copy of the first walk.
  void cross(const Walk& head, const Walk& tail, Dice& dice, Walk& child);

  /// Replaces the stretch between two random nodes at most 30 apart by a random walk. With waits, may instead stay a step longer or shorter
  /// somewhere.
  void mutate(Walk& walk, Dice& dice);
  /// Replaces the stretch between two given nodes by a random walk.
  bool reroute(Walk& walk, std::size_t i, std::size_t j, Dice& dice);

  /// Steps aside from node i into a random neighbour, stays there for some steps and comes back, to let another robot pass in a corridor.
  /// Nothing changes if there is no neighbour.
  void step_aside(Walk& walk, std::size_t i, std::size_t steps, Dice& dice);

  /// Direction of the move between two neighbours, 0 to 7; 8 if they are the same cell.
  [[nodiscard]] int direction(CellIndex from, CellIndex to) const;

 private:
  bool line(CellIndex from, CellIndex to, std::uint32_t order, Walk& out) const;
  bool join_nearby(const Walk& head, const Walk& tail, Dice& dice, Walk& child);
  std::size_t shortest_cut(const Walk& head, const Walk& tail);
  void mark(const Walk& walk);   // last place of each cell
  [[nodiscard]] bool marked(CellIndex at) const { return mark_[at] == stamp_; }
  void new_stamp();

  const Grid* grid_;
  bool waits_;
  std::int32_t stride_;
  std::vector<std::uint32_t> mark_, place_;
  std::uint32_t stamp_ = 0;
  Walk scratch_, other_;
  std::vector<double> head_length_, tail_length_;
  std::vector<std::size_t> common_;
};

}  // namespace kb::planners
