#include "sim/mind/map_roads.h"

#include <algorithm>
#include <map>

#include "compiler/model/ground.h"

namespace kb::sim {

MapRoads::MapRoads(const model::Model& model, double metre) {
  std::map<model::RowId, std::size_t> number;
  for (const model::LegRoad& leg : model.leg_roads) {
    if (leg.road != model::RowId::kNone) number.emplace(leg.road, 0);
  }
  std::vector<model::GroundRoad> used;
  for (const model::Map& map : model.maps) {
    const auto roads = model::ground_roads(model, map);
    if (!roads) return;
    std::copy_if(roads->begin(), roads->end(), std::back_inserter(used), [&](const model::GroundRoad& road) { return number.contains(road.row); });
  }
  owned_.reserve(used.size());
  for (const model::GroundRoad& road : used) {
    number[road.row] = owned_.size();
    Owned& owned = owned_.emplace_back(std::string(road.from), std::string(road.exit), std::string(road.to), std::string(road.approach), std::string(road.by));
    for (const model::GroundPiece& piece : model::pieces_of(road, metre)) owned.course.push_back({static_cast<float>(piece.heading_rad), static_cast<float>(piece.length_m)});
    roads_.push_back({owned.from.c_str(), owned.exit.c_str(), owned.to.c_str(), owned.approach.c_str(), owned.by.c_str(),
                      road.limit_m_per_s > 0.0f ? road.limit_m_per_s : mts::kInfinity, owned.course.data(), static_cast<std::uint16_t>(owned.course.size()),
                      static_cast<float>(road.begins_apart_rad), static_cast<float>(road.ends_apart_rad)});
  }
  const auto order = program::cell_order(model);
  for (const model::LegRoad& leg : model.leg_roads) {
    if (leg.road != model::RowId::kNone) legs_.push_back({order[model::index(leg.leg)], number[leg.road]});
  }
}

const mts::MapRoad* MapRoads::find(const char* from, const char* exit) const {
  const auto found = std::ranges::find_if(roads_, [&](const mts::MapRoad& road) { return mts::same_text(road.from, from) && mts::same_text(road.exit, exit); });
  return found == roads_.end() ? nullptr : &*found;
}

const mts::MapRoad* MapRoads::of_leg(const std::function<bool(program::CellId)>& high) const {
  const auto found = std::ranges::find_if(legs_, [&](const LegOn& leg) { return high(leg.leg); });
  return found == legs_.end() ? nullptr : &roads_[found->road];
}

}  // namespace kb::sim
