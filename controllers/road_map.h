// The map in a program: what `kbc compile --map` writes of the roads that routes lead along, and the tasks that follow from it.
//
//   road_of_leg(mind) -> MapRoad -> RoadsDriven --task_across--> Task of the crossing before the road
//                                               --task_along---> Task of the road
//
// `road_of_leg` is in the generated header. The leg changes where the sign of the road's first landmark is read, so while the robot
// crosses, it tells the road by which it leaves.
#pragma once

#include "angles.h"
#include "body.h"
#include "senses.h"
#include "text.h"

namespace mts {

/// A road in one direction, from the middle of one crossing to the middle of the next, as the knowledge base has it. Static data.
struct MapRoad {
  const char* from;        ///< the landmark that it leaves, by its side `exit`: "LM5", "S"
  const char* exit;
  const char* to;          ///< the landmark that it reaches, at its side `approach`; "" if the knowledge base has no such field
  const char* approach;
  const char* by;          ///< how it is driven: "mark"; "" if the knowledge base does not say
  float limit_m_per_s;     ///< the fastest that it may be driven; infinity: no limit
  const Piece* course;     ///< at least one; no piece is shorter than 1 cm, unless it is the only one
  std::uint16_t pieces;
  float begins_apart_rad = kPi;   ///< the angle where it begins between it and the road beside it that is nearest, up to pi: none is beside it
  float ends_apart_rad = kPi;     ///< the same where it ends
};

/// Facts that stand beside each other in the numbering of a knowledge base, and several runs of them. Static data.
struct FactRun {
  std::uint32_t first, count;
};
struct FactRuns {
  const FactRun* runs = nullptr;
  std::size_t count = 0;
};

/// Whether the road leads across a hall: `by open`, as `std.hall` calls it.
[[nodiscard]] constexpr bool crosses_hall(const MapRoad& road) noexcept { return same_text(road.by, "open"); }

/// Whether one is the other in the opposite direction.
[[nodiscard]] constexpr bool is_way_back(const MapRoad& a, const MapRoad& b) noexcept {
  return same_text(a.from, b.to) && same_text(a.exit, b.approach) && same_text(a.to, b.from) && same_text(a.approach, b.exit);
}

/// Keeps the road on which the robot came to a crossing. Owned by the caller.
class RoadsDriven {
 public:
  /// Call it after each tick of the mind, with what `road_of_leg` says. A leg that another one replaces before it was driven, for its road is
  /// closed, leaves `came` as it is.
  constexpr void follow(const MapRoad* road) noexcept {
    const bool another = road != road_;
    if (road == nullptr || (another && carried_)) came_ = nullptr;
    else if (another && road_ != nullptr && same_text(road_->to, road->from)) came_ = road_;
    else if (came_ != nullptr && !same_text(came_->to, road->from)) came_ = nullptr;
    carried_ = carried_ && !another;
    road_ = road;
  }
  /// The robot was carried. The leg may stay what it was, but the robot does not come to the next crossing on its road.
  constexpr void forget() noexcept {
    came_ = nullptr;
    carried_ = true;
  }
  /// The road that the robot is on or, at a crossing, by which it leaves; null: unknown.
  [[nodiscard]] constexpr const MapRoad* road() const noexcept { return road_; }
  /// The road on which it came to where `road` begins; null: unknown.
  [[nodiscard]] constexpr const MapRoad* came() const noexcept { return came_; }

