// How a robot that has entered a crossing beside its line looks for that line.
//
//     ──3──●        1  it turns to the left and drives 6 cm, the row of line sensors 9 cm before it
//     stop │line    2  to the right, by way of straight ahead, and 6 cm beyond where it began
//     ──2──┼──1──   3  back
// The robot has found the line when the row has passed over paint as narrow as a line. A broad stripe is the stop line of another road;
// there it turns round.
#pragma once

#include "course.h"
#include "heard.h"
#include "line_sight.h"

namespace mts {

class LineSearch {
 public:
  [[nodiscard]] bool waits() const noexcept { return leg_ == Leg::kNotYet; }
  [[nodiscard]] bool runs() const noexcept { return leg_ != Leg::kNotYet && leg_ != Leg::kOver; }
  void begin(const OnCourse& on) noexcept {
    leg_ = Leg::kLeft;
    begin_m_ = on.left_m;
  }
  void end() noexcept { leg_ = Leg::kOver; }

  /// Whether there is room beside the robot to look for the line. False if a range finder that looks there is silent.
  [[nodiscard]] static bool has_room(const Senses& senses, const Body& body) noexcept {
    float nearest = senses.range_known ? 1e3f : 0.0f;
    constexpr std::size_t kBeside[] = {1, 2, 3, 5, 6, 7};   // eighths of a turn
    for (const std::size_t eighths : kBeside) nearest = knows_range(senses, eighths) ? least(nearest, senses.range_m[eighths]) : 0.0f;
    return nearest > kAside_m + body.radius_m + kFree_m;
  }

  /// Takes one sample. True if the line has just been found: then it lies `line_left_m()` to the left of the course.
  [[nodiscard]] bool look(const OnCourse& on, const LineSight& line, const Body& body, float dt_s) noexcept {
    if (line.seen) stripe_.add(on.left_m + body.line_ahead_m * sine(on.turned_rad) + line.left_m * cosine(on.turned_rad));
    const bool broad = stripe_.counts && stripe_.most_m - stripe_.least_m > greatest(kBroad_m, kOfPaint * body.paint_width_m);
    const bool found = !line.seen && stripe_.counts && stripe_.least_m <= stripe_.most_m;
    const float left = on.left_m - begin_m_;
    spent_s_ += dt_s;
    if (leg_ == Leg::kLeft && (broad || (left > kAside_m && !line.seen))) leg_ = Leg::kRight;
    else if (leg_ == Leg::kRight && (broad || (left < -kAside_m && !line.seen))) leg_ = Leg::kBack;
    if (found || (leg_ == Leg::kBack && left > 0.0f) || spent_s_ > kLongest_s) end();
    line_left_m_ = 0.5f * (stripe_.least_m + stripe_.most_m);
    if (broad) stripe_.counts = false;
    if (!line.seen) stripe_ = {};
    return found;
  }
  [[nodiscard]] float line_left_m() const noexcept { return line_left_m_; }

  /// The motion of the search.
  [[nodiscard]] Motion steer(const OnCourse& on, float speed_m_s, float turn_rad_s) const noexcept {
    if (!runs()) return {};
    // The angle is not wrapped: the robot turns by way of straight ahead, not over the stop line behind it.
    const float off = (leg_ == Leg::kRight ? -0.5f : 0.5f) * kPi - on.turned_rad;
    return {magnitude(off) < kAligned_rad ? speed_m_s : 0.0f, clamped(kTurn_1_s * off, -turn_rad_s, turn_rad_s)};
  }

 private:
  /// The paint that the row is passing over.
  struct Stripe {
    float least_m = 1e3f, most_m = -1e3f;   ///< to the left of the course
    bool counts = true;
    void add(float left_m) noexcept {
      least_m = least(least_m, left_m);
      most_m = greatest(most_m, left_m);
    }
  };
  static constexpr float kAside_m = 0.06f, kBroad_m = 0.05f, kFree_m = 0.2f, kLongest_s = 8.0f;
  static constexpr float kOfPaint = 1.5f;   ///< a stripe more than this many times as broad as a line is not a line
  static constexpr float kAligned_rad = 20.0f * kRadPerDeg, kTurn_1_s = 4.0f;
  enum class Leg : std::uint8_t { kNotYet, kLeft, kRight, kBack, kOver };
  Leg leg_ = Leg::kNotYet;
  Stripe stripe_{};
  float begin_m_ = 0.0f, line_left_m_ = 0.0f, spent_s_ = 0.0f;
};

}  // namespace mts
