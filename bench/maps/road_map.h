// Road maps of any size, made from a seed, as `.kb` text: what the figures for large knowledge bases are measured on.
//
//   city        a grid of streets with blocks of all shapes: roads are missing, streets end blindly, and some corners are
//               bends or straights without a landmark. Each street is driven by one method.
//   warehouse   aisles with picking positions between racks, joined by cross aisles at the front, at the back and between;
//               some aisles are blind. At the front a spur leads from each second aisle to a station.
//
// Every map is connected. The same arguments give the same bytes on every machine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace kb::bench {

inline constexpr std::uint32_t kNoRoad = 0xFFFFFFFFu;
inline constexpr std::uint32_t kFewestRoads = 24;

enum class Side : std::uint8_t { kN, kE, kS, kW };
[[nodiscard]] constexpr Side opposite(Side s) { return static_cast<Side>((static_cast<unsigned>(s) + 2u) % 4u); }
enum class Method : std::uint8_t { kMark, kDist, kAzimuth };

struct Point { double x_m = 0.0, y_m = 0.0; };

/// One end of a road: the landmark, and on which side of it.
struct End { std::uint32_t landmark = 0; Side side = Side::kN; };
struct Road {
  End a, b;
  Method by = Method::kMark;
  std::optional<Point> bend;
};
struct Landmark {
  char letter = 'J';     ///< its name is the letter and its number: J junction, X crossing of aisles, P position, S station
  Point at;
  std::array<std::uint32_t, 4> road{kNoRoad, kNoRoad, kNoRoad, kNoRoad};   ///< by side
};
struct RoadMap {
  std::string_view name;
  std::vector<Landmark> landmarks;
  std::vector<Road> roads;      ///< all both ways; at most one between two landmarks, none from a landmark to itself

  /// The other end of the road that leaves by this side; the road must be there.
  [[nodiscard]] End across(End from) const {
    const Road& road = roads[landmarks[from.landmark].road[static_cast<std::size_t>(from.side)]];
    const bool forth = road.a.landmark == from.landmark;
    return forth ? road.b : road.a;
  }
  [[nodiscard]] std::string landmark_name(std::uint32_t landmark) const {
    return landmarks[landmark].letter + std::to_string(landmark);
  }
};

/// Maps of exactly `roads` roads (at least kFewestRoads; fewer are taken as that). Time and memory O(roads).
[[nodiscard]] RoadMap make_city(std::uint32_t roads, std::uint64_t seed);
[[nodiscard]] RoadMap make_warehouse(std::uint32_t roads, std::uint64_t seed);

/// A tour of `legs` roads: where it begins, and the side by which each landmark is left. It turns back only in dead ends.
struct Tour { std::uint32_t start = 0; std::vector<Side> exits; };
[[nodiscard]] Tour make_tour(const RoadMap& map, std::uint32_t legs, std::uint64_t seed);

/// The knowledge base: std.navigation, the map, one rule for each road and direction, the tour by the command `Go`.
[[nodiscard]] std::string kb_text(const RoadMap& map, const Tour& tour);

}  // namespace kb::bench
