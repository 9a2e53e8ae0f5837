// A small world for closed loops: a robot on a map of one-dimensional roads.
//
//            sign               entry line | crossing | exit line
//   ── road ──┼──── approach ───────────┤██│██ ...  ██│██├── road ──
//             0.8 m before the end       0.12       0.12
//
// It knows no rules. The robot does what the strategy says (drive.h), what it senses becomes facts (sense.h), and
// whatever a careful engineer would call an accident is written into `faults`.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tests/world/map.h"

namespace kb::world {

inline constexpr double kSpeedMps = 0.5;
inline constexpr double kLineWidth = 0.12;      ///< metres, as all below
inline constexpr double kSignBefore = 0.8;      ///< a sign is seen from here before the end of its road ...
inline constexpr double kSignBehind = 0.2;      ///< ... and so far behind the exit line
inline constexpr double kCrossingLength = 0.8;
inline constexpr double kObstacleSeen = 0.4;    ///< an obstacle is seen from here

/// Where the road of arrival can be seen: at the sign only, on the line only, or all the way.
enum class ArrivalSeen : std::uint8_t { kAtSign, kOnLine, kBoth };
/// Where the memory of a landmark (Safe, CrossBy, Closed) can be read: from its sign on, or on its line only.
enum class MemoryRead : std::uint8_t { kFromSign, kOnLine };

struct OnRoad { EdgeId edge{}; double s_m = 0.0; };
struct InCrossing { LandmarkId landmark{}; Direction arm{}; double p_m = 0.0; std::optional<EdgeId> exit; };
using Pose = std::variant<OnRoad, InCrossing>;

struct Fault { std::int64_t time_ms = 0; std::string what; };
struct Crossed { LandmarkId landmark{}; Direction exit{}; };

struct World {
  Map map;
  ArrivalSeen arrival_seen = ArrivalSeen::kBoth;
  MemoryRead memory_read = MemoryRead::kOnLine;
  Pose pose;
  std::int64_t time_ms = 0;
  bool turned = false;               ///< has come about on the last step
  bool aside = false;                ///< beside the track, on the way round an obstacle
  std::int64_t turning_ms = 0;       ///< how long it has been turning on the spot
  double off_track_s = 0.0;          ///< how long it has driven by a method that cannot be followed here
  std::vector<Fault> faults;
  std::vector<Crossed> way;          ///< the crossings that were driven

  // ---- where it is
  [[nodiscard]] const OnRoad* on_road() const { return std::get_if<OnRoad>(&pose); }
  [[nodiscard]] const InCrossing* in_crossing() const { return std::get_if<InCrossing>(&pose); }
  [[nodiscard]] bool on(std::string_view edge) const { return on_road() && on_road()->edge == map.edge(edge); }
  [[nodiscard]] bool comes_from(std::string_view landmark) const;
  [[nodiscard]] bool heads_for(std::string_view landmark) const;
  [[nodiscard]] bool inside(std::string_view landmark) const;
  /// Metres on the road, or in the crossing.
  [[nodiscard]] double position_m() const;
  /// Metres to the end of the road; infinite inside a crossing.
  [[nodiscard]] double to_end_m() const;
  [[nodiscard]] bool on_entry_line() const { return to_end_m() < kLineWidth; }
  /// Whether an obstacle stands within `range_m`: ahead only, or on both sides.
  [[nodiscard]] bool obstacle_within(double range_m, bool ahead_only) const;
  /// The obstacles of the road or crossing where the robot is, and where one of them stands as the robot counts metres.
  [[nodiscard]] const std::vector<Obstacle>& obstacles_here() const;
  [[nodiscard]] double place_of(const Obstacle& obstacle) const;

  // ---- putting it somewhere
  void put(EdgeId edge, double s_m) { pose = OnRoad{edge, s_m}; }
  void put_in_crossing(LandmarkId landmark, Direction arm, Turn turn, double p_m);
  /// Notes an accident; the same one again and again is noted once.
  void fault(std::string what);
  /// `LM5.W LM2.S`: the crossings driven and the exits taken.
  [[nodiscard]] std::string way_text() const;
  /// For messages: `LM5.W@1.20` or `in LM2 0.35`.
  [[nodiscard]] std::string where() const;
};

}  // namespace kb::world
