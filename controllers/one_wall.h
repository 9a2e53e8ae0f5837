// Keeps one wall, or whatever stands there, at one hand, round inner and outer corners.
//
// Steers by the nearest point towards that hand among those seen lately (near_points.h), at the distance d and the bearing beta:
//   e = D - d                 how much too near it is         D: the wanted distance
//   psi = 90 degrees - beta   how far the robot is turned towards it
//   omega = v (lambda^2 e + 2 lambda psi)    away from it     (the law of course.h, applied to what is seen)
// A straight wall has its nearest point abeam. An outer corner is itself the nearest point while it is passed, so the robot goes round it
// on a circle. In an inner corner the wall ahead becomes the nearest when it is D away, and the robot turns on the spot. In a gap with less
// than D of room at each side, D is half of the gap. ("Wall following" of Lumelsky and Stepanov,
// Algorithmica 2, 1987, with the law made explicit.)
// With `passes`, the robot does not change over from the wall to a thing ahead if it can drive between the two, that is, if some lane between
// their directions, as broad as the robot and 2 cm on each side, is free for 0.45 m. The two are then separate obstacles for a body of that
// size, and the robot goes round the one with which it began. That is the nearest one ahead or abeam: a corner that the robot has passed may
// be nearer, and would lead it away from what stands in its way.
// If nothing is in reach, the robot drives straight on at first, and on a circle of radius D to that hand once it has kept a wall. After a
// distance of `gap`, or three quarters of a turn, it stops.
#pragma once

#include "near_points.h"
#include "wall_sight.h"

namespace mts {

struct OneWallGains {
  float speed_m_s = 0.2f;
  float distance_m = 0.2f;           ///< from the robot's centre
  float convergence_1_m = 7.0f;
  float turn_rad_s = 2.0f;
  float reach_m = 0.35f;             ///< so far beyond the wanted distance a wall is still the one that is kept
  float gap_m = 1.0f;
  bool passes = false;               ///< whether it drives between the wall and another thing where there is room
};

class OneWall {
 public:
  /// `left`: the wall is at the left hand.
  void start(bool left) noexcept {
    points_.forget();
    kept_ = {};
    gone_m_ = turned_rad_ = 0.0f;
    left_ = left;
    met_ = beside_ = abeam_ = false;
  }

  /// The senses must have been `heard`, the range finders must be known, and `at` must be reckoned by heading and odometry.
  [[nodiscard]] Motion step(const Senses& senses, const Place& at, float dt, const OneWallGains& gains,
                            const Body& body) noexcept {
    const float hand = left_ ? 1.0f : -1.0f;
    const float reach = gains.distance_m + gains.reach_m;
    points_.step(senses, at, left_, reach, dt);
    NearPoints::Nearest wall = gains.passes && !abeam_ ? points_.nearest_ahead(at, left_) : points_.nearest(at, left_);
    if (gains.passes && wall.found && wall.bearing_rad < kPi / 3.0f) {
      const NearPoints::Nearest beside = points_.nearest(at, left_, true);
      if (beside.found && beside.distance_m < reach && was_kept(beside, at) && passable(wall.bearing_rad, beside.bearing_rad, at, body)) wall = beside;
    }
    beside_ = wall.found && wall.distance_m < reach;
    if (beside_) {
      met_ = true;
      abeam_ = abeam_ || wall.bearing_rad > kPi / 3.0f;
      kept_ = spot_of(wall, at);
      gone_m_ = turned_rad_ = 0.0f;
      return clear(along(wall, senses, hand, gains, body), at, body);
    }
    const float speed = met_ ? least(gains.speed_m_s, 0.8f * gains.turn_rad_s * gains.distance_m) : gains.speed_m_s;
    const float turn = met_ ? speed / gains.distance_m : 0.0f;
    if (lost(gains)) return {};
    gone_m_ += dt * magnitude(senses.speed_m_s);
    turned_rad_ += dt * turn;
    return clear({speed, hand * turn}, at, body);
  }

