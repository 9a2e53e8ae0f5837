// What the three manoeuvres have in common: how a crossing is driven from the stop line in to the stop line out.
//
//        |  out |                 The frame's origin is the middle of the crossing, its axes are those of the compass.
//        |==3===|                 1  the row of line sensors lies on the stop line in; the robot may stand askew
//   -----'  |   '-----            2  a bend of the radius R in the middle (`back`: a turn on the spot)
//           2--------1 in         3  the row of line sensors is on the stop line out: done
//   ------------------
// The robot drives two straight pieces and a bend as course.h says, by reckoning (reckoning.h); line and walls correct the reckoning.
// Corrections are those of a fixed-gain observer (Luenberger): place += gain * (measured - reckoned).
//
// The manoeuvre ends at the stop line out. If that line does not come, the robot stops `overrun` past its expected place and is `lost()`.
// If the line sensors are silent, it stops at the expected place and is done.
#pragma once

#include "course.h"
#include "gain.h"
#include "heard.h"
#include "line_sight.h"

namespace mts {

struct CrossingGains {
  float speed_m_s = 0.25f;
  float convergence_1_m = 9.0f;
  float turn_rad_s = 145.0f * kRadPerDeg;
  float bend_radius_m = 0.06f;
  float overrun_m = 0.25f;
};

inline constexpr Gain<CrossingGains> kCrossingGains[] = {
    gain("speed", "m/s", &CrossingGains::speed_m_s, 0.05f, 0.6f, "on straight pieces"),
    gain("convergence", "1/m", &CrossingGains::convergence_1_m, 2.0f, 15.0f, "lambda: how quickly errors decay over the way"),
    angle_gain("turn_speed", "deg/s", &CrossingGains::turn_rad_s, 20.0f, 240.0f, "the fastest turn"),
    gain("bend_radius", "m", &CrossingGains::bend_radius_m, 0.0f, 0.3f, "of the turn in the middle; 0: on the spot"),
    gain("overrun", "m", &CrossingGains::overrun_m, 0.0f, 1.0f, "how far past the stop line's place it looks for it"),
};

/// The angle from the heading of the road in to the heading of the road out, at a crossing of four roads.
[[nodiscard]] constexpr float angle_of_turn(Turn turn) noexcept {
  switch (turn) {
    case Turn::kLeft: return 0.5f * kPi;
    case Turn::kRight: return -0.5f * kPi;
    case Turn::kBack: return kPi;
    case Turn::kForward: break;
  }
  return 0.0f;
}

class Crossing {
 public:
  Reckoning reckoning{};

  void start(const Task& task, const Senses& senses, const CrossingGains& gains, const Body& body) noexcept {
    *this = Crossing{};
    gains_ = gains;
    body_ = body;
    begun_ = true;
    turn_ = task.turn;
    const float span = task.crossing_m > 0.1f ? task.crossing_m : body.crossing_m;
    in_m_ = task.middle_m > 0.0f && task.middle_m < span ? task.middle_m : 0.5f * span;
    out_m_ = span - in_m_;
    const Headings headings = headings_of(task, senses);
    // Where the robot stands: on the line, or past it, since stopping takes a moment.
    const float past = look_at_line(senses, body).across ? 0.0f : 0.5f * body.stop_line_width_m + 0.02f;
    const float back = in_m_ + body.line_ahead_m - past;
    Place begin{-back * cosine(headings.in), -back * sine(headings.in), headings.in};
    // A robot that came to the line from the side, on its way round something, has the row on the line and its centre anywhere.
    if (senses.heading_known && magnitude(wrapped_angle(senses.heading_rad - headings.in)) > kAskew_rad) {
      const float row = body.line_ahead_m - past;
      begin.x_m = -in_m_ * cosine(headings.in) - row * cosine(senses.heading_rad);
      begin.y_m = -in_m_ * sine(headings.in) - row * sine(senses.heading_rad);
    }
    Place axis = begin;
    float to_middle = back;
    if (task.entry_known && task.entry_left_m != 0.0f && magnitude(task.entry_left_m) < kStopLineEnds_m) {
      to_middle = -(begin.x_m * cosine(headings.in) + begin.y_m * sine(headings.in));
      axis = {-to_middle * cosine(headings.in), -to_middle * sine(headings.in), headings.in};
      begin = {axis.x_m - task.entry_left_m * sine(headings.in), axis.y_m + task.entry_left_m * cosine(headings.in), headings.in};
    }
    reckoning.start(senses, begin);
    const Piece pieces[] = {{headings.in, to_middle}, {headings.out, out_m_}};
    course_.start(pieces, 2, gains.bend_radius_m, axis);
    on_ = course_.at(reckoning.at);
  }

