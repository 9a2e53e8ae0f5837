// The three manoeuvres over a crossing; crossing.h says what they have in common. Each stops without odometry or any heading
// (neither compass nor `turned`).
#pragma once

#include "crossing.h"
#include "line_search.h"
#include "wall_sight.h"

namespace mts {

/// By compass and odometry alone.
class TurnByCompass {
 public:
  CrossingGains gains;
  Body body;

  void start(const Task& task, const Senses& senses) noexcept { crossing_.start(task, heard(senses, body), gains, body); }
  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = heard(raw, body);
    return crossing_.reckon(senses, sane_period(dt_s)) ? crossing_.steer(senses) : Motion{};
  }
  [[nodiscard]] bool done() const noexcept { return crossing_.done(); }
  [[nodiscard]] bool lost() const noexcept { return crossing_.lost(); }

 private:
  Crossing crossing_{};
};

/// By the painted lines that meet in the middle of the crossing.
///
/// Across: on a straight piece, a line under the row at y to the left says that the robot is e = -y - L psi to the left of the line (L: how
/// far the row lies ahead). The reckoned place follows it with a time constant of 80 ms, the heading with 8 rad/s for each metre. Along: an arm of the line to a side says that the row has reached the middle. An arm that comes in from the end
/// of the row belongs to a road at a sharp angle, and says how far the middle still is. One that grows out of the middle belongs to a fork,
/// and says how far the row has come since. Up to 7 cm of line beyond the reckoned middle say that the middle is farther.
///
/// A measurement that differs from the reckoning by more than 6 cm, or half of a row that is broader than 12 cm (along: 9 cm), is ignored.
/// A robot that comes by compass may enter beside the line: if there is no line behind the stop line, it searches 16 cm to the left and to
/// the right if there is room (line_search.h), and goes on by reckoning if there is none. If the line sensors are silent, it stops.
class TurnOnLine {
 public:
  CrossingGains gains;
  Body body;

