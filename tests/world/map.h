// The map that the robot drives on: landmarks with four arms, roads of one dimension between them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/world/compass.h"

namespace kb::world {

enum class LandmarkId : std::uint32_t {};
enum class RoadId : std::uint32_t {};
/// A road in one direction.
enum class EdgeId : std::uint32_t {};

/// Something that stands in the way, `at_m` from the beginning of `seen_from` (of the crossing, for a crossing's).
struct Obstacle {
  double at_m = 0.0;
  std::optional<EdgeId> seen_from;
  bool passable = true;              ///< the robot can get round it
};

struct Road {
  double length_m = 0.0;  ///< from the exit line of one crossing to the far side of the entry line of the next
  Method by = Method::kMark;         ///< what the memory at its beginning says
  MethodSet tracks;                  ///< what can really be followed
  bool closed = false;
  std::vector<Obstacle> obstacles;
};

struct Edge {
  LandmarkId from{};
  Direction exit{};
  LandmarkId to{};
  Direction approach{};              ///< seen from `to`: the arm on which the robot arrives
  RoadId road{};
  std::optional<EdgeId> back;        ///< the same road the other way, unless it is one-way
};

struct Landmark {
  std::string name;
  bool safe = true;
  MethodSet cross_by{Method::kMark};
  std::vector<Obstacle> obstacles;   ///< inside its crossing
};

struct Map {
  std::vector<Landmark> landmarks;
  std::vector<Road> roads;
  std::vector<Edge> edges;

  [[nodiscard]] const Landmark& operator[](LandmarkId id) const { return landmarks[index(id)]; }
  [[nodiscard]] Landmark& operator[](LandmarkId id) { return landmarks[index(id)]; }
  [[nodiscard]] const Edge& operator[](EdgeId id) const { return edges[index(id)]; }
  [[nodiscard]] const Road& road(EdgeId id) const { return roads[index(edges[index(id)].road)]; }
  [[nodiscard]] Road& road(EdgeId id) { return roads[index(edges[index(id)].road)]; }

  /// The edge that leaves `from` by `exit`, if there is a road.
  [[nodiscard]] std::optional<EdgeId> leaving(LandmarkId from, Direction exit) const;
  /// By name; throws std::out_of_range for a landmark that the map does not have (a mistake in a test).
  [[nodiscard]] LandmarkId landmark(std::string_view name) const;
  /// `LM5.W`: the edge that leaves LM5 to the west; throws std::out_of_range if there is none.
  [[nodiscard]] EdgeId edge(std::string_view landmark_and_exit) const;

  LandmarkId add_landmark(std::string name);
  /// Adds a road and its edges (two, unless it is one-way). Tracks: `by` and the compass, which serves everywhere.
  EdgeId add_road(LandmarkId from, Direction exit, LandmarkId to, Direction approach, bool one_way, Method by,
                  double length_m);
};

}  // namespace kb::world
