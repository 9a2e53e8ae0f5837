// Goes round an obstacle and back to the track.
//
// The track is the course of the task, its bends rounded with 30 cm, or, without one, the straight line ahead of where it starts. The
// robot keeps the obstacle on one hand at a distance (one_wall.h) until it crosses the track again beyond the obstacle, or is within 3 cm of
// the track with nothing beside it. Then it turns into the track as course.h says, and is done once it drives along it. `both` keeps the
// obstacle on the hand opposite to the side with more room. If the obstacle disappears, the robot also returns to the track. A thing that
// comes nearer than the robot's own motion explains is moving: the robot stands until that is over.
// If the wall leads it back the way it came, if it makes no progress, or if the gap is hardly wider than the robot, there is no path past
// on that hand: it goes back to where it started and faces along the track. `both` then tries the other hand, once. After that the robot
// stands there, where it can see whether the obstacle remains, and is lost. It gives up in the same way after a distance of `detour`
// without reaching the track. If range finders, odometry or every heading are silent, it stops.
#pragma once

#include "course.h"
#include "gain.h"
#include "one_wall.h"

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
    distance_gain("distance", &RoundObstacleGains::distance_m, 0.15f, 1.0f, "from the robot's centre to the obstacle"),
    angle_gain("turn_speed", "deg/s", &RoundObstacleGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    gain("detour", "m", &RoundObstacleGains::detour_m, 0.5f, 50.0f, "the longest way round"),
};

class RoundObstacle {
 public:
  RoundObstacleGains gains;
  Body body;

  void start(const Task& task, const Senses& raw) noexcept {
    const Senses senses = heard(raw, body);
    reckoning_.start_along(senses, task);
    const Piece ahead{reckoning_.at.heading_rad, 1e3f};
    track_.start(task.pieces > 0 ? task.course : &ahead, task.pieces > 0 ? task.pieces : 1, kBend_m, {});
    // An obstacle kept at the right hand is passed on the left.
    const float room_left = room_at(senses, 1, 2), room_right = room_at(senses, 7, 6);
    left_ = gains.side == Side::kLeft || (gains.side == Side::kBoth && senses.range_known && room_right > room_left);
    tried_ = gains.side != Side::kBoth;
    done_ = lost_ = false;
    nearest_m_.reset();
    closing_m_ = yield_s_ = 0.0f;
    take_hand(0.0f);
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    Senses senses = heard(raw, body);
    senses.met_m = kOutOfRange;   // it has its own way to find what it must let pass: see `yields`
    const float dt = sane_period(dt_s);
    reckoning_.step(senses, dt);
    const bool blind = !senses.range_known || !reckoning_.heading_known() || !reckoning_.distance_known();
    if (blind || done_ || lost_) return {};
    Course track = track_;   // followed from its beginning each time: on the way round, the robot comes back beside pieces that it had passed
    const OnCourse on = track.at(reckoning_.at);
    if (yields(senses, dt)) return {};
    const OneWallGains how{gains.speed_m_s, gains.distance_m, 7.0f, gains.turn_rad_s, 0.35f, 1.5f, true};
    if (phase_ == Phase::kReturn || phase_ == Phase::kBack) one_.look(senses, reckoning_.at, dt, how);
    if (phase_ == Phase::kReturn) return go_back(senses, dt);
    if (phase_ == Phase::kFace) return face(on);
    const float aside = left_ ? -on.left_m : on.left_m;   // grows as it goes round
    away_m_ = greatest(away_m_, aside);
    idle_s_ = magnitude(senses.speed_m_s) < 0.02f ? idle_s_ + dt : 0.0f;
    if (phase_ == Phase::kRound && (led_back(on, how) || too_narrow(senses))) {
      phase_ = Phase::kReturn;
      idle_s_ = 0.0f;
      return {};
    }
    const bool over_track = away_m_ > 0.08f && aside < 0.03f && (on.along_m > 0.2f || track.in_bend() || track.piece() > 0);
    const bool passed = on.along_m > from_along_m_ + kPassed_m;   // what is beside it now is another thing
    if (phase_ == Phase::kRound && (over_track || passed || one_.gone_m() > kNothing_m)) {
      phase_ = over_track || magnitude(on.left_m) < kNearTrack_m ? Phase::kBack : Phase::kReturn;
      idle_s_ = 0.0f;
      if (phase_ == Phase::kReturn) return {};
    }
    if (phase_ == Phase::kBack && (idle_s_ > 1.0f || hemmed_in(senses))) take_hand(on.along_m);   // the obstacle still stands there, or another does
    if (phase_ == Phase::kBack) {
      done_ = magnitude(on.left_m) < 0.03f && magnitude(on.turned_rad) < 6.0f * kRadPerDeg;
      return done_ ? Motion{} : one_.clear(braked(along_course(on, {gains.speed_m_s, 8.0f, gains.turn_rad_s, 0.6f}), senses, body), reckoning_.at, body);
    }
    return braked(one_.step(senses, reckoning_.at, dt, how, body), senses, body);
  }

