// The trail of a bug along walls, and the sign rule on it (Filimonov and Filimonov 2019; planners/bug_modified.cc has the rule on a
// grid).
//
// The robot may leave a wall at P for the goal G unless the segment PG crosses a piece of the trail towards the side on which the obstacle
// lay there: then it would run into a wall that it has followed. With a, b the ends of a piece, side(q) = (b - a) x (q - a) is positive to
// its left; PG crosses the piece if P and G lie on different sides of it, and a and b on different sides of PG.
#pragma once

#include "reckoning.h"

namespace mts {

/// At most 128 points, at first 10 cm apart. When there is no more room, every second one is dropped, and the points that follow lie twice
/// as far apart. Cost of `forbids`: one look at each piece.
class Trail {
 public:
  constexpr void start() noexcept {
    count_ = 0;
    apart_m_ = kApart_m;
    left_ = wall_ = opened_ = false;
  }

  /// From here on the robot follows a wall, which lies to its left or to its right.
  constexpr void begin_wall(bool left) noexcept {
    left_ = left;
    wall_ = true;
    opened_ = false;
  }
  /// The robot leaves the wall. Straight pieces are not kept: all point at the goal, so none crosses another.
  constexpr void leave_wall() noexcept { wall_ = false; }

  constexpr void add(const Place& at) noexcept {
    if (!wall_) return;
    if (opened_) {
      const Point& last = points_[count_ - 1];
      const float dx = at.x_m - last.x_m, dy = at.y_m - last.y_m;
      if (dx * dx + dy * dy < apart_m_ * apart_m_) return;
    }
    if (count_ == kMost) thin();
    points_[count_++] = {at.x_m, at.y_m, left_, !opened_};
    opened_ = true;
  }

  /// Whether the sign rule forbids to leave at `p` for `g`.
  [[nodiscard]] constexpr bool forbids(const Place& p, const Place& g) const noexcept {
    for (std::size_t i = 1; i < count_; ++i) {
      const Point& a = points_[i - 1];
      const Point& b = points_[i];
      if (b.first) continue;
      const float dx = p.x_m - b.x_m, dy = p.y_m - b.y_m;
      if (dx * dx + dy * dy < 4.0f * apart_m_ * apart_m_) continue;   // the robot stands on this piece
      const float p_side = side(a.x_m, a.y_m, b.x_m, b.y_m, p.x_m, p.y_m), g_side = side(a.x_m, a.y_m, b.x_m, b.y_m, g.x_m, g.y_m);
      const float a_side = side(p.x_m, p.y_m, g.x_m, g.y_m, a.x_m, a.y_m), b_side = side(p.x_m, p.y_m, g.x_m, g.y_m, b.x_m, b.y_m);
      if (p_side * g_side >= 0.0f || a_side * b_side >= 0.0f) continue;
      // If the obstacle lay to the left of the piece and the way leads from its right to its left, it leads into the obstacle; and mirrored.
      if ((p_side < 0.0f) == b.left) return true;
    }
    return false;
  }

 private:
  static constexpr std::size_t kMost = 128;
  static constexpr float kApart_m = 0.1f;
  struct Point {
    float x_m = 0.0f, y_m = 0.0f;
    bool left = false;    ///< the obstacle lay to the left of the piece that ends here
    bool first = false;   ///< no piece ends here
  };

  [[nodiscard]] static constexpr float side(float ax, float ay, float bx, float by, float qx, float qy) noexcept {
    return (bx - ax) * (qy - ay) - (by - ay) * (qx - ax);
  }
  constexpr void thin() noexcept {
    std::size_t kept = 0;
    bool first = false;   // a dropped point began a wall
    for (std::size_t i = 0; i < count_; ++i) {
      first = first || points_[i].first;
      if (i % 2 != 0) continue;
      points_[kept] = points_[i];
      points_[kept++].first = first;
      first = false;
    }
    count_ = kept;
    apart_m_ *= 2.0f;
    if (first) opened_ = false;   // the last point was dropped and began a wall: now the next one does
  }

  Point points_[kMost] = {};
  std::size_t count_ = 0;
  float apart_m_ = kApart_m;
  bool left_ = false, wall_ = false, opened_ = false;
};

}  // namespace mts
