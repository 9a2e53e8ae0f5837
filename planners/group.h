// Plans several robots one after the other, each in space and time and round those planned before it.
//
// Knowledge: full map, and every other robot's plan. Robot k plans with the cells and moves of robots 1 to k - 1 reserved. If it finds no
// plan, it goes first in the next order; at most `orders` orders are tried. This is incomplete by nature: some groups have a solution that
// no order finds, such as two robots that must change places in a corridor with one bay.
//
// A robot that has arrived stays at its goal. It therefore arrives only after the robots planned before it have passed that cell for the
// last time.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/genetic.h"
#include "planners/problem.h"

namespace kb::planners {

/// How one robot of a group is planned.
enum class GroupPlanner : std::uint8_t {
  kGenetic,    ///< genetic.h over (x, y, t)
  kNeural,     ///< the neural map's maximum form, unrolled over time; see `plan_timed_field`
  kSpaceTime,  ///< space-time A*: the reference
};

struct GroupProblem {
  const Grid* grid = nullptr;         ///< not owned
  std::vector<Cell> starts, goals;    ///< one of each for each robot; all starts differ, and so do all goals
};

struct GroupOptions {
  GroupPlanner planner = GroupPlanner::kSpaceTime;
  std::uint32_t orders = 5;           ///< the most orders to try
  std::uint32_t horizon = 0;          ///< the most steps of a plan; 0: 4 (W + H) more than the longest path of a robot alone
  GeneticOptions genetic = {};        ///< for kGenetic; the group sets `horizon` and `earliest_arrival`
};

struct GroupResult {
  /// kReached if all are. Otherwise the worst outcome of any robot: kUnreachable, kLimit, or kConflict (no order tried has a plan).
  Outcome outcome = Outcome::kInvalid;
  Fault fault = Fault::kNone;
  /// Of each robot: kReached, kConflict, kUnreachable, or kLimit (its turn did not come, or its path is too long for the horizon even
  /// alone).
  std::vector<Outcome> robots;
  std::vector<std::vector<Cell>> walks;      ///< of each robot, one cell a step; empty unless kReached
  std::uint32_t makespan = 0;                ///< steps until the last robot has arrived
  std::uint64_t flowtime = 0;                ///< sum of all arrivals, in steps
  std::uint32_t orders = 0;                  ///< how many were tried
};

[[nodiscard]] GroupResult plan_group(const GroupProblem& problem, const RunOptions& run, const GroupOptions& options = {});

struct TimedQuestion;
class Movers;
/// Walks up the neural map with a layer of neurons for each time step: y(i, t) = max_j gamma w_ij y(j, t + 1). A wait counts as a link of
/// length 1, blocked neurons and reserved links are 0, and the goal is 1 from its earliest arrival on. What is computed is -ln y with
/// gamma = gamma*, the length of the shortest walk with each wait counted as 1. One sweep back in time gives the equilibrium. That walk is the
/// shortest of those that take at most 8 steps more than the robot alone would, or, if there is none, 32, 128, ... up to the horizon. `to_goal`
/// is `steps_to` of the goal. Empty if there is no walk. O(cells * horizon).
[[nodiscard]] std::vector<Cell> plan_timed_field(const Grid& grid, const Movers& movers, const TimedQuestion& question,
                                                 const std::vector<std::uint32_t>& to_goal);

}  // namespace kb::planners
