// Several robots planned one after the other: each in space and time, round those that have been planned before it.
//
// Knowledge: full map, and every other robot's plan. Robot k plans with the cells and moves of robots 1 .. k - 1 reserved;
// if it finds no plan it goes first in the next order, at most `orders` times. This is incomplete by nature: there are groups
// that have a solution and that no order solves (two robots that must change places in a corridor with one bay, say).
//
// A robot that has arrived stays at its goal. A plan therefore ends after the last time anybody planned before it comes
// through its goal.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/genetic.h"
#include "planners/problem.h"

namespace kb::planners {

/// How one robot of a group is planned.
enum class GroupPlanner : std::uint8_t {
  kGenetic,    ///< genetic.h over (x, y, t)
  kNeural,     ///< the neural map's maximum form, unrolled over time: see `plan_timed_field`
  kSpaceTime,  ///< space-time A*: the reference
};

struct GroupProblem {
  const Grid* grid = nullptr;         ///< not owned
  std::vector<Cell> starts, goals;    ///< one of each for each robot; no two starts and no two goals the same
};

struct GroupOptions {
  GroupPlanner planner = GroupPlanner::kSpaceTime;
  std::uint32_t orders = 5;           ///< tried at most
  std::uint32_t horizon = 0;          ///< most steps of a plan; 0: 4 (W + H) more than the longest of the ways without the others
  GeneticOptions genetic = {};        ///< for kGenetic; `horizon` and `earliest_arrival` are set by the group
};

struct GroupResult {
  /// kReached: all. Otherwise what is worst of any robot: kUnreachable; kLimit; kConflict, then in no order tried.
  Outcome outcome = Outcome::kInvalid;
  Fault fault = Fault::kNone;
  /// Of each: kReached; kConflict; kUnreachable; kLimit if not got to, or if its way is longer than the horizon without the others, too.
  std::vector<Outcome> robots;
  std::vector<std::vector<Cell>> walks;      ///< of each, one cell a step; empty unless kReached
  std::uint32_t makespan = 0;                ///< steps until the last has arrived
  std::uint64_t flowtime = 0;                ///< sum of arrivals
  std::uint32_t orders = 0;                  ///< tried
};

[[nodiscard]] GroupResult plan_group(const GroupProblem& problem, const RunOptions& run, const GroupOptions& options = {});

/// Meetings in a cell, exchanges of places and crossings of diagonals among walks, counted by a map of who is where at each
/// step. Robots stay where their walks end. 0 for every result of `plan_group`.
[[nodiscard]] std::uint64_t count_conflicts(const Grid& grid, const std::vector<std::vector<Cell>>& walks);

struct TimedQuestion;
class Movers;
/// Walks up the neural map with a layer of neurons for each step of time: y(i, t) = max_j gamma w_ij y(j, t + 1), the wait
/// counting as a link of length 1, blocked neurons and reserved links at 0, the goal at 1 from its earliest arrival on. With
/// gamma = gamma* it is -ln y that is computed, the length of the shortest walk with each wait counted as 1. One sweep back
/// in time gives the equilibrium. `to_goal`: `steps_to` of the goal. Empty if there is no walk. O(cells * horizon).
[[nodiscard]] std::vector<Cell> plan_timed_field(const Grid& grid, const Movers& movers, const TimedQuestion& question,
                                                 const std::vector<std::uint32_t>& to_goal);

}  // namespace kb::planners