 private:
  const MapRoad *road_ = nullptr, *came_ = nullptr;
  bool carried_ = false;   // since the leg began
};

/// From the middle of its first crossing to that of its last.
[[nodiscard]] constexpr float length_m(const MapRoad& road) noexcept {
  float sum_m = 0.0f;
  for (std::size_t i = 0; i < road.pieces; ++i) sum_m += road.course[i].length_m;
  return sum_m;
}

/// The way along the road from `from_m` to `to_m`, both counted from the middle of its first crossing; the piece that it ends on is its heading.
[[nodiscard]] constexpr Door way_between(const MapRoad& road, float from_m, float to_m) noexcept {
  Door way;
  float passed_m = 0.0f;
  for (std::size_t i = 0; i < road.pieces; ++i) {
    const Piece& piece = road.course[i];
    const float part_m = greatest(least(passed_m + piece.length_m, to_m) - greatest(passed_m, from_m), 0.0f);
    way.x_m += part_m * cosine(piece.heading_rad);
    way.y_m += part_m * sine(piece.heading_rad);
    if (i == 0 || passed_m < to_m) way.heading_rad = piece.heading_rad;
    passed_m += piece.length_m;
  }
  return way;
}

/// Adds a piece to the course of a task, to the one before if that has the same direction. False: there is no room, and no later piece may be
/// added either.
[[nodiscard]] constexpr bool append(Task& task, const Piece& piece) noexcept {
  constexpr float kSame_rad = 1e-3f;
  Piece* const last = task.pieces > 0 ? &task.course[task.pieces - 1] : nullptr;
  if (last != nullptr && magnitude(wrapped_angle(piece.heading_rad - last->heading_rad)) < kSame_rad) last->length_m += piece.length_m;
  else if (task.pieces == kLongestCourse) return false;
  else task.course[task.pieces++] = piece;
  return true;
}

/// How far from the middle of a crossing the stop line of a road is painted, if the road beside it is `apart_rad` from it: clear of the corner
/// between the two, and nowhere nearer than half of `Body::crossing_m`. For roads less than 10 degrees from each other that would be too far out; theirs
/// is taken to be the nearest.
[[nodiscard]] constexpr float stop_line_m(float apart_rad, const Body& body) noexcept {
  constexpr float kLeastApart_rad = 0.1745f, kCorner_m = 0.1f;   // from the corner to the line, for a robot of size 1
  const float least_m = 0.5f * body.crossing_m, half_rad = 0.5f * apart_rad;
  if (!(apart_rad >= kLeastApart_rad)) return least_m;
  return greatest(least_m, 0.5f * body.road_width_m * cosine(half_rad) / sine(half_rad) + kCorner_m * body.size);
}
/// From the middle of the crossing where the road begins to its stop line out, and from its stop line in to the middle of the crossing where it ends.
[[nodiscard]] constexpr float line_out_m(const MapRoad& road, const Body& body) noexcept { return stop_line_m(road.begins_apart_rad, body); }
[[nodiscard]] constexpr float line_in_m(const MapRoad& road, const Body& body) noexcept { return stop_line_m(road.ends_apart_rad, body); }
/// From the middle of the crossing where the road begins to the sign on it, a little outside the stop line out.
[[nodiscard]] constexpr float sign_m(const MapRoad& road, const Body& body) noexcept {
  constexpr float kOutside_m = 0.15f;   // for a robot of size 1
  return line_out_m(road, body) + kOutside_m * body.size;
}

/// Where the robot's centre is when its line sensors are on the stop line out, in m from the middle of that crossing; and where the stop line in is.
[[nodiscard]] constexpr float begin_of_course_m(const MapRoad& road, const Body& body) noexcept { return line_out_m(road, body) - body.line_ahead_m; }
[[nodiscard]] constexpr float end_of_course_m(const MapRoad& road, const Body& body) noexcept { return length_m(road) - line_in_m(road, body); }

/// What to ask of a controller that drives `road` from its beginning: its course from the robot's centre, whose line sensors are on the
/// stop line out, to the stop line in. A robot that begins farther on, since it
/// was set down there or has turned back, is `driven_m` past that beginning; NaN is 0. At the stop line in, and on a road shorter than its
/// crossings, there is 1 cm left. Pieces in one direction are one, and those beyond the eighth are left out. O(pieces).
[[nodiscard]] constexpr Task task_along(const MapRoad& road, const Body& body, float driven_m = 0.0f) noexcept {
  constexpr float kLeast_m = 0.01f;
  Task task;
  const float line_m = line_out_m(road, body), to_m = end_of_course_m(road, body);
  const float from_m = begin_of_course_m(road, body) + (driven_m > 0.0f ? driven_m : 0.0f);
  float passed_m = 0.0f;
  for (std::size_t i = 0; i < road.pieces; ++i) {
    const Piece& piece = road.course[i];
    const float left_m = least(passed_m + piece.length_m, to_m) - greatest(passed_m, from_m);
    passed_m += piece.length_m;
    if (left_m >= kLeast_m && !append(task, {piece.heading_rad, left_m})) break;
  }
  if (task.pieces == 0) task.course[task.pieces++] = {road.course[road.pieces - 1].heading_rad, kLeast_m};
  task.in_hall = crosses_hall(road) && to_m > line_m;
  if (!task.in_hall) return task;
  const Door ahead = way_between(road, from_m, line_m), behind = way_between(road, line_m, from_m);   // one of them has no length
  task.in = {ahead.x_m - behind.x_m, ahead.y_m - behind.y_m, road.course[0].heading_rad};
  task.out = way_between(road, from_m, to_m);
  return task;
}
/// The same for the road that the robot is on. An unknown one has no course.
[[nodiscard]] constexpr Task task_along(const RoadsDriven& roads, const Body& body, float driven_m = 0.0f) noexcept {
  return roads.road() != nullptr ? task_along(*roads.road(), body, driven_m) : Task{};
}

/// How a robot comes to a crossing.
struct Arrival {
  float heading_rad = 0.0f;
  bool heading_known = false;
  float line_m = 0.0f;          ///< from its stop line to the middle of the crossing
};
/// The same of a robot that comes by `came`; by its own heading if that is null.
[[nodiscard]] constexpr Arrival arrival_by(const MapRoad* came, const Body& body) noexcept {
  if (came == nullptr) return {.line_m = stop_line_m(kPi, body)};
  return {came->course[came->pieces - 1].heading_rad, true, line_in_m(*came, body)};
}

/// What to ask of a controller that drives over the crossing at which `next` begins; null: it knows no exit. `turn` is the control line's business.
[[nodiscard]] constexpr Task task_across(const Arrival& arrival, const MapRoad* next, const Body& body) noexcept {
  Task task;
  task.entry_heading_rad = arrival.heading_rad;
  task.entry_known = arrival.heading_known;
  task.middle_m = arrival.line_m;
  task.crossing_m = arrival.line_m + stop_line_m(next != nullptr ? next->begins_apart_rad : kPi, body);
  if (next == nullptr) return task;
  task.exit_heading_rad = next->course[0].heading_rad;
  task.exit_known = true;
  return task;
}
/// The same for the crossing at which `roads.road()` begins: rules of the standard library cross only where a leg begins.
[[nodiscard]] constexpr Task task_across(const RoadsDriven& roads, const Body& body) noexcept { return task_across(arrival_by(roads.came(), body), roads.road(), body); }

}  // namespace mts
