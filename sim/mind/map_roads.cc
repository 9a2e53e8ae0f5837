#include "sim/mind/map_roads.h"

#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

constexpr double kShortestPiece = 0.01;   // m

std::vector<mts::Piece> pieces_of(const Labyrinth& labyrinth, const Arm& arm) {
  std::vector<mts::Piece> pieces;
  Spot here = labyrinth.point(arm, 0);
  const std::size_t count = labyrinth[arm.road].along.size();
  for (std::size_t i = 1; i < count; ++i) {
    const Spot piece = labyrinth.point(arm, i) - here;
    if (length(piece) < kShortestPiece && (i + 1 < count || !pieces.empty())) continue;
    pieces.push_back({static_cast<float>(heading(piece)), static_cast<float>(length(piece))});
    here = labyrinth.point(arm, i);
  }
  return pieces;
}

/// From an arm to the one beside it that is nearest, up to pi.
float apart_rad(const Crossing& crossing, const Arm& arm) {
  double least_rad = kPi;
  for (const Arm& other : crossing.arms) {
    if (&other != &arm) least_rad = std::min(least_rad, std::abs(wrap(other.heading_rad - arm.heading_rad)));
  }
  return static_cast<float>(least_rad);
}

}  // namespace

MapRoads::MapRoads(const Labyrinth& labyrinth) {
  for (std::size_t c = 0; c < labyrinth.crossings.size(); ++c) {
    for (const Arm& arm : labyrinth.crossings[c].arms) add(labyrinth, static_cast<CrossingId>(c), arm);
  }
}

void MapRoads::add(const Labyrinth& labyrinth, CrossingId crossing, const Arm& arm) {
  const Road& road = labyrinth[arm.road];
  const Crossing &from = labyrinth[crossing], &to = labyrinth[arm.forward ? road.to : road.from];
  const Arm& approach = *to.arm(arm.forward ? road.approach : road.exit);
  by_end_.emplace(std::pair<std::string_view, std::string_view>(from.name, arm.name), roads_.size());
  ends_.push_back({crossing, &arm});
  const std::vector<mts::Piece>& course = courses_.emplace_back(pieces_of(labyrinth, arm));
  roads_.push_back({from.name.c_str(), arm.name.c_str(), to.name.c_str(), approach.name.c_str(), road.method.c_str(), mts::kInfinity, course.data(),
                    static_cast<std::uint16_t>(course.size()), apart_rad(from, arm), apart_rad(to, approach)});
}

const mts::MapRoad* MapRoads::find(std::string_view landmark, std::string_view exit) const {
  const auto found = by_end_.find({landmark, exit});
  return found == by_end_.end() ? nullptr : &roads_[found->second];
}

}  // namespace kb::sim
