// Bug methods: a point robot that knows its own place and the goal's, and of obstacles only what it touches.
//
// Lumelsky and Stepanov, Algorithmica 2, 1987 (Bug1, Bug2); LaValle, Planning Algorithms, 12.3.3; Filimonov and Filimonov,
// Mekhatronika, Avtomatizatsiya, Upravlenie 20(11), 2019 (the modified bug). Geometry: boundary.h.
//
// All of them answer right: kReached, or kUnreachable after a closed loop that shows it. `modified_bug` in its literal mode
// is the exception: see below. Paths run along walls (Touch::kContact), from centre to centre.
#pragma once

#include <cstdint>
#include <vector>

#include "planners/boundary.h"
#include "planners/problem.h"

namespace kb::planners {

/// When the modified bug may leave a wall.
enum class LeaveRule : std::uint8_t {
  /// As printed: the way ahead is free, and the line to the goal does not enter the passed path from its right side. It has
  /// no proof, and inside rooms it spirals: it goes round again a little farther in, never crossing its path. A closed
  /// loop without a departure is kTrapped, not kUnreachable, unless the loop proves more.
  kLiteral,
  /// The same, and only at a point nearer to the goal than every hit so far; after a closed loop without such a point it
  /// goes to the nearest point of the loop, as Bug1. Complete: hits come ever nearer to the goal, and there are finitely
  /// many of them.
  kGuarded,
  /// Nearer to the goal than every hit so far, and the way ahead is free; no sign rule. Complete for the same reason.
  kNearer,
};

/// Which way to turn at a hit.
enum class HandRule : std::uint8_t {
  kLeft,         ///< always the obstacle on the left, as printed
  kRight,
  kSmallerTurn,  ///< along the wall in the direction that the robot was going; ties to the left
  kAlternate,    ///< left, right, left, ... (Rev1 of Horiuchi and Noborio)
};

struct BugOptions {
  LeaveRule leave = LeaveRule::kGuarded;
  HandRule hand = HandRule::kLeft;        ///< the method `bug` takes kSmallerTurn, which is shorter on every map we have
  std::uint64_t max_halves = 50'000'000;  ///< half cells of wall to follow before kLimit
};

// Statistics of all: steps = half cells of wall followed, and in `more`
//   "hits"            walls run into
//   "loops"           walls followed all the way round
//   "followed share"  of the path's length along walls
//   "length bound"    m, what theory grants this run; the path is never longer (a breach is kNumeric). Not where there is none

/// Follows each wall all the way round, then goes back to its point nearest to the goal. Bound (LaValle):
/// d(S, G) + 1.5 sum of the walls followed.
[[nodiscard]] Result bug1(const Problem& problem, const RunOptions& run, const BugOptions& options = {});

/// Follows each wall until it meets the line from start to goal, nearer to the goal than it left it, with the way ahead
/// free. (Filimonov and Filimonov do not say "nearer"; without it the method can loop.) Bound (Lumelsky and Stepanov):
/// d(S, G) + the sum over all walls of n p / 2, where the line meets a wall of length p n times. `options.hand` may be
/// anything: the proofs of all three do not depend on it.
[[nodiscard]] Result bug2(const Problem& problem, const RunOptions& run, const BugOptions& options = {});

/// Follows each wall until a permitted departure point: see `LeaveRule`. Bound of kGuarded and kNearer: d(S, G) + 1.5 times
/// the sum, over hits, of the wall hit. It depends on the run, for no bound from the map alone is known.
[[nodiscard]] Result modified_bug(const Problem& problem, const RunOptions& run, const BugOptions& options = {});

}  // namespace kb::planners
