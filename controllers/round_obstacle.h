// Goes round what stands in the way, and back to the track.
//
// The track is the straight line ahead of where it starts. The obstacle is kept at one hand at a distance (one_wall.h) until the
// robot comes back over the track beyond it, or has it within 3 cm with nothing beside; then it turns into the track as course.h
// says, and is done when it drives along it. `both` takes the hand at whose opposite side there is more room.
// Blind (range finders, odometry, or any heading silent): it stops. Past `detour` of way without the track it stops for good.
#pragma once

#include "controllers/course.h"
#include "controllers/gain.h"
#include "controllers/one_wall.h"

namespace mts {

struct RoundObstacleGains {
  Side side = Side::kBoth;
  float speed_m_s = 0.2f;
  float distance_m = 0.2f;
  float turn_rad_s = 115.0f * kRadPerDeg;
  float detour_m = 4.0f;
};

inline constexpr Gain<RoundObstacleGains> kRoundObstacleGains[] = {
    side_gain("side", &RoundObstacleGains::side, "at which hand the obstacle is kept; both: whichever has more room"),
    gain("speed", "m/s", &RoundObstacleGains::speed_m_s, 0.05f, 0.6f, "beside the obstacle"),
    gain("distance", "m", &RoundObstacleGains::distance_m, 0.15f, 1.0f, "from the robot's centre to the obstacle"),
    angle_gain("turn_speed", "deg/s", &RoundObstacleGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    gain("detour", "m", &RoundObstacleGains::detour_m, 0.5f, 50.0f, "the longest way round"),
};

class RoundObstacle {
 public:
  RoundObstacleGains gains;
  Body body;

  void start(const Task&, const Senses& raw) noexcept {
    const Senses senses = heard(raw);
    reckoning_.start(senses, {});
    const Piece track{reckoning_.at.heading_rad, 1e3f};
    track_.start(&track, 1, 0.0f, {});
    // Kept at the right hand means passed on the left.
    const float room_left = least(senses.range_m[1], senses.range_m[2]);
    const float room_right = least(senses.range_m[7], senses.range_m[6]);
    left_ = gains.side == Side::kLeft || (gains.side == Side::kBoth && senses.range_known && room_right > room_left);
    one_.start(left_);
    away_m_ = 0.0f;
    back_ = done_ = lost_ = false;
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = heard(raw);
    const float dt = sane_period(dt_s);
    reckoning_.step(senses, dt);
    const bool blind = !senses.range_known || !reckoning_.heading_known() || !reckoning_.distance_known();
    if (blind || done_ || lost_) return {};
    const OnCourse on = track_.at(reckoning_.at);
    const float aside = left_ ? -on.left_m : on.left_m;   // grows as it goes round
    away_m_ = greatest(away_m_, aside);
    const OneWallGains how{gains.speed_m_s, gains.distance_m, 7.0f, gains.turn_rad_s, 0.35f, 1.5f};
    lost_ = reckoning_.travelled_m() > gains.detour_m || one_.lost(how);
    if (!back_) back_ = away_m_ > 0.08f && aside < 0.03f && on.along_m > 0.2f;
    if (back_) {
      done_ = magnitude(on.left_m) < 0.03f && magnitude(on.turned_rad) < 6.0f * kRadPerDeg;
      return done_ ? Motion{} : braked(along_course(on, 0.0f, {gains.speed_m_s, 8.0f, gains.turn_rad_s, 0.6f}), senses, body);
    }
    return braked(one_.step(senses, reckoning_.at, dt, how, body), senses, body);
  }

  /// Back on the track, and along it.
  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] bool lost() const noexcept { return lost_; }

 private:
  Reckoning reckoning_{};
  Course track_{};
  OneWall one_{};
  float away_m_ = 0.0f;   ///< the farthest that it was from the track
  bool left_ = false, back_ = false, done_ = false, lost_ = false;
};

}  // namespace mts
