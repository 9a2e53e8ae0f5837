// A course of straight pieces with rounded bends, where a place is on it, and the motion that leads along it.
//
// In a frame that moves along the course (e: how far to its left the robot is; psi: the robot's heading against it; kappa: its curvature):
//   e' = v sin(psi),  psi' = omega - v kappa
//   omega = v (kappa - lambda^2 e - 2 lambda psi)
// makes e decay over the way s as e'' + 2 lambda e' + lambda^2 e = 0: critically damped, and the same at every speed
// (Canudas de Wit, Siciliano, Bastin, "Theory of Robot Control", 1996, chapter 9; linearised). Before a bend of radius R
// that is driven with omega_b, the speed falls as v^2 = (omega_b R)^2 + 2 a s.
#pragma once

#include "reckoning.h"

namespace mts {

/// Where a place is on a course.
struct OnCourse {
  float left_m = 0.0f;          ///< e
  float turned_rad = 0.0f;      ///< psi
  float curvature_1_m = 0.0f;   ///< kappa
  float along_m = 0.0f;         ///< from the beginning of the piece, along it; negative at the end of the bend before it
  float to_bend_m = 1e3f;       ///< to the beginning of the next bend
  float bend_radius_m = 0.0f;   ///< R, of that bend or of the one that it is in; 0: it turns on the spot
  bool on_the_spot = false;     ///< the bend is so sharp that the robot turns on the spot in its corner
};

class Course {
 public:
  /// Copies `pieces`; the first begins at `from`. Bends are rounded with `radius_m`, or less where a piece is short. Bends of more than
  /// 120 degrees, and all bends if the radius is 0, are turned on the spot.
  constexpr void start(const Piece* pieces, std::size_t count, float radius_m, const Place& from) noexcept {
    *this = Course{};
    count_ = count < kLongestCourse ? count : kLongestCourse;
    for (std::size_t i = 0; i < count_; ++i) pieces_[i] = pieces[i];
    radius_m_ = radius_m;
    x_m_ = from.x_m;
    y_m_ = from.y_m;
    measure_bend();
  }

  /// Advances along the course to the piece where the place is now. Cost: a few sines.
  constexpr OnCourse at(const Place& place) noexcept;

  /// Whether there is nothing to drive along: it has not been started, or without pieces.
  [[nodiscard]] constexpr bool empty() const noexcept { return count_ == 0; }
  /// Index of the piece that is driven; whether the robot is in the bend at its end.
  [[nodiscard]] constexpr std::size_t piece() const noexcept { return piece_; }
  [[nodiscard]] constexpr bool in_bend() const noexcept { return in_bend_; }
  [[nodiscard]] constexpr bool on_last() const noexcept { return piece_ + 1 >= count_ && !in_bend_; }
  [[nodiscard]] constexpr const Piece& current() const noexcept { return pieces_[piece_]; }

 private:
  constexpr void measure_bend() noexcept {
    tangent_m_ = 0.0f;
    bend_rad_ = 0.0f;
    bend_radius_m_ = kStraight_m;
    spot_ = false;
    if (piece_ + 1 >= count_) return;
    bend_rad_ = wrapped_angle(pieces_[piece_ + 1].heading_rad - pieces_[piece_].heading_rad);
    const float half = 0.5f * magnitude(bend_rad_);
    if (half < 0.01f) return;
    spot_ = half > 60.0f * kRadPerDeg || !(radius_m_ > 0.01f);
    if (spot_) return;
    const float slope = sine(half) / cosine(half);
    const float shorter = least(pieces_[piece_].length_m, pieces_[piece_ + 1].length_m);
    tangent_m_ = least(radius_m_ * slope, 0.5f * shorter);
    bend_radius_m_ = greatest(tangent_m_ / slope, 0.01f);
  }
  constexpr OnCourse on_straight(const Place& place) const noexcept {
    const Piece& piece = pieces_[piece_];
    const float ux = cosine(piece.heading_rad), uy = sine(piece.heading_rad);
    const float dx = place.x_m - x_m_, dy = place.y_m - y_m_;
    OnCourse on;
    on.along_m = dx * ux + dy * uy;
    on.left_m = dy * ux - dx * uy;
    on.turned_rad = wrapped_angle(place.heading_rad - piece.heading_rad);
    on.bend_radius_m = spot_ ? 0.0f : bend_radius_m_;
    if (piece_ + 1 < count_) on.to_bend_m = piece.length_m - tangent_m_ - on.along_m;
    return on;
  }
  constexpr OnCourse on_bend(const Place& place) const noexcept;
  constexpr void next_piece() noexcept {
    x_m_ += pieces_[piece_].length_m * cosine(pieces_[piece_].heading_rad);
    y_m_ += pieces_[piece_].length_m * sine(pieces_[piece_].heading_rad);
    ++piece_;
    in_bend_ = false;
    measure_bend();
  }

