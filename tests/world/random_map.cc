#include "tests/world/random_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>

namespace kb::world {
namespace {

constexpr double kRoadExists = 0.72;
constexpr double kBendWithoutLandmark = 0.45;
constexpr double kOneWay = 0.15;
constexpr double kTurnBack = 0.25;

/// One end of a road: a node of the grid and the arm there.
struct End { int node = 0; Direction arm{}; };
struct Node {
  bool alive = true;
  std::array<std::optional<End>, 4> arms;   ///< by Direction: where the road leads
  [[nodiscard]] std::vector<Direction> open() const {
    std::vector<Direction> found;
    for (const Direction d : kDirections) {
      if (arms[index(d)]) found.push_back(d);
    }
    return found;
  }
};
struct Grid {
  int width = 0, height = 0;
  std::vector<Node> nodes;
  [[nodiscard]] Node& at(int x, int y) { return nodes[static_cast<std::size_t>(y * width + x)]; }
  Node& operator[](int node) { return nodes[static_cast<std::size_t>(node)]; }
  void join(End a, End b) {
    (*this)[a.node].arms[index(a.arm)] = b;
    (*this)[b.node].arms[index(b.arm)] = a;
  }
};

Grid random_grid(Dice& dice) {
  Grid grid;
  grid.width = dice.between(2, 5);
  grid.height = dice.between(2, 5);
  grid.nodes.resize(static_cast<std::size_t>(grid.width * grid.height));
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const int here = y * grid.width + x;
      const bool north = y + 1 < grid.height && dice.chance(kRoadExists);
      if (north) grid.join({here, Direction::kN}, {here + grid.width, Direction::kS});
      const bool east = x + 1 < grid.width && dice.chance(kRoadExists);
      if (east) grid.join({here, Direction::kE}, {here + 1, Direction::kW});
    }
  }
  return grid;
}

/// Some bends and straights become roads without a landmark: so arise curved roads, parallel roads and loops.
void drop_some_landmarks(Dice& dice, Grid& grid) {
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    Node& node = grid.nodes[i];
    const auto open = node.open();
    if (open.size() != 2 || !dice.chance(kBendWithoutLandmark)) continue;
    const End a = *node.arms[index(open[0])], b = *node.arms[index(open[1])];
    const int here = static_cast<int>(i);
    if (a.node == here || b.node == here) continue;
    grid.join(a, b);
    node.alive = false;
    node.arms = {};
  }
}

/// The nodes that roads connect with the node of most arms, in ascending order.
std::vector<int> main_part(Grid& grid) {
  int hub = 0;
  for (std::size_t i = 1; i < grid.nodes.size(); ++i) {
    if (grid.nodes[i].open().size() > grid[hub].open().size()) hub = static_cast<int>(i);
  }
  std::vector<int> part{hub};
  for (std::size_t next = 0; next < part.size(); ++next) {
    for (const Direction d : grid[part[next]].open()) {
      const int other = grid[part[next]].arms[index(d)]->node;
      if (std::find(part.begin(), part.end(), other) == part.end()) part.push_back(other);
    }
  }
  std::sort(part.begin(), part.end());
  return part;
}

Method random_method(Dice& dice) {
  static const std::vector<Method> kMarkTwiceAsOften{Method::kMark, Method::kMark, Method::kDist, Method::kAzimuth};
  return dice.pick(kMarkTwiceAsOften);
}

Map map_of_grid(Dice& dice, Grid& grid, const std::vector<int>& part) {
  Map map;
  const auto landmark = [&](int node) {
    return static_cast<LandmarkId>(std::lower_bound(part.begin(), part.end(), node) - part.begin());
  };
  for (std::size_t i = 0; i < part.size(); ++i) map.add_landmark(fmt::format("L{}", i + 1));
  for (const int node : part) {
    for (const Direction d : grid[node].open()) {
      End here{node, d};
      End there = *grid[node].arms[index(d)];
      if (there.node < node || (there.node == node && index(there.arm) <= index(d))) continue;
      const bool one_way = dice.chance(kOneWay);
      if (one_way && dice.chance(0.5)) std::swap(here, there);
      const double length_m = 1.6 + 2.0 * dice.unit();
      map.add_road(landmark(here.node), here.arm, landmark(there.node), there.arm, one_way, random_method(dice),
                   length_m);
    }
  }
  return map;
}

/// The exits of `at` that a walk which arrives on `arm` may take: back only now and then, or out of a dead end.
std::vector<EdgeId> ways_on(Dice& dice, const Map& map, LandmarkId at, Direction arm) {
  std::vector<EdgeId> exits, onward;
  for (const Direction d : kDirections) {
    if (const auto edge = map.leaving(at, d)) exits.push_back(*edge);
  }
  for (const EdgeId edge : exits) {
    if (map[edge].exit != arm || exits.size() == 1 || dice.chance(kTurnBack)) onward.push_back(edge);
  }
  return onward;
}

}  // namespace

Map random_map(Dice& dice) {
  for (;;) {
    Grid grid = random_grid(dice);
    drop_some_landmarks(dice, grid);
    const std::vector<int> part = main_part(grid);
    if (part.size() < 3) continue;
    return map_of_grid(dice, grid, part);
  }
}

std::string map_text(const Map& map) {
  std::string text = "map M {\n";
  for (const Landmark& landmark : map.landmarks) text += fmt::format("  landmark {}\n", landmark.name);
  for (std::size_t i = 0; i < map.edges.size(); ++i) {
    const Edge& edge = map.edges[i];
    if (edge.back && index(*edge.back) < i) continue;
    text += fmt::format("  road {}.{} {} {}.{} by {}\n", map[edge.from].name, name(edge.exit), edge.back ? "--" : "->",
                        map[edge.to].name, name(edge.approach), name(map.roads[index(edge.road)].by));
  }
  return text + "}\n";
}

RandomRoute random_route(Dice& dice, const Map& map) {
  for (;;) {
    RandomRoute route;
    route.start = static_cast<EdgeId>(dice.below(map.edges.size()));
    EdgeId last = route.start;
    for (int stops = dice.between(2, 9); stops > 0; --stops) {
      const auto onward = ways_on(dice, map, map[last].to, map[last].approach);
      if (onward.empty()) break;
      last = dice.pick(onward);
      route.edges.push_back(last);
    }
    if (!route.edges.empty()) return route;
  }
}

std::string route_text(const Map& map, const RandomRoute& route, int number) {
  std::string stops;
  for (const EdgeId id : route.edges) {
    const Edge& edge = map[id];
    const auto parallel = std::count_if(map.edges.begin(), map.edges.end(), [&](const Edge& other) {
      return other.from == edge.from && other.to == edge.to;
    });
    stops += map[edge.from].name;
    if (parallel > 1) stops += fmt::format(".{}", name(edge.exit));
    stops += " -> ";
  }
  stops += map[map[route.edges.back()].to].name;
  return fmt::format("command Go{0}\nroute R{0} on M by Go{0}: {1}\n", number, stops);
}

std::string way_of(const Map& map, const RandomRoute& route) {
  std::string way;
  for (const EdgeId id : route.edges) {
    if (!way.empty()) way += ' ';
    way += fmt::format("{}.{}", map[map[id].from].name, name(map[id].exit));
  }
  return way;
}

}  // namespace kb::world
