// The 72 fuzzy rules of Darintsev and Migranov (2012) as a table: eight terms of the angular deviation from the goal, nine
// nested rules for each. The paper gives the structure and not the rules; the rules are ours.
//
// Inputs: A, a bit for each of eight sensors that look at heading + k * 45 degrees (1: obstacle; for a diagonal also if a cell
// beside it is blocked), and b, the deviation of the goal's direction from the heading. The terms of b lie at k * 45 degrees;
// memberships are triangles of half-width 45 degrees: at most two of them are not zero, and they sum to 1.
//
// For the term g the directions are tried in order of their deviation from it,
//   o = (0, +s, -s, +2s, -2s, +3s, -3s, 4),   s = +1 if b is past the middle of the term counter-clockwise, or just there,
//                                             else -1
//   R(g, 1)         if g + o0 is free                                        then go to g + o0
//   R(g, m), m<9    if g + o0 ... g + o(m-2) are blocked, g + o(m-1) free    then go to g + o(m-1)
//   R(g, 9)         if all are blocked                                      then stop
// Exactly one of the nine holds for each A; 8 * 9 = 72.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "planners/geometry.h"

namespace kb::planners {

/// The direction of a decision that there is none: stop.
inline constexpr std::uint8_t kStandStill = 8;

/// The offset tried as number `rank` (0 to 7) on side `s` (+1 or -1), in 0 to 7.
[[nodiscard]] constexpr int fuzzy_offset(int rank, int s) {
  const int size = (rank + 1) / 2;
  return ((rank % 2 == 1 ? s : -s) * size + 8) % 8;
}

/// fuzzy_table()[g + 8 * (s < 0)][A]: the direction, or kStandStill. 4 KiB, made when compiling.
using FuzzyTable = std::array<std::array<std::uint8_t, 256>, 16>;
[[nodiscard]] constexpr FuzzyTable make_fuzzy_table() {
  FuzzyTable table{};
  for (int row = 0; row < 16; ++row) {
    for (int blocked = 0; blocked < 256; ++blocked) {
      std::uint8_t chosen = kStandStill;
      for (int rank = 7; rank >= 0; --rank) {
        const int direction = (row % 8 + fuzzy_offset(rank, row < 8 ? 1 : -1)) % 8;
        if ((blocked >> direction & 1) == 0) chosen = static_cast<std::uint8_t>(direction);
      }
      table[static_cast<std::size_t>(row)][static_cast<std::size_t>(blocked)] = chosen;
    }
  }
  return table;
}
inline constexpr FuzzyTable kFuzzyTable = make_fuzzy_table();

/// Membership of the deviation b (rad) in the term g.
[[nodiscard]] inline double fuzzy_membership(double b, int g) {
  const double off = std::abs(wrap_angle(b - g * (kPi / 4.0)));
  return off < kPi / 4.0 ? 1.0 - off / (kPi / 4.0) : 0.0;
}

/// The row of the table for the stronger term of a goal in the direction (dx, dy), in the frame of (dx, dy). No division and
/// no arc tangent: 22.5 degrees are where dy = (sqrt(2) - 1) dx.
[[nodiscard]] inline std::uint32_t fuzzy_row(std::int32_t dx, std::int32_t dy) {
  const double ax = std::abs(static_cast<double>(dx)), ay = std::abs(static_cast<double>(dy));
  const double low = ax < ay ? ax : ay, high = ax < ay ? ay : ax;
  const bool diagonal = low > (kSqrt2 - 1.0) * high;
  // The octant's own frame has the goal at 0 to 45 degrees from an axis; `turned` is how it is mirrored into it.
  const bool steep = ay > ax;
  const std::uint32_t quadrant = (dx < 0 ? 1u : 0u) ^ (dy < 0 ? 3u : 0u);   // 0, 1, 2, 3 counter-clockwise
  const bool odd = (quadrant & 1u) != 0;
  const bool on_first = steep == odd;   // nearer to the quadrant's first axis than to its second
  const std::uint32_t g = diagonal ? 2 * quadrant + 1 : (2 * quadrant + (on_first ? 0u : 2u)) & 7u;
  // Past the middle of the term counter-clockwise, or just there.
  const bool past = diagonal ? (!on_first || ax == ay) : (on_first || low == 0.0);
  return g + (past ? 0u : 8u);
}

/// One move on a grid: the direction for the goal at (dx, dy) cells and the moves that are free (Grid::moves).
[[nodiscard]] inline std::uint8_t fuzzy_move(std::int32_t dx, std::int32_t dy, std::uint8_t moves) {
  return kFuzzyTable[fuzzy_row(dx, dy)][static_cast<std::uint8_t>(~moves)];
}

/// Continuous steering (zero-order Sugeno).
struct FuzzySteering {
  bool stop = false;         ///< all is blocked
  double turn_rad = 0.0;     ///< to the wanted direction, from the heading
  bool ahead = false;        ///< the wanted direction is the heading within 2 degrees: top speed; else turn on the spot
};
/// `b` is the goal's deviation from the heading, `blocked` is A. Two terms that want directions within 45 degrees of each
/// other are averaged by their memberships; otherwise the stronger has its way: the mean of +90 and -90 is an obstacle.
[[nodiscard]] FuzzySteering steer(double b, std::uint8_t blocked);

}  // namespace kb::planners