  static constexpr float kStraight_m = 1e3f;   ///< the radius where the course goes straight on
  Piece pieces_[kLongestCourse] = {};
  std::size_t count_ = 0, piece_ = 0;
  float radius_m_ = 0.0f;
  float x_m_ = 0.0f, y_m_ = 0.0f;   ///< where the current piece begins
  float tangent_m_ = 0.0f, bend_radius_m_ = 0.0f, bend_rad_ = 0.0f;   ///< of the bend at its end
  bool in_bend_ = false, spot_ = false;
};

constexpr OnCourse Course::on_bend(const Place& place) const noexcept {
  const Piece& piece = pieces_[piece_];
  const Piece& next = pieces_[piece_ + 1];
  const float ux = cosine(piece.heading_rad), uy = sine(piece.heading_rad);
  const float side = sign_of(bend_rad_);
  OnCourse on;
  on.to_bend_m = 0.0f;
  if (spot_) {
    on = on_straight(place);
    on.turned_rad = wrapped_angle(place.heading_rad - next.heading_rad);
    on.to_bend_m = 0.0f;
    on.on_the_spot = true;
    return on;
  }
  // The centre of the arc lies square to the piece, beside the place where the bend begins.
  const float begin = piece.length_m - tangent_m_;
  const float cx = x_m_ + begin * ux - side * bend_radius_m_ * uy;
  const float cy = y_m_ + begin * uy + side * bend_radius_m_ * ux;
  const float rx = place.x_m - cx, ry = place.y_m - cy;
  const float tangent_heading = angle_of(rx, ry) + side * 0.5f * kPi;
  on.left_m = side * (bend_radius_m_ - square_root(rx * rx + ry * ry));
  on.turned_rad = wrapped_angle(place.heading_rad - tangent_heading);
  on.curvature_1_m = side / bend_radius_m_;
  on.bend_radius_m = bend_radius_m_;
  return on;
}

constexpr OnCourse Course::at(const Place& place) noexcept {
  for (std::size_t guard = 0; guard < 2 * kLongestCourse && piece_ + 1 < count_; ++guard) {
    if (!in_bend_) {
      const OnCourse on = on_straight(place);
      if (on.to_bend_m > 0.0f) return on;
      in_bend_ = true;
    }
    if (spot_) {
      const OnCourse on = on_bend(place);
      if (magnitude(on.turned_rad) > 4.0f * kRadPerDeg) return on;
      next_piece();
      continue;
    }
    const Piece& piece = pieces_[piece_];
    const Piece& next = pieces_[piece_ + 1];
    const float ux = cosine(next.heading_rad), uy = sine(next.heading_rad);
    const float corner_x = x_m_ + piece.length_m * cosine(piece.heading_rad);
    const float corner_y = y_m_ + piece.length_m * sine(piece.heading_rad);
    const float past = (place.x_m - corner_x) * ux + (place.y_m - corner_y) * uy;
    if (past < tangent_m_ && magnitude(bend_rad_) >= 0.02f) return on_bend(place);
    next_piece();
  }
  return on_straight(place);
}

/// How a course is driven.
struct CourseGains {
  float speed_m_s = 0.3f;          ///< on straight pieces; above 0
  float convergence_1_m = 8.0f;    ///< lambda: an error is halved within 0.2 m of way at 8; [2, 15]
  float turn_rad_s = 2.0f;         ///< the fastest turn, also on the spot; (0, 4]
  float slowing_m_s2 = 0.6f;       ///< a, before bends; (0, 1.5]
};

/// The motion from a place on the course. A robot turned away from it by more than 60 degrees turns on the spot.
[[nodiscard]] constexpr Motion along_course(const OnCourse& on, const CourseGains& gains) noexcept {
  constexpr float kTooFar = 60.0f * kRadPerDeg, kSpot_1_s = 4.0f;
  if (on.on_the_spot || magnitude(on.turned_rad) > kTooFar) {
    return {0.0f, clamped(-kSpot_1_s * on.turned_rad, -gains.turn_rad_s, gains.turn_rad_s)};
  }
  // In a bend, a part of the turning rate is kept for corrections.
  const float in_bend = greatest(0.8f * gains.turn_rad_s * on.bend_radius_m, 0.05f);
  float speed = square_root(in_bend * in_bend + 2.0f * gains.slowing_m_s2 * greatest(on.to_bend_m, 0.0f));
  speed = least(speed, gains.speed_m_s) * (1.0f - 0.7f * magnitude(on.turned_rad) / kTooFar);
  const float l = gains.convergence_1_m;
  const float left = clamped(on.left_m, -1.2f / l, 1.2f / l);   // from far away it approaches at an angle, not in a circle
  const float turn = speed * (on.curvature_1_m - l * l * left - 2.0f * l * on.turned_rad);
  return {speed, clamped(turn, -gains.turn_rad_s, gains.turn_rad_s)};
}

}  // namespace mts
