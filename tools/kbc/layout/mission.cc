// A mission by its stops: the shortest way in metres from each to the next.
#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "tools/kbc/layout/layout.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

double length_of(const Layout& layout, const Road& road) {
  Point at = layout.places[road.from].at;
  double length = 0.0;
  const auto go = [&](Point to) { length += std::hypot(to.x_m - at.x_m, to.y_m - at.y_m), at = to; };
  for (const Point& point : road.through) go(point);
  go(layout.places[road.to].at);
  return length;
}

/// An end of a road is an edge away from it; of several edges between two places Dijkstra takes the shortest.
struct RoadEnd {
  double length_m = 0.0;
  std::uint32_t exit = 0;
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, RoadEnd>;

Graph graph_of(const Layout& layout, std::span<const Road> roads) {
  Graph graph(layout.places.size());
  for (const Road& road : roads) {
    const double length_m = length_of(layout, road);
    boost::add_edge(road.from, road.to, RoadEnd{length_m, road.exit}, graph);
    if (road.both) boost::add_edge(road.to, road.from, RoadEnd{length_m, road.approach}, graph);
  }
  return graph;
}

/// The side by which the shortest road leads from one place to its neighbour; the first of those that are equally long.
std::uint32_t exit_to(const Graph& graph, std::size_t from, std::size_t to) {
  RoadEnd best{std::numeric_limits<double>::infinity(), 0};
  for (const auto& edge : boost::make_iterator_range(boost::out_edges(from, graph))) {
    if (boost::target(edge, graph) == to && graph[edge].length_m < best.length_m) best = graph[edge];
  }
  return best.exit;
}

/// The mission goes on to `to` by the shortest way. False if there is none.
bool go_on(const Graph& graph, std::uint32_t to, Mission& mission) {
  const std::size_t from = mission.visits.back().place;
  std::vector<std::size_t> before(boost::num_vertices(graph));
  boost::dijkstra_shortest_paths(graph, from, boost::predecessor_map(before.data()).weight_map(boost::get(&RoadEnd::length_m, graph)));
  std::vector<std::size_t> way;
  for (std::size_t at = to; at != from; at = before[at]) {
    if (before[at] == at) return false;
    way.push_back(at);
  }
  for (auto at = way.rbegin(); at != way.rend(); ++at) {
    mission.visits.back().exit = exit_to(graph, mission.visits.back().place, *at);
    mission.visits.push_back({static_cast<std::uint32_t>(*at), 0});
  }
  return !way.empty();
}

}  // namespace

std::optional<Mission> mission_by_stops(const Layout& layout, std::span<const Road> roads, std::span<const std::string> names,
                                        std::span<const std::string> stops, diagnostics::Diagnostics& diagnostics) {
  std::unordered_map<std::string_view, std::uint32_t> index;
  for (std::uint32_t i = 0; i < names.size(); ++i) index.try_emplace(names[i], i);
  for (std::uint32_t i = 0; i < names.size(); ++i) index.insert_or_assign(layout.places[i].id, i);
  const Graph graph = graph_of(layout, roads);
  Mission mission;
  for (const std::string& stop : stops) {
    const auto found = index.find(stop);
    if (found == index.end()) {
      std::vector<std::string_view> known;
      for (const Place& place : layout.places) known.push_back(place.id);
      diagnostics.report(Kind::kLayoutNoStop, {}, {stop}).suggest(diagnostics::closest(stop, known));
      return std::nullopt;
    }
    if (mission.visits.empty()) {
      mission.visits.push_back({found->second, 0});
    } else if (!go_on(graph, found->second, mission)) {
      diagnostics.report(Kind::kLayoutNoWay, {}, {layout.places[mission.visits.back().place].id, stop});
      return std::nullopt;
    }
  }
  return mission;
}

}  // namespace kb::layout
