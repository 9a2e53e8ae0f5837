#include "tests/world/map.h"

#include <stdexcept>

namespace kb::world {

std::optional<EdgeId> Map::leaving(LandmarkId from, Direction exit) const {
  for (std::size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].from == from && edges[i].exit == exit) return static_cast<EdgeId>(i);
  }
  return std::nullopt;
}

LandmarkId Map::landmark(std::string_view name) const {
  for (std::size_t i = 0; i < landmarks.size(); ++i) {
    if (landmarks[i].name == name) return static_cast<LandmarkId>(i);
  }
  throw std::out_of_range("the map has no landmark " + std::string(name));
}

EdgeId Map::edge(std::string_view landmark_and_exit) const {
  const std::size_t dot = landmark_and_exit.find('.');
  if (dot != std::string_view::npos) {
    const auto exit = find<Direction>(kDirectionNames, landmark_and_exit.substr(dot + 1));
    const auto found = exit ? leaving(landmark(landmark_and_exit.substr(0, dot)), *exit) : std::nullopt;
    if (found) return *found;
  }
  throw std::out_of_range("the map has no road " + std::string(landmark_and_exit));
}

LandmarkId Map::add_landmark(std::string name) {
  landmarks.push_back(Landmark{std::move(name), true, {Method::kMark}, {}});
  return static_cast<LandmarkId>(landmarks.size() - 1);
}

EdgeId Map::add_road(LandmarkId from, Direction exit, LandmarkId to, Direction approach, bool one_way, Method by,
                     double length_m) {
  const auto road_id = static_cast<RoadId>(roads.size());
  roads.push_back(Road{length_m, by, {by, Method::kAzimuth}, false, {}});
  const auto there = static_cast<EdgeId>(edges.size());
  edges.push_back(Edge{from, exit, to, approach, road_id, std::nullopt});
  if (!one_way) {
    edges.push_back(Edge{to, approach, from, exit, road_id, there});
    edges[index(there)].back = static_cast<EdgeId>(index(there) + 1);
  }
  return there;
}

}  // namespace kb::world
