// Many robots that decide for themselves, move one cell a tick, and never share a cell: the decentralised step of groups.
//
// Knowledge: local range. A robot knows its cell, its goal's, and which of the eight cells round it are taken by a wall or another robot.
// All robots sense the state of tick n and choose by the same table. Then claims on cells are resolved in three phases, so that the result
// depends neither on the number of threads nor on the order of robots:
//   1  every robot writes the direction in which it wants to go into its own cell;
//   2  every robot looks round its target for others that want to go there. The first in the order of directions wins; the order begins
//      with another direction at each tick, so that no robot is always last;
//   3  the winners move.
// In each phase a robot writes only what no other robot writes, and reads only what no robot writes in that phase, so no atomics are
// needed. A robot's target was free when the robot sensed it at tick n. So no robot follows into a cell that another is leaving, and two
// robots cannot change places. A diagonal move needs both cells beside it free, of robots too, so diagonals do not cross.
//
// The rules have no memory. Robots can go in circles or block each other; `SwarmResult::outcome` reports that, and nothing cures it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planners/fuzzy_rules.h"
#include "planners/grid.h"
#include "planners/problem.h"

namespace kb::planners {

struct SwarmResult {
  Outcome outcome = Outcome::kInvalid;   ///< kReached: all arrived; kTrapped: no robot moved for 3 (W + H) ticks; kLimit; kInvalid
  Fault fault = Fault::kNone;            ///< kInvalid: of the first robot with a fault
  std::uint64_t ticks = 0;               ///< how many were run
  std::size_t arrived = 0;
  std::uint64_t makespan = 0;            ///< tick of the last arrival
  std::uint64_t flowtime = 0;            ///< sum of the ticks of arrival
  std::vector<std::uint32_t> stuck;      ///< robots that have not arrived, when kTrapped
};

class Swarm {
 public:
  struct Robot {
    Cell at, goal;
  };
  /// The table has the form of kFuzzyTable: in row g + 8 c the goal lies nearest to direction g (0 = +x, counter-clockwise), clockwise of it if
  /// c is 1, on it or counter-clockwise of it if c is 0. Bit k of the column is set if a move in direction k is not possible, whether for the
  /// cell itself or for one beside a diagonal.
  /// Each robot must be in a free cell of its own and have its goal in a free cell; otherwise `ok()` is false and `fault()` says why.
  Swarm(const Grid& grid, const FuzzyTable& table, const std::vector<Robot>& robots);
  [[nodiscard]] bool ok() const { return fault_ == Fault::kNone; }
  [[nodiscard]] Fault fault() const { return fault_; }

  /// Runs one tick for all robots, and returns how many moved. Robots that have arrived stay where they are, as obstacles. O(robots),
  /// independent of the size of the map. If the system cannot start that many threads, those that it starts share the work.
  std::size_t step(unsigned threads = 1);

  /// Runs ticks until all robots have arrived, none moves any more, or `max_ticks` is reached.
  [[nodiscard]] SwarmResult run(const RunOptions& options, std::uint64_t max_ticks, unsigned threads = 1);

  /// The robots' cells, by number of the robot.
  [[nodiscard]] std::vector<Cell> cells() const;
  [[nodiscard]] std::size_t arrived() const { return arrived_; }
  /// Memory in bytes, without the grid: 13 a robot and 2 a cell.
  [[nodiscard]] std::size_t bytes() const {
    return slots_.size() * (sizeof(Slot) + sizeof(std::uint32_t) + 1) + taken_.size() + wishes_.size();
  }

 private:
  struct Place {
    std::int16_t x, y;
  };
  struct Slot {
    Place at, goal;
  };
  struct Tally {
    std::size_t moved = 0, arrived = 0;
  };
  void choose(std::size_t first, std::size_t last);
  void resolve(std::size_t first, std::size_t last);
  [[nodiscard]] Tally move(std::size_t first, std::size_t last);
  void sort_by_place();
  [[nodiscard]] std::size_t index(Place at) const {
    return static_cast<std::size_t>((at.y + 1) * stride_ + at.x + 1);
  }

  const Grid* grid_;
  std::array<std::array<std::uint8_t, 256>, 32> table_;   // by the code of the goal's direction (fuzzy_rules.h)
  Fault fault_ = Fault::kNone;
  std::int32_t stride_;
  // By slot. Slots are kept roughly in the order of places, so that what is near in the world is near in memory.
  std::vector<Slot> slots_;
  std::vector<std::uint32_t> numbers_;
  std::vector<std::uint8_t> choices_;
  // By cell.
  std::vector<std::uint8_t> taken_;   // 0xFF: blocked, or a robot is there
  std::vector<std::uint8_t> wishes_;  // the direction in which its robot wants to go; kStandStill: none, or no robot
  std::uint64_t ticks_ = 0;
  std::size_t arrived_ = 0;
};

}  // namespace kb::planners
