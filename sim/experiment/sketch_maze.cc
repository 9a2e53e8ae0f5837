// Makes a labyrinth of a window of a maze.
#include <fmt/format.h>

#include <algorithm>

#include "sim/experiment/lattice.h"

namespace kb::sim::experiment {
namespace {

constexpr std::size_t kLandmarksOfAWindow = 8;
constexpr int kWindows = 200;         // how many are tried
constexpr std::size_t kMostBends = 5; // of a road: a controller can take eight pieces
constexpr float kPlainCorners = 0.5f;

/// The width of the corridors: the shortest run of free cells in all rows and columns. And the least x and the least y of a free cell.
struct Corridors { std::int32_t width = 0, x = 0, y = 0; };
Corridors corridors_of(const planners::Grid& maze) {
  Corridors found;
  found.width = std::max(maze.width(), maze.height());
  const auto look = [&](std::int32_t length, std::int32_t across, bool upright) {
    std::int32_t run = 0;
    for (std::int32_t i = 0; i <= length; ++i) {
      const planners::Cell cell = upright ? planners::Cell{across, i} : planners::Cell{i, across};
      if (maze.free(cell)) {
        ++run;
        continue;
      }
      if (run > 0) found.width = std::min(found.width, run);
      run = 0;
    }
  };
  for (std::int32_t x = 0; x < maze.width(); ++x) look(maze.height(), x, true);
  for (std::int32_t y = 0; y < maze.height(); ++y) look(maze.width(), y, false);
  found.x = maze.width();
  found.y = maze.height();
  for (std::int32_t y = 0; y < maze.height(); ++y) {
    for (std::int32_t x = 0; x < maze.width(); ++x) {
      if (!maze.free({x, y})) continue;
      found.x = std::min(found.x, x);
      found.y = std::min(found.y, y);
    }
  }
  return found;
}

/// The whole maze: a node for each square as wide as the corridors. The walls between them are one cell thick.
Lattice lattice_of(const planners::Grid& maze, const Corridors& corridors) {
  const std::int32_t step = corridors.width + 1;
  Lattice lattice((maze.width() - corridors.x + 1) / step, (maze.height() - corridors.y + 1) / step);
  for (int node = 0; node < lattice.size(); ++node) {
    const std::int32_t x = corridors.x + node % lattice.columns() * step, y = corridors.y + node / lattice.columns() * step;
    bool north = true, east = true;
    for (std::int32_t i = 0; i < corridors.width; ++i) {
      for (std::int32_t k = 0; k <= corridors.width; ++k) {
        north = north && maze.free({x + i, y + k});
        east = east && maze.free({x + k, y + i});
      }
    }
    if (north) lattice.set_road(node, 0, true);
    if (east) lattice.set_road(node, 1, true);
  }
  return lattice;
}

Lattice window_of(const Lattice& maze, int column, int row, int side) {
  Lattice window(side, side);
  for (int node = 0; node < window.size(); ++node) {
    const int there = maze.node(column + node % side, row + node / side);
    for (const int to : {0, 1}) {
      if (window.beside(node, to) >= 0 && maze.road(there, to)) window.set_road(node, to, true);
    }
  }
  return window;
}

}  // namespace

std::optional<Sketch> sketch_of_maze(const planners::Grid& maze, int side, Random& random) {
  const Lattice whole = lattice_of(maze, corridors_of(maze));
  if (whole.columns() < side || whole.rows() < side) return std::nullopt;
  for (int tried = 0; tried < kWindows; ++tried) {
    const int column = static_cast<int>(random.next() % static_cast<std::uint64_t>(whole.columns() - side + 1));
    const int row = static_cast<int>(random.next() % static_cast<std::uint64_t>(whole.rows() - side + 1));
    const Lattice window = window_of(whole, column, row, side);
    SketchRules rules;
    rules.methods = {"dist"};
    std::size_t most = 0;
    int hub = 0;
    for (int node = 0; node < window.size(); ++node) {
      rules.plain.push_back(window.degree(node) == 2 && (window.straight(node) || random.chance(kPlainCorners)));
      rules.place.push_back({static_cast<double>(node % side), static_cast<double>(node / side)});
      const std::size_t size = window.part_of(node).size();
      if (size <= most) continue;
      most = size;
      hub = node;
    }
    Sketch sketch = sketch_of(window, hub, rules, random);
    const bool unfit = std::any_of(sketch.roads.begin(), sketch.roads.end(), [](const auto& road) { return road.through.size() > kMostBends || road.from == road.to; });
    if (unfit || sketch.landmarks.size() < kLandmarksOfAWindow) continue;
    sketch.origin = fmt::format("maze, corridors {} to {} and {} to {}", column, column + side - 1, row, row + side - 1);
    return sketch;
  }
  return std::nullopt;
}

}  // namespace kb::sim::experiment