  void start(const Task& task, const Senses& senses) noexcept {
    crossing_.start(task, heard(senses, body), gains, body);
    middle_found_ = false;
    beside_ = {};
    wide_m_ = kNever_m;
    forks_ = false;
    held_m_ = 0.0f;
    search_ = {};
  }
  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = heard(raw, body);
    const float dt = sane_period(dt_s);
    if (!crossing_.reckon(senses, dt) || !senses.line_known) return {};
    const LineSight line = look_at_line(senses, body);
    look_behind_stop_line(line, senses);
    if (search_.runs()) return search(line, senses, dt);
    correct(line, dt);
    return crossing_.steer(senses);
  }
  [[nodiscard]] bool done() const noexcept { return crossing_.done(); }
  [[nodiscard]] bool lost() const noexcept { return crossing_.lost(); }

 private:
  // Begins the search for the line as soon as the row, even if turned to a side, would be clear of the stop line: nothing but the line is
  // painted there.
  void look_behind_stop_line(const LineSight& line, const Senses& senses) noexcept {
    if (!search_.waits() || !crossing_.entering()) return;
    const float past = crossing_.past_entry_m(), clear = 0.5f * body.stop_line_width_m + 0.02f;
    if (past + body.line_ahead_m > clear && line.seen) return search_.end();
    if (past < clear + body.line_sensor_left_m(0) + 0.02f || magnitude(crossing_.on().left_m) > kBeside_m) return;
    if (LineSearch::has_room(senses, body)) search_.begin(crossing_.on());
    else search_.end();
  }

  [[nodiscard]] Motion search(const LineSight& line, const Senses& senses, float dt) noexcept {
    if (search_.look(crossing_.on(), line, body, dt)) crossing_.correct(-search_.line_left_m(), 0.0f);
    return braked(search_.steer(crossing_.on(), gains.speed_m_s, gains.turn_rad_s), senses, body);
  }

  /// Whether the row has just come to the middle. Then its place along the way in is corrected.
  [[nodiscard]] bool finds_middle(const LineSight& line, float row) noexcept {
    if (!crossing_.entering() || middle_found_ || row < -kSharp_m) return false;
    beside_.left_m = line.left_beside ? least(beside_.left_m, row) : beside_.left_m;
    beside_.right_m = line.right_beside ? least(beside_.right_m, row) : beside_.right_m;
    wide_m_ = line.wide() ? least(wide_m_, row) : line.forked ? wide_m_ : kNever_m;
    forks_ = beside_.left_m == kNever_m && beside_.right_m == kNever_m && row - wide_m_ > kSquare_m;
    const bool left = line.across || line.left_arm, right = line.across || line.right_arm;
    if (!(left || right || (line.forked && forks_)) || magnitude(crossing_.on().turned_rad) > 0.25f) return false;
    const float arm = greatest(left ? before_middle_m(row - beside_.left_m) : 0.0f, right ? before_middle_m(row - beside_.right_m) : 0.0f);
    const float before = forks_ ? -kFork * (row - wide_m_) : arm;
    middle_found_ = magnitude(row + before) < kFits_m;
    if (middle_found_) crossing_.correct(0.0f, -before - row);
    return middle_found_;
  }

  void correct(const LineSight& line, float dt) noexcept {
    const OnCourse on = crossing_.on();
    const float row = crossing_.past_middle_m() + body.line_ahead_m;
    if (finds_middle(line, row)) return;
    // The line goes on where the middle was reckoned to be: the crossing is longer than was thought.
    const bool awaits_middle = crossing_.entering() && crossing_.turns_aside() && !middle_found_;
    if (awaits_middle && line.narrow() && row > 0.0f && held_m_ < kLongest_m) {
      held_m_ += row;
      crossing_.correct(0.0f, -row);
    }
    if (!line.narrow() || magnitude(on.turned_rad) > 0.3f) return;
    if (!crossing_.entering() && !crossing_.leaving()) return;
    if (crossing_.entering() ? middle_found_ && forks_ : row < 0.04f) return;   // lines of other roads meet here
    const float off = -line.left_m - body.line_ahead_m * on.turned_rad - on.left_m;
    if (magnitude(off) > greatest(kAside_m, body.line_sensor_left_m(0))) return;
    crossing_.correct(off * (dt / (kPlaceTau_s + dt)), 0.0f);
    crossing_.reckoning.correct_heading(clamped(kHeading_rad_m_s * off * dt, -0.02f, 0.02f));   // who is farther to the left than reckoned also faces farther to the left
  }

  /// How far the row is before the middle when an arm has reached its second sensor, `since_m` of way after the first. The arm of a road
  /// that meets this one at an angle a comes nearer by tan(a) = pitch / since_m; at a right angle it reaches both at once.
  [[nodiscard]] float before_middle_m(float since_m) const noexcept {
    const float second = body.line_sensor_left_m(1), pitch = body.line_sensor_left_m(0) - second;
    const float cotangent = since_m > kSquare_m ? since_m / pitch : 0.0f;
    return second * cotangent + 0.5f * body.paint_width_m * square_root(1.0f + cotangent * cotangent);
  }

  /// Where roads fork, half the width of the two lines together grows from 1.5 cm in the middle over 2.3 cm, too wide for one line, to 4 cm,
  /// as wide as the row. The way from the middle to there is kFork times the way since they became too wide for one.
  static constexpr float kFork = 1.5f;
  static constexpr float kBeside_m = 0.05f;   ///< farther than this from the line's expected place it does not search yet
  static constexpr float kAside_m = 0.06f;
  static constexpr float kPlaceTau_s = 0.08f;
  static constexpr float kHeading_rad_m_s = 8.0f;   ///< radians a second for each metre of the line's deviation
  static constexpr float kLongest_m = 0.07f;
  static constexpr float kSharp_m = 0.3f;   ///< an arm is not seen farther than this before the middle
  static constexpr float kSquare_m = 0.006f; ///< about one control period, or a robot that is a little askew
  static constexpr float kFits_m = 0.09f;
  static constexpr float kNever_m = 1e3f;
  Crossing crossing_{};
  LineSearch search_{};
  float held_m_ = 0.0f;   ///< how much farther the middle is than was reckoned
  bool middle_found_ = false;
  bool forks_ = false;   ///< paint has grown out of the line, as where roads fork
  struct Rows { float left_m = kNever_m, right_m = kNever_m; };
  Rows beside_{};   ///< where the row was when an arm was first seen beside the line
  float wide_m_ = kNever_m;   ///< where the row was when the paint became too wide for one line
};

