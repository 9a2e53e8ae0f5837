// Robots of other sizes, and robots that are slow to start and to turn.
//
// The controllers contain about a hundred lengths (how far ahead they look, how near a wall is, how far they search for a lost line) that
// fit a robot of 6 to 20 cm radius on roads 60 cm wide. They also drive a robot `size` times as large on a floor `size` times as large:
// convert what goes in to the scale of the small robot, and convert the answer back.
//
//   const mts::Similarity as(body);                                         // with `size = 4.0f` on roads 2.4 m wide
//   drive.choose(mts::ControllerId::kKeepWall, as.in(body));
//   if (drive.set("speed", as.in(0.8f, "m/s")) != mts::Setting::kSet) ...
//   drive.start(as.in(task), as.in(senses));
//   for (;;) wheels(as.out(drive.step(as.in(senses), as.in(dt_s, "s"))));
//
// note [times grow with the root of lengths]
// All robots brake with much the same acceleration. If lengths are in the ratio L and times in the ratio T, accelerations are in the
// ratio L / T^2, which is 1 for T = sqrt(L). Speeds then grow with sqrt(L), and turning rates shrink by the same factor. By this law Froude
// compared ships with their models (v^2 / (g l) is the same for both; W. Froude, "On experiments with H.M.S. Greyhound", Transactions of
// the Institution of Naval Architects 15, 1874). Real vehicles follow it: one of 50 cm radius drives 1.2 m/s, not 2.4.
//
// note [slow wheels take longer]
// The controllers want wheels of 1 m/s^2 and 0.2 m/s and a body that turns at 1 rad/s (of size 1). With 0.6 m/s^2 a robot still arrives, but comes to
// rest behind the sign that forbids a road; with 0.3 m/s^2 it overshoots its turns, and hits walls. By the same law a slower robot does the same on the
// same way in longer time: in S times the time all speeds and turning rates are 1 / S, and all accelerations 1 / S^2, of what they were. So S is
// what the weakest of the three needs. Such a robot drives at 1 / S of the speed that is meant for a quick one.
#pragma once

#include <initializer_list>

#include "../runtime/math.h"
#include "body.h"
#include "senses.h"

namespace mts {

class Similarity {
 public:
  /// `size`: see Body::size. 1 changes no bit; with 4, 16 or 1/4 every conversion is exact.
  constexpr explicit Similarity(float size = 1.0f) noexcept : Similarity(size, 1.0f) {}
  /// Of this robot: see note [slow wheels take longer]. For a quick one the same as by its size.
  constexpr explicit Similarity(const Body& robot) noexcept : Similarity(robot.size, slowness(robot)) {}
  /// By size alone.
  [[nodiscard]] constexpr Similarity of_size() const noexcept { return Similarity(length_, 1.0f); }
  /// By size and brakes: how early it has to notice who comes. People are no slower for a robot that only turns slowly.
  [[nodiscard]] static constexpr Similarity of_brakes(const Body& robot) noexcept { return Similarity(robot.size, slowness_of_brakes(robot)); }
  /// What is left to convert where `part` has converted already.
  [[nodiscard]] constexpr Similarity after(const Similarity& part) const noexcept { return Similarity(length_ / part.length_, slow_ / part.slow_); }
  /// How many times as long all takes: 1 for a quick robot, at most `kSlowest`. See note [slow wheels take longer].
  [[nodiscard]] static constexpr float slowness(const Body& robot) noexcept {
    const float root = square_root(robot.size);   // speeds grow with it, turning rates shrink
    if (!(robot.top_turn_rad_s > 0.0f && robot.top_speed_m_s > 0.0f && root > 0.0f)) return kSlowest;   // nor NaN
    const float slow = greatest(slowness_of_brakes(robot), greatest(kQuick_rad_s / (robot.top_turn_rad_s * root), kQuick_m_s * root / robot.top_speed_m_s));
    return least(slow, kSlowest);
  }
  static constexpr float kQuick_m_s2 = 1.0f, kQuick_rad_s = 1.0f, kQuick_m_s = 0.2f, kSlowest = 4.0f;

