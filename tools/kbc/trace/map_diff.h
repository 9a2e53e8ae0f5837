// Compares the maps of two knowledge bases: which places and roads differ, and whether a drive has come there.
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

/// The changes by map, landmarks before roads, then by name. Maps, landmarks and roads are matched by name.
[[nodiscard]] std::vector<MapChange> map_changes(const model::Model& before, const model::Model& after);

/// Notes which of the changes a drive reaches, as either side sees it. All must outlive it.
class MapWatch {
 public:
  MapWatch(std::vector<MapChange>& changes, DecisionDiffer::Side before, DecisionDiffer::Side after);
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

/// For people, a line without line break: `map Town: landmark Quay at (6, 5) instead of landmark Quay at (6, 3); the drive does not come
/// there`.
[[nodiscard]] std::string print(const MapChange& change);

}  // namespace kb::trace
