// What a controller sees, what it is asked for, and what it answers: the one contract between the functions that drive a
// robot and the robot, simulated or real.
//
// Frames: x east, y north, angles counter-clockwise from east in (-pi, pi]; of the robot's own frame x is ahead and y to the
// left. Lengths in metres, times in seconds. Nothing here allocates, throws or knows a knowledge base.
#pragma once

#include <cstddef>
#include <cstdint>

namespace mts {

inline constexpr std::size_t kLineSensors = 5;    ///< in a row across the front of the robot, the first at the left
inline constexpr std::size_t kRangeFinders = 8;   ///< every 45 degrees, the first ahead, counter-clockwise (index 2: left)
inline constexpr std::size_t kLongestCourse = 8;  ///< straight pieces of one road
inline constexpr float kOutOfRange = 4.0f;        ///< m

/// How long ago each group of `Senses` was measured, s. What is older than `Body::longest_silence_s` counts as silent; who leaves
/// them at 0 marks as silent himself what does not come any more: nothing else tells a sensor that has died from a world that
/// does not change. NaN and negative ages are old.
struct Ages {
  float line_s = 0.0f, range_s = 0.0f, heading_s = 0.0f;
  float odometry_s = 0.0f;            ///< of `turned` as well
};

/// One sample of the robot's sensors. The caller owns it; a sensor that is silent keeps its flag false. A number that cannot have
/// been measured (NaN, infinite, beyond a million) makes its group silent; of the range finders, that one.
struct Senses {
  float line[kLineSensors] = {};      ///< darkness of the floor, 0 bright to 1 dark
  /// From the centre of the robot, not from its edge, to the nearest surface. `kOutOfRange` (times Body::size) and more, also +inf: there is none.
  /// -inf: so near that it cannot be measured, taken for 0 (both as REP 117 of ROS says). NaN, or below 0: it is unknown.
  float range_m[kRangeFinders] = {};
  std::uint8_t ranges_unknown = 0;    ///< bit i: range finder i says nothing, whatever stands in `range_m`
  /// m ahead of the robot's centre, along its way: there begins the lane of somebody who comes so that both would meet. What `SteadyRanges` finds;
  /// no sensor says it. Below 0 the robot is in that lane. `kOutOfRange`, more, or NaN: nobody comes.
  float met_m = kOutOfRange;
  float heading_rad = 0.0f;           ///< compass
  float x_m = 0.0f, y_m = 0.0f;       ///< odometry: where the wheels say the robot is, in a frame of their own; it drifts, but does not leap
  float speed_m_s = 0.0f;             ///< odometry; backwards negative
  float turned_rad = 0.0f;            ///< odometry: the angle that the wheels (or a gyroscope) have turned it; any zero; drifts
  bool line_known = false, range_known = false, heading_known = false, odometry_known = false;
  bool turned_known = false;          ///< without it controllers make do with the compass
  bool touched = false;               ///< bumper: nothing drives ahead while it is pressed
  Ages age{};
};
static_assert(kRangeFinders <= 8, "Senses::ranges_unknown has a bit for each");

/// A straight piece of a road as a landmark's memory tells it.
struct Piece {
  float heading_rad = 0.0f;
  float length_m = 0.0f;
};

enum class Turn : std::uint8_t { kBack, kLeft, kForward, kRight };

/// The way into a hall or out of it: the middle of its stop line, counted from where the strategy begins, axes of the compass.
struct Door {
  float x_m = 0.0f, y_m = 0.0f;
  float heading_rad = 0.0f;            ///< of one who goes through it along the road
};

/// Why a controller that crosses a hall does not get to the other side.
enum class Plight : std::uint8_t {
  kNone,
  kTrapped,   ///< it would go on for ever without coming nearer to the goal
  kNoWay,     ///< by all that it knows and has seen there is no way
};

/// What the strategy is about; fixed while it runs. What a controller does not need it does not read. What the program says of its
/// own map is not checked as senses are: all of it must be numbers, and no more than kilometres.
struct Task {
  Turn turn = Turn::kForward;          ///< manoeuvres: how the crossing is to be driven
  Piece course[kLongestCourse] = {};   ///< roads: the pieces ahead, the first of them from where the strategy begins
  std::uint8_t pieces = 0;
  float exit_heading_rad = 0.0f;       ///< manoeuvres: the heading of the road that the crossing is left by
  float entry_heading_rad = 0.0f;      ///< manoeuvres: the heading of the road that it is entered on, if `entry_known`
  bool entry_known = false;            ///< else the heading at the start, or what `turn` says of `exit_heading_rad`
  float entry_left_m = 0.0f;           ///< manoeuvres: how far the robot's centre is to the left of the middle of that road; measured, and checked.
                                       ///< 0, or 0.5 and more: where the line, or nothing, says
  float crossing_m = 0.0f;             ///< manoeuvres: from stop line to stop line; 0: as the `Body` says
  float middle_m = 0.0f;               ///< manoeuvres: from the stop line in to the middle of the crossing, < crossing_m; 0: half of it
  bool in_hall = false;                ///< the road leads across a hall, from the door `in` to the door `out`
  Door in, out;
};

/// What the wheels are to do. The robot clips it to its limits.
struct Motion {
  float speed_m_s = 0.0f;
  float turn_rad_s = 0.0f;   ///< counter-clockwise
};

}  // namespace mts