/// By the walls of the roads. Between two walls, or beside one, distances and angles (wall_sight.h) correct the place across and the
/// heading. The place along is corrected where the wall on the side of the turn ends, or by the distance to a wall ahead. A measurement
/// that differs from the reckoning by more than 12 cm (one wall alone: 6 cm) is ignored. If the range finders are silent, it stops.
class TurnByWalls {
 public:
  CrossingGains gains;
  Body body;

  void start(const Task& task, const Senses& senses) noexcept {
    crossing_.start(task, heard(senses, body), gains, body);
    half_width_m_ = 0.5f * body.road_width_m;
    was_beside_[0] = was_beside_[1] = false;
  }
  [[nodiscard]] Motion step(const Senses& raw, float dt_s) noexcept {
    const Senses senses = heard(raw, body);
    const float dt = sane_period(dt_s);
    if (!crossing_.reckon(senses, dt) || !senses.range_known) return {};
    if ((crossing_.entering() || crossing_.leaving()) && magnitude(crossing_.on().turned_rad) < 0.3f) {
      correct_across(senses, dt);
      correct_along(senses, dt);
    }
    return crossing_.steer(senses);
  }
  [[nodiscard]] bool done() const noexcept { return crossing_.done(); }
  [[nodiscard]] bool lost() const noexcept { return crossing_.lost(); }

 private:
  void correct_across(const Senses& senses, float dt) noexcept {
    // Between the corners of the crossing, a wall beside belongs to another road.
    if (magnitude(crossing_.past_middle_m()) < half_width_m_) return;
    const float reach = half_width_m_ + 0.2f;
    const WallSight left = look_at_wall(senses, true, reach), right = look_at_wall(senses, false, reach);
    if (!left.beside && !right.beside) return;
    const OnCourse on = crossing_.on();
    float left_m = right.beside ? right.distance_m - half_width_m_ : half_width_m_ - left.distance_m;
    if (left.beside && right.beside) {
      left_m = 0.5f * (right.distance_m - left.distance_m);
      const float half = clamped(0.5f * (left.distance_m + right.distance_m), 0.2f, 0.45f);
      half_width_m_ += (half - half_width_m_) * (dt / (0.1f + dt));
    }
    const float off = left_m - on.left_m;
    if (magnitude(off) > (left.beside && right.beside ? kLargest_m : 0.5f * kLargest_m)) return;
    crossing_.correct(off * (dt / (kTau_s + dt)), 0.0f);
    if (!left.angle_known && !right.angle_known) return;
    float angle = left.angle_known ? left.angle_rad : right.angle_rad;
    if (left.angle_known && right.angle_known) angle = 0.5f * (left.angle_rad + right.angle_rad);
    const float askew = wrapped_angle(angle - on.turned_rad);
    if (magnitude(askew) < 0.2f) crossing_.reckoning.correct_heading(askew * (dt / (kHeadingTau_s + dt)));
  }

  void correct_along(const Senses& senses, float dt) noexcept {
    if (!crossing_.entering()) return;
    for (int hand = 0; hand < 2; ++hand) {
      const bool left = hand == 1;
      const float side = range_at(senses, left, 2);
      if (!knows_range(senses, left ? 2 : 6)) was_beside_[hand] = false;   // a silent range finder does not mean that its wall has ended
      const bool beside = side < half_width_m_ + 0.2f;
      const bool ends = was_beside_[hand] && !beside;
      was_beside_[hand] = beside;
      const float off = -half_width_m_ - crossing_.past_middle_m();
      if (ends && magnitude(off) < kLargest_m && magnitude(crossing_.on().turned_rad) < kSlant_rad) crossing_.correct(0.0f, 0.7f * off);
    }
    if (crossing_.forward()) return;
    const float off = half_width_m_ - senses.range_m[0] - crossing_.past_middle_m();   // a wall at the far side of the crossing
    if (magnitude(off) < kLargest_m) crossing_.correct(0.0f, off * (dt / (kTau_s + dt)));
  }

  static constexpr float kTau_s = 0.1f, kHeadingTau_s = 0.4f, kLargest_m = 0.12f;
  static constexpr float kSlant_rad = 0.1f;   ///< a robot that is more askew sees a corner too early or too late
  Crossing crossing_{};
  float half_width_m_ = 0.3f;
  bool was_beside_[2] = {false, false};   ///< right, left
};

}  // namespace mts