  /// How many of the robot's own units make one unit of the small robot. `unit` is a product of `m`, `s`, `deg` and `rad` with at most one
  /// `/`, as in Parameter::unit: `m/s`, `1/(m s2)`. O(length of `unit`).
  [[nodiscard]] constexpr float of(const char* unit) const noexcept {
    float ratio = 1.0f, last = 1.0f;
    bool below = false;
    for (; *unit != '\0'; ++unit) {
      if (*unit == '/') below = true;
      if (*unit == 'm' || *unit == 's') last = *unit == 'm' ? length_ : time_;
      if (*unit == 'm' || *unit == 's' || *unit == '2') ratio = below ? ratio / last : ratio * last;
    }
    return ratio;
  }
  /// `in` converts a value of the robot to the scale of the small one; `out` converts it back.
  [[nodiscard]] constexpr float in(float value, const char* unit) const noexcept { return value / of(unit); }
  [[nodiscard]] constexpr float out(float value, const char* unit) const noexcept { return value * of(unit); }

  [[nodiscard]] constexpr Body in(const Body& robot) const noexcept { return scaled(robot, 1.0f / length_, 1.0f / time_, 1.0f / slow_); }
  [[nodiscard]] constexpr Body out(const Body& body) const noexcept { return scaled(body, length_, time_, slow_); }

  /// What is unknown, infinite or old stays so. `met_m` is not converted: SteadyRanges computes it from the converted senses.
  [[nodiscard]] constexpr Senses in(Senses senses) const noexcept {
    for (float& range_m : senses.range_m) range_m /= length_;
    senses.x_m /= length_;
    senses.y_m /= length_;
    senses.speed_m_s *= time_ / length_;
    for (float* age_s : {&senses.age.line_s, &senses.age.range_s, &senses.age.heading_s, &senses.age.odometry_s}) *age_s /= time_;
    return senses;
  }
  [[nodiscard]] constexpr Task in(Task task) const noexcept {
    for (Piece& piece : task.course) piece.length_m /= length_;
    for (float* length_m : {&task.entry_left_m, &task.crossing_m, &task.middle_m, &task.in.x_m, &task.in.y_m, &task.out.x_m, &task.out.y_m}) *length_m /= length_;
    return task;
  }
  [[nodiscard]] constexpr Motion out(const Motion& motion) const noexcept { return {motion.speed_m_s * (length_ / time_), motion.turn_rad_s / time_}; }

 private:
  constexpr Similarity(float size, float slow) noexcept : length_(size), time_(square_root(size) * slow), slow_(slow) {}
  [[nodiscard]] static constexpr float slowness_of_brakes(const Body& robot) noexcept {
    return robot.top_acceleration_m_s2 > 0.0f ? clamped(square_root(kQuick_m_s2 / robot.top_acceleration_m_s2), 1.0f, kSlowest) : kSlowest;
  }
  [[nodiscard]] static constexpr Body scaled(Body body, float length, float time, float slow) noexcept {
    body.size *= length;
    body.top_acceleration_m_s2 /= slow * slow;
    body.top_turn_rad_s /= time;
    for (float Body::* length_m : {&Body::radius_m, &Body::wheel_base_m, &Body::line_ahead_m, &Body::line_span_m, &Body::paint_width_m, &Body::stop_line_width_m,
                                   &Body::road_width_m, &Body::crossing_m, &Body::hall_door_m}) {
      body.*length_m *= length;
    }
    for (float Body::* speed_m_s : {&Body::top_speed_m_s, &Body::crawl_m_s}) body.*speed_m_s *= length / time;
    for (float Body::* time_s : {&Body::range_latency_s, &Body::longest_silence_s}) body.*time_s *= time;
    return body;
  }

  float length_, time_, slow_;
};

}  // namespace mts
