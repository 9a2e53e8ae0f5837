// Checks that landmarks, roads and walls leave each other room.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "compiler/diagnostics/display.h"
#include "sim/world/geometry.h"
#include "sim/world/parts.h"

namespace kb::sim {
namespace {

using diagnostics::Diagnostics;
using diagnostics::Kind;

constexpr double kLeastBetween = 0.97 * kRoadWidth;   // between the middles of two roads; times the size
constexpr double kLeastToWall = 0.2;                  // between the middle of a road and a wall; times the size

/// Calls `visit(crossing, other)` for each two landmarks that leave their crossings no room, in ascending order.
template <class Visit>
void each_crowded(const Labyrinth& labyrinth, const Nearby& crossings, Visit visit) {
  const double least_m = 2.0 * labyrinth.size * kLeastStop;
  for (std::size_t i = 0; i < labyrinth.crossings.size(); ++i) {
    for (const std::uint32_t j : crossings.near(bounds_of(labyrinth.crossings[i].at), least_m)) {
      if (j >= i) break;
      if (distance(labyrinth.crossings[i].at, labyrinth.crossings[j].at) < least_m) visit(labyrinth.crossings[i], labyrinth.crossings[j]);
    }
  }
}

bool check_landmarks(const Labyrinth& labyrinth, const Nearby& crossings, Diagnostics& diagnostics) {
  bool good = true;
  each_crowded(labyrinth, crossings, [&](const Crossing& crossing, const Crossing& other) {
    diagnostics.report(Kind::kSimLandmarksCoincide, crossing.span, {crossing.name, other.name, fmt::format("{:.2f}", distance(crossing.at, other.at))})
        .note(Kind::kSimOtherHere, other.span);
    good = false;
  });
  return good;
}

/// Reports two roads (or two pieces of one road) that come too near to each other. Roads that cross have been checked by cross_roads();
/// here they only must not lie on each other.
bool check_pair(const Labyrinth& labyrinth, const Road& a, const Road& b, const std::vector<Spot>& chain_a, const std::vector<Spot>& chain_b, Diagnostics& diagnostics) {
  const bool same = &a == &b;
  bool crosses = false;
  const double least_m = labyrinth.size * kLeastBetween;
  double near_m = least_m;
  for (std::size_t i = 1; i < chain_a.size(); ++i) {
    for (std::size_t j = same ? i + 2 : 1; j < chain_b.size(); ++j) {
      if (meet(chain_a[i - 1], chain_a[i], chain_b[j - 1], chain_b[j])) crosses = true;
      else near_m = std::min(near_m, gap_between(chain_a[i - 1], chain_a[i], chain_b[j - 1], chain_b[j]));
    }
  }
  if (near_m >= (crosses ? 0.5 * labyrinth.widths.line_m : least_m)) return true;
  const std::string other = same ? "itself" : fmt::format("`{}`", a.name);
  auto message = diagnostics.report(Kind::kSimRoadsNear, b.span, {b.name, fmt::format("{:.2f}", near_m), other, fmt::format("{:.2f}", labyrinth.size * kRoadWidth)});
  if (!same) message.note(Kind::kSimOtherHere, a.span);
  note_floor(labyrinth, labyrinth[b.from].map, labyrinth[a.from].map, message);
  return false;
}

bool check_passed(const Labyrinth& labyrinth, const Nearby& crossings, const Road& road, const std::vector<Spot>& chain, Diagnostics& diagnostics) {
  const double from_landmark_m = 0.95 * labyrinth.size * kLeastStop;
  for (const std::uint32_t c : crossings.near(bounds_of(chain), from_landmark_m)) {
    const Crossing& crossing = labyrinth.crossings[c];
    if (nearest_along(chain, crossing.at).distance_m >= from_landmark_m) continue;
    auto message = diagnostics.report(Kind::kSimRoadOverLandmark, road.span, {road.name, crossing.name});
    note_floor(labyrinth, labyrinth[road.from].map, crossing.map, message);
    return false;
  }
  return true;
}

bool check_walls(const Labyrinth& labyrinth, const Nearby& walls, const Road& road, const std::vector<Spot>& chain, Diagnostics& diagnostics) {
  const double from_wall_m = labyrinth.size * kLeastToWall;
  if (road.kind == Picture::Kind::kOpen) return true;   // a hall may have things standing in it
  for (const std::uint32_t w : walls.near(bounds_of(chain), from_wall_m)) {
    const Picture::Wall& wall = labyrinth.walls[w];
    for (std::size_t i = 1; i < chain.size(); ++i) {
      if (gap_between(chain[i - 1], chain[i], wall.from, wall.to) >= from_wall_m) continue;
      diagnostics.report(Kind::kSimRoadWalled, road.span, {road.name, place_text(labyrinth, nearest_of(chain[i - 1], chain[i], wall.from, wall.to))});
      return false;
    }
  }
  return true;
}

/// Reports a road that leads over blocked cells of the background. These have walls only at their borders, so a road that lies wholly among
/// them comes near no wall. What stands in a hall is gone round; its doors have to be free.
bool check_free(const Labyrinth& labyrinth, const Road& road, const std::vector<Spot>& chain, const planners::Grid& background, Diagnostics& diagnostics) {
  const double long_m = length_of(chain), door_m = labyrinth.size * kHallDoor;
  const int steps = static_cast<int>(long_m / background.cell_m()) + 1;
  for (int i = 0; i <= steps; ++i) {
    const double along_m = long_m * i / steps;
    if (road.kind == Picture::Kind::kOpen && along_m > door_m && along_m < long_m - door_m) continue;
    const Spot at = point_on(chain, along_m).at;
    const planners::Point there{at.x_m, at.y_m};
    if (!background.contains(there) || !background.blocked(background.cell_at(there))) continue;
    diagnostics.report(Kind::kSimRoadWalled, road.span, {road.name, place_text(labyrinth, at)});
    return false;
  }
  return true;
}

}  // namespace

std::string place_text(const Labyrinth& labyrinth, Spot spot) {
  return fmt::format("({:.2f}, {:.2f})", spot.x_m / labyrinth.scale, spot.y_m / labyrinth.scale);
}

bool check_maps(const Labyrinth& labyrinth, Diagnostics& diagnostics) {
  if (labyrinth.maps.size() < 2) return true;
  struct Crowded {
    const Crossing* one = nullptr;
    const Crossing* other = nullptr;
    std::size_t more = 0;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, Crowded> found;
  const Nearby crossings(labyrinth.crossings, [](const Crossing& crossing) { return bounds_of(crossing.at); });
  each_crowded(labyrinth, crossings, [&](const Crossing& crossing, const Crossing& other) {
    if (crossing.map == other.map) return;
    const auto [at, is_new] = found.try_emplace(std::minmax(crossing.map, other.map), Crowded{&crossing, &other});
    at->second.more += is_new ? 0 : 1;
  });
  for (const auto& [maps, crowded] : found) {
    const auto& [one, other, more] = crowded;
    const std::string others = more == 0 ? "" : fmt::format(" (and {} more)", diagnostics::counted(more, "pair"));
    diagnostics.report(Kind::kSimMapsCoincide, one->span,
                       {labyrinth.maps[other->map], labyrinth.maps[one->map], one->name, other->name, fmt::format("{:.2f}", distance(one->at, other->at)), others})
        .note(Kind::kSimOtherHere, other->span);
  }
  return found.empty();
}

bool check_room(const Labyrinth& labyrinth, const Ways& ways, const planners::Grid* background, Diagnostics& diagnostics) {
  const Nearby crossings(labyrinth.crossings, [](const Crossing& crossing) { return bounds_of(crossing.at); });
  const Nearby walls(labyrinth.walls, [](const Picture::Wall& wall) { return bounds_of(wall.from, wall.to); });
  bool good = check_landmarks(labyrinth, crossings, diagnostics);
  for (std::size_t i = 0; i < labyrinth.roads.size(); ++i) {   // before pairs: a road that runs over a landmark also comes near that one's roads
    if (!check_passed(labyrinth, crossings, labyrinth.roads[i], ways[i], diagnostics)) good = false;
  }
  if (!good) return false;
  ways.each_pair(labyrinth.size * kLeastBetween, [&](std::size_t i, std::size_t j) {
    if (!check_pair(labyrinth, labyrinth.roads[j], labyrinth.roads[i], ways[j], ways[i], diagnostics)) good = false;
  });
  if (!good) return false;
  for (std::size_t i = 0; i < labyrinth.roads.size(); ++i) {
    if (!check_walls(labyrinth, walls, labyrinth.roads[i], ways[i], diagnostics) ||
        (background != nullptr && !check_free(labyrinth, labyrinth.roads[i], ways[i], *background, diagnostics))) {
      good = false;
    }
  }
  return good;
}

}  // namespace kb::sim
