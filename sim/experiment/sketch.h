// A labyrinth as the experiment makes it up: landmarks, roads, how each road is driven. It becomes the text of a map.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planners/grid.h"
#include "sim/random.h"
#include "sim/recording.h"

namespace kb::sim::experiment {

struct Sketch {
  struct Landmark { std::string name; Spot at; };         ///< in metres of the map
  struct Road {
    std::size_t from = 0, to = 0;                         ///< indexes of landmarks
    char exit = 'N', approach = 'S';                      ///< points of the compass
    std::string method;                                   ///< `mark`, `dist` or `azimuth`
    std::vector<Spot> through;                            ///< its bends
  };
  std::string origin;                                     ///< for people: `5 x 4, slanted`
  std::vector<Landmark> landmarks;
  std::vector<Road> roads;                                ///< all of them both ways
};

struct GridForm {
  int columns = 4, rows = 4;                              ///< crossings of the full grid, a metre apart; [2, 12]
  double roads = 0.75;                                    ///< the share of the full grid's roads that is there
  double bends = 0.4;                                     ///< the share of crossings of two roads that have no landmark
  double slant_m = 0.0;                                   ///< crossings stand so far away from the grid, at most; [0, 0.15]
};

/// A grid from which roads were taken away, as long as all of it hung together; of what is left, what hangs together with its
/// largest crossing. Half of the roads have a marking, the others walls or nothing. Never less than five landmarks.
[[nodiscard]] Sketch sketch_of_grid(const GridForm& form, Random& random);

/// A window of `side` x `side` corridors of a maze: corridors become roads with walls, junctions, dead ends and some of the
/// corners become landmarks. The corridors' width is taken from the map: the shortest run of free cells. Nothing if no window
/// of that size holds eight landmarks that hang together.
[[nodiscard]] std::optional<Sketch> sketch_of_maze(const planners::Grid& maze, int side, Random& random);

/// `map Town { ... }`.
[[nodiscard]] std::string print(const Sketch& sketch);

}  // namespace kb::sim::experiment
