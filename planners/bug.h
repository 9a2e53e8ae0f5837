// Bug methods, for a point robot that knows its own place and the goal's, and of obstacles only what it touches.
//
// Lumelsky and Stepanov, Algorithmica 2, 1987 (Bug1, Bug2); LaValle, Planning Algorithms, 12.3.3; Filimonov and Filimonov,
// Mekhatronika, Avtomatizatsiya, Upravlenie 20(11), 2019 (the modified bug). Geometry: boundary.h.
//
// All of them answer correctly: kReached, or kUnreachable after a closed loop that proves it. The exception is `modified_bug` in its
// literal mode (see below). Paths run along walls (Touch::kContact) and lead from centre to centre.
#pragma once

#include <cstdint>

#include "planners/boundary.h"
#include "planners/problem.h"

namespace kb::planners {

/// When the modified bug may leave a wall.
enum class LeaveRule : std::uint8_t {
  /// As printed: the path ahead is free, and the line to the goal does not enter the passed path from its right side. It ends, but whether it finds each
  /// way that there is has no proof: inside rooms the robot spirals: it goes round again a little farther in, never crossing its path. A closed loop without a
  /// departure is kTrapped, not kUnreachable, unless the loop proves more.
  kLiteral,
  /// The same, but only at a point nearer to the goal than every hit so far. After a closed loop without such a point the robot goes to the
  /// nearest point of the loop, as in Bug1. Complete, since hits come ever nearer to the goal and there are finitely many of them.
  kGuarded,
  /// At a point nearer to the goal than every hit so far, if the path ahead is free; no sign rule. Complete for the same reason.
  kNearer,
};

/// Which way to turn at a hit.
enum class HandRule : std::uint8_t {
  kLeft,         ///< the obstacle always on the left, as printed
  kRight,
  kSmallerTurn,  ///< along the wall more in the direction in which the robot was going; ties to the left
  kAlternate,    ///< left, right, left, ... (Rev1 of Horiuchi and Noborio)
};

struct BugOptions {
  LeaveRule leave = LeaveRule::kGuarded;
  HandRule hand = HandRule::kLeft;        ///< the method `bug` takes kSmallerTurn, which is shorter on every map we have
  std::uint64_t max_halves = 50'000'000;  ///< half cells of wall to follow before kLimit
};

// The statistics of all three: steps = half cells of wall followed, and in `more`
//   "hits"            how many walls were hit
//   "loops"           how many walls were followed all the way round
//   "followed share"  the share of the path's length that runs along walls
//   "length bound"    m, what theory grants this run, if there is a bound; the path is never longer (a breach is kNumeric)

/// Follows each wall all the way round, then goes back to its point nearest to the goal. Bound (LaValle): d(S, G) + 1.5 times the sum of
/// the walls followed.
[[nodiscard]] Result bug1(const Problem& problem, const RunOptions& run, const BugOptions& options = {});

/// Follows each wall until it meets the line from start to goal at a point nearer to the goal than where it left the line, with the path
/// ahead free. (Filimonov and Filimonov do not say "nearer"; without it the method can loop.) Bound (Lumelsky and Stepanov): d(S, G) + the
/// sum over all walls of n p / 2, where p is the length of a wall and n how often the line meets it. Any `options.hand` will do: the proofs
/// of all three methods do not depend on it.
[[nodiscard]] Result bug2(const Problem& problem, const RunOptions& run, const BugOptions& options = {});

/// Follows each wall until a permitted departure point (see `LeaveRule`). Bound of kGuarded and kNearer: d(S, G) + 1.5 times the sum, over
/// hits, of the wall hit. It depends on the run; no bound from the map alone is known.
[[nodiscard]] Result modified_bug(const Problem& problem, const RunOptions& run, const BugOptions& options = {});

}  // namespace kb::planners
