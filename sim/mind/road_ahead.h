// The road that the robot is on, as the memory of the landmark at its beginning told of it, and where on it the robot is by
// its own reckoning.
//
// A place is the reckoning's (x east, y north, metres; any zero). The road lies in the same frame: where the robot set out is
// known to a few centimetres, and what the robot then sees of a line or of two walls beside it moves the road sidewards, so
// that the drift of compass and odometry does not grow with the way (map matching; the gain is that of a low-pass filter).
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
#include "sim/robot/sensors.h"
#include "sim/world/geometry.h"

namespace kb::sim {

/// Where on a road. Nothing known of the road: as at its beginning, facing along it.
struct Progress {
  float along_m = 0.0f;      ///< from its beginning
  float aside_m = 0.0f;      ///< from its middle, to either side
  float to_bend_m = 1e3f;    ///< to the nearest bend, ahead or behind; so far at least, as odometry may be off
  float turned_rad = 0.0f;   ///< against the one of the pieces near by that it faces along most, 0 to pi
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
  /// Nothing is known of the road.
  void forget() { *this = RoadAhead{}; }
  /// It is driven back from here on, whatever a tag at its beginning says; until a crossing is entered.
  void turn_back();
  void enter_crossing() { turned_back_ = over_ = false; }
  /// The robot has driven all of it, and on, and nothing has come.
  void give_up() { over_ = true; }

  [[nodiscard]] bool known() const { return memory_ != nullptr; }
  [[nodiscard]] bool turned_back() const { return turned_back_; }
  [[nodiscard]] bool given_up() const { return over_; }
  /// Of the landmark where it begins, and on which of its arms; none if it was turned back on.
  [[nodiscard]] bool begins_at(const Memory& memory, std::uint32_t arm) const;
  /// What the landmark's memory says of it; null if nothing is known.
  [[nodiscard]] const Memory::Exit* exit() const { return known() ? &memory_->exits[exit_] : nullptr; }
  [[nodiscard]] const HallMap* hall() const { return known() ? memory_->exits[exit_].hall.get() : nullptr; }
  /// It begins at this landmark.
  [[nodiscard]] bool leaves(const std::string& landmark) const { return known() && memory_->landmark == landmark; }
  /// `mark`, `dist`, ...; empty if nothing is known.
  [[nodiscard]] std::string_view method() const;
  [[nodiscard]] Progress progress(const mts::Place& at) const;
  /// Nothing: nothing is known of the road. Which one it is, its having been turned back on does not change.
  [[nodiscard]] std::optional<MapPlace> where(const mts::Place& at) const;
  /// By the way that was driven the robot is where the road ends.
  [[nodiscard]] bool due(const mts::Place& at) const;
  /// By the way that was driven it is behind the road's end, and so are its line sensors: the stop line there was not below them.
  [[nodiscard]] bool passed(const mts::Place& at) const;
  /// The direction in which it reaches its end; it must be known.
  [[nodiscard]] double end_heading_rad() const { return heading(course().back() - course()[course().size() - 2]); }
  /// How far the robot is to the left of the road at its end, as after the way round something. 0 if nothing is known, or if it is
  /// so near to the middle that line and walls say it better.
  [[nodiscard]] float left_of_end_m(const mts::Place& at) const;
  /// The middle of the road beside the robot, and its direction there.
  [[nodiscard]] std::optional<mts::Place> middle(const mts::Place& at) const;
  /// `spot` (of the reckoning's frame) is less than `half_m` from the middle, and no farther along than `ahead_m` from `from_m`.
  [[nodiscard]] bool holds(Spot spot, double from_m, double ahead_m, double half_m) const;
  /// There is room before its end to look for its line to both sides.
  [[nodiscard]] bool has_room_to_seek(const mts::Place& at) const;
  /// What comes before the pieces ahead, if the robot is beside the middle.
  enum class Back : std::uint8_t {
    kToMiddle,
    kToLine,   ///< which is somewhere near, to the left or to the right
    kNever,    ///< nothing: they are to be driven as far aside as it is
  };
  /// The pieces ahead, and the doors of a hall, for `task`.
  void tell(mts::Task& task, const mts::Place& at, Back back) const;
  /// Line and walls say where its middle is; near a bend they do not, but behind it they say where it was. Call once a period while
  /// the robot is on the road.
  void settle(const mts::Senses& senses, const mts::Place& at, const mts::Body& body, float dt_s);
  /// The same where its line is crossed, on the way round something or in search of it: who was pushed aside learns there where the
  /// road is. `pushed`: how far along it is, it does not know either. True: it is not where it was thought.
  bool cross_line(const mts::Senses& senses, const mts::Place& at, const mts::Body& body, bool pushed);

 private:
  [[nodiscard]] const std::vector<Spot>& course() const { return memory_->exits[exit_].course; }
  /// How far that spot, of the course's frame, lies behind the end; 0 where another part of the road is nearer.
  [[nodiscard]] double behind_end_m(Spot here) const;
  [[nodiscard]] Spot spot_of(const mts::Place& at) const { return {static_cast<double>(at.x_m - x_m_), static_cast<double>(at.y_m - y_m_)}; }

  std::shared_ptr<const Memory> memory_, entered_;   // of its course; of the landmark where it was entered
  std::uint32_t exit_ = 0, entered_by_ = 0;
  float x_m_ = 0.0f, y_m_ = 0.0f;    // where its course begins
  bool turned_back_ = false, over_ = false;
  bool reversed_ = false;            // its course is the one that it was entered with, from the end
};

}  // namespace kb::sim
