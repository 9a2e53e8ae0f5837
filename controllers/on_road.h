// Where on a road of the map the robot is, by its own reckoning: what a controller has to be told that begins in the middle of one.
//
// Where the robot entered the road is known to a few centimetres. From there on the place is reckoned (reckoning.h), and the nearest point of
// the course that the robot can have reached by now is where it is. Line and walls correct nothing here: they correct the controllers
// themselves.
#pragma once

#include "reckoning.h"
#include "road_map.h"
#include "similarity.h"

namespace mts {

/// In metres of the robot, whatever its size; only `step` and `enter` take senses, which must have been `heard`, of size 1.
class OnRoad {
 public:
  struct Spot {
    float along_m = 0.0f;      ///< from the middle of the road's first crossing
    float past_m = 0.0f;       ///< how far the robot is past the middle of its last one
    float left_m = 0.0f;       ///< how far the robot is to the left of the road's middle
    float x_m = 0.0f, y_m = 0.0f;   ///< from the robot to the point of the road beside it, with the axes of the compass
    float heading_rad = 0.0f;  ///< of the road there
  };

  /// `body` is the robot's own, not converted.
  constexpr explicit OnRoad(const Body& body = {}) noexcept : body_(body) {}

  /// A manoeuvre begins, with the line sensors on the stop line in; `heading_rad`: in which the robot comes.
  constexpr void enter_crossing(float heading_rad) noexcept {
    const float to_middle_m = 0.5f * body_.crossing_m + body_.line_ahead_m;
    middle_x_m_ = x_m() + to_middle_m * cosine(heading_rad);
    middle_y_m_ = y_m() + to_middle_m * sine(heading_rad);
  }
  /// The robot leaves the crossing where `road` begins, with its line sensors on the stop line out. Null: it is on an unknown road.
  constexpr void enter(const MapRoad* road, const Senses& senses) noexcept {
    road_ = road;
    Task along;
    if (road != nullptr) along.course[along.pieces++] = road->course[0];
    reckoning_.start_along(senses, along);
    started_ = true;
    if (road != nullptr) put(*road, begin_of_course_m(body_));
  }
  /// It is on `road`, somewhere: on the way round something it has left the crossing that it entered last.
  constexpr void enter_aside(const MapRoad& road) noexcept {
    road_ = &road;
    x_m_ = middle_x_m_, y_m_ = middle_y_m_;
    const float dx = x_m() - x_m_, dy = y_m() - y_m_;
    entered_m_ = square_root(dx * dx + dy * dy);
    turned_m_ = travelled_m();
  }
  /// It is in the middle of `road`, `along_m` from the middle of its first crossing.
  constexpr void put(const MapRoad& road, float along_m) noexcept {
    road_ = &road;
    const Door way = way_between(road, 0.0f, along_m);
    x_m_ = x_m() - way.x_m, y_m_ = y_m() - way.y_m;
    entered_m_ = along_m;
    turned_m_ = travelled_m();
  }
  /// It may be anywhere.
  constexpr void forget() noexcept { road_ = nullptr; }
  /// The robot has come about where it is, and `back` is its road in the other direction.
  constexpr void turn_back(const MapRoad& back) noexcept {
    const float length = length_m(*road_);
    const Door whole = way_between(*road_, 0.0f, length);
    entered_m_ = length - spot().along_m;
    turned_m_ = travelled_m();
    x_m_ += whole.x_m, y_m_ += whole.y_m;
    road_ = &back;
  }
  constexpr void step(const Senses& senses, float dt_s) noexcept {
    if (!started_) reckoning_.start(senses, {});
    started_ = true;
    reckoning_.step(senses, dt_s);
  }

