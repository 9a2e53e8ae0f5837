#include "sim/mind/speed_limits.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace kb::sim {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

}  // namespace

void SpeedLimits::add(const RoadEnd& end, float limit_m_s) {
  float& known = by_landmark_[std::string(end.landmark)].try_emplace(std::string(end.side), kNone).first->second;
  known = std::min(known, limit_m_s);
  lowest_ = std::min(lowest_, limit_m_s);
}

float SpeedLimits::at(const RoadEnd& end) const {
  const auto landmark = by_landmark_.find(end.landmark);
  if (landmark == by_landmark_.end()) return kNone;
  const auto side = landmark->second.find(end.side);
  return side == landmark->second.end() ? kNone : side->second;
}

SpeedLimits limits_of(const model::Model& model) {
  SpeedLimits limits;
  for (const model::Map& map : model.maps) {
    for (std::size_t i = 0; i < map.roads.size(); ++i) {
      const model::MapRoad& road = map.roads[i];
      const bool way_back = i > 0 && map.roads[i - 1].road == road.road;   // its ends are the same
      if (road.limit_m_per_s <= 0.0f || way_back) continue;
      const model::Row& row = model[road.row];
      for (const auto& [landmark, side] : {std::pair("from", "exit"), std::pair("to", "approach")}) {
        const model::Row* end = model.row_in(row, landmark);   // a library of the user's own may do without
        if (end != nullptr) limits.add({end->name, model.member_in(row, side)}, road.limit_m_per_s);
      }
    }
  }
  return limits;
}

}  // namespace kb::sim
