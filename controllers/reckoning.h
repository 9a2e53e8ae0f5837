// Dead reckoning over a manoeuvre or a road: where the robot is, counted from the place where it was told to begin.
//
//   heading += change of `turned`                          the wheels: smooth, but they drift
//   heading += (compass - heading) dt / (tau + dt)          the compass: rough, but without drift; tau = 0.5 s
//   x += s cos(heading),  y += s sin(heading)               s: how far odometry's place has moved, or its speed times the period
// (a complementary filter: Mahony, Hamel and Pflimlin, IEEE Trans. Automatic Control 53(5), 2008, in one dimension). Without
// `turned`, the compass passes a low-pass of 30 ms; without the compass, the wheels go on alone. If a loop is late, however long, the place
// of odometry loses nothing as long as the robot turns by less than half a turn meanwhile; reckoning by its speed does.
#pragma once

#include "filter.h"
#include "senses.h"

namespace mts {

/// A place with a direction, in a frame with the axes of the compass.
struct Place {
  float x_m = 0.0f, y_m = 0.0f;
  float heading_rad = 0.0f;
};

/// How far the wheels have driven from one sample to the next. Not every robot gives `x_m` and `y_m`. Speed is used instead until they
/// have changed once, while they are not numbers, and when they jump, as they do if odometry restarts elsewhere: by more than 3 m if the
/// loop was late, by more than 30 cm (and 3 m/s) otherwise.
class Odometer {
 public:
  /// The distance driven since the last sample; negative backwards. Odometry must be known.
  [[nodiscard]] constexpr float way_m(const Senses& senses, float dt_s) noexcept {
    const float by_speed = senses.speed_m_s * dt_s;
    const float faster = magnitude(speed_m_s_) > magnitude(senses.speed_m_s) ? speed_m_s_ : senses.speed_m_s;
    if (!told_ || !tells(senses) || magnitude(faster) < kStands_m_s) return by_speed;   // a place that trembles while the robot stands is not a distance driven
    const float dx = senses.x_m - x_m_, dy = senses.y_m - y_m_;
    const float moved = square_root(dx * dx + dy * dy);
    if (moved > (dt_s < kLate_s ? kLeap_m + kLeap_m_s * dt_s : kLateLeap_m)) return by_speed;
    if (!moves_ && !(moved > 0.0f)) {
      counted_m_ += magnitude(by_speed);
      return by_speed;
    }
    const float way = moved - least(counted_m_, moved);   // without what has been counted by speed already
    unseen_m_ = moved > 0.0f ? 0.0f : clamped(unseen_m_ + by_speed, -kLeap_m, kLeap_m);
    moves_ = true;
    counted_m_ = 0.0f;
    return sign_of(faster) * way;
  }
  /// To be asked when odometry falls silent: the way by its speed since its place last changed, at most 30 cm. If its place was stuck meanwhile,
  /// and it is silent because somebody noticed that, the robot has driven so far.
  [[nodiscard]] constexpr float unseen_m() const noexcept { return told_ ? unseen_m_ : 0.0f; }
  constexpr void take(const Senses& senses) noexcept {
    told_ = senses.odometry_known && tells(senses);
    if (!told_) unseen_m_ = 0.0f;
    x_m_ = senses.x_m;
    y_m_ = senses.y_m;
    speed_m_s_ = senses.odometry_known ? senses.speed_m_s : 0.0f;
  }

 private:
  [[nodiscard]] static constexpr bool tells(const Senses& senses) noexcept {
    return magnitude(senses.x_m) <= kFarthest_m && magnitude(senses.y_m) <= kFarthest_m;   // false for NaN
  }

  static constexpr float kStands_m_s = 0.01f, kFarthest_m = 1e6f;
  static constexpr float kLate_s = 0.5f;   ///< the longest period that controllers accept: see sane_period
  static constexpr float kLeap_m = 0.3f, kLeap_m_s = 3.0f, kLateLeap_m = 3.0f;
  float x_m_ = 0.0f, y_m_ = 0.0f, speed_m_s_ = 0.0f;
  float counted_m_ = 0.0f;   ///< by speed, until `x_m` and `y_m` have changed once
  float unseen_m_ = 0.0f;    ///< by speed, since they have changed
  bool told_ = false, moves_ = false;
};

class Reckoning {
 public:
  Place at{};   ///< users may correct it, by a line or by walls

