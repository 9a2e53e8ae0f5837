// Notices that somebody has lifted the robot and set it down: its compass has turned, and its wheels have not; or its road runs otherwise than
// the map says.
#pragma once

#include "angles.h"
#include "senses.h"

namespace mts {

class Lifted {
 public:
  /// One control period. The senses must have been `heard`. `off_road`: the robot drives, and its road should run in another direction. False
  /// while compass or `turned_rad` are silent.
  constexpr void step(const Senses& senses, bool off_road, float dt_s) noexcept {
    if (!senses.heading_known || !senses.turned_known) return;
    if (!known_) offset_rad_ = senses.heading_rad - senses.turned_rad;   // from the first moment at which both are known
    known_ = true;
    const float off_rad = wrapped_angle(senses.heading_rad - senses.turned_rad - offset_rad_);
    const bool elsewhere = off_road || magnitude(off_rad) > kAgrees_rad;
    if (elsewhere && !suspected()) facing_rad_ = senses.heading_rad;
    disagree_s_ = elsewhere ? disagree_s_ + dt_s : 0.0f;
    if (!elsewhere) offset_rad_ += off_rad * (dt_s / (kTau_s + dt_s));   // follows slowly: odometry drifts
  }
  /// Whether it may have been; and whether it surely was. Then `forget`.
  [[nodiscard]] constexpr bool suspected() const noexcept { return disagree_s_ > 0.0f; }
  [[nodiscard]] constexpr bool now() const noexcept { return !(disagree_s_ < kSure_s); }
  /// Its heading where it was set down.
  [[nodiscard]] constexpr float facing_rad() const noexcept { return facing_rad_; }
  /// Compass and wheels are compared from here on.
  constexpr void forget() noexcept {
    known_ = false;
    disagree_s_ = 0.0f;
  }

  static constexpr float kDrives_m_s = 0.15f;      ///< a slower robot may still be turning into its road

 private:
  static constexpr float kAgrees_rad = 0.6f;       // a greater difference is no error of the two
  static constexpr float kTau_s = 2.0f, kSure_s = 0.2f;

  bool known_ = false;
  float offset_rad_ = 0.0f, disagree_s_ = 0.0f;    // compass against wheels; how long they, or road and compass, have disagreed
  float facing_rad_ = 0.0f;
};

}  // namespace mts
