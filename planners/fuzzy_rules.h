// The 72 fuzzy rules of Darintsev and Migranov (2012) as a table: eight terms of the angular deviation from the goal, with nine nested
// rules for each. The paper gives the structure but not the rules; the rules are ours.
//
// The inputs are A, with a bit for each of eight sensors that look at heading + k * 45 degrees (1: obstacle; for a diagonal also if a cell
// beside it is blocked), and b, the deviation of the goal's direction from the heading. The terms of b lie at k * 45 degrees. Their
// memberships are triangles of half-width 45 degrees, so at most two are not zero, and they sum to 1.
//
// For the term g the directions are tried in the order of their deviation from it,
//   o = (0, +s, -s, +2s, -2s, +3s, -3s, 4),   s = +1 if b is at the middle of the term or past it counter-clockwise, else -1
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

/// The "direction" of a decision to stop.
inline constexpr std::uint8_t kStandStill = 8;

/// The offset, 0 to 7, that is tried at place `rank` (0 to 7) with side `s` (+1 or -1).
[[nodiscard]] constexpr int fuzzy_offset(int rank, int s) {
  const int size = (rank + 1) / 2;
  return ((rank % 2 == 1 ? s : -s) * size + 8) % 8;
}

/// kFuzzyTable[g + 8 * (s < 0)][A] is the direction, or kStandStill. 4 KiB, made when compiling.
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

/// A goal's direction as five bits, by comparisons: dx < 0, dy < 0, |dy| > |dx|, nearer to a diagonal than to an axis, exactly on a
/// diagonal or an axis. At the goal it is `kFuzzyThere`, which no direction has. |dx| and |dy| must not exceed Grid::kMaxSide. There is
/// no branch, division or arc tangent, so a compiler can do this for several robots at once. The limit of 22.5 degrees is low = (sqrt(2)
/// - 1) high, or low^2 + 2 low high = high^2, and every term stays below 2^31.
[[nodiscard]] constexpr std::uint32_t fuzzy_code(std::int32_t dx, std::int32_t dy) {
  const std::int32_t ax = dx < 0 ? -dx : dx, ay = dy < 0 ? -dy : dy;
  const std::int32_t low = ax < ay ? ax : ay, high = ax < ay ? ay : ax;
  const bool diagonal = low * low + high * (2 * low - high) > 0, edge = (low == 0) | (ax == ay);
  return static_cast<std::uint32_t>(dx < 0) | static_cast<std::uint32_t>(dy < 0) << 1 | static_cast<std::uint32_t>(ay > ax) << 2 |
         static_cast<std::uint32_t>(diagonal) << 3 | static_cast<std::uint32_t>(edge) << 4 | (high == 0 ? 12u : 0u);
}
inline constexpr std::uint32_t kFuzzyThere = fuzzy_code(0, 0);

/// The row of the table for a direction's code, that of the stronger term.
[[nodiscard]] constexpr std::uint32_t fuzzy_row_of(std::uint32_t code) {
  const bool left = (code & 1u) != 0, down = (code & 2u) != 0, steep = (code & 4u) != 0;
  const bool diagonal = (code & 8u) != 0, edge = (code & 16u) != 0;
  const std::uint32_t quadrant = left ? (down ? 2u : 1u) : (down ? 3u : 0u);   // counter-clockwise
  const bool on_first = steep == (left != down);   // nearer to the quadrant's first axis than to its second
  const std::uint32_t term = diagonal ? 2 * quadrant + 1 : (2 * quadrant + (on_first ? 0u : 2u)) % 8;
  const bool past = edge || (diagonal ? !on_first : on_first);
  return term + (past ? 0u : 8u);
}
/// The same for a goal in the direction (dx, dy), in the frame of (dx, dy). Not for (0, 0).
[[nodiscard]] constexpr std::uint32_t fuzzy_row(std::int32_t dx, std::int32_t dy) { return fuzzy_row_of(fuzzy_code(dx, dy)); }

/// The rules by a direction's code and the free moves (Grid::moves), so that a decision is one look-up. 8 KiB.
using FuzzyMoves = std::array<std::array<std::uint8_t, 256>, 32>;
[[nodiscard]] constexpr FuzzyMoves make_fuzzy_moves() {
  FuzzyMoves out{};
  for (std::uint32_t code = 0; code < 32; ++code) {
    for (std::uint32_t moves = 0; moves < 256; ++moves) {
      out[code][moves] = code == kFuzzyThere ? kStandStill : kFuzzyTable[fuzzy_row_of(code)][~moves & 0xFFu];
    }
  }
  return out;
}
inline constexpr FuzzyMoves kFuzzyMoves = make_fuzzy_moves();

/// One move on a grid: the direction, given the goal at (dx, dy) cells and the free moves; kStandStill at the goal.
[[nodiscard]] constexpr std::uint8_t fuzzy_move(std::int32_t dx, std::int32_t dy, std::uint8_t moves) {
  return kFuzzyMoves[fuzzy_code(dx, dy)][moves];
}

/// Continuous steering (zero-order Sugeno).
struct FuzzySteering {
  bool stop = false;         ///< everything is blocked
  double turn_rad = 0.0;     ///< from the heading to the wanted direction
  bool ahead = false;        ///< the wanted direction is within 2 degrees of the heading: drive at top speed; else turn on the spot
};
/// `b` is the goal's deviation from the heading, `blocked` is A. If two terms want directions within 45 degrees of each other, these are
/// averaged by membership. Otherwise the stronger term decides, since the mean of +90 and -90 would lead into the obstacle.
[[nodiscard]] FuzzySteering steer(double b, std::uint8_t blocked);

}  // namespace kb::planners
