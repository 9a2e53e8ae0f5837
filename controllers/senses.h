// What a controller senses, what it is asked to do, and what it answers: the contract between controllers and the robot, simulated or
// real.
//
// Frames: x is east, y north; angles count counter-clockwise from east, in (-pi, pi]. In the robot's own frame, x is ahead and y to the
// left. Lengths are in metres, times in seconds. Nothing here allocates, throws or depends on a knowledge base.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mts {

inline constexpr std::size_t kLineSensors = 5;    ///< in a row across the front of the robot, the first at the left
inline constexpr std::size_t kRangeFinders = 8;   ///< every 45 degrees, the first ahead, counter-clockwise (index 2: left)
inline constexpr std::size_t kLongestCourse = 8;  ///< straight pieces of one road
inline constexpr float kOutOfRange = 4.0f;        ///< m

/// How long ago each group of `Senses` was measured, in seconds. A group older than `Body::longest_silence_s` counts as silent. NaN and
/// negative ages count as too old. If you leave the ages at 0, mark a group as silent yourself when its data stop coming: nothing else
/// tells a dead sensor from a world that does not change.
struct Ages {
  float line_s = 0.0f, range_s = 0.0f, heading_s = 0.0f;
  float odometry_s = 0.0f;            ///< of `turned_rad` as well
};

/// One sample of the robot's sensors, owned by the caller. Leave the flag of a silent sensor false. A number that cannot have been
/// measured (NaN, infinite, beyond a million) makes its whole group silent; among the range finders, only that one.
struct Senses {
  float line[kLineSensors] = {};      ///< darkness of the floor, 0 bright to 1 dark
  /// Distance to the nearest surface, from the centre of the robot, not from its edge. `kOutOfRange` (times Body::size) or more, also +inf:
  /// nothing is in range. -inf: too near to measure, taken as 0 (both infinities as in REP 117 of ROS). NaN or any other negative value:
  /// unknown.
  float range_m[kRangeFinders] = {};
  std::uint8_t ranges_unknown = 0;    ///< bit i: range finder i is silent, whatever `range_m[i]` is
  /// Distance in m from the robot's centre, along its path, to the lane of somebody on a collision course. No sensor measures it:
  /// `SteadyRanges` computes it. Below 0: the robot is in that lane. `kOutOfRange` or more, or NaN: nobody comes.
  float met_m = kOutOfRange;
  float heading_rad = 0.0f;           ///< compass
  /// Odometry: position by the wheels, in their own frame; drifts, but does not jump. Keep it within some 5 km of zero, where a float moves in steps of
  /// half a millimetre: take off a multiple of a kilometre where it grows beyond; for that one period the speed counts.
  float x_m = 0.0f, y_m = 0.0f;
  float speed_m_s = 0.0f;             ///< odometry; negative when driving backwards
  float turned_rad = 0.0f;            ///< odometry: angle turned, by the wheels or a gyroscope; from any zero; drifts. Take off whole turns beyond 1,000 rad
  bool line_known = false, range_known = false, heading_known = false, odometry_known = false;
  bool turned_known = false;          ///< without it controllers make do with the compass
  bool touched = false;               ///< bumper: nothing drives ahead while it is pressed
  Ages age{};
};
static_assert(kRangeFinders <= 8, "Senses::ranges_unknown has a bit for each");

/// A straight piece of a road.
struct Piece {
  float heading_rad = 0.0f;
  float length_m = 0.0f;
};

enum class Turn : std::uint8_t { kBack, kLeft, kForward, kRight };

/// The way into a hall or out of it: the middle of its stop line. The origin is where the strategy begins, the axes are the compass's.
struct Door {
  float x_m = 0.0f, y_m = 0.0f;
  float heading_rad = 0.0f;            ///< of a robot that passes it along the road
};

/// Why a controller fails to cross a hall.
enum class Plight : std::uint8_t {
  kNone,
  kTrapped,   ///< it would go on for ever without getting nearer to the goal
  kNoWay,     ///< as far as it knows and has seen, there is no way
};

/// What the strategy has to do; fixed while it runs. A controller reads only the fields it needs. Unlike senses, numbers that
/// come from the program's own map are not checked: each must be finite, and lengths no more than kilometres.
struct Task {
  Turn turn = Turn::kForward;          ///< manoeuvres: how the crossing is to be driven
  Piece course[kLongestCourse] = {};   ///< roads: the pieces ahead; the first begins where the strategy begins
  std::uint8_t pieces = 0;
  float exit_heading_rad = 0.0f;       ///< manoeuvres: heading of the road by which the robot leaves the crossing, if `exit_known`
  bool exit_known = false;             ///< if false: the heading of the entry, turned by `turn`
  float entry_heading_rad = 0.0f;      ///< manoeuvres: heading of the road on which it enters, if `entry_known`
  bool entry_known = false;            ///< if false: the heading at the start, or the one that follows from `turn` and the exit
  float entry_left_m = 0.0f;           ///< manoeuvres: measured distance of the robot's centre to the left of the middle of that road.
                                       ///< Ignored if 0, NaN, 0.5 m or more to either side, or without `entry_known`
  float crossing_m = 0.0f;             ///< manoeuvres: from stop line to stop line; 0: as the `Body` says
  float middle_m = 0.0f;               ///< manoeuvres: from the stop line in to the middle of the crossing, < crossing_m; 0: half of it
  bool in_hall = false;                ///< the road leads across a hall, from the door `in` to the door `out`
  Door in, out;
};

/// What the wheels are to do. The robot clips both numbers to its limits.
struct Motion {
  float speed_m_s = 0.0f;
  float turn_rad_s = 0.0f;   ///< counter-clockwise
};

}  // namespace mts