  /// Begins at `place`. Its heading counts only if the compass is silent.
  constexpr void start(const Senses& senses, const Place& place) noexcept {
    *this = Reckoning{};
    at = place;
    if (senses.heading_known) at.heading_rad = wrapped_angle(senses.heading_rad);
    turned_rad_ = senses.turned_rad;
    turned_known_ = senses.turned_known;
    odometry_.take(senses);
  }

  /// The same for users that need only turns and distances since the start. If the compass is silent at first, it is aligned
  /// with the reckoned heading when it is first heard.
  constexpr void start_relative(const Senses& senses) noexcept {
    start(senses, {});
    relative_ = !senses.heading_known;
  }

  /// The same for robots sent along a course. With the compass silent, the robot is taken to face along the first piece, or `turned_rad` from
  /// there.
  constexpr void start_along(const Senses& senses, const Task& task, float turned_rad = 0.0f) noexcept {
    if (task.pieces > 0) start(senses, {0.0f, 0.0f, wrapped_angle(task.course[0].heading_rad + turned_rad)});
    else start_relative(senses);
  }

  /// Takes one sample. The senses must have been `heard`.
  constexpr void step(const Senses& senses, float dt_s) noexcept {
    const float before = at.heading_rad;
    const bool wheels = senses.turned_known && turned_known_;
    if (wheels) at.heading_rad += wrapped_angle(senses.turned_rad - turned_rad_);
    turned_rad_ = senses.turned_rad;
    turned_known_ = senses.turned_known;
    if (senses.heading_known) {
      if (relative_) offset_rad_ = wrapped_angle(senses.heading_rad - at.heading_rad);
      relative_ = false;
      const float tau = wheels ? kCompassTau_s : kCompassAloneTau_s;
      at.heading_rad += wrapped_angle(senses.heading_rad - offset_rad_ - at.heading_rad) * (dt_s / (tau + dt_s));
    }
    at.heading_rad = wrapped_angle(at.heading_rad);
    heading_known_ = wheels || senses.heading_known;
    distance_known_ = senses.odometry_known;
    const float way = distance_known_ ? odometry_.way_m(senses, dt_s) : odometry_.unseen_m();
    odometry_.take(senses);
    way_m_ = magnitude(way);
    if (senses.heading_known) compass_silent_m_ = 0.0f;
    else compass_silent_m_ += way_m_;
    const float middle = before + 0.5f * wrapped_angle(at.heading_rad - before);
    at.x_m += way * cosine(middle);
    at.y_m += way * sine(middle);
    travelled_m_ += way_m_;
  }

  /// Tells the reckoning that its heading is wrong by `by_rad`. From now on the compass is corrected by as much.
  constexpr void correct_heading(float by_rad) noexcept {
    at.heading_rad = wrapped_angle(at.heading_rad + by_rad);
    offset_rad_ = clamped(offset_rad_ - by_rad, -kLargestOffset_rad, kLargestOffset_rad);
  }

  [[nodiscard]] constexpr bool heading_known() const noexcept { return heading_known_; }
  [[nodiscard]] constexpr bool distance_known() const noexcept { return distance_known_; }
  /// Since the start. After 8 km steps of a millimetre are lost in its last digit: for short ways of an object that never starts again use `way_m`.
  [[nodiscard]] constexpr float travelled_m() const noexcept { return travelled_m_; }
  /// In the last step.
  [[nodiscard]] constexpr float way_m() const noexcept { return way_m_; }
  /// Distance driven since the compass was last heard.
  [[nodiscard]] constexpr float compass_silent_m() const noexcept { return compass_silent_m_; }

 private:
  static constexpr float kCompassTau_s = 0.5f, kCompassAloneTau_s = 0.03f;
  static constexpr float kLargestOffset_rad = 15.0f * kRadPerDeg;

  Odometer odometry_{};
  float turned_rad_ = 0.0f;
  float offset_rad_ = 0.0f;   ///< of the compass
  float way_m_ = 0.0f, travelled_m_ = 0.0f, compass_silent_m_ = 0.0f;
  bool relative_ = false;     ///< the compass has not been heard yet, and its axes do not matter
  bool turned_known_ = false, heading_known_ = false, distance_known_ = false;
};

}  // namespace mts
