#include "sim/experiment/way.h"

#include <algorithm>
#include <limits>

#include "sim/world/geometry.h"

namespace kb::sim::experiment {

bool Bans::holds(RoadId road) const { return std::find(roads.begin(), roads.end(), road) != roads.end(); }

std::optional<RoutePlan> shortest_way(const Labyrinth& labyrinth, CrossingId from, CrossingId to, const Bans& bans) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const std::size_t count = labyrinth.crossings.size();
  std::vector<double> far(count, kFar);
  std::vector<bool> settled(count, false);
  struct Step { CrossingId from = CrossingId::kNone; const Arm* arm = nullptr; };
  std::vector<Step> came(count);
  far[at(from)] = 0.0;
  for (;;) {   // Dijkstra's algorithm; for some dozens of crossings it needs no queue
    std::size_t here = count;
    for (std::size_t i = 0; i < count; ++i) {
      if (!settled[i] && far[i] < kFar && (here == count || far[i] < far[here])) here = i;
    }
    if (here == count) return std::nullopt;
    if (here == at(to)) break;
    settled[here] = true;
    for (const Arm& arm : labyrinth.crossings[here].arms) {
      const Road& road = labyrinth[arm.road];
      const CrossingId there = arm.forward ? road.to : road.from;
      if (!arm.leads_out || bans.holds(arm.road)) continue;
      const double length_m = far[here] + length_of(road.along);
      if (length_m >= far[at(there)]) continue;
      far[at(there)] = length_m;
      came[at(there)] = {static_cast<CrossingId>(here), &arm};
    }
  }
  RoutePlan way;
  for (CrossingId here = to; here != from; here = came[at(here)].from) {
    way.crossings.push_back(here);
    way.exits.push_back(came[at(here)].arm);
  }
  way.crossings.push_back(from);
  std::reverse(way.crossings.begin(), way.crossings.end());
  std::reverse(way.exits.begin(), way.exits.end());
  return way;
}

double time_for(const Road& road, double road_m, double crossing_m) { return road_m / (road.method == "mark" ? kMarkSpeed : kOtherSpeed) + crossing_m / kCrossingSpeed; }

Extent extent_of(const Labyrinth& labyrinth, const RoutePlan& way) {
  Extent extent;
  for (std::size_t i = 0; i < way.exits.size(); ++i) {
    const Arm& arm = *way.exits[i];
    const Road& road = labyrinth[arm.road];
    const double road_m = road.ends_m - road.begins_m;
    const Crossing& there = labyrinth[way.crossings[i + 1]];
    const Arm& arrives = *there.arm(arm.forward ? road.approach : road.exit);
    const bool last = i + 1 == way.exits.size();
    const double crossing_m = arm.stop_m + (last ? 0.0 : arrives.stop_m);
    extent.length_m += road_m + crossing_m;
    extent.time_s += time_for(road, road_m, crossing_m);
  }
  return extent;
}

}  // namespace kb::sim::experiment
