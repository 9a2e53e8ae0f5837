// Where on a road of the map the robot is, by its own reckoning: what a controller has to be told that begins in the middle of one.
//
// Where the robot entered the road is known to a few centimetres. From there on the place is reckoned (reckoning.h), and the nearest point of
// the course that the robot can have reached by now is where it is. Where line or walls show the middle of the road, they move it sidewards,
// so that the drift of compass and odometry does not grow with the distance (map matching; the gain is that of a low-pass filter).
#pragma once

#include "reckoning.h"
#include "road_map.h"
#include "road_sight.h"
#include "similarity.h"

namespace mts {

/// In metres of the robot, whatever its size; only `step`, `settle` and `enter` take senses, which must have been `heard`, of size 1.
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
  constexpr explicit OnRoad(const Body& body = {}) noexcept : body_(body), small_(Similarity(body.size).in(body)) {}

  /// A manoeuvre begins, with the line sensors on the stop line in, `line_m` before the middle; `heading_rad`: in which the robot comes.
  constexpr void enter_crossing(float heading_rad, float line_m) noexcept {
    const float to_middle_m = line_m + body_.line_ahead_m;
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
    if (road != nullptr) put(*road, begin_of_course_m(*road, body_));
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

  /// Corrects the road by its line or walls. To be called each period while the robot is on the road. Near a bend they show nothing, but a robot
  /// that faces along the piece behind a bend has passed it, wherever the bend was reckoned to be.
  constexpr void settle(const Senses& senses, float dt_s) noexcept {
    if (road_ == nullptr) return;
    const Spot here = spot();
    const Facing facing = piece_faced(here.along_m);
    const float turned_rad = wrapped_angle(heading_rad() - facing.heading_rad);
    const bool passed_bend = magnitude(wrapped_angle(here.heading_rad - facing.heading_rad)) > kBendShows_rad;
    if (magnitude(turned_rad) > kFacesAlong_rad || (!passed_bend && to_bend_m(here.along_m) < kClearOfBend_m * body_.size)) return;
    float seen_m = 0.0f;
    if (!see_middle(senses, small_, road_->by, turned_rad, seen_m)) return;
    const float off_m = facing.left_m - body_.size * seen_m;   // how far the road lies to the left of where it was reckoned
    if (magnitude(off_m) > kLargestShift_m * body_.size + kDrift * here.along_m) return;
    const float shift_m = off_m * (dt_s / (kShiftTau_s + dt_s));
    x_m_ -= shift_m * sine(facing.heading_rad), y_m_ += shift_m * cosine(facing.heading_rad);
  }

  /// Null: unknown.
  [[nodiscard]] constexpr const MapRoad* road() const noexcept { return road_; }
  /// The robot's heading, and its way since it entered the road; both by reckoning.
  [[nodiscard]] constexpr float heading_rad() const noexcept { return reckoning_.at.heading_rad; }
  [[nodiscard]] constexpr bool heading_known() const noexcept { return reckoning_.heading_known(); }
  [[nodiscard]] constexpr float travelled_m() const noexcept { return body_.size * reckoning_.travelled_m(); }
  /// In the last step.
  [[nodiscard]] constexpr float way_m() const noexcept { return body_.size * reckoning_.way_m(); }
  /// Whether the robot faces along the road, or back to where it came from, to 45 degrees. False if the road is unknown.
  [[nodiscard]] constexpr bool faces_along() const noexcept { return road_ != nullptr && turned_rad() < 0.25f * kPi; }
  [[nodiscard]] constexpr bool faces_back() const noexcept { return road_ != nullptr && turned_rad() > 0.75f * kPi; }
  /// Where it is in the reckoning's own frame, which has the axes of the compass.
  [[nodiscard]] constexpr Place at() const noexcept { return {x_m(), y_m(), heading_rad()}; }
  /// The least angle between the robot's heading and a piece of the road near by, along it; 0 to pi. The road must be known.
  [[nodiscard]] constexpr float turned_rad(float along_m) const noexcept { return magnitude(wrapped_angle(heading_rad() - piece_faced(along_m).heading_rad)); }
  /// From a point of the road to its nearest bend, ahead or behind, at the least: odometry may be wrong. Infinity if it has none.
  [[nodiscard]] constexpr float to_bend_m(float along_m) const noexcept {
    float passed_m = 0.0f, nearest_m = kInfinity;
    for (std::size_t i = 0; i + 1 < road_->pieces; ++i) {
      passed_m += road_->course[i].length_m;
      nearest_m = least(nearest_m, greatest(magnitude(passed_m - along_m) - kDrift * along_m, 0.0f));
    }
    return nearest_m;
  }
  /// The road must be known. O(pieces).
  [[nodiscard]] constexpr Spot spot() const noexcept { return spot_of(0.0f, 0.0f); }
  /// The same for a thing that lies `thing_x_m`, `thing_y_m` from the robot, with the axes of the compass.
  [[nodiscard]] constexpr Spot spot_of(float thing_x_m, float thing_y_m) const noexcept {
    const float from_x_m = x_m() + thing_x_m - x_m_, from_y_m = y_m() + thing_y_m - y_m_;
    const float farthest_m = entered_m_ + kCuts * (travelled_m() - turned_m_) + kNearBy_m * body_.size + square_root(thing_x_m * thing_x_m + thing_y_m * thing_y_m);
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
    const float driven_m = here.along_m - begin_of_course_m(*road_, body_), ahead_m = kRejoin_m * body_.size;
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

  /// The piece near by along which the robot faces most, and how far the robot is to the left of it.
  struct Facing {
    float heading_rad = 0.0f, left_m = 0.0f;
  };
  [[nodiscard]] constexpr Facing piece_faced(float along_m) const noexcept {
    const float near_m = kNearBy_m * body_.size + kDrift * along_m;
    Facing best;
    float from_x_m = x_m() - x_m_, from_y_m = y_m() - y_m_, passed_m = 0.0f, least_rad = kInfinity;   // `from`: from the corner to the robot
    for (std::size_t i = 0; i < road_->pieces; ++i) {
      const Piece& piece = road_->course[i];
      const float ux = cosine(piece.heading_rad), uy = sine(piece.heading_rad);
      const float off_rad = magnitude(wrapped_angle(heading_rad() - piece.heading_rad));
      const bool near_by = along_m > passed_m - near_m && along_m < passed_m + piece.length_m + near_m;
      if (near_by && off_rad < least_rad) {
        least_rad = off_rad;
        best = {piece.heading_rad, ux * from_y_m - uy * from_x_m};
      }
      from_x_m -= piece.length_m * ux, from_y_m -= piece.length_m * uy;
      passed_m += piece.length_m;
    }
    return best;
  }

  static constexpr float kCuts = 1.5f;         ///< a bend may be cut: a right angle by the root of 2, across a hall
  static constexpr float kNearBy_m = 0.4f;
  static constexpr float kRejoin_m = 0.35f, kBeside_m = 0.03f;
  static constexpr float kDrift = 0.03f;       ///< of odometry, as a share of the way
  static constexpr float kClearOfBend_m = 0.45f;   ///< this far from a bend, line and walls are straight beside the robot
  static constexpr float kFacesAlong_rad = 0.25f, kBendShows_rad = 0.5f;   ///< the heading tells a sharper bend from straight on
  static constexpr float kLargestShift_m = 0.3f;   ///< a line farther aside is not that of this road
  static constexpr float kShiftTau_s = 0.5f;

  Body body_, small_;                          ///< the robot's own; the same of size 1
  Reckoning reckoning_{};
  const MapRoad* road_ = nullptr;
  bool started_ = false;
  float middle_x_m_ = 0.0f, middle_y_m_ = 0.0f;   ///< of the crossing that it entered last, in the reckoning's frame
  float x_m_ = 0.0f, y_m_ = 0.0f;    ///< the middle of the road's first crossing, in the reckoning's frame
  float entered_m_ = 0.0f;           ///< how far along the robot was when it entered the road, or came about
  float turned_m_ = 0.0f;            ///< what it had travelled by then
};

}  // namespace mts
