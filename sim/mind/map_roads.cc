#include "sim/mind/map_roads.h"

#include "compiler/model/ground.h"
#include "sim/world/geometry.h"

namespace kb::sim {
namespace {

std::vector<mts::Piece> pieces_of(const Labyrinth& labyrinth, const Arm& arm) {
  std::vector<model::Point> course;
  for (std::size_t i = 0; i < labyrinth[arm.road].along.size(); ++i) {
    const Spot spot = labyrinth.point(arm, i);
    course.push_back({spot.x_m, spot.y_m});
  }
  std::vector<mts::Piece> pieces;
  for (const model::GroundPiece& piece : model::pieces_of(course)) pieces.push_back({static_cast<float>(piece.heading_rad), static_cast<float>(piece.length_m)});
  return pieces;
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
                    static_cast<std::uint16_t>(course.size()), static_cast<float>(from.apart_rad(arm)), static_cast<float>(to.apart_rad(approach))});
}

const mts::MapRoad* MapRoads::find(std::string_view landmark, std::string_view exit) const {
  const auto found = by_end_.find({landmark, exit});
  return found == by_end_.end() ? nullptr : &roads_[found->second];
}

}  // namespace kb::sim
