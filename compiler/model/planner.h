// Shortest ways over the roads of the maps: those with the fewest roads. Of several, the one that breadth-first search finds first
// when it takes roads in order of declaration.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compiler/model/draft.h"

namespace kb::model {

/// All landmarks and roads, laid out for search (a compressed Boost.Graph). Built in O(landmarks + roads).
class RoadGraph {
 public:
  explicit RoadGraph(const Draft& draft);
  ~RoadGraph();
  RoadGraph(const RoadGraph&) = delete;
  RoadGraph& operator=(const RoadGraph&) = delete;

 private:
  friend class RoadSearch;
  struct Layout;
  std::unique_ptr<Layout> layout_;
};

/// The graph of all maps; built when it is first asked for.
[[nodiscard]] const RoadGraph& road_graph(Draft& draft);

/// A way: directed roads in order.
using Way = std::vector<std::uint32_t>;

/// By landmark: the first road of its shortest way to `goal`, the one that `RoadSearch::shortest` takes with nothing to avoid; kNone32
/// at the goal itself and at landmarks from which no way leads there. One search for all landmarks: O(landmarks + roads).
[[nodiscard]] std::vector<std::uint32_t> roads_towards(const Draft& draft, std::uint32_t goal);

/// One search at a time; keeps its memory between searches, so that a search costs only what it visits.
class RoadSearch {
 public:
  explicit RoadSearch(const RoadGraph& graph);

  /// The shortest way from `start` to `goal` that takes no road of `avoid` (in either direction); empty if they are the
  /// same landmark, nothing if there is none. Stops at the goal.
  [[nodiscard]] std::optional<Way> shortest(std::uint32_t start, std::uint32_t goal, std::span<const std::uint32_t> avoid);
  /// The way to another goal after `shortest` found none: its search has then visited all that can be reached from the start.
  [[nodiscard]] std::optional<Way> known(std::uint32_t goal) const;

 private:
  const RoadGraph& graph_;
  std::uint32_t start_ = kNone32;
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> seen_in_;  // by landmark: the round that last saw it
  std::vector<std::uint32_t> by_;       // by landmark: the road that it was reached by
  std::vector<std::uint32_t> queue_;
};

}  // namespace kb::model
