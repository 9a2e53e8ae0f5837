#include "compiler/model/planner.h"

#include <algorithm>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <utility>

namespace kb::model {
namespace {

struct RoadProperty { std::uint32_t directed = 0; std::uint32_t road = 0; };
using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, RoadProperty, boost::no_property,
                                                 std::uint32_t, std::uint32_t>;
using Edge = boost::graph_traits<Graph>::edge_descriptor;

struct NotAvoided {
  const Graph* graph = nullptr;
  std::span<const std::uint32_t> avoid;
  bool operator()(const Edge& edge) const {
    return std::find(avoid.begin(), avoid.end(), (*graph)[edge].road) == avoid.end();
  }
};

/// Boost's colours: black if seen in this round, else white. So nothing needs to be cleared between searches.
struct SeenMap {
  using key_type = std::uint32_t;
  using value_type = boost::default_color_type;
  using reference = value_type;
  using category = boost::read_write_property_map_tag;
  std::vector<std::uint32_t>* seen_in;
  std::uint32_t round;
  friend value_type get(const SeenMap& map, std::uint32_t landmark) {
    return (*map.seen_in)[landmark] == map.round ? boost::black_color : boost::white_color;
  }
  friend void put(const SeenMap& map, std::uint32_t landmark, value_type) { (*map.seen_in)[landmark] = map.round; }
};

/// The queue of a search that can end early: it claims to be empty once the goal is found.
struct Queue {
  using value_type = std::uint32_t;
  std::vector<std::uint32_t>* items;
  const bool* found;
  std::size_t head = 0;
  [[nodiscard]] bool empty() const { return *found || head == items->size(); }
  [[nodiscard]] std::uint32_t top() const { return (*items)[head]; }
  void pop() { ++head; }
  void push(std::uint32_t landmark) { items->push_back(landmark); }
};

struct Recorder : boost::default_bfs_visitor {
  Recorder(const Graph& g, std::uint32_t wanted, std::vector<std::uint32_t>& reached_by, bool& at_goal)
      : graph(&g), goal(wanted), by(&reached_by), found(&at_goal) {}
  template <class AnyGraph>
  void tree_edge(const Edge& edge, const AnyGraph& /*filtered*/) const {
    const auto to = static_cast<std::uint32_t>(target(edge, *graph));
    (*by)[to] = (*graph)[edge].directed;
    *found = *found || to == goal;
  }
  const Graph* graph;
  std::uint32_t goal;
  std::vector<std::uint32_t>* by;
  bool* found;
};

}  // namespace

struct RoadGraph::Layout {
  Graph graph;
  std::vector<std::uint32_t> from;  // by directed road
};

RoadGraph::RoadGraph(const Draft& draft) : layout_(std::make_unique<Layout>()) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<RoadProperty> properties;
  edges.reserve(draft.roads.size());
  properties.reserve(draft.roads.size());
  for (std::uint32_t landmark = 0; landmark < draft.landmarks.size(); ++landmark) {
    for (const std::uint32_t id : draft.landmarks[landmark].out) {
      const DirectedRoad& road = draft.roads[id];
      edges.emplace_back(road.from, road.to);
      properties.push_back({id, road.road});
    }
  }
  for (const DirectedRoad& road : draft.roads) layout_->from.push_back(road.from);
  layout_->graph = Graph(boost::edges_are_sorted, edges.begin(), edges.end(), properties.begin(),
                         static_cast<std::uint32_t>(draft.landmarks.size()), static_cast<std::uint32_t>(edges.size()));
}

RoadGraph::~RoadGraph() = default;

const RoadGraph& road_graph(Draft& draft) {
  if (!draft.graph) draft.graph = std::make_shared<const RoadGraph>(draft);
  return *draft.graph;
}

// Of all shortest ways from a landmark, a search that takes roads in order finds the one that leaves by the earliest road, leaves the next
// landmark by its earliest road, and so on. So it is enough to find the earliest such road of each landmark.
std::vector<std::uint32_t> roads_towards(const Draft& draft, std::uint32_t goal) {
  std::vector<std::vector<std::uint32_t>> before(draft.landmarks.size());   // by landmark: those from which a road leads to it
  for (std::uint32_t landmark = 0; landmark < draft.landmarks.size(); ++landmark) {
    for (const std::uint32_t id : draft.landmarks[landmark].out) before[draft.roads[id].to].push_back(landmark);
  }
  std::vector<std::uint32_t> far(draft.landmarks.size(), kNone32), queue{goal};
  far[goal] = 0;
  for (std::size_t head = 0; head < queue.size(); ++head) {
    for (const std::uint32_t landmark : before[queue[head]]) {
      if (far[landmark] != kNone32) continue;
      far[landmark] = far[queue[head]] + 1;
      queue.push_back(landmark);
    }
  }
  std::vector<std::uint32_t> next(draft.landmarks.size(), kNone32);
  for (const std::uint32_t landmark : queue) {
    if (landmark == goal) continue;
    const auto& out = draft.landmarks[landmark].out;
    next[landmark] = *std::find_if(out.begin(), out.end(), [&](std::uint32_t id) { return far[draft.roads[id].to] == far[landmark] - 1; });
  }
  return next;
}

RoadSearch::RoadSearch(const RoadGraph& graph)
    : graph_(graph), seen_in_(num_vertices(graph.layout_->graph), 0), by_(seen_in_.size(), kNone32) {}

std::optional<Way> RoadSearch::shortest(std::uint32_t start, std::uint32_t goal, std::span<const std::uint32_t> avoid) {
  start_ = start;
  ++round_;
  queue_.clear();
  if (start == goal) return Way{};
  const Graph& graph = graph_.layout_->graph;
  const boost::filtered_graph<Graph, NotAvoided> open(graph, NotAvoided{&graph, avoid});
  bool found = false;
  Queue queue{&queue_, &found};
  boost::breadth_first_visit(open, start, queue, Recorder(graph, goal, by_, found), SeenMap{&seen_in_, round_});
  return found ? known(goal) : std::nullopt;
}

std::optional<Way> RoadSearch::known(std::uint32_t goal) const {
  if (goal == start_) return Way{};
  if (seen_in_[goal] != round_) return std::nullopt;
  Way way;
  for (std::uint32_t at = goal; at != start_; at = graph_.layout_->from[by_[at]]) way.push_back(by_[at]);
  std::reverse(way.begin(), way.end());
  return way;
}

}  // namespace kb::model
