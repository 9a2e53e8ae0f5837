// What all controllers that cross a hall have in common: where the robot is between the two doors, how it comes in by one and goes out
// by the other, and whether it still gets nearer to that one.
//
//        stop line   door                               door   stop line
//      ═══ in ═══════╡                                    ╞═══════ out ═══      x: the point `in_hall` behind the door out, on
//                    │   ·  what stands there  ·      x   │                     its axis. There the crossing ends and the door
//                    ╰────────────────────────────────────╯                     begins: both doors are driven along their axes.
//
// The place is reckoned (reckoning.h) from where the strategy begins. On the way out, the walls beside the door correct it across the
// axis. While the robot crosses, doors can be shut in its senses: the range finders then see a wall there. Otherwise a controller that
// follows walls or is repelled by them would leave by the door by which it came in.
#pragma once

#include "body.h"
#include "course.h"
#include "heard.h"

namespace mts {

/// How fast the robot drives through doors, and turns in halls.
struct HallGains {
  float speed_m_s = 0.25f;
  float turn_rad_s = 115.0f * kRadPerDeg;
};

/// Which doors the range finders see as walls while the robot crosses.
enum class Shut : std::uint8_t { kNone, kIn, kBoth };

class Hall {
 public:
  constexpr void start(const Task& task, const Senses& raw, const Body& body, Shut doors) noexcept {
    *this = Hall{};
    body_ = body;
    shut_ = doors;
    in_ = task.in;
    out_ = task.out;
    known_ = task.in_hall;
    reckoning_.start(heard(raw, body_), {0.0f, 0.0f, task.in.heading_rad});   // the robot stands in the door in
    const Place in = along(in_);
    phase_ = in.x_m < body_.hall_door_m + kIn_m && magnitude(in.y_m) < kOnAxis_m ? Phase::kIn : Phase::kAcross;
    const float behind = body_.hall_door_m + kIn_m + 0.08f;
    gate_ = {out_.x_m - behind * cosine(out_.heading_rad), out_.y_m - behind * sine(out_.heading_rad), out_.heading_rad};
    best_m_ = to_gate();
  }

  /// Takes one sample: reckons, and returns the senses with the doors shut and with nobody coming, since the walls all round would be
  /// mistaken for somebody who comes (comers.h).
  [[nodiscard]] constexpr Senses hear(const Senses& raw, float dt_s) noexcept {
    Senses senses = heard(raw, body_);
    senses.met_m = kOutOfRange;
    dt_s_ = sane_period(dt_s);
    reckoning_.step(senses, dt_s_);
    blind_ = !known_ || !reckoning_.heading_known() || !reckoning_.distance_known();
    const bool stands = !crosses() && !past() && reckoning_.way_m() < kCreeps_m_s * dt_s_;
    if (!blind_ && sees(senses)) stood_s_ = stands ? stood_s_ + dt_s_ : 0.0f;   // a robot that stands because its range finders are silent does not wait in vain
    if (blind_) return senses;
    if (phase_ == Phase::kIn && along(in_).x_m > body_.hall_door_m + kIn_m) phase_ = Phase::kAcross;
    if (phase_ == Phase::kAcross && to_gate() < kAtGate_m) phase_ = Phase::kOut;
    if (phase_ == Phase::kOut && along(out_).x_m > kOverrun_m) phase_ = Phase::kPast;
    if (phase_ == Phase::kOut && senses.range_known) centre(senses);
    if (phase_ != Phase::kAcross) return senses;
    if (senses.range_known) watch();
    if (senses.range_known && shut_ != Shut::kNone) shut(in_, 1.0f, senses);
    if (senses.range_known && shut_ == Shut::kBoth) shut(out_, -1.0f, senses);
    return senses;
  }

  /// Whether the range finders say what stands in the way, or the body has none: the robot then drives. The senses must have been `heard`.
  [[nodiscard]] constexpr bool sees(const Senses& senses) const noexcept { return senses.range_known || !body_.has_range_finders; }
  /// Whether it knows of no hall, or not where it is.
  [[nodiscard]] constexpr bool blind() const noexcept { return blind_; }
  /// Whether the robot is between the doors: the controller decides its motion.
  [[nodiscard]] constexpr bool crosses() const noexcept { return phase_ == Phase::kAcross; }
  /// The motion through a door; past the end the robot stands.
  [[nodiscard]] constexpr Motion through_door(const Senses& senses, const HallGains& gains) const noexcept {
    if (phase_ == Phase::kPast) return {};
    const Place on = along(phase_ == Phase::kIn ? in_ : out_);
    OnCourse course;
    course.left_m = on.y_m;
    course.turned_rad = on.heading_rad;
    return braked(along_course(course, {gains.speed_m_s, 8.0f, gains.turn_rad_s, 0.6f}), senses, body_);
  }
  /// Whether the robot has stood before a door, in it, or where the stop line behind it should be, for so long that it must have missed the
  /// door: after a long way it knows less well where it is.
  [[nodiscard]] constexpr bool missed_door() const noexcept { return stood_s_ > kWaits_s; }
  /// Whether the robot is past the stop line while its strategy still runs.
  [[nodiscard]] constexpr bool past() const noexcept { return phase_ == Phase::kPast; }