  /// Whether the robot is back on the track and drives along it.
  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] bool lost() const noexcept { return lost_; }

 private:
  enum class Phase : std::uint8_t { kRound, kBack, kReturn, kFace };

  /// The lesser range of two range finders; 0, no room that is known, if one of them is silent.
  [[nodiscard]] static float room_at(const Senses& senses, std::size_t i, std::size_t k) noexcept {
    return knows_range(senses, i) && knows_range(senses, k) ? least(senses.range_m[i], senses.range_m[k]) : 0.0f;
  }

  /// Whether, a moment ago, something came nearer by more than the robot's own motion explains.
  [[nodiscard]] bool yields(const Senses& senses, float dt) noexcept {
    std::size_t at = 0;
    for (std::size_t i = 1; i < kRangeFinders; ++i) at = senses.range_m[i] < senses.range_m[at] ? i : at;
    // A thing nearer than this is broad enough to be seen by some range finder, in whatever direction it stands.
    if (senses.range_m[at] > kSees_m) {
      nearest_m_.reset();
      closing_m_ = 0.0f;
    } else {
      const float before = nearest_m_.primed ? nearest_m_.value : senses.range_m[at];
      const float by_itself = greatest(senses.speed_m_s * cosine(range_finder_rad(at)), 0.0f) * dt;
      const float closer = before - nearest_m_.step(senses.range_m[at], kTau_s, dt) - by_itself;
      closing_m_ = greatest((closing_m_ + closer) * (kWindow_s / (kWindow_s + dt)), 0.0f);
    }
    yield_s_ = closing_m_ > kCloser_m ? kYields_s : greatest(yield_s_ - dt, 0.0f);
    return yield_s_ > 0.0f;
  }

  void take_hand(float along_m) noexcept {
    one_.start(left_);
    from_along_m_ = along_m;
    phase_ = Phase::kRound;
    away_m_ = idle_s_ = blocked_s_ = 0.0f;
    from_m_ = reckoning_.travelled_m();
  }
  [[nodiscard]] bool led_back(const OnCourse& on, const OneWallGains& how) const noexcept {
    const float outwards = left_ ? -on.turned_rad : on.turned_rad;
    return outwards > kLedBack_rad || magnitude(on.left_m) > kFarAside_m || idle_s_ > kIdle_s || reckoning_.travelled_m() - from_m_ > gains.detour_m || one_.lost(how);
  }
  [[nodiscard]] bool too_narrow(const Senses& senses) const noexcept {
    const float left = least(senses.range_m[1], senses.range_m[2]), right = least(senses.range_m[7], senses.range_m[6]);
    return left + right < 2.0f * (body.radius_m + kMargin_m);
  }
  [[nodiscard]] bool hemmed_in(const Senses& senses) const noexcept {
    const float ahead = least(senses.range_m[0], least(senses.range_m[1], senses.range_m[7]));
    return ahead < body.radius_m + 2.0f * kMargin_m || least(senses.range_m[2], senses.range_m[6]) < body.radius_m + 0.02f;
  }
  /// Drives straight back to where the track begins. The robot came from there round something, so a thing on the straight way ends this.
  [[nodiscard]] Motion go_back(const Senses& senses, float dt) noexcept {
    idle_s_ += dt;
    const float x_m = reckoning_.at.x_m, y_m = reckoning_.at.y_m, away = square_root(x_m * x_m + y_m * y_m);
    if (away < 0.04f || idle_s_ > kReturn_s || blocked_s_ > kBlocked_s) {
      phase_ = Phase::kFace;
      return {};
    }
    const float towards = wrapped_angle(angle_of(-x_m, -y_m) - reckoning_.at.heading_rad);
    if (magnitude(towards) > 0.3f) return {0.0f, clamped(4.0f * towards, -gains.turn_rad_s, gains.turn_rad_s)};
    const Motion motion = one_.clear(braked({least(gains.speed_m_s, 0.5f * away + 0.05f), 3.0f * towards}, senses, body), reckoning_.at, body);
    blocked_s_ = motion.speed_m_s > 0.0f ? blocked_s_ : blocked_s_ + dt;
    return motion;
  }
  [[nodiscard]] Motion face(const OnCourse& on) noexcept {
    if (magnitude(on.turned_rad) > kFaces_rad) {
      return {0.0f, clamped(-4.0f * on.turned_rad, -gains.turn_rad_s, gains.turn_rad_s)};
    }
    if (tried_) {
      lost_ = true;
      return {};
    }
    tried_ = true;
    left_ = !left_;
    take_hand(on.along_m);
    return {};
  }

  static constexpr float kBend_m = 0.3f;       ///< the radius with which the track's bends are rounded
  static constexpr float kLedBack_rad = 110.0f * kRadPerDeg, kFaces_rad = 3.0f * kRadPerDeg;
  static constexpr float kIdle_s = 4.0f, kReturn_s = 8.0f, kBlocked_s = 0.6f, kMargin_m = 0.03f;
  static constexpr float kPassed_m = 2.0f;     ///< along the track: after this way the obstacle is passed
  static constexpr float kNearTrack_m = 0.35f, kFarAside_m = 0.8f;
  static constexpr float kNothing_m = 0.15f;   ///< after driving this far with nothing beside it, nothing is there any more
  static constexpr float kSees_m = 0.35f, kTau_s = 0.1f, kWindow_s = 0.4f, kCloser_m = 0.04f, kYields_s = 1.0f;
  Reckoning reckoning_{};
  Course track_{};
  OneWall one_{};
  Phase phase_ = Phase::kRound;
  float away_m_ = 0.0f;   ///< the farthest that the robot has been from the track on this hand's side
  float idle_s_ = 0.0f;   ///< for how long it has got no farther; on the way back: for how long it has driven
  float blocked_s_ = 0.0f;  ///< for how long something has been on its way back
  float from_along_m_ = 0.0f;   ///< where along the track it took this hand
  float from_m_ = 0.0f;   ///< the distance driven when it took this hand
  LowPass nearest_m_{};    ///< the distance of the nearest thing
  float closing_m_ = 0.0f; ///< by how much that thing came nearer lately by its own motion
  float yield_s_ = 0.0f;  ///< for how much longer the robot stands to let something pass
  bool left_ = false, tried_ = false, done_ = false, lost_ = false;
};

}  // namespace mts
