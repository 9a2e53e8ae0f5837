// The steps of lay_out(); not for users.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "sim/world/labyrinth.h"
#include "sim/world/nearby.h"

namespace kb::sim {

/// The part of each road between its stop lines, and which of these may be near each other.
class Ways {
 public:
  /// The roads must have been stretched.
  explicit Ways(const Labyrinth& labyrinth);

  [[nodiscard]] const std::vector<Spot>& operator[](std::size_t road) const { return chains_[road]; }
  /// Calls `visit(i, j)` for each road i and each j <= i that may come within `within_m` of it, in ascending order of i, then of j.
  template <class Visit>
  void each_pair(double within_m, Visit visit) const {
    for (std::size_t i = 0; i < chains_.size(); ++i) {
      for (const std::uint32_t j : near_.near(bounds_of(chains_[i]), within_m)) {
        if (j <= i) visit(i, std::size_t{j});
      }
    }
  }

 private:
  std::vector<std::vector<Spot>> chains_;
  Nearby near_;
};

/// Adds to a message about two things of different maps that these share a floor.
inline void note_floor(const Labyrinth& labyrinth, std::uint32_t map, std::uint32_t other, diagnostics::Builder& message) {
  if (map != other) message.note(diagnostics::Kind::kSimOneFloor, {}, {labyrinth.maps[map], labyrinth.maps[other]});
}

/// Reads a map: arms and roads, nothing scaled yet. Nothing if that fails (reported).
[[nodiscard]] std::optional<Labyrinth> read_map(const model::Model& model, double size, diagnostics::Diagnostics& diagnostics);
/// Removes bends beside landmarks where exits are nearly parallel to others, as far as that separates them (reported as a warning).
void straighten_curves(Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);
/// Sorts the arms of each crossing and places their stop lines; false if exits coincide or lead elsewhere than named (reported).
[[nodiscard]] bool arrange_arms(Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);
/// Makes everything `scale` times as long and sets where each road begins and ends; false if a road is too short (reported).
[[nodiscard]] bool stretch(Labyrinth& labyrinth, const LayoutOptions& options, diagnostics::Diagnostics& diagnostics);
/// Builds walls: of roads, of crossings, of halls with their pillars, of the background.
void build_walls(Labyrinth& labyrinth, const planners::Grid* background);
/// Finds the extent of the floor.
void find_corners(Labyrinth& labyrinth);
/// Finds where roads cross without a landmark (reported as a warning); false if they cannot (reported as an error).
[[nodiscard]] bool cross_roads(Labyrinth& labyrinth, const Ways& ways, diagnostics::Diagnostics& diagnostics);
/// Makes lines, stop lines and tags.
void paint_floor(Labyrinth& labyrinth);
/// Reports maps whose landmarks stand in each other's way: all maps lie on one floor. One message for each pair of maps.
[[nodiscard]] bool check_maps(const Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);
/// Reports landmarks and roads that stand in each other's way, and walls that stand on roads.
[[nodiscard]] bool check_room(const Labyrinth& labyrinth, const Ways& ways, const planners::Grid* background, diagnostics::Diagnostics& diagnostics);

/// In the map's metres.
[[nodiscard]] std::string place_text(const Labyrinth& labyrinth, Spot spot);

}  // namespace kb::sim