  [[nodiscard]] constexpr const Place& at() const noexcept { return reckoning_.at; }
  [[nodiscard]] constexpr const Place& gate() const noexcept { return gate_; }
  [[nodiscard]] constexpr float travelled_m() const noexcept { return reckoning_.travelled_m(); }
  [[nodiscard]] constexpr float to_gate() const noexcept { return distance_to(gate_); }
  [[nodiscard]] constexpr float distance_to(const Place& place) const noexcept {
    const float dx = place.x_m - reckoning_.at.x_m, dy = place.y_m - reckoning_.at.y_m;
    return square_root(dx * dx + dy * dy);
  }
  /// The angle from ahead to a place, counter-clockwise.
  [[nodiscard]] constexpr float bearing(const Place& place) const noexcept {
    return wrapped_angle(angle_of(place.x_m - reckoning_.at.x_m, place.y_m - reckoning_.at.y_m) - reckoning_.at.heading_rad);
  }
  /// How far the robot has driven, and for how long, since it last came nearer to the gate than ever before.
  [[nodiscard]] constexpr float vain_m() const noexcept { return reckoning_.travelled_m() - best_at_m_; }
  [[nodiscard]] constexpr float vain_s() const noexcept { return vain_s_; }

 private:
  enum class Phase : std::uint8_t { kIn, kAcross, kOut, kPast };

  /// The robot's place in the frame of a door: x from its stop line along its axis, y to the left of the axis, the heading against the axis.
  [[nodiscard]] constexpr Place along(const Door& door) const noexcept {
    const float ux = cosine(door.heading_rad), uy = sine(door.heading_rad);
    const float dx = reckoning_.at.x_m - door.x_m, dy = reckoning_.at.y_m - door.y_m;
    return {dx * ux + dy * uy, dy * ux - dx * uy, wrapped_angle(reckoning_.at.heading_rad - door.heading_rad)};
  }

  /// Adds a wall across a door to what the range finders see. `side`: 1 behind its stop line, -1 before it.
  constexpr void shut(const Door& door, float side, Senses& senses) const noexcept {
    const Place on = along(door);
    const float wall = side * body_.hall_door_m, half = 0.5f * body_.road_width_m + 0.05f;
    for (std::size_t i = 0; i < kRangeFinders; ++i) {
      const float direction = on.heading_rad + range_finder_rad(i);
      const float slope = cosine(direction);
      if (magnitude(slope) < 0.05f) continue;
      const float range = (wall - on.x_m) / slope;
      if (range > 0.0f && range < senses.range_m[i] && magnitude(on.y_m + range * sine(direction)) < half) senses.range_m[i] = range;
    }
  }

  /// Corrects the place across the door's axis by the walls of the door, between which the axis is in the middle.
  constexpr void centre(const Senses& senses) noexcept {
    const Place on = along(out_);
    const float left = senses.range_m[2], right = senses.range_m[6], half = 0.5f * body_.road_width_m;
    const bool between = left < 1.5f * half && right < 1.5f * half && magnitude(left + right - 2.0f * half) < 0.1f;
    if (!between || magnitude(on.heading_rad) > 0.35f) return;
    const float wrong = on.y_m - 0.5f * (right - left);
    const float by = wrong * dt_s_ / (kDoorTau_s + dt_s_);
    reckoning_.at.x_m += by * sine(out_.heading_rad);
    reckoning_.at.y_m -= by * cosine(out_.heading_rad);
  }

  constexpr void watch() noexcept {
    vain_s_ += dt_s_;
    if (to_gate() > best_m_ - kNearer_m) return;
    best_m_ = to_gate();
    best_at_m_ = reckoning_.travelled_m();
    vain_s_ = 0.0f;
  }

  static constexpr float kIn_m = 0.22f;        ///< behind the door: from here on all of the robot is in the hall
  static constexpr float kCreeps_m_s = 0.01f, kWaits_s = 20.0f;
  static constexpr float kOnAxis_m = 0.2f, kAtGate_m = 0.12f, kOverrun_m = 0.3f, kNearer_m = 0.05f, kDoorTau_s = 0.15f;
  Reckoning reckoning_{};
  Body body_{};
  Door in_{}, out_{};
  Place gate_{};
  Phase phase_ = Phase::kIn;
  float dt_s_ = 0.0f, best_m_ = 0.0f, best_at_m_ = 0.0f, vain_s_ = 0.0f, stood_s_ = 0.0f;
  Shut shut_ = Shut::kNone;
  bool known_ = false, blind_ = true;
};

/// What the controllers that cross a hall tell of themselves. They start `hall_`, and set `plight_` where they can no longer get on.
class HallController {
 public:
  [[nodiscard]] bool done() const noexcept { return hall_.past(); }
  [[nodiscard]] bool lost() const noexcept { return hall_.past() || plight_ != Plight::kNone; }
  [[nodiscard]] Plight plight() const noexcept { return plight_; }

 protected:
  Hall hall_{};
  Plight plight_ = Plight::kNone;
};

/// Drives towards a bearing; turns on the spot while it is more than 35 degrees off.
[[nodiscard]] constexpr Motion towards(float bearing_rad, const HallGains& gains) noexcept {
  constexpr float kSpot = 35.0f * kRadPerDeg;
  const float turn = clamped(4.0f * bearing_rad, -gains.turn_rad_s, gains.turn_rad_s);
  if (magnitude(bearing_rad) > kSpot) return {0.0f, turn};
  return {gains.speed_m_s * (1.0f - 0.8f * magnitude(bearing_rad) / kSpot), turn};
}

}  // namespace mts
