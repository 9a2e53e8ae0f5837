// Crosses a hall in a field of forces: the goal attracts, the nearest thing that the range finders have seen lately repels, and the
// robot goes where the sum pushes it (Khatib 1986; Filimonov and Filimonov 2019, whose equation numbers these are).
//
//   parabolic (4)   F_att = k d                      d: from the robot to the goal
//   conic     (5)   F_att = k
//   combined  (6)   F_att = k d for d <= near, k near beyond (joined without a jump; planners/potential.h says why)
//   F_rep = k_r (1/p - 1/zone) / p^2 for p < zone    p: from the robot's edge to the nearest point
//   kinematic (3)   v = F, at most `speed`;  k_r such that a force of `speed` is balanced at `balance`
//
// A robot on two wheels cannot move along F at once: it turns towards F, on the spot if the angle is large.
// The field may have minima other than the goal: seen from the goal, there is one behind every wall across the path. A robot that drives a
// distance of `patience`, or for 8 s, without getting nearer to the goal than before is trapped: `plight()` says so, and it stands.
// Without range finders, odometry, any heading or a hall, it stops.
#pragma once

#include "gain.h"
#include "hall.h"
#include "near_points.h"

namespace mts {

struct PotentialGains {
  FieldKind kind = FieldKind::kConic;
  float speed_m_s = 0.25f;
  float zone_m = 0.3f;
  float balance_m = 0.09f;
  float near_m = 0.5f;
  float turn_rad_s = 115.0f * kRadPerDeg;
  float patience_m = 3.0f;
};

/// Of `zone`: the farthest from the edge that a wall can hold the robot. At the zone's rim the repulsion is 0.
inline constexpr float kMostBalanceOfZone = 0.9f;

inline constexpr Gain<PotentialGains> kPotentialGains[] = {
    kind_gain("kind", &PotentialGains::kind, "how the goal attracts"),
    gain("speed", "m/s", &PotentialGains::speed_m_s, 0.05f, 0.6f, "the fastest; the conic attraction"),
    gain("zone", "m", &PotentialGains::zone_m, 0.1f, 1.0f, "from the robot's edge, where things repel"),
    gain("balance", "m", &PotentialGains::balance_m, 0.03f, 0.3f, "from the robot's edge, where a wall holds it at top speed; at most 0.9 of `zone`"),
    gain("near", "m", &PotentialGains::near_m, 0.1f, 2.0f, "from the goal, where the combined attraction begins to fall"),
    angle_gain("turn_speed", "deg/s", &PotentialGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    gain("patience", "m", &PotentialGains::patience_m, 0.5f, 50.0f, "how far it drives without coming nearer to the goal"),
};

class Potential : public HallController {
 public:
  PotentialGains gains;
  Body body;

  void start(const Task& task, const Senses& raw) noexcept {
    hall_.start(task, raw, body, Shut::kIn);
    points_.forget();
    plight_ = Plight::kNone;
  }

  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const float dt = sane_period(dt_s);
    const Senses senses = hall_.hear(raw, dt);
    if (hall_.blind() || !senses.range_known || plight_ != Plight::kNone) return {};
    if (hall_.missed_door()) plight_ = Plight::kTrapped;
    if (!hall_.crosses()) return hall_.through_door(senses, {gains.speed_m_s, gains.turn_rad_s});
    if (hall_.vain_m() > gains.patience_m || hall_.vain_s() > kPatience_s) {
      plight_ = Plight::kTrapped;
      return {};
    }
    points_.step_all(senses, hall_.at(), body.radius_m + gains.zone_m + 0.1f, dt);
    return braked(pushed(), senses, body);
  }

 private:
  [[nodiscard]] float attraction() const noexcept {
    const float d = hall_.to_gate(), k = gains.speed_m_s / gains.near_m;   // all kinds have the top speed at `near`
    switch (gains.kind) {
      case FieldKind::kParabolic: return k * d;
      case FieldKind::kConic: return gains.speed_m_s;
      case FieldKind::kCombined: return k * least(d, gains.near_m);
    }
    return 0.0f;
  }
  [[nodiscard]] float repulsion(float edge_m) const noexcept {
    const float p = greatest(edge_m, kLeast_m), b = least(gains.balance_m, kMostBalanceOfZone * gains.zone_m);
    if (p >= gains.zone_m) return 0.0f;
    const float k_r = gains.speed_m_s * b * b / (1.0f / b - 1.0f / gains.zone_m);
    return k_r * (1.0f / p - 1.0f / gains.zone_m) / (p * p);
  }
  [[nodiscard]] Motion pushed() const noexcept {
    const float bearing = hall_.bearing(hall_.gate()), pull = attraction();
    float ahead = pull * cosine(bearing), left = pull * sine(bearing);
    const NearPoints::Nearest wall = points_.nearest_of_all(hall_.at());
    if (wall.found) {
      const float push = repulsion(wall.distance_m - body.radius_m);
      ahead -= push * cosine(wall.bearing_rad);
      left -= push * sine(wall.bearing_rad);
    }
    const float force = square_root(ahead * ahead + left * left);
    return towards(angle_of(ahead, left), {least(force, gains.speed_m_s), gains.turn_rad_s});
  }

  static constexpr float kPatience_s = 8.0f, kLeast_m = 0.01f;
  NearPoints points_{};
};

}  // namespace mts
