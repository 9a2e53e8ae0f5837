// Drives along walls: between two of them, or with one at a given distance on the left or right hand (one_wall.h).
//
// Between two walls, d_l and d_r away, the robot is turned by psi against their mean direction and lies
//   e = (d_r - d_l) / 2   to the left of the middle;        omega = -v (lambda^2 e + 2 lambda psi)
// If one side is open (a gap, the inner side of a bend), the robot keeps the other wall at half of the last measured width, or at `distance`
// if none was measured yet. If both are open, it goes straight on by the heading that the walls had, for at most `gap`.
// A wall ahead nearer than half the width + `corner_radius`, with just one side open (no wall beside, or one that has ended 45 degrees
// ahead), is a bend: the robot turns to the open side on a circle of `corner_radius` until it runs along the outer wall or has turned by
// 88 degrees. If no side is open, it stops before the wall. If range finders are silent it stops; with one wall it also stops without
// odometry or any heading.
#pragma once

#include "gain.h"
#include "one_wall.h"
#include "wall_sight.h"

namespace mts {

struct KeepWallGains {
  Side side = Side::kBoth;
  float speed_m_s = 0.3f;
  float distance_m = 0.3f;
  float convergence_1_m = 6.0f;
  float turn_rad_s = 115.0f * kRadPerDeg;
  float corner_radius_m = 0.12f;
  float reach_m = 0.35f;
  float gap_m = 1.0f;
};

inline constexpr Gain<KeepWallGains> kKeepWallGains[] = {
    side_gain("side", &KeepWallGains::side, "at which hand the wall is kept; both: between two walls"),
    gain("speed", "m/s", &KeepWallGains::speed_m_s, 0.05f, 0.6f, "along straight walls"),
    distance_gain("distance", &KeepWallGains::distance_m, 0.15f, 1.0f, "from the robot's centre to the wall"),
    gain("convergence", "1/m", &KeepWallGains::convergence_1_m, 2.0f, 15.0f, "lambda: how quickly errors decay over the way"),
    angle_gain("turn_speed", "deg/s", &KeepWallGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    gain("corner_radius", "m", &KeepWallGains::corner_radius_m, 0.05f, 0.5f, "how bends and corners are rounded"),
    gain("reach", "m", &KeepWallGains::reach_m, 0.05f, 1.0f, "beyond the distance, where a wall is still the wall"),
    gain("gap", "m", &KeepWallGains::gap_m, 0.0f, 5.0f, "how far it goes on without a wall"),
};

class KeepWall {
 public:
  KeepWallGains gains;
  Body body;

  void start(const Task&, const Senses& raw) noexcept {
    reckoning_.start_relative(heard(raw, body));
    one_.start(gains.side == Side::kLeft);
    half_width_m_ = gains.distance_m;
    wall_heading_known_ = width_known_ = false;
    corner_ = lost_ = false;
    straight_s_ = gone_m_ = turned_rad_ = last_turn_rad_s_ = 0.0f;
    left_.reset();
    angle_.reset();
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    Senses senses = heard(raw, body);
    if (gains.side != Side::kBoth) senses.met_m = kOutOfRange;   // what it goes round seems to come, as corners of walls do: see comers.h
    const float dt = sane_period(dt_s);
    const float before = reckoning_.at.heading_rad;
    reckoning_.step(senses, dt);
    if (!senses.range_known) return {};
    const float change = reckoning_.heading_known() ? wrapped_angle(reckoning_.at.heading_rad - before) : last_turn_rad_s_ * dt;
    Motion motion;
    if (gains.side != Side::kBoth) {
      if (!reckoning_.heading_known() || !reckoning_.distance_known()) return {};
      const OneWallGains how{gains.speed_m_s,  gains.distance_m, gains.convergence_1_m,
                             gains.turn_rad_s, gains.reach_m,    gains.gap_m};
      motion = one_.step(senses, reckoning_.at, dt, how, body);
      lost_ = one_.lost(how);
    } else {
      motion = corner_ ? round_corner(senses, change) : between(senses, dt);
    }
    motion = braked(motion, senses, body);
    last_turn_rad_s_ = motion.turn_rad_s;
    return motion;
  }

  [[nodiscard]] bool done() const noexcept { return false; }
  /// Whether it found no wall for longer than `gap`; the robot then stands.
  [[nodiscard]] bool lost() const noexcept { return lost_; }

 private:
  [[nodiscard]] Motion between(const Senses& senses, float dt) noexcept {
    // Once the width is known, a wall farther away than the robot can be beside the middle is taken for another road's.
    const float reach = half_width_m_ + (width_known_ ? least(gains.reach_m, 0.22f) : gains.reach_m);
    const WallSight left = look_at_wall(senses, true, reach), right = look_at_wall(senses, false, reach);
    const bool recedes_left = recedes(senses, left, true), recedes_right = recedes(senses, right, false);
    if (recedes_left != recedes_right && senses.range_m[0] < half_width_m_ + gains.corner_radius_m) {
      corner_ = true;
      to_left_ = recedes_left;
      turned_rad_ = gone_m_ = 0.0f;
      lost_ = false;
      return round_corner(senses, 0.0f);
    }
    if (!left.beside && !right.beside) return across_gap(senses, dt);
    gone_m_ = 0.0f;
    lost_ = false;
    float off = right.beside ? right.distance_m - half_width_m_ : half_width_m_ - left.distance_m;
    if (left.beside && right.beside) {
      off = 0.5f * (right.distance_m - left.distance_m);
      const float half = 0.5f * (left.distance_m + right.distance_m);
      // At first any two walls set the width; once it is known, only straight walls change it, not what is seen at an opening.
      const bool seen = width_known_ ? left.straight && right.straight : left.angle_known && right.angle_known;
      if (seen && magnitude(left.angle_rad - right.angle_rad) < 0.2f) {
        half_width_m_ += (half - half_width_m_) * (dt / (0.2f + dt));
        straight_s_ += dt;
        width_known_ = width_known_ || straight_s_ > 0.5f;
      }
    }
    off = left_.step(off, kTau_s, dt);
    return along(off, angle_to(left, right, dt));
  }

  /// Whether the side is open. A robot that is askew still sees the end of its wall beside it. A side with a silent range finder is not open.
  [[nodiscard]] bool recedes(const Senses& senses, const WallSight& wall, bool left) const noexcept {
    if (!knows_range(senses, left ? 1 : 7) || !knows_range(senses, left ? 2 : 6)) return false;
    return !wall.beside || range_at(senses, left, 1) > kDiagonal * half_width_m_;
  }

  [[nodiscard]] Motion along(float off, float angle) const noexcept {
    const float l = gains.convergence_1_m;
    const float speed = gains.speed_m_s * (1.0f - 0.6f * least(magnitude(angle), 1.0f));
    const float turn = -speed * (l * l * clamped(off, -1.2f / l, 1.2f / l) + 2.0f * l * angle);
    return {speed, clamped(turn, -gains.turn_rad_s, gains.turn_rad_s)};
  }

  /// The heading relative to the walls: by the walls that show it, otherwise by the heading that the walls had.
  [[nodiscard]] float angle_to(const WallSight& left, const WallSight& right, float dt) noexcept {
    if (!left.angle_known && !right.angle_known) {
      if (wall_heading_known_ && reckoning_.heading_known()) return wrapped_angle(reckoning_.at.heading_rad - wall_heading_rad_);
      return angle_.value;
    }
    float angle = left.angle_known ? left.angle_rad : right.angle_rad;
    if (left.angle_known && right.angle_known) angle = 0.5f * (left.angle_rad + right.angle_rad);
    angle = angle_.step(angle, kTau_s, dt);
    if (reckoning_.heading_known()) {
      const float heading = wrapped_angle(reckoning_.at.heading_rad - angle);
      wall_heading_rad_ += wall_heading_known_ ? wrapped_angle(heading - wall_heading_rad_) * (dt / (0.2f + dt)) : heading;
      wall_heading_rad_ = wrapped_angle(wall_heading_rad_);
      wall_heading_known_ = true;
    }
    return angle;
  }

  [[nodiscard]] Motion across_gap(const Senses& senses, float dt) noexcept {
    gone_m_ += dt * (senses.odometry_known ? searched_m_s(senses, gains.speed_m_s) : gains.speed_m_s);
    lost_ = gone_m_ >= gains.gap_m;
    left_.reset();
    angle_.reset();
    if (lost_) return {};
    const bool heading = wall_heading_known_ && reckoning_.heading_known();
    return along(0.0f, heading ? wrapped_angle(reckoning_.at.heading_rad - wall_heading_rad_) : 0.0f);
  }

  [[nodiscard]] Motion round_corner(const Senses& senses, float change) noexcept {
    const float hand = to_left_ ? 1.0f : -1.0f;
    turned_rad_ += hand * change;
    const WallSight outer = look_at_wall(senses, !to_left_, half_width_m_ + gains.reach_m);
    const bool runs_along = outer.angle_known && hand * outer.angle_rad > -kAligned_rad;
    const bool clear = senses.range_m[0] > half_width_m_ + 0.45f;
    if ((clear && runs_along && turned_rad_ > 0.3f) || turned_rad_ > 88.0f * kRadPerDeg) {
      corner_ = false;
      wall_heading_known_ = false;
      left_.reset();
      angle_.reset();
    }
    const float speed = least(gains.speed_m_s, 0.8f * gains.turn_rad_s * gains.corner_radius_m);
    return {speed, hand * speed / gains.corner_radius_m};
  }

  static constexpr float kTau_s = 0.05f, kAligned_rad = 10.0f * kRadPerDeg;
  static constexpr float kDiagonal = 1.8f;   ///< times half the width; at 45 degrees a wall beside is 1.4 times away
  Reckoning reckoning_{};
  OneWall one_{};
  LowPass left_{}, angle_{};
  float half_width_m_ = 0.3f, wall_heading_rad_ = 0.0f;
  float straight_s_ = 0.0f;   ///< time between two walls whose angles agree
  float gone_m_ = 0.0f;       ///< distance since there was a wall
  float turned_rad_ = 0.0f;   ///< angle turned in the corner
  float last_turn_rad_s_ = 0.0f;
  bool wall_heading_known_ = false, width_known_ = false, corner_ = false, to_left_ = false, lost_ = false;
};

}  // namespace mts
