// The map of a knowledge base as a floor: roads of a width, crossings between their stop lines, paint, walls, tags.
//
//              │ road │              Each arm of a crossing ends at a stop line, `stop_m` from the landmark. What lies
//        ──────┤      ├──────        between the stop lines is the crossing. A tag lies before each stop line; the robot
//        road  ═      ═  road        that passes over it reads the landmark's memory: see Tag.
//        ──────┴──────┴──────
//
// Roads by `mark` have a painted line, whose bends are arcs; roads by `dist` have walls on both sides, and the crossings
// they reach have wall corners; roads by `azimuth` have nothing; any other method (`open`) is a hall with what stands in it.
// Metres, radians; see sim/recording.h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "compiler/diagnostics/diagnostics.h"
#include "compiler/model/model.h"
#include "planners/grid.h"
#include "sim/recording.h"
#include "sim/robot_body.h"

namespace kb::sim {

// The lengths of a floor for a robot of size 1; for another size they are scaled: see Labyrinth::size.
inline constexpr double kRoadWidth = static_cast<double>(kRobot.road_width_m);
inline constexpr double kLeastStop = 0.5 * static_cast<double>(kRobot.crossing_m);        ///< from a landmark to the middle of a stop line, at least
inline constexpr double kLeastRoad = 1.6;           ///< between the stop lines of a road, at least
inline constexpr double kTagBefore = 0.15;          ///< how far outside its stop line a tag lies
inline constexpr double kTagRange = 0.30;           ///< ... and is read within this distance
inline constexpr double kBendRadius = 0.3;          ///< of the painted line
inline constexpr double kHallWidth = 2.4;           ///< of roads by methods other than those three, if not given
inline constexpr double kHallDoor = static_cast<double>(kRobot.hall_door_m);   ///< from a stop line to the hall behind it

/// How broad paint is, m.
struct PaintWidths {
  double line_m = static_cast<double>(kRobot.paint_width_m);
  double stop_line_m = static_cast<double>(kRobot.stop_line_width_m);   ///< along the road; across it, it is as wide as the road
  [[nodiscard]] bool operator==(const PaintWidths&) const = default;
};
/// The widths on the floor that a robot is built for.
[[nodiscard]] constexpr PaintWidths widths_of(const mts::Body& body) { return {static_cast<double>(body.paint_width_m), static_cast<double>(body.stop_line_width_m)}; }

enum class CrossingId : std::uint32_t { kNone = 0xFFFFFFFFu };
enum class RoadId : std::uint32_t { kNone = 0xFFFFFFFFu };
template <class Id>
  requires std::is_enum_v<Id>
[[nodiscard]] constexpr std::size_t at(Id id) { return static_cast<std::size_t>(id); }

/// An arm of a crossing.
struct Arm {
  std::string name;                 ///< of the exit: `N`
  RoadId road = RoadId::kNone;
  bool forward = true;              ///< the road begins here (else it ends here)
  bool leads_out = true;            ///< may be driven away from the crossing
  double heading_rad = 0.0;         ///< outwards
  double stop_m = 0.0;              ///< from the landmark to the middle of the stop line
};

struct Crossing {
  std::string name;                 ///< the landmark
  Spot at;
  std::vector<Arm> arms;            ///< counter-clockwise, from the smallest heading in (-pi, pi]
  bool walled = false;              ///< a `dist` road reaches it
  bool painted = true;              ///< lines lead from its stop lines to its middle
  std::vector<std::string> methods; ///< those that work in it, as its memory says
  source::Span span;
  std::uint32_t map = 0;            ///< index into Labyrinth::maps

  [[nodiscard]] const Arm* arm(std::string_view exit) const;
  /// From one of its arms to the one beside it that is nearest, up to pi: none is beside it.
  [[nodiscard]] double apart_rad(const Arm& arm) const;
};

/// How a hall is built and furnished, if not like the others. Metres of the floor. Places in it are given from the end that `road`
/// names: `along` from its stop line into the hall, `aside` to the left of the road's middle.
struct HallBuild {
  struct Box {
    double from_along_m = 0.0, from_aside_m = 0.0, to_along_m = 0.0, to_aside_m = 0.0;
    source::Span span{};            ///< where it is written
  };
  std::string road;                 ///< one of its ends: `LM2.E`
  std::optional<double> width_m;    ///< none: kHallWidth, times the floor's size
  bool pillars = true;              ///< it has a round pillar every 1.1 m, times the size
  std::vector<Box> boxes;           ///< cupboards, and walls within it
  source::Span span;                ///< where `road` is written
};

struct Road {
  std::string name;                 ///< `LM5.W--LM2.E`; `->` if it is one-way
  CrossingId from{}, to{};
  std::string exit, approach;       ///< its arms at `from` and at `to`
  Picture::Kind kind = Picture::Kind::kMark;
  std::string method;               ///< `mark`
  double width_m = 0.0;
  bool pillars = true;              ///< halls
  std::vector<HallBuild::Box> boxes;///< halls; given from its first landmark
  std::vector<Spot> along;          ///< from landmark to landmark
  double begins_m = 0.0, ends_m = 0.0;   ///< its stop lines, along it
  source::Span span;

