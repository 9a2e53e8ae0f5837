// Random labyrinths and routes, written as `.kb` text.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/world/dice.h"
#include "tests/world/map.h"

namespace kb::world {

/// A connected map of 3 to 25 landmarks L1, L2, ... on a grid: bends, T-junctions, crosses, dead ends, roads that bend
/// without a landmark, loops, parallel roads, one-way roads, and all three methods.
[[nodiscard]] Map random_map(Dice& dice);

/// The map as declarations (`map M { ... }`).
[[nodiscard]] std::string map_text(const Map& map);

/// A walk over the map. It may visit a landmark again, take a loop, and turn back.
struct RandomRoute {
  EdgeId start{};                  ///< the robot begins on this edge ...
  std::vector<EdgeId> edges;       ///< ... and then drives these: at least one
};
[[nodiscard]] RandomRoute random_route(Dice& dice, const Map& map);

/// `command Go1` and `route R1 on M by Go1: L4 -> L2.N -> ...`; exits are named where two roads lead to the next stop.
[[nodiscard]] std::string route_text(const Map& map, const RandomRoute& route, int number);
/// What World::way_text says when the route was driven.
[[nodiscard]] std::string way_of(const Map& map, const RandomRoute& route);

}  // namespace kb::world
