// The road that the robot is on, as the memory of its first landmark describes it, and where on it the robot is by its own
// reckoning.
//
// Places are in the reckoning's frame (x east, y north, metres; any zero), and so is the road. Where the robot set out is known to a
// few centimetres. What it then sees of a line or of two walls moves the road sidewards, so that the drift of compass and odometry
// does not grow with the distance (map matching; the gain is that of a low-pass filter).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <waymark/controllers/body.h>
#include <waymark/controllers/reckoning.h>
#include <waymark/controllers/senses.h>
#include "sim/mind/speed_limits.h"
#include "sim/robot/sensors.h"
#include "sim/world/geometry.h"

namespace kb::sim {

/// Where on a road. If nothing is known of the road: at its beginning, facing along it.
struct Progress {
  float along_m = 0.0f;      ///< from its beginning
  float aside_m = 0.0f;      ///< from its middle, to either side
  float to_bend_m = 1e3f;    ///< least distance to the nearest bend, ahead or behind, allowing for errors of odometry
  float turned_rad = 0.0f;   ///< 0 to pi, against that of the pieces near by along which it faces most
  std::size_t piece = 1;     ///< that piece: from spot `piece - 1` of the course to spot `piece`
};

/// Where a robot is, by the names of the map.
struct MapPlace {
  std::string landmark, exit;   ///< on the road that leaves that landmark by that exit; without an exit: in its crossing, or before it
  double along_m = 0.0;         ///< from the landmark
  bool outwards = true;         ///< it faces away from it
};

class RoadAhead {
 public:
  /// The robot's centre, at `at`, is at `begin` in the frame of the course of exit `exit`: 0 at the stop line.
  void enter(std::shared_ptr<const Memory> memory, std::uint32_t exit, const mts::Place& at, Spot begin);
  /// Forgets the road.
  void forget() { *this = RoadAhead{}; }
  /// From here on the road is driven back, whatever a tag at its beginning says, until a crossing is entered.
  void turn_back();
  void enter_crossing() { turned_back_ = over_ = false; }
  /// The robot has driven past the end of the road and found nothing.
  void give_up() { over_ = true; }

  [[nodiscard]] bool known() const { return memory_ != nullptr; }
  [[nodiscard]] bool turned_back() const { return turned_back_; }
  [[nodiscard]] bool given_up() const { return over_; }
  /// Whether the road begins at this arm of this landmark; false after turning back on it.
  [[nodiscard]] bool begins_at(const Memory& memory, std::uint32_t arm) const;
  /// What the landmark's memory says of it; null if nothing is known.
  [[nodiscard]] const Memory::Exit* exit() const { return known() ? &memory_->exits[exit_] : nullptr; }
  /// Its straight pieces; 0 if nothing is known.
  [[nodiscard]] std::size_t pieces() const { return known() ? course().size() - 1 : 0; }
  [[nodiscard]] const HallMap* hall() const { return known() ? memory_->exits[exit_].hall.get() : nullptr; }
  /// The end by which it was entered; it must be known.
  [[nodiscard]] RoadEnd entered() const { return {entered_->landmark, entered_->exits[entered_by_].name}; }
  /// Whether it begins at this landmark.
  [[nodiscard]] bool leaves(const std::string& landmark) const { return known() && memory_->landmark == landmark; }
  /// `mark`, `dist`, ...; empty if nothing is known.
  [[nodiscard]] std::string_view method() const;
  [[nodiscard]] Progress progress(const mts::Place& at) const;
  /// Where the robot is; nothing if the road is unknown. Turning back does not change which road it is.
  [[nodiscard]] std::optional<MapPlace> where(const mts::Place& at) const;
  /// Whether by the distance driven the robot is at the end of the road.
  [[nodiscard]] bool due(const mts::Place& at) const;
  /// Whether by the distance driven the robot and its line sensors are past the road's end: they did not see the stop line there.
  [[nodiscard]] bool passed(const mts::Place& at) const;
  /// The direction in which it reaches its end; it must be known.
  [[nodiscard]] double end_heading_rad() const { return heading(course().back() - course()[course().size() - 2]); }
  /// How far to the left of the road the robot is at its end, for instance after going round something. 0 if nothing is known, or if
  /// the robot is so near the middle that line and walls tell it better.
  [[nodiscard]] float left_of_end_m(const mts::Place& at) const;
  /// The middle of the road beside the robot, and its direction there.
  [[nodiscard]] std::optional<mts::Place> middle(const mts::Place& at) const;
  /// Whether `spot` (in the reckoning's frame) is less than `half_m` from the middle, and no farther along than `ahead_m` from `from_m`.
  [[nodiscard]] bool holds(Spot spot, double from_m, double ahead_m, double half_m) const;
  /// Whether there is room before its end to look for its line to both sides.
  [[nodiscard]] bool has_room_to_seek(const mts::Place& at) const;
  /// How to get back to the road if the robot is beside the middle, before the pieces ahead.
  enum class Back : std::uint8_t {
    kToMiddle,
    kToLine,   ///< to its line, which is somewhere near, to the left or to the right
    kNever,    ///< not at all: the pieces are driven as far aside as the robot is
  };
  /// Writes the pieces ahead, and the doors of a hall, into `task`.
  void tell(mts::Task& task, const mts::Place& at, Back back) const;
  /// Corrects the road by line and walls, which show its middle. Near a bend they do not, but after it they show where the bend was.
  /// Call once a period while the robot is on the road.
  void settle(const mts::Senses& senses, const mts::Place& at, const mts::Body& body, float dt_s);
  /// The same when the robot crosses the road's line, on the way round something or in search of the line: a robot that was pushed
  /// aside learns there where the road is. `pushed`: how far along it is, is unknown too. True if the robot is not where it was thought.
  bool cross_line(const mts::Senses& senses, const mts::Place& at, const mts::Body& body, bool pushed);

 private:
  [[nodiscard]] const std::vector<Spot>& course() const { return memory_->exits[exit_].course; }
  /// How far the spot, in the course's frame, lies past the end; 0 if another part of the road is nearer.
  [[nodiscard]] double behind_end_m(Spot here) const;
  [[nodiscard]] Spot spot_of(const mts::Place& at) const { return {static_cast<double>(at.x_m - x_m_), static_cast<double>(at.y_m - y_m_)}; }

  std::shared_ptr<const Memory> memory_, entered_;   // the memory of its course; that of the landmark where it was entered
  std::uint32_t exit_ = 0, entered_by_ = 0;
  float x_m_ = 0.0f, y_m_ = 0.0f;    // where its course begins
  bool turned_back_ = false, over_ = false;
  bool reversed_ = false;            // its course is that with which it was entered, reversed
};

}  // namespace kb::sim