  [[nodiscard]] std::vector<Spot> between_stop_lines() const;
};

/// A straight stretch of paint.
struct Paint {
  Spot from, to;
  double half_width_m = 0.0;
  RoadId road = RoadId::kNone;      ///< whose marking it is; kNone: a stop line or the paint of a crossing
  CrossingId crossing = CrossingId::kNone;   ///< from whose middle it leads to a stop line
};

/// Where a tag lies. What it says is the present memory of its landmark (floor.h).
struct Tag {
  Spot at;
  CrossingId crossing{};
  std::uint32_t arm = 0;
};

/// Where two roads cross without a landmark. If their lines would mislead a robot, they are left out within this distance.
struct Level {
  RoadId over{}, by{};
  Spot at;
  double unpainted_m = 0.0;
};

struct Pillar { Spot at; double radius_m = 0.0; };

struct Labyrinth {
  double scale = 1.0;               ///< metres on the floor for a metre of the map
  RoadId scaled_for = RoadId::kNone;   ///< the road for whose sake it is more than 1; kNone: it is 1, or was asked for
  double size = 1.0;                ///< of its robot (Body::size): all that is built here is larger by this factor, except paint, which has `widths`
  PaintWidths widths;
  std::vector<std::string> maps;    ///< their names: all lie on this one floor
  std::vector<Crossing> crossings;
  std::unordered_map<std::string, CrossingId> by_name;   ///< the same by landmark, the first of several of one name; only looked up, never iterated
  std::vector<Road> roads;
  std::vector<Paint> paint, stop_lines;
  std::vector<Picture::Wall> walls;
  std::vector<Level> levels;
  std::vector<Pillar> pillars;
  std::vector<std::vector<Spot>> boxes;   ///< the corners of things in halls; their sides are among the walls
  std::vector<Tag> tags;
  Spot low, high;

  [[nodiscard]] const Crossing& operator[](CrossingId id) const { return crossings[at(id)]; }
  [[nodiscard]] const Road& operator[](RoadId id) const { return roads[at(id)]; }
  [[nodiscard]] CrossingId crossing(std::string_view landmark) const;
  /// The road that leaves or reaches a landmark by an exit: `LM7`, `E`; nothing if there is none.
  struct End { CrossingId crossing{}; const Arm* arm = nullptr; };
  [[nodiscard]] std::optional<End> end(std::string_view landmark_and_exit) const;
  /// A point of a road, the crossing of `arm` being number 0.
  [[nodiscard]] Spot point(const Arm& arm, std::size_t number) const {
    const auto& along = (*this)[arm.road].along;
    return along[arm.forward ? number : along.size() - 1 - number];
  }
  /// The place `along_m` beyond the stop line of an arm, on its road, heading away from the crossing; on the arc at a bend of a painted line.
  [[nodiscard]] Pose place(End end, double along_m) const;
  /// Whether a disc can stand there: no wall, pillar or box within `radius_m`. Outside all roads there is room. O(walls).
  [[nodiscard]] bool has_room(Spot spot, double radius_m) const;
  /// The road seen from the crossing of `arm`: from its stop line there to the other.
  [[nodiscard]] std::vector<Spot> course(const Arm& arm) const;
};

/// What a scenario file says of its robot's size, of paint and halls, which has to be known before the floor is laid out.
struct FloorBuild {
  double size = 1.0;                ///< see Labyrinth::size
  PaintWidths widths;
  std::vector<HallBuild> halls;     ///< each road once
};

struct LayoutOptions {
  std::optional<double> scale;      ///< none: the least at which the shortest road still has kLeastRoad, times the size, between stop lines
  const planners::Grid* background = nullptr;   ///< walls of a building, in the map's coordinates times scale
  FloorBuild build{};
};

/// Lays out all maps of a knowledge base. A curve that leaves a landmark along another road is built straight there (KB1319). Reports
/// (KB13xx) what cannot be laid out: landmarks without a place, exits that coincide or lead elsewhere than named, walled roads that
/// cross without a landmark, roads through walls, halls that are not halls. Pure.
/// O(n log n) in landmarks, roads and walls, as long as few of them lie near each other.
[[nodiscard]] std::optional<Labyrinth> lay_out(const model::Model& model, const LayoutOptions& options,
                                               diagnostics::Diagnostics& diagnostics);

/// The picture of it for a recording.
[[nodiscard]] Picture picture_of(const Labyrinth& labyrinth, double robot_radius_m);

/// The angle that a compass word means (`N` is pi/2), if it is one of the sixteen.
[[nodiscard]] std::optional<double> compass_heading(std::string_view word);
/// The nearest of `E`, `N`, `W`, `S`.
[[nodiscard]] std::string_view compass_word(double heading_rad);

}  // namespace kb::sim
