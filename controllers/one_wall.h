// Keeps one wall, or whatever stands there, at one hand: past corners that come towards the robot and corners that recede.
//
//   along    omega = -v (lambda^2 e + 2 lambda psi), e the distance less the wanted one, both to the left (course.h: the same
//            law, by what the range finders see)
//   inner    something is ahead within distance + corner_radius: it turns away on the spot until ahead is free and the wall
//            is beside it, or it has turned by a quarter
//   outer    the wall beside it ends: it goes round the corner on a circle of the wanted distance, until there is a wall
//            beside it again; after three quarters of a turn, or `gap` of way, it stops
//   search   there has been no wall yet: straight on, at most `gap`
// ("wall following" of Lumelsky and Stepanov, Algorithmica 2, 1987, with the corners made explicit.)
#pragma once

#include "controllers/filter.h"
#include "controllers/heard.h"
#include "controllers/reckoning.h"
#include "controllers/wall_sight.h"

namespace mts {

struct OneWallGains {
  float speed_m_s = 0.2f;
  float distance_m = 0.2f;           ///< from the robot's centre
  float convergence_1_m = 6.0f;
  float turn_rad_s = 2.0f;
  float corner_radius_m = 0.12f;
  float reach_m = 0.35f;             ///< beyond the wanted distance, where a wall is still the wall
  float gap_m = 1.0f;
};

class OneWall {
 public:
  /// `left`: the wall is at the left hand.
  void start(bool left) noexcept {
    *this = OneWall{};
    left_ = left;
  }

  /// The motion while something may be beside; the senses have been `heard` and the range finders are known.
  [[nodiscard]] Motion step(const Senses& senses, float heading_change_rad, float dt, const OneWallGains& gains,
                            const Body& body) noexcept {
    const float hand = left_ ? 1.0f : -1.0f;
    const WallSight wall = look_at_wall(senses, left_, gains.distance_m + gains.reach_m);
    const float ahead = senses.range_m[0], aslant = range_at(senses, left_, 1);
    const float near = gains.distance_m + gains.corner_radius_m;
    if (!away_ && (ahead < near || aslant < body.radius_m + 0.04f)) {
      away_ = true;
      turned_rad_ = 0.0f;
    }
    if (away_) {
      turned_rad_ -= hand * heading_change_rad;
      const bool clear = ahead > near + 0.12f && aslant > 1.1f * gains.distance_m;
      away_ = !(clear && (wall.beside || turned_rad_ > 0.5f * kPi)) && turned_rad_ < 1.9f * kPi;
      if (away_) return {0.0f, -hand * gains.turn_rad_s * (turned_rad_ > 0.4f * kPi ? 0.6f : 1.0f)};
      turned_rad_ = 0.0f;
    }
    if (wall.beside) return along(wall, hand, dt, gains);
    const float speed = met_ ? least(gains.speed_m_s, 0.8f * gains.turn_rad_s * gains.distance_m) : gains.speed_m_s;
    gone_m_ += dt * (senses.odometry_known ? magnitude(senses.speed_m_s) : speed);
    if (met_) turned_rad_ += hand * heading_change_rad;
    if (lost(gains)) return {};
    angle_.reset();
    distance_.reset();
    return {speed, met_ ? hand * speed / gains.distance_m : 0.0f};
  }

  /// There is nothing beside it, and there was nothing for too long.
  [[nodiscard]] bool lost(const OneWallGains& gains) const noexcept {
    return gone_m_ >= gains.gap_m || turned_rad_ > 1.5f * kPi;
  }

 private:
  [[nodiscard]] Motion along(const WallSight& wall, float hand, float dt, const OneWallGains& gains) noexcept {
    met_ = true;
    gone_m_ = turned_rad_ = 0.0f;
    const float distance = distance_.step(wall.distance_m, kTau_s, dt);
    const float angle = wall.angle_known ? angle_.step(wall.angle_rad, kTau_s, dt) : 0.0f;
    const float l = gains.convergence_1_m;
    const float left = clamped(hand * (gains.distance_m - distance), -1.2f / l, 1.2f / l);
    const float speed = gains.speed_m_s * (1.0f - 0.6f * least(magnitude(angle), 1.0f));
    return {speed, clamped(-speed * (l * l * left + 2.0f * l * angle), -gains.turn_rad_s, gains.turn_rad_s)};
  }

  static constexpr float kTau_s = 0.04f;
  LowPass distance_{}, angle_{};
  float gone_m_ = 0.0f;       ///< since there was a wall
  float turned_rad_ = 0.0f;   ///< away from the wall, or towards it round an outer corner
  bool left_ = false, away_ = false, met_ = false;
};

}  // namespace mts
