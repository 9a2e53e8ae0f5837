// Where on a road of the map the robot is, by its own reckoning: what a controller has to be told that begins in the middle of one.
//
// Where the robot entered the road is known to a few centimetres. From there on the place is reckoned (reckoning.h), and the nearest point of
// the course that the robot can have reached by now is where it is. Where line or walls show the middle of the road, they move it sidewards,
// so that the drift of compass and odometry does not grow with the distance (map matching; the gain is that of a low-pass filter).
#pragma once

#include <cstddef>
#include <cstdint>

#include "line_sight.h"
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

  /// A manoeuvre begins, with the line sensors on the stop line in, `line_m` before the middle, and the robot `left_m` to the left of the road;
  /// `heading_rad`: in which the robot comes.
  constexpr void enter_crossing(float heading_rad, float line_m, float left_m = 0.0f) noexcept {
    const float to_middle_m = line_m + body_.line_ahead_m;
    middle_x_m_ = x_m() + to_middle_m * cosine(heading_rad) + left_m * sine(heading_rad);
    middle_y_m_ = y_m() + to_middle_m * sine(heading_rad) - left_m * cosine(heading_rad);
  }
  /// How far to the left of the road the robot is at its end, for instance after going round something. 0 if the road is unknown or does not reach
  /// its end in this direction, or if the robot is so near the middle that line and walls tell it better.
  [[nodiscard]] constexpr float left_of_end_m(float heading_rad) const noexcept {
    if (road_ == nullptr || magnitude(wrapped_angle(end_heading_rad() - heading_rad)) > 0.25f * kPi) return 0.0f;
    const Spot here = spot();
    const Door on = way_between(*road_, here.along_m, length_m(*road_));
    const float left_m = (here.x_m + on.x_m) * sine(end_heading_rad()) - (here.y_m + on.y_m) * cosine(end_heading_rad());
    return magnitude(left_m) > kNoticed_m * body_.size && magnitude(left_m) < kStopLineEnds_m * body_.size ? left_m : 0.0f;
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
    x_m_ = middle_x_m_;
    y_m_ = middle_y_m_;
    const float dx = x_m() - x_m_, dy = y_m() - y_m_;
    entered_m_ = square_root(dx * dx + dy * dy);
    turned_m_ = travelled_m();
  }
  /// It is in the middle of `road`, `along_m` from the middle of its first crossing.
  constexpr void put(const MapRoad& road, float along_m) noexcept {
    road_ = &road;
    const Door way = way_between(road, 0.0f, along_m);
    x_m_ = x_m() - way.x_m;
    y_m_ = y_m() - way.y_m;
    entered_m_ = along_m;
    turned_m_ = travelled_m();
  }
  /// It may be anywhere, and face anywhere.
  constexpr void forget() noexcept {
    road_ = nullptr;
    turned_away_ = true;
  }
  /// The robot has come about where it is, and `back` is its road in the other direction.
  constexpr void turn_back(const MapRoad& back) noexcept {
    const float length = length_m(*road_);
    const Door whole = way_between(*road_, 0.0f, length);
    entered_m_ = length - spot().along_m;
    turned_m_ = travelled_m();
    x_m_ += whole.x_m;
    y_m_ += whole.y_m;
    road_ = &back;
  }
  constexpr void step(const Senses& senses, float dt_s) noexcept {
    if (!started_) reckoning_.start(senses, {});
    started_ = true;
    reckoning_.step(senses, dt_s);
    if (!turned_away_ || !senses.heading_known) return;
    reckoning_.at.heading_rad = wrapped_angle(senses.heading_rad);   // a robot that was carried was turned without its wheels
    turned_away_ = false;
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
    x_m_ -= shift_m * sine(facing.heading_rad);
    y_m_ += shift_m * cosine(facing.heading_rad);
  }

  /// The same when the robot crosses the road's line, on the way round something or in search of the line: a robot that was pushed aside learns
  /// there where the road is. `pushed`: how far along it is, is unknown too. True if the robot is not where it was thought to be.
  constexpr bool cross_line(const Senses& senses, bool pushed) noexcept {
    if (!driven_by("mark") || !senses.line_known) return false;
    const Spot here = spot();
    const LineSight line = look_at_line(senses, small_);
    const float size = body_.size, ends_m = kStopLineEnds_m * size;
    const bool at_end = !pushed && (here.along_m < line_out_m(*road_, body_) + ends_m || here.along_m > end_of_course_m(*road_, body_) - ends_m);   // it may be a stop line
    if (line.strength < 1.0f || turned_rad(here.along_m) < kFacesAlong_rad || to_bend_m(here.along_m) < kClearOfBend_m * size || at_end) return false;
    const float ux = cosine(heading_rad()), uy = sine(heading_rad()), ahead_m = body_.line_ahead_m, left_m = size * line.left_m;
    const float x_m = ahead_m * ux - left_m * uy - here.x_m, y_m = ahead_m * uy + left_m * ux - here.y_m;   // from the road to the paint
    const float off_m = y_m * cosine(here.heading_rad) - x_m * sine(here.heading_rad);
    if (magnitude(off_m) > kLargestShift_m * size + kDrift * here.along_m) return false;
    x_m_ -= off_m * sine(here.heading_rad);
    y_m_ += off_m * cosine(here.heading_rad);
    return magnitude(off_m) > kStillBeside_m * size;
  }
  [[nodiscard]] constexpr bool sees_line(const Senses& senses) const noexcept { return look_at_line(senses, small_).seen; }
  [[nodiscard]] constexpr bool driven_by(const char* by) const noexcept { return road_ != nullptr && same_text(road_->by, by); }
  /// Whether the robot is so far beside its road that it has to come back to it on its way round something; not past the end of the road, where it
  /// would come to a crossing first.
  [[nodiscard]] constexpr bool far_off() const noexcept {
    if (road_ == nullptr) return false;
    const Spot here = spot();
    return magnitude(here.left_m) > kFarOff_m * body_.size && here.along_m + here.past_m < end_of_course_m(*road_, body_);
  }
  /// Whether there is room before the end of the road to look for its line to both sides.
  [[nodiscard]] constexpr bool has_room_to_seek() const noexcept {
    return road_ != nullptr && spot().along_m + (4.0f * kSeeks_m + kStopLineEnds_m) * body_.size < end_of_course_m(*road_, body_);
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
  /// Whether it is so far from the nearest bend that line and walls are straight beside it. The road must be known.
  [[nodiscard]] constexpr bool clear_of_bend() const noexcept { return !(to_bend_m(spot().along_m) < kClearOfBend_m * body_.size); }
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
      corner_x_m += piece.length_m * ux;
      corner_y_m += piece.length_m * uy;
      passed_m += piece.length_m;
    }
    return best;
  }

  /// How a course leads a robot that is beside the middle of its road.
  enum class Back : std::uint8_t {
    kNever,      ///< not at all: it runs as far aside as the robot is
    kToMiddle,
    kToLine,     ///< to the line, which is somewhere near, to the left or to the right
  };
  /// What to ask of a controller that drives the rest of the road. Nothing if the road is unknown.
  [[nodiscard]] constexpr Task task(Back back) const noexcept {
    if (road_ == nullptr) return {};
    const Spot here = spot();
    const float driven_m = here.along_m - begin_of_course_m(*road_, body_), size = body_.size;
    const bool beside = back != Back::kNever && magnitude(here.left_m) > kBeside_m * size;
    Task task = task_along(*road_, body_, driven_m);
    if (task.in_hall) {
      for (Door* door : {&task.in, &task.out}) {
        door->x_m += here.x_m;
        door->y_m += here.y_m;
      }
    }
    if (!beside && back != Back::kToLine) return task;
    task.pieces = 0;
    float ahead_m = kRejoin_m * size + here.past_m;
    if (back == Back::kToLine) {   // a zigzag: to the left of the middle, to the right of it, and back
      ahead_m = 4.0f * kSeeks_m * size;
      const float ux = cosine(here.heading_rad), uy = sine(here.heading_rad), side_m = kSeeks_m * size;
      const float first_x_m = here.x_m + side_m * (ux - uy), first_y_m = here.y_m + side_m * (uy + ux);
      task.course[task.pieces++] = {angle_of(first_x_m, first_y_m), square_root(first_x_m * first_x_m + first_y_m * first_y_m)};
      task.course[task.pieces++] = {wrapped_angle(here.heading_rad - kOneInOne_rad), square_root(8.0f) * side_m};
      task.course[task.pieces++] = {wrapped_angle(here.heading_rad + kOneInOne_rad), square_root(2.0f) * side_m};
    } else {
      // Past the end of the road it comes to the middle farther on, instead of turning back.
      const Door there = way_between(*road_, here.along_m, here.along_m + ahead_m);
      const float beyond_m = greatest(here.along_m + ahead_m - length_m(*road_), 0.0f);
      const float x_m = here.x_m + there.x_m + beyond_m * cosine(end_heading_rad()), y_m = here.y_m + there.y_m + beyond_m * sine(end_heading_rad());
      task.course[task.pieces++] = {angle_of(x_m, y_m), square_root(x_m * x_m + y_m * y_m)};
    }
    const Task rest = task_along(*road_, body_, driven_m + ahead_m);
    bool room = true;
    for (std::size_t i = 0; i < rest.pieces && room; ++i) room = append(task, rest.course[i]);
    const bool near_end = here.along_m + ahead_m + kRejoin_m * size > end_of_course_m(*road_, body_);
    if (room && near_end) static_cast<void>(append(task, {end_heading_rad(), kRejoin_m * size}));   // it crosses the stop line at a right angle
    return task;
  }
  /// The direction in which the road reaches its end; it must be known.
  [[nodiscard]] constexpr float end_heading_rad() const noexcept { return road_->course[road_->pieces - 1].heading_rad; }

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
      from_x_m -= piece.length_m * ux;
      from_y_m -= piece.length_m * uy;
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
  static constexpr float kSeeks_m = 0.3f, kOneInOne_rad = 0.25f * kPi;   ///< to either side, in search of a line from which it was pushed away
  static constexpr float kFarOff_m = 0.35f;
  static constexpr float kStillBeside_m = 0.08f, kNoticed_m = 0.12f, kStopLineEnds_m = 0.45f;

  Body body_, small_;                          ///< the robot's own; the same of size 1
  Reckoning reckoning_{};
  const MapRoad* road_ = nullptr;
  bool started_ = false, turned_away_ = false;
  float middle_x_m_ = 0.0f, middle_y_m_ = 0.0f;   ///< of the crossing that it entered last, in the reckoning's frame
  float x_m_ = 0.0f, y_m_ = 0.0f;    ///< the middle of the road's first crossing, in the reckoning's frame
  float entered_m_ = 0.0f;           ///< how far along the robot was when it entered the road, or came about
  float turned_m_ = 0.0f;            ///< what it had travelled by then
};

}  // namespace mts
