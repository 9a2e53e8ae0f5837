// Dead reckoning over the length of a manoeuvre or a road: where the robot is, counted from where it was told to begin.
//
//   heading += change of `turned`                          the wheels: smooth, drifting
//   heading += (compass - heading) dt / (tau + dt)          the compass: rough, true; tau = 0.5 s
//   x += v dt cos(heading),  y += v dt sin(heading)         v: odometry's speed
// (a complementary filter: Mahony, Hamel and Pflimlin, IEEE Trans. Automatic Control 53(5), 2008, in one dimension). Without
// `turned` the compass is taken through a low-pass of 30 ms; without compass the wheels go on alone.
#pragma once

#include "filter.h"
#include "senses.h"

namespace mts {

/// A place with a direction; the frame has the axes of the compass.
struct Place {
  float x_m = 0.0f, y_m = 0.0f;
  float heading_rad = 0.0f;
};

class Reckoning {
 public:
  Place at{};   ///< may be corrected by its user: by a line, by walls

  /// Begins at `place`, whose heading counts only if the compass is silent.
  constexpr void start(const Senses& senses, const Place& place) noexcept {
    *this = Reckoning{};
    at = place;
    if (senses.heading_known) at.heading_rad = wrapped(senses.heading_rad);
    turned_rad_ = senses.turned_rad;
    turned_known_ = senses.turned_known;
  }

  /// One sample. The senses have been `heard`.
  constexpr void step(const Senses& senses, float dt_s) noexcept {
    const float before = at.heading_rad;
    const bool wheels = senses.turned_known && turned_known_;
    if (wheels) at.heading_rad += wrapped(senses.turned_rad - turned_rad_);
    turned_rad_ = senses.turned_rad;
    turned_known_ = senses.turned_known;
    if (senses.heading_known) {
      const float tau = wheels ? kCompassTau_s : kCompassAloneTau_s;
      at.heading_rad += wrapped(senses.heading_rad - offset_rad_ - at.heading_rad) * (dt_s / (tau + dt_s));
    }
    at.heading_rad = wrapped(at.heading_rad);
    heading_known_ = wheels || senses.heading_known;
    distance_known_ = senses.odometry_known;
    if (senses.heading_known) compass_silent_m_ = 0.0f;
    else if (distance_known_) compass_silent_m_ += magnitude(senses.speed_m_s) * dt_s;
    if (!distance_known_) return;
    const float way = senses.speed_m_s * dt_s;
    const float middle = before + 0.5f * wrapped(at.heading_rad - before);
    at.x_m += way * cosine(middle);
    at.y_m += way * sine(middle);
    travelled_m_ += magnitude(way);
  }

  /// Says that the heading is wrong by `by_rad`: the compass is believed less by as much from now on.
  constexpr void correct_heading(float by_rad) noexcept {
    at.heading_rad = wrapped(at.heading_rad + by_rad);
    offset_rad_ = clamped(offset_rad_ - by_rad, -kLargestOffset_rad, kLargestOffset_rad);
  }

  [[nodiscard]] constexpr bool heading_known() const noexcept { return heading_known_; }
  [[nodiscard]] constexpr bool distance_known() const noexcept { return distance_known_; }
  [[nodiscard]] constexpr float travelled_m() const noexcept { return travelled_m_; }
  /// How far it went since the compass was last heard.
  [[nodiscard]] constexpr float compass_silent_m() const noexcept { return compass_silent_m_; }

 private:
  static constexpr float kCompassTau_s = 0.5f, kCompassAloneTau_s = 0.03f;
  static constexpr float kLargestOffset_rad = 15.0f * kRadPerDeg;

  float turned_rad_ = 0.0f;
  float offset_rad_ = 0.0f;   ///< of the compass
  float travelled_m_ = 0.0f, compass_silent_m_ = 0.0f;
  bool turned_known_ = false, heading_known_ = false, distance_known_ = false;
};

}  // namespace mts
