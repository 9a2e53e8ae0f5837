// Shortest ways over the roads of the maps: in metres where all landmarks of the map have places, those with the fewest roads elsewhere.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "compiler/model/draft.h"

namespace kb::model {

/// How long a way is, in units of no meaning but that more is longer. Of two ways of the same length, to a tenth of a millimetre, the one of
/// fewer roads is shorter.
using Length = std::uint64_t;

/// All landmarks and roads, laid out for search (a compressed Boost.Graph). Built in O(landmarks + roads).
class RoadGraph {
 public:
  /// `backwards`: each road leads from where it ends to where it begins.
  explicit RoadGraph(const Draft& draft, bool backwards = false);
  ~RoadGraph();
  RoadGraph(const RoadGraph&) = delete;
  RoadGraph& operator=(const RoadGraph&) = delete;

  /// Of a directed road, with its bends.
  [[nodiscard]] Length length(std::uint32_t road) const;

 private:
  friend class RoadSearch;
  struct Layout;
  std::unique_ptr<Layout> layout_;
};

/// The graph of all maps; built when it is first asked for.
[[nodiscard]] const RoadGraph& road_graph(Draft& draft);

/// A way: directed roads in order.
using Way = std::vector<std::uint32_t>;

/// By landmark: the first road of a shortest way to `goal`, of several the one that is declared first; kNone32 at the goal itself and at
/// landmarks from which no way leads there. One search for all landmarks: O(roads log roads).
[[nodiscard]] std::vector<std::uint32_t> roads_towards(const Draft& draft, std::uint32_t goal);

/// One search at a time; keeps its memory between searches, so that a search costs only what it visits.
class RoadSearch {
 public:
  explicit RoadSearch(const RoadGraph& graph);

  /// A shortest way from `start` to `goal` that takes no road of `avoid` (in either direction); empty if they are the
  /// same landmark, nothing if there is none. Stops at the goal. Of several, the one that is found first when roads are taken in order of
  /// declaration.
  [[nodiscard]] std::optional<Way> shortest(std::uint32_t start, std::uint32_t goal, std::span<const std::uint32_t> avoid);
  /// The way to another goal after `shortest` found none: its search has then visited all that can be reached from the start.
  [[nodiscard]] std::optional<Way> known(std::uint32_t goal) const;
  /// How far `landmark` is from the start, after a search that did not find its goal; nothing if no way leads there.
  [[nodiscard]] std::optional<Length> distance(std::uint32_t landmark) const;

 private:
  const RoadGraph& graph_;
  std::uint32_t start_ = kNone32;
  std::uint32_t round_ = 0;
  std::vector<std::uint32_t> seen_in_;  // by landmark: the round that last saw it
  std::vector<std::uint32_t> by_;       // by landmark: the road that it was reached by
  std::vector<Length> far_;             // by landmark: how far it is from the start
};

}  // namespace kb::model
