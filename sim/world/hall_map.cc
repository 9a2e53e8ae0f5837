#include "sim/world/hall_map.h"

#include <algorithm>
#include <cmath>

#include "sim/world/geometry.h"
#include "sim/world/nearby.h"

namespace kb::sim {
namespace {

constexpr double kBeside = 0.3;   // m, times the size: walls and pillars up to this far outside of a hall are on its map too

std::shared_ptr<const HallMap> map_of_hall(const Labyrinth& labyrinth, const Road& road, const Nearby& walls, const Nearby& pillars) {
  auto map = std::make_shared<HallMap>();
  map->along = road.between_stop_lines();
  map->width_m = road.width_m;
  map->door_m = labyrinth.size * kHallDoor;
  const Bounds bounds = bounds_of(map->along);
  const double within_m = 0.5 * road.width_m + labyrinth.size * kBeside;
  const auto near = [&](Spot a, Spot b) {
    for (std::size_t i = 1; i < map->along.size(); ++i) {
      if (gap_between(map->along[i - 1], map->along[i], a, b) < within_m) return true;
    }
    return false;
  };
  for (const std::uint32_t w : walls.near(bounds, within_m)) {
    const Picture::Wall& wall = labyrinth.walls[w];
    if (near(wall.from, wall.to)) map->walls.push_back(wall);
  }
  for (const std::uint32_t p : pillars.near(bounds, within_m)) {
    const Pillar& pillar = labyrinth.pillars[p];
    if (near(pillar.at, pillar.at)) map->pillars.push_back(pillar);
  }
  return map;
}

}  // namespace

double HallMap::ray(Spot from, Spot ahead, double most_m) const {
  double nearest_m = most_m;
  for (const Picture::Wall& wall : walls) {
    if (const auto meeting = meet(from, from + most_m * ahead, wall.from, wall.to)) nearest_m = std::min(nearest_m, meeting->along_a * most_m);
  }
  for (const Pillar& pillar : pillars) {
    const Spot to = pillar.at - from;
    const double along_m = dot(to, ahead), aside_m = cross(ahead, to);
    if (along_m <= 0.0 || std::abs(aside_m) >= pillar.radius_m) continue;
    nearest_m = std::min(nearest_m, std::max(along_m - std::sqrt(pillar.radius_m * pillar.radius_m - aside_m * aside_m), 0.0));
  }
  return nearest_m;
}

double HallMap::clearance(Spot at) const {
  double nearest_m = 1e9;
  for (const Picture::Wall& wall : walls) nearest_m = std::min(nearest_m, nearest_on(wall.from, wall.to, at).distance_m);
  for (const Pillar& pillar : pillars) nearest_m = std::min(nearest_m, distance(pillar.at, at) - pillar.radius_m);
  return nearest_m;
}

planners::Grid HallMap::grid(double cell_m, double clearance_m) const {
  Spot low = along.front(), high = along.front();
  for (const Spot& spot : along) {
    low = {std::min(low.x_m, spot.x_m), std::min(low.y_m, spot.y_m)};
    high = {std::max(high.x_m, spot.x_m), std::max(high.y_m, spot.y_m)};
  }
  const double half_m = 0.5 * width_m, long_m = length_of(along);
  low = low - Spot{half_m, half_m};
  high = high + Spot{half_m, half_m};
  const auto cells = [&](double length_m) { return static_cast<std::int32_t>(std::ceil(length_m / cell_m)); };
  planners::Grid grid(cells(high.x_m - low.x_m), cells(high.y_m - low.y_m), cell_m, {low.x_m, low.y_m});
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      const planners::Point centre = grid.centre({x, y});
      const Spot at{centre.x, centre.y};
      const Along near = nearest_along(along, at);
      const bool inside = near.distance_m < half_m && near.along_m > door_m && near.along_m < long_m - door_m;
      if (!inside || clearance(at) < clearance_m) grid.set_blocked({x, y}, true);
    }
  }
  return grid;
}

std::vector<std::shared_ptr<const HallMap>> maps_of_halls(const Labyrinth& labyrinth) {
  std::vector<std::shared_ptr<const HallMap>> maps(labyrinth.roads.size());
  const Nearby walls(labyrinth.walls, [](const Picture::Wall& wall) { return bounds_of(wall.from, wall.to); });
  const Nearby pillars(labyrinth.pillars, [](const Pillar& pillar) { return bounds_of(pillar.at); });
  for (std::size_t r = 0; r < labyrinth.roads.size(); ++r) {
    if (labyrinth.roads[r].kind == Picture::Kind::kOpen) maps[r] = map_of_hall(labyrinth, labyrinth.roads[r], walls, pillars);
  }
  return maps;
}

}  // namespace kb::sim
