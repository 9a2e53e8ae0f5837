// Fairway and bug (Filimonov and Filimonov 2019): the map is known, but for a while small obstacles that it does not show may stand in the
// path. The robot follows the fairway, goes round by the wall where it is blocked, and takes up the fairway again beyond.
//
// Knowledge: the full map; of what it does not show, only what the robot touches or sees within 6 cells.
#pragma once

#include "planners/problem.h"

namespace kb::planners {

/// `problem.grid` is the map; `actual` is the world, of the same size, in which at least the map's blocked cells are blocked.
/// At a hit the robot follows the wall, with the smaller turn first, until
///   - it meets the fairway again at a later place with a free path ahead (the test of Bug2, with the curve for the line), or
///   - the point of the fairway 6 cells beyond the hit (2 p0 in the paper's terms) lies in a free straight line.
/// After a closed loop the robot enters what it has touched into the map, and computes the fairway anew from where it is. Every loop adds
/// at least one cell, so this ends: kReached, or kUnreachable once the map shows no path. `kInvalid` with kStartBlocked or kGoalBlocked
/// if `actual` is blocked there. Statistics: steps = half cells of wall, and in `more` "hits", "loops" (how often the fairway was
/// computed anew) and "touched" (cells entered into the map).
[[nodiscard]] Result fairway_bug(const Problem& problem, const Grid& actual, const RunOptions& run);

}  // namespace kb::planners
