// Fairway and bug (Filimonov and Filimonov 2019): the map is known, but small obstacles may stand on the way for a while that
// it does not show. Follow the fairway; where it is blocked go round by the wall, and take up the fairway again behind.
//
// Knowledge: the full map, and of what it does not show what the robot touches or sees within `range_cells`.
#pragma once

#include "planners/problem.h"

namespace kb::planners {

struct FairwayBugOptions {
  /// How far the robot sees. It may also leave a wall by a straight free line to the fairway this far behind the hit (2 p0 in
  /// the paper's terms; p0 is 3 cells by default).
  std::uint32_t range_cells = 6;
  std::uint64_t max_halves = 50'000'000;   ///< half cells of wall to follow before kLimit
};

/// `problem.grid` is the map; `actual` is the world, of the same size, in which at least the map's blocked cells are blocked.
/// At a hit the robot follows the wall, with the smaller turn first, until
///   - it meets the fairway again at a later place, with the way ahead free (the test of Bug2, with the curve for the line), or
///   - the fairway `range_cells` behind the hit lies in a free straight line.
/// After a closed loop what has been touched is entered into the map and the fairway is computed anew from where the robot
/// is. Every loop adds a cell at least, so this ends: kReached, or kUnreachable once the map shows no way.
/// `kInvalid` with kStartBlocked or kGoalBlocked if `actual` has something there. Statistics: steps = half cells of wall, and
/// in `more` "hits", "loops" (times the fairway was computed anew), "touched" (cells entered into the map).
[[nodiscard]] Result fairway_bug(const Problem& problem, const Grid& actual, const RunOptions& run,
                                 const FairwayBugOptions& options = {});

}  // namespace kb::planners
