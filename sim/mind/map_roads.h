// The map as `kbc compile --map` gives it to a C++ program: the roads that legs lead along, each in one direction.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <waymark/controllers/road_map.h>
#include "compiler/model/model.h"
#include "compiler/program/program.h"

namespace kb::sim {

class MapRoads {
 public:
  /// `metre`: how long a metre of the map is on the floor. Without places in the map there are no roads. O(n log n).
  MapRoads(const model::Model& model, double metre);
  MapRoads(const MapRoads&) = delete;   // roads point into it

  /// The road that leaves a landmark by one of its sides; null if no leg leads along it. O(roads).
  [[nodiscard]] const mts::MapRoad* find(const char* from, const char* exit) const;
  /// The road of the first leg that is `high`; null if there is none, or on the way to the first landmark of a route. O(legs).
  [[nodiscard]] const mts::MapRoad* of_leg(const std::function<bool(program::CellId)>& high) const;

 private:
  struct Owned {
    std::string from, exit, to, approach, by;
    std::vector<mts::Piece> course;
  };
  struct LegOn { program::CellId leg{}; std::size_t road = 0; };

  std::vector<Owned> owned_;
  std::vector<mts::MapRoad> roads_;   // in the same order
  std::vector<LegOn> legs_;
};

}  // namespace kb::sim
