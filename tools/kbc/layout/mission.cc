// Makes a mission from its stops, by the shortest way in metres from each to the next, and reduces a map to what a mission needs.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <limits>
#include <set>
#include <unordered_map>

#include "tools/kbc/layout/chain.h"
#include "tools/kbc/layout/layout.h"

namespace kb::layout {

using diagnostics::Kind;

namespace {

double length_of(const Layout& layout, const Road& road) {
  const std::vector<Point> course = course_of(layout, road);
  double length = 0.0;
  for (std::size_t i = 1; i < course.size(); ++i) length += distance(course[i - 1], course[i]);
  return length;
}

/// An edge of the graph: a road as driven away from one of its ends. Between two places Dijkstra takes the shortest of several edges.
struct RoadEnd {
  double length_m = 0.0;
  std::uint32_t exit = 0;
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, boost::no_property, RoadEnd>;

Graph graph_of(const Map& map) {
  Graph graph(map.layout.places.size());
  for (const Road& road : map.roads) {
    const double length_m = length_of(map.layout, road);
    boost::add_edge(road.from, road.to, RoadEnd{length_m, road.exit}, graph);
    if (road.both) boost::add_edge(road.to, road.from, RoadEnd{length_m, road.approach}, graph);
  }
  return graph;
}

/// The side by which the shortest road from a place to its neighbour leaves; of equally long ones, the first.
std::uint32_t exit_to(const Graph& graph, std::size_t from, std::size_t to) {
  RoadEnd best{std::numeric_limits<double>::infinity(), 0};
  for (const auto& edge : boost::make_iterator_range(boost::out_edges(from, graph))) {
    if (boost::target(edge, graph) == to && graph[edge].length_m < best.length_m) best = graph[edge];
  }
  return best.exit;
}

/// Extends the mission to `to` by the shortest way. False if there is none.
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

/// The side by which a road reaches a place; nothing if it does not lead there.
std::optional<std::uint32_t> arrives_by(const Road& road, std::uint32_t place) {
  if (road.to == place) return road.approach;
  return road.both && road.from == place ? std::optional(road.exit) : std::nullopt;
}

/// By road, whether a mission needs it: it drives it, or it comes by it to its first landmark. See `trimmed`.
std::vector<bool> needed_roads(const std::vector<Road>& roads, const std::vector<Visit>& visits) {
  const Visit& first = visits.front();
  std::vector<bool> needed(roads.size());
  std::optional<std::size_t> best;
  double straight = -1.0;
  for (std::size_t r = 0; r < roads.size(); ++r) {
    const auto is_driven = [&](const Visit& a, const Visit& b) { return roads[r].leads(a.place, b.place) == a.exit; };
    needed[r] = std::adjacent_find(visits.begin(), visits.end(), is_driven) != visits.end();
    const auto side = arrives_by(roads[r], first.place);
    if (!side) continue;
    const double turn = needed[r] ? kSideCount : sides_apart(*side, first.exit);
    if (turn > straight) straight = turn, best = r;
  }
  if (best) needed[*best] = true;
  return needed;
}

}  // namespace

void take_limits(const Mission& mission, Map& map) {
  for (std::size_t i = 0; i + 1 < mission.visits.size(); ++i) {
    const Visit &from = mission.visits[i], &to = mission.visits[i + 1];
    if (from.limit_m_s == 0.0) continue;
    for (Road& road : map.roads) {
      if (road.leads(from.place, to.place) == from.exit) road.limit_m_s = lower_limit(road.limit_m_s, from.limit_m_s);
    }
  }
}

bool has_way_round(const Map& map, const Mission& mission) {
  std::vector<std::vector<std::pair<std::size_t, std::uint32_t>>> out(map.names.size());   // by place: roads, and where they lead
  for (std::size_t r = 0; r < map.roads.size(); ++r) {
    const Road& road = map.roads[r];
    out[road.from].emplace_back(r, road.to);
    if (road.both) out[road.to].emplace_back(r, road.from);
  }
  const auto& visits = mission.visits;
  for (std::size_t j = 0; j + 1 < visits.size(); ++j) {
    const auto driven = std::find_if(map.roads.begin(), map.roads.end(), [&](const Road& road) { return road.leads(visits[j].place, visits[j + 1].place) == visits[j].exit; });
    const auto closed = static_cast<std::size_t>(driven - map.roads.begin());
    std::vector<bool> goal(out.size()), reached(out.size());
    for (std::size_t t = j + 1; t < visits.size(); ++t) goal[visits[t].place] = true;
    std::vector<std::uint32_t> open;
    const auto reach = [&](std::uint32_t from) {
      for (const auto& [road, to] : out[from]) {
        if (road == closed || reached[to]) continue;
        reached[to] = true;
        open.push_back(to);
      }
    };
    reach(visits[j].place);
    while (!open.empty()) {
      const std::uint32_t at = open.back();
      open.pop_back();
      if (goal[at]) return true;
      reach(at);
    }
  }
  return false;
}

std::pair<Map, Mission> trimmed(const Map& map, const Mission& mission) {
  constexpr std::uint32_t kLeftOut = 0xFFFFFFFFu;
  const std::vector<bool> needed = needed_roads(map.roads, mission.visits);
  std::vector<std::uint32_t> index(map.names.size(), kLeftOut);
  std::pair<Map, Mission> out{{}, mission};
  out.second.alone = true;
  auto& [fewer, same] = out;
  for (const Visit& visit : mission.visits) index[visit.place] = 0;
  for (std::size_t r = 0; r < needed.size(); ++r) {
    if (!needed[r]) continue;
    fewer.roads.push_back(map.roads[r]);
    index[map.roads[r].from] = index[map.roads[r].to] = 0;
  }
  fewer.layout.name = map.layout.name;
  for (std::size_t i = 0; i < index.size(); ++i) {
    if (index[i] == kLeftOut) continue;
    index[i] = static_cast<std::uint32_t>(fewer.names.size());
    fewer.layout.places.push_back(map.layout.places[i]);
    fewer.names.push_back(map.names[i]);
  }
  for (Road& road : fewer.roads) road.from = index[road.from], road.to = index[road.to];
  for (Visit& visit : same.visits) visit.place = index[visit.place];
  return out;
}

namespace {

using Index = std::unordered_map<std::string_view, std::uint32_t>;

/// Landmarks by their names and by all ids of their places. An id goes before an equal name.
Index index_of(const Map& map) {
  Index index;
  for (std::uint32_t i = 0; i < map.names.size(); ++i) index.try_emplace(map.names[i], i);
  for (std::uint32_t i = 0; i < map.names.size(); ++i) {
    const Place& place = map.layout.places[i];
    index.insert_or_assign(place.id, i);
    for (const std::string& id : place.also) index.insert_or_assign(id, i);
  }
  return index;
}

/// The landmark that `stop` names: by its name or id, or by a station that is served nowhere else.
std::optional<std::uint32_t> landmark_of(const std::string& stop, const Layout& layout, const Index& index, diagnostics::Diagnostics& diagnostics) {
  if (const auto found = index.find(stop); found != index.end()) return found->second;
  std::set<std::uint32_t> served;
  for (const Station& station : layout.stations) {
    if (station.id != stop) continue;
    for (const std::string& id : station.places) {
      if (const auto found = index.find(id); found != index.end()) served.insert(found->second);
    }
  }
  if (served.size() == 1) return *served.begin();
  std::vector<std::string_view> known;
  if (served.empty()) {
    for (const Place& place : layout.places) known.push_back(place.id);
    for (const Station& station : layout.stations) known.push_back(station.id);
    diagnostics.report(Kind::kLayoutNoStop, {}, {stop}).suggest(diagnostics::closest(stop, known));
  } else {
    for (const std::uint32_t at : served) known.push_back(layout.places[at].id);
    diagnostics.report(Kind::kLayoutStationOfMany, {}, {stop, fmt::format("`{}`", fmt::join(known, "`, `"))});
  }
  return std::nullopt;
}

}  // namespace

std::optional<Mission> mission_by_stops(const Map& map, std::span<const std::string> stops, diagnostics::Diagnostics& diagnostics) {
  const Index index = index_of(map);
  const Graph graph = graph_of(map);
  Mission mission;
  std::string_view before;
  for (const std::string& stop : stops) {
    const auto place = landmark_of(stop, map.layout, index, diagnostics);
    if (!place) return std::nullopt;
    const bool first = mission.visits.empty(), another_name = !first && mission.visits.back().place == *place && stop != before;
    before = stop;
    if (first) {
      mission.visits.push_back({*place, 0});
    } else if (!another_name && !go_on(graph, *place, mission)) {
      diagnostics.report(Kind::kLayoutNoWay, {}, {map.layout.places[mission.visits.back().place].id, stop});
      return std::nullopt;
    }
  }
  return mission;
}

}  // namespace kb::layout
