// The points that the range finders have seen lately, so that a thing between their directions is not forgotten: the robot sees a corner
// as it comes, and has to go round it when no range finder looks at it any longer.
#pragma once

#include "heard.h"
#include "reckoning.h"

namespace mts {

/// Up to 96 points in the frame of a reckoning, at most one in each square of 3 cm. A point is the mean of what was seen in its square,
/// each new sample with a weight of 0.3. A new square takes the place of the one that was seen longest ago; a point that is not seen again
/// for 5 s is forgotten, since things move. `step` takes the range finders ahead, up to 135 degrees to the robot's hand and up to 45
/// degrees to the other side. Cost of a step: 5 times 96 comparisons.
class NearPoints {
 public:
  struct Nearest {
    bool found = false;
    float distance_m = 0.0f;   ///< from the robot's centre
    float bearing_rad = 0.0f;  ///< from ahead towards the hand
  };

  /// Forgets all points. It does so in place: assigning a fresh object would need 1.9 KB of stack.
  void forget() noexcept {
    for (Point& point : points_) point = Point{};
  }
  /// Takes what the range finders at the hand see from `at`, up to `reach_m`.
  void step(const Senses& senses, const Place& at, bool left, float reach_m, float dt_s) noexcept {
    for (Point& point : points_) point.age_s += dt_s;
    constexpr std::size_t kToHand[] = {0, 1, 2, 3, 7};
    for (const std::size_t eighths : kToHand) take(senses, at, left ? eighths : (kRangeFinders - eighths) % kRangeFinders, reach_m);
  }
  /// The same with all range finders, for users that keep nothing at a hand.
  void step_all(const Senses& senses, const Place& at, float reach_m, float dt_s) noexcept {
    for (Point& point : points_) point.age_s += dt_s;
    for (std::size_t i = 0; i < kRangeFinders; ++i) take(senses, at, i, reach_m);
  }

  /// The nearest point of all, its bearing counter-clockwise from ahead.
  [[nodiscard]] Nearest nearest_of_all(const Place& at) const noexcept {
    float best = kInfinity, dx = 0.0f, dy = 0.0f;
    for (const Point& point : points_) {
      if (point.age_s > kForgets_s) continue;
      const float x = point.x_m - at.x_m, y = point.y_m - at.y_m;
      if (x * x + y * y >= best) continue;
      best = x * x + y * y;
      dx = x;
      dy = y;
    }
    if (!(best < kInfinity)) return {};
    return {true, square_root(best), wrapped_angle(angle_of(dx, dy) - at.heading_rad)};
  }

  /// How far away the first point lies in the lane from `at` towards `bearing_rad` (counter-clockwise from ahead) that is `half_m` broad to
  /// each side; at most `reach_m`.
  [[nodiscard]] float room(const Place& at, float bearing_rad, float half_m, float reach_m) const noexcept {
    each(at, at.heading_rad + bearing_rad, [&](float ahead, float to_left, float) {
      if (ahead > 0.0f && ahead < reach_m && magnitude(to_left) < half_m) reach_m = ahead;
    });
    return reach_m;
  }

  /// The nearest point that a disc of `radius_m` going straight on would meet within `room_m` of its edge; its bearing is counter-clockwise
  /// from ahead. Points 75 degrees or more to a side do not count: the disc passes them.
  [[nodiscard]] Nearest meets(const Place& at, float radius_m, float room_m) const noexcept {
    constexpr float kCosine75 = 0.258819045f;
    Nearest best{false, radius_m + room_m, 0.0f};
    each(at, at.heading_rad, [&](float ahead, float to_left, float square) {
      const float away = square_root(square);
      if (away >= best.distance_m || ahead < kCosine75 * away || magnitude(to_left) > radius_m) return;
      best = {true, away, angle_of(ahead, to_left)};
    });
    return best;
  }

  /// The nearest point on the side of the hand, including points ahead and up to 30 degrees to the other side. With `beside`, only points at
  /// least 60 degrees to the hand count.
  [[nodiscard]] Nearest nearest(const Place& at, bool left, bool beside = false) const noexcept {
    return nearest_that(at, left, [&](float ahead, float aside) { return !beside || aside * kTan30 >= ahead; });
  }
  /// The same without points farther back than 110 degrees to the hand.
  [[nodiscard]] Nearest nearest_ahead(const Place& at, bool left) const noexcept {
    return nearest_that(at, left, [](float ahead, float aside) { return ahead > -kTan20 * aside; });
  }

 private:
  template <class Counts>
  [[nodiscard]] Nearest nearest_that(const Place& at, bool left, Counts&& counts) const noexcept {
    float best = kInfinity, best_ahead = 0.0f, best_aside = 0.0f;
    each(at, at.heading_rad, [&](float ahead, float to_left, float square) {
      const float aside = left ? to_left : -to_left;
      if (square >= best || (aside < 0.0f && aside < -kTan30 * ahead) || !counts(ahead, aside)) return;
      best = square;
      best_ahead = ahead;
      best_aside = aside;
    });
    if (!(best < kInfinity)) return {};
    return {true, square_root(best), angle_of(best_ahead, best_aside)};
  }

  static constexpr float kForgets_s = 5.0f, kSquare_m = 0.03f, kTan20 = 0.363970234f, kTan30 = 0.577350269f;
  struct Point {
    float x_m = 0.0f, y_m = 0.0f;
    float age_s = 1e3f;
    std::int32_t column = 0, row = 0;
  };

  /// Calls `f(ahead_m, to_left_m, square_m2)` for each point that is not forgotten: its coordinates as seen from `at` in that heading, and
  /// the square of its distance.
  template <class F>
  void each(const Place& at, float heading_rad, F&& f) const noexcept {
    const float ux = cosine(heading_rad), uy = sine(heading_rad);
    for (const Point& point : points_) {
      if (point.age_s > kForgets_s) continue;
      const float dx = point.x_m - at.x_m, dy = point.y_m - at.y_m;
      f(dx * ux + dy * uy, dy * ux - dx * uy, dx * dx + dy * dy);
    }
  }

  /// The column or row of the square at a coordinate; a reckoning stays within a few hundred metres of its origin.
  [[nodiscard]] static constexpr std::int32_t square_of(float m) noexcept {
    return static_cast<std::int32_t>(clamped(m, -1e4f, 1e4f) / kSquare_m + 1e6f);
  }

  void take(const Senses& senses, const Place& at, std::size_t i, float reach_m) noexcept {
    const float range = senses.range_m[i];
    if (!(range < reach_m)) return;
    const float direction = at.heading_rad + range_finder_rad(i);
    add(at.x_m + range * cosine(direction), at.y_m + range * sine(direction));
  }
  void add(float x_m, float y_m) noexcept {
    const std::int32_t column = square_of(x_m), row = square_of(y_m);
    Point* oldest = &points_[0];
    for (Point& point : points_) {
      if (point.column == column && point.row == row && point.age_s <= kForgets_s) {
        point.x_m += 0.3f * (x_m - point.x_m);
        point.y_m += 0.3f * (y_m - point.y_m);
        point.age_s = 0.0f;
        return;
      }
      if (point.age_s > oldest->age_s) oldest = &point;
    }
    *oldest = {x_m, y_m, 0.0f, column, row};
  }

  Point points_[96] = {};
};
static_assert(sizeof(NearPoints) == 96 * 20);

}  // namespace mts