  /// Null: unknown.
  [[nodiscard]] constexpr const MapRoad* road() const noexcept { return road_; }
  /// The robot's heading, and its way since it entered the road; both by reckoning.
  [[nodiscard]] constexpr float heading_rad() const noexcept { return reckoning_.at.heading_rad; }
  [[nodiscard]] constexpr bool heading_known() const noexcept { return reckoning_.heading_known(); }
  [[nodiscard]] constexpr float travelled_m() const noexcept { return body_.size * reckoning_.travelled_m(); }
  /// Whether the robot faces along the road, or back to where it came from, to 45 degrees. False if the road is unknown.
  [[nodiscard]] constexpr bool faces_along() const noexcept { return road_ != nullptr && turned_rad() < 0.25f * kPi; }
  [[nodiscard]] constexpr bool faces_back() const noexcept { return road_ != nullptr && turned_rad() > 0.75f * kPi; }
  /// The road must be known. O(pieces).
  [[nodiscard]] constexpr Spot spot() const noexcept {
    const float from_x_m = x_m() - x_m_, from_y_m = y_m() - y_m_;
    const float farthest_m = entered_m_ + kCuts * (travelled_m() - turned_m_) + kNearBy_m * body_.size;
    Spot best;
    float corner_x_m = 0.0f, corner_y_m = 0.0f, passed_m = 0.0f, nearest_m2 = kInfinity;
    for (std::size_t i = 0; i < road_->pieces && passed_m < farthest_m; ++i) {
      const Piece& piece = road_->course[i];
      const float ux = cosine(piece.heading_rad), uy = sine(piece.heading_rad);
      const float dx = from_x_m - corner_x_m, dy = from_y_m - corner_y_m, ahead_m = dx * ux + dy * uy;
      const float along_m = clamped(ahead_m, 0.0f, least(piece.length_m, farthest_m - passed_m));
      const float off_x_m = along_m * ux - dx, off_y_m = along_m * uy - dy, off_m2 = off_x_m * off_x_m + off_y_m * off_y_m;
      if (off_m2 < nearest_m2) {
        nearest_m2 = off_m2;
        const float past_m = i + 1 == road_->pieces ? greatest(ahead_m - piece.length_m, 0.0f) : 0.0f;
        best = {passed_m + along_m, past_m, dy * ux - dx * uy, off_x_m, off_y_m, piece.heading_rad};
      }
      corner_x_m += piece.length_m * ux, corner_y_m += piece.length_m * uy;
      passed_m += piece.length_m;
    }
    return best;
  }

  /// What to ask of a controller that drives the rest of the road. If the robot is beside its middle and `rejoins`, the course leads back to
  /// it first; otherwise it runs beside the road. Nothing if the road is unknown.
  [[nodiscard]] constexpr Task task(bool rejoins) const noexcept {
    if (road_ == nullptr) return {};
    const Spot here = spot();
    const float driven_m = here.along_m - begin_of_course_m(body_), ahead_m = kRejoin_m * body_.size;
    const bool beside = rejoins && magnitude(here.left_m) > kBeside_m * body_.size && here.along_m + ahead_m < end_of_course_m(*road_, body_);
    Task task = task_along(*road_, body_, driven_m);
    if (task.in_hall) {
      for (Door* door : {&task.in, &task.out}) door->x_m += here.x_m, door->y_m += here.y_m;
    }
    if (!beside) return task;
    const Door there = way_between(*road_, here.along_m, here.along_m + ahead_m);
    const float x_m = here.x_m + there.x_m, y_m = here.y_m + there.y_m;
    const Task rest = task_along(*road_, body_, driven_m + ahead_m);
    task.pieces = 0;
    task.course[task.pieces++] = {angle_of(x_m, y_m), square_root(x_m * x_m + y_m * y_m)};
    for (std::size_t i = 0; i < rest.pieces && append(task, rest.course[i]); ++i) {}
    return task;
  }

 private:
  [[nodiscard]] constexpr float x_m() const noexcept { return body_.size * reckoning_.at.x_m; }
  [[nodiscard]] constexpr float y_m() const noexcept { return body_.size * reckoning_.at.y_m; }
  [[nodiscard]] constexpr float turned_rad() const noexcept { return magnitude(wrapped_angle(reckoning_.at.heading_rad - spot().heading_rad)); }

  static constexpr float kCuts = 1.5f;         ///< a bend may be cut: a right angle by the root of 2, across a hall
  static constexpr float kNearBy_m = 0.4f;
  static constexpr float kRejoin_m = 0.35f, kBeside_m = 0.03f;

  Body body_;
  Reckoning reckoning_{};
  const MapRoad* road_ = nullptr;
  bool started_ = false;
  float middle_x_m_ = 0.0f, middle_y_m_ = 0.0f;   ///< of the crossing that it entered last, in the reckoning's frame
  float x_m_ = 0.0f, y_m_ = 0.0f;    ///< the middle of the road's first crossing, in the reckoning's frame
  float entered_m_ = 0.0f;           ///< how far along the robot was when it entered the road, or came about
  float turned_m_ = 0.0f;            ///< what it had travelled by then
};

}  // namespace mts