  /// Advances the reckoning by one period. False: the robot is blind and must stop.
  [[nodiscard]] bool reckon(const Senses& senses, float dt_s) noexcept {
    reckoning.step(senses, dt_s);
    if (!reckoning.heading_known() || !reckoning.distance_known()) return false;
    on_ = course_.at(reckoning.at);
    return true;
  }

  /// The motion; zero before `start`, and once the manoeuvre is done or lost.
  [[nodiscard]] Motion steer(const Senses& senses) noexcept {
    look_for_end(senses);
    if (!begun_ || done_ || lost_) return {};
    return braked(along_course(on_, {gains_.speed_m_s, gains_.convergence_1_m, gains_.turn_rad_s, 0.8f}),
                  senses, body_);
  }

  /// Whether the robot is on the straight piece in, or on the one out.
  [[nodiscard]] bool entering() const noexcept { return course_.piece() == 0 && !course_.in_bend(); }
  [[nodiscard]] bool leaving() const noexcept { return course_.on_last(); }
  [[nodiscard]] const OnCourse& on() const noexcept { return on_; }
  /// The distance past the middle of the crossing, in the direction of the piece that is driven.
  [[nodiscard]] float past_middle_m() const noexcept {
    return course_.piece() == 0 ? on_.along_m - course_.current().length_m : on_.along_m;
  }

  /// The distance past the stop line in, on the piece that leads in.
  [[nodiscard]] float past_entry_m() const noexcept { return in_m_ + past_middle_m(); }

  /// Moves the reckoned place to the left of, and along, the piece that is driven.
  void correct(float left_m, float ahead_m) noexcept {
    const float ux = cosine(course_.current().heading_rad), uy = sine(course_.current().heading_rad);
    reckoning.at.x_m += ahead_m * ux - left_m * uy;
    reckoning.at.y_m += ahead_m * uy + left_m * ux;
    on_ = course_.at(reckoning.at);
  }

  [[nodiscard]] bool forward() const noexcept { return turn_ == Turn::kForward; }
  [[nodiscard]] bool turns_aside() const noexcept { return turn_ == Turn::kLeft || turn_ == Turn::kRight; }
  [[nodiscard]] bool done() const noexcept { return done_; }
  [[nodiscard]] bool lost() const noexcept { return lost_; }

 private:
  struct Headings { float in, out; };

  /// The headings in and out. What the task does not know follows from the other and the turn; an entry that contradicts the compass is the
  /// heading, and then compass and turn give both.
  [[nodiscard]] static Headings headings_of(const Task& task, const Senses& senses) noexcept {
    constexpr float kNear = 40.0f * kRadPerDeg, kSlant = 70.0f * kRadPerDeg;
    const float turn = angle_of_turn(task.turn);
    if (!task.exit_known) {
      const float in = task.entry_known ? task.entry_heading_rad : senses.heading_known ? wrapped_angle(senses.heading_rad) : 0.0f;
      return {in, wrapped_angle(in + turn)};
    }
    const float guess = wrapped_angle(task.exit_heading_rad - turn);
    Headings headings{task.entry_heading_rad, task.exit_heading_rad};
    if (task.entry_known) return headings;
    const bool fits = !senses.heading_known || magnitude(wrapped_angle(senses.heading_rad - guess)) < kNear;
    headings.in = fits ? guess : wrapped_angle(senses.heading_rad);
    if (magnitude(wrapped_angle(headings.out - headings.in - turn)) > kSlant) headings.out = wrapped_angle(headings.in + turn);
    return headings;
  }

  void look_for_end(const Senses& senses) noexcept {
    if (done_ || !leaving()) return;
    const float row = on_.along_m + body_.line_ahead_m;   // from the middle
    if (!senses.line_known) {
      done_ = row >= out_m_;
      return;
    }
    done_ = row > 0.55f * out_m_ && magnitude(on_.turned_rad) < 0.5f && look_at_line(senses, body_).across;
    lost_ = !done_ && row > out_m_ + gains_.overrun_m;
  }

  static constexpr float kAskew_rad = 20.0f * kRadPerDeg;
  static constexpr float kStopLineEnds_m = 0.5f;   ///< no stop line reaches farther from its middle; the comparison is false for NaN too
  CrossingGains gains_{};
  Body body_{};
  Course course_{};
  OnCourse on_{};
  float in_m_ = 0.35f, out_m_ = 0.35f;   // from the middle to the stop lines
  Turn turn_ = Turn::kForward;
  bool begun_ = false, done_ = false, lost_ = false;
};

}  // namespace mts
