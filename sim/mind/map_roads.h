// The roads of a floor as `mts::Pilot` and `mts::Lookout` know them: what `kbc compile --map` gives to a C++ program.
#pragma once

#include <map>
#include <string_view>
#include <utility>
#include <vector>

#include <waymark/controllers/road_map.h>
#include "sim/world/labyrinth.h"

namespace kb::sim {

/// Speed limits are not among what they say: see note [where a limit holds] in speed_limits.h.
class MapRoads {
 public:
  /// `labyrinth` must outlive it. O(n log n).
  explicit MapRoads(const Labyrinth& labyrinth);
  MapRoads(const MapRoads&) = delete;   // roads point into it

  /// The road that leaves a landmark by one of its sides, as it lies, whether or not it may be driven so; null if there is none. O(log n).
  [[nodiscard]] const mts::MapRoad* find(std::string_view landmark, std::string_view exit) const;
  /// Which road of the labyrinth it is, and the end where it begins.
  [[nodiscard]] const Labyrinth::End& end_of(const mts::MapRoad& road) const { return ends_[static_cast<std::size_t>(&road - roads_.data())]; }

 private:
  void add(const Labyrinth& labyrinth, CrossingId crossing, const Arm& arm);

  std::vector<std::vector<mts::Piece>> courses_;
  std::vector<Labyrinth::End> ends_;
  std::vector<mts::MapRoad> roads_;   // all in the same order
  std::map<std::pair<std::string_view, std::string_view>, std::size_t> by_end_;
};

}  // namespace kb::sim
