// Two knowledge bases by their maps: what is another place or road in one of them, and whether a drive has come there.
#pragma once

#include <string>
#include <vector>

#include "compiler/model/model.h"
#include "tools/kbc/trace/decision_diff.h"

namespace kb::trace {

/// A landmark or road of a map that both have, as it would be written in each; empty where there is none.
struct MapChange {
  std::string map, before, after;
  std::vector<std::string> landmarks;   ///< the landmark, or the ends of the road
  bool reached = false;                 ///< one of them was in view
};

/// By map, landmarks before roads, by name. Maps are the same if they have the same name, and so is what is on them.
[[nodiscard]] std::vector<MapChange> map_changes(const model::Model& before, const model::Model& after);

/// Notes which of the changes a drive reaches, as either side sees it. All must outlive it.
class MapWatch {
 public:
  MapWatch(std::vector<MapChange>& changes, Differ::Side before, Differ::Side after);
  /// After each tick. Cost: two comparisons for each landmark of a change that is not reached yet.
  void look();

 private:
  struct Sight {
    const Engine* engine;
    program::CellId fact;
    float threshold;
    MapChange* change;
  };
  std::vector<Sight> sights_;   // not seen yet
};

/// For people, a line without its end: `map Town: landmark Quay at (6, 5) instead of landmark Quay at (6, 3); the drive does not come there`.
[[nodiscard]] std::string print(const MapChange& change);

}  // namespace kb::trace