  /// Takes what is seen, for `clear`, without keeping a wall. `step` does this itself.
  void look(const Senses& senses, const Place& at, float dt, const OneWallGains& gains) noexcept {
    points_.step(senses, at, left_, gains.distance_m + gains.reach_m, dt);
  }
  /// The motion, or a turn away on the spot if the robot would drive into something that it saw a moment ago, though no range finder may see
  /// it now.
  [[nodiscard]] Motion clear(Motion motion, const Place& at, const Body& body) const noexcept {
    if (!(motion.speed_m_s > 0.0f)) return motion;
    const NearPoints::Nearest met = points_.meets(at, body.radius_m, kRoom_m);
    return met.found ? Motion{0.0f, met.bearing_rad > 0.0f ? -kAway_rad_s : kAway_rad_s} : motion;
  }
  /// How far the robot has driven since it last had anything beside it.
  [[nodiscard]] float gone_m() const noexcept { return gone_m_; }
  /// Whether there has been nothing beside the robot for too long.
  [[nodiscard]] bool lost(const OneWallGains& gains) const noexcept {
    return !beside_ && (gone_m_ >= gains.gap_m || turned_rad_ > 1.5f * kPi);
  }

 private:
  [[nodiscard]] Place spot_of(const NearPoints::Nearest& point, const Place& at) const noexcept {
    const float direction = at.heading_rad + (left_ ? point.bearing_rad : -point.bearing_rad);
    return {at.x_m + point.distance_m * cosine(direction), at.y_m + point.distance_m * sine(direction), 0.0f};
  }
  /// Whether the point belongs to what was kept a moment ago.
  [[nodiscard]] bool was_kept(const NearPoints::Nearest& point, const Place& at) const noexcept {
    const Place spot = spot_of(point, at);
    const float dx = spot.x_m - kept_.x_m, dy = spot.y_m - kept_.y_m;
    return met_ && dx * dx + dy * dy < kPart_m * kPart_m;
  }
  /// Whether the robot can drive between two things at these bearings, which are counted towards the hand.
  [[nodiscard]] bool passable(float ahead_rad, float beside_rad, const Place& at, const Body& body) const noexcept {
    constexpr int kLanes = 6;
    constexpr float kFree_m = 0.45f, kMargin_m = 0.02f;
    for (int i = 1; i < kLanes; ++i) {
      const float bearing = ahead_rad + (beside_rad - ahead_rad) * static_cast<float>(i) / static_cast<float>(kLanes);
      if (points_.room(at, left_ ? bearing : -bearing, body.radius_m + kMargin_m, kFree_m) >= kFree_m) return true;
    }
    return false;
  }
  [[nodiscard]] Motion along(const NearPoints::Nearest& wall, const Senses& senses, float hand, const OneWallGains& gains,
                             const Body& body) const noexcept {
    const float other = least(range_at(senses, !left_, 1), range_at(senses, !left_, 2));
    const float distance = least(gains.distance_m, greatest(0.5f * (wall.distance_m + other), body.radius_m + 0.01f));
    const float l = gains.convergence_1_m;
    const float lacking = clamped(distance - wall.distance_m, -1.2f / l, 1.2f / l);
    const float towards = 0.5f * kPi - wall.bearing_rad;
    const float law = l * l * lacking + 2.0f * l * towards;   // per metre of way
    // The robot has to turn so far, and the wall ahead is so near, that it would drive into the wall meanwhile: it turns on the spot.
    if (towards + 0.5f * l * lacking > kSpot_rad || (towards > 0.35f && wall.distance_m < body.radius_m + 0.03f)) {
      return {0.0f, -hand * gains.turn_rad_s};
    }
    const float speed = gains.speed_m_s * greatest(1.0f - 0.7f * magnitude(towards), 0.3f);
    return {speed, clamped(-hand * speed * law, -gains.turn_rad_s, gains.turn_rad_s)};
  }

  static constexpr float kSpot_rad = 35.0f * kRadPerDeg, kPart_m = 0.12f, kRoom_m = 0.025f, kAway_rad_s = 1.0f;
  NearPoints points_{};
  Place kept_{};               ///< where the wall was nearest, if `met_`
  float gone_m_ = 0.0f, turned_rad_ = 0.0f;   ///< driven and turned since there was a wall
  bool left_ = false;
  bool met_ = false, beside_ = false;   ///< there has been a wall; there is one now
  bool abeam_ = false;         ///< it has been abeam
};

}  // namespace mts
