#include "compiler/model/planner.h"

#include <algorithm>
#include <boost/graph/breadth_first_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/filtered_graph.hpp>
#include <cmath>
#include <functional>
#include <queue>
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

/// What is to be visited, the nearest first, of equally near ones the one that was found first. A landmark to which a shorter way was found
/// stands in it twice; the second time nothing follows from it.
class Queue {
 public:
  using value_type = std::uint32_t;
  Queue(const std::vector<Length>& far, const bool& found) : far_(far), found_(found) {}
  [[nodiscard]] bool empty() const { return found_ || items_.empty(); }
  [[nodiscard]] std::uint32_t top() const { return items_.top().landmark; }
  void pop() { items_.pop(); }
  void push(std::uint32_t landmark) { items_.push({far_[landmark], number_++, landmark}); }

 private:
  struct Item {
    Length far;
    std::uint32_t number, landmark;
    auto operator<=>(const Item&) const = default;
  };
  const std::vector<Length>& far_;
  const bool& found_;   // claims to be empty once the goal is found
  std::priority_queue<Item, std::vector<Item>, std::greater<>> items_;
  std::uint32_t number_ = 0;
};

/// Dijkstra's algorithm, on Boost's breadth-first search with another queue.
struct Recorder : boost::default_bfs_visitor {
  template <class AnyGraph>
  void examine_vertex(std::uint32_t landmark, const AnyGraph& /*filtered*/) const { *found = landmark == goal; }
  template <class AnyGraph>
  void tree_edge(const Edge& edge, const AnyGraph& /*filtered*/) const {
    reach(edge);   // the search puts it into the queue
  }
  template <class AnyGraph>
  void black_target(const Edge& edge, const AnyGraph& /*filtered*/) const {
    if (far_by(edge) < (*far)[to(edge)]) reach(edge), queue->push(to(edge));
  }
  void reach(const Edge& edge) const {
    (*by)[to(edge)] = (*graph)[edge].directed;
    (*far)[to(edge)] = far_by(edge);
  }
  [[nodiscard]] Length far_by(const Edge& edge) const { return (*far)[boost::source(edge, *graph)] + (*lengths)[(*graph)[edge].directed]; }
  [[nodiscard]] std::uint32_t to(const Edge& edge) const { return static_cast<std::uint32_t>(boost::target(edge, *graph)); }

  const Graph* graph;
  const std::vector<Length>* lengths;   // by directed road
  std::uint32_t goal;
  std::vector<std::uint32_t>* by;
  std::vector<Length>* far;
  Queue* queue;
  bool* found;
};

/// Lengths to a tenth of a millimetre and numbers of roads, in one number. A longer road counts as one of 100 km, so a way of 10,000 such roads fits.
constexpr int kRoadBits = 20;
constexpr double kPerMetre = 1e4, kLongestRoad = 1e9;

Length length_between(const Point& a, const Point& b) {
  return static_cast<Length>(std::llround(std::min(std::hypot(b.x - a.x, b.y - a.y) * kPerMetre, kLongestRoad)));
}

/// By directed road; 1 for the roads of a map of which some landmark has no place.
std::vector<Length> lengths_of_roads(const Draft& draft) {
  std::vector<const Point*> places;
  std::vector<char> whole(draft.model.maps.size(), 1);
  for (const LandmarkInfo& landmark : draft.landmarks) {
    places.push_back(draft.model.point_in(draft.model[landmark.row], "at"));
    if (places.back() == nullptr) whole[landmark.map] = 0;
  }
  std::vector<Length> lengths(draft.roads.size(), 1);
  std::size_t id = 0;
  for (const Map& map : draft.model.maps) {
    for (const MapRoad& bends : map.roads) {
      const DirectedRoad& road = draft.roads[id];
      Length& length = lengths[id++];
      if (whole[draft.landmarks[road.from].map] == 0) continue;
      const Point* at = places[road.from];
      Length sum = 0;
      for (const Point& bend : map.through(bends)) sum += length_between(*std::exchange(at, &bend), bend);
      length += std::min(sum + length_between(*at, *places[road.to]), static_cast<Length>(kLongestRoad)) << kRoadBits;
    }
  }
  return lengths;
}

}  // namespace

struct RoadGraph::Layout {
  Graph graph;
  std::vector<std::uint32_t> from;  // by directed road: where it begins in this graph
  std::vector<Length> lengths;      // by directed road
};

RoadGraph::RoadGraph(const Draft& draft, bool backwards) : layout_(std::make_unique<Layout>()) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  std::vector<RoadProperty> properties;
  edges.reserve(draft.roads.size());
  properties.reserve(draft.roads.size());
  layout_->lengths = lengths_of_roads(draft);
  for (std::uint32_t id = 0; id < draft.roads.size(); ++id) {
    const DirectedRoad& road = draft.roads[id];
    edges.emplace_back(backwards ? road.to : road.from, backwards ? road.from : road.to);
    properties.push_back({id, road.road});
    layout_->from.push_back(edges.back().first);
  }
  layout_->graph = Graph(boost::edges_are_unsorted_multi_pass, edges.begin(), edges.end(), properties.begin(),
                         static_cast<std::uint32_t>(draft.landmarks.size()));
}

Length RoadGraph::length(std::uint32_t road) const { return layout_->lengths[road]; }

RoadGraph::~RoadGraph() = default;

const RoadGraph& road_graph(Draft& draft) {
  if (!draft.graph) draft.graph = std::make_shared<const RoadGraph>(draft);
  return *draft.graph;
}

std::vector<std::uint32_t> roads_towards(const Draft& draft, std::uint32_t goal) {
  const RoadGraph backwards(draft, true);
  RoadSearch search(backwards);
  static_cast<void>(search.shortest(goal, kNone32, {}));   // from no landmark: so it visits all
  std::vector<std::uint32_t> next(draft.landmarks.size(), kNone32);
  for (std::uint32_t landmark = 0; landmark < next.size(); ++landmark) {
    const auto far = search.distance(landmark);
    if (!far || landmark == goal) continue;
    const auto& out = draft.landmarks[landmark].out;
    next[landmark] = *std::find_if(out.begin(), out.end(), [&](std::uint32_t id) {
      const auto rest = search.distance(draft.roads[id].to);
      return rest && *rest + backwards.length(id) == *far;
    });
  }
  return next;
}

RoadSearch::RoadSearch(const RoadGraph& graph)
    : graph_(graph), seen_in_(num_vertices(graph.layout_->graph), 0), by_(seen_in_.size(), kNone32), far_(seen_in_.size(), 0) {}

std::optional<Way> RoadSearch::shortest(std::uint32_t start, std::uint32_t goal, std::span<const std::uint32_t> avoid) {
  start_ = start;
  ++round_;
  if (start == goal) return Way{};
  const Graph& graph = graph_.layout_->graph;
  const boost::filtered_graph<Graph, NotAvoided> open(graph, NotAvoided{&graph, avoid});
  bool found = false;
  far_[start] = 0;
  Queue queue(far_, found);
  boost::breadth_first_visit(open, start, queue, Recorder{{}, &graph, &graph_.layout_->lengths, goal, &by_, &far_, &queue, &found}, SeenMap{&seen_in_, round_});
  return found ? known(goal) : std::nullopt;
}

std::optional<Length> RoadSearch::distance(std::uint32_t landmark) const {
  return seen_in_[landmark] == round_ ? std::optional(far_[landmark]) : std::nullopt;
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
