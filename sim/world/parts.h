// The steps of lay_out(); not for users.
#pragma once

#include <string>
#include <vector>

#include "sim/world/labyrinth.h"
#include "sim/world/nearby.h"

namespace kb::sim {

/// A map as it was read: arms and roads, nothing scaled yet. Nothing if it cannot be (reported).
[[nodiscard]] std::optional<Labyrinth> read_map(const model::Model& model, double size, diagnostics::Diagnostics& diagnostics);
/// Takes bends beside landmarks away where exits are nearly parallel to others, as far as that sets them apart (told).
void straighten_curves(Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);
/// Sorts the arms of each crossing and says where their stop lines lie; false if exits coincide or lead elsewhere than
/// they say (reported).
[[nodiscard]] bool arrange_arms(Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);
/// Makes everything `scale` times as long and says where each road begins and ends; false if a road is too short (reported).
[[nodiscard]] bool stretch(Labyrinth& labyrinth, const LayoutOptions& options, diagnostics::Diagnostics& diagnostics);
/// Walls of roads, of crossings, of halls with their pillars, of the background.
void build_walls(Labyrinth& labyrinth, const planners::Grid* background);
/// Says how large the floor is.
void find_corners(Labyrinth& labyrinth);
/// Finds where roads cross and no landmark is (told); false if they cannot (reported).
[[nodiscard]] bool cross_roads(Labyrinth& labyrinth, diagnostics::Diagnostics& diagnostics);
/// Lines, stop lines, tags.
void paint_floor(Labyrinth& labyrinth);
/// Reports landmarks and roads that stand in each other's way, and walls that stand on roads.
[[nodiscard]] bool check_room(const Labyrinth& labyrinth, const planners::Grid* background, diagnostics::Diagnostics& diagnostics);

/// Of each road what lies between its stop lines.
using Ways = std::vector<std::vector<Spot>>;
[[nodiscard]] Ways ways_of(const Labyrinth& labyrinth);
[[nodiscard]] std::vector<Bounds> all_bounds_of(const Ways& ways);
/// In the map's metres.
[[nodiscard]] std::string place_text(const Labyrinth& labyrinth, Spot spot);

}  // namespace kb::sim
