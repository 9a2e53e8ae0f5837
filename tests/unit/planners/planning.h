// Worlds for the tests of planners: drawn, random, and from data/movingai.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planners/maps/maps.h"
#include "planners/method.h"

namespace kb::planners::testing {

/// A grid from rows of `.` and `#`, the topmost first; letters are free cells that `find` finds.
[[nodiscard]] Grid draw(const std::vector<std::string_view>& rows);
[[nodiscard]] Cell find(const std::vector<std::string_view>& rows, char letter);

/// The direction from a cell to one of its eight neighbours; -1 if `to` is not one of them.
[[nodiscard]] constexpr int direction_between(Cell from, Cell to) {
  for (int k = 0; k < 8; ++k) {
    const Cell step = kDirections[static_cast<std::size_t>(k)];
    if (from.x + step.x == to.x && from.y + step.y == to.y) return k;
  }
  return -1;
}

/// Each cell blocked with the chance `share`.
[[nodiscard]] Grid random_grid(std::int32_t width, std::int32_t height, double share, std::uint64_t seed);

/// A free cell, drawn by `dice()`, which gives whole numbers from 0.
template <class Dice>
[[nodiscard]] Cell random_free_cell(const Grid& grid, Dice& dice) {
  for (;;) {
    const Cell cell{static_cast<std::int32_t>(dice() % static_cast<std::uint64_t>(grid.width())),
                    static_cast<std::int32_t>(dice() % static_cast<std::uint64_t>(grid.height()))};
    if (grid.free(cell)) return cell;
  }
}

/// Centre to centre.
[[nodiscard]] Problem problem_between(const Grid& grid, Cell start, Cell goal);

struct Benchmark {
  std::string name;
  Grid grid;
  std::vector<Scenario> scenarios;
};
/// A map of data/movingai with its scenarios. Throws if it cannot be read.
[[nodiscard]] Benchmark load_benchmark(const std::string& map, const std::vector<std::string>& scenarios);
/// All four maps with all their scenarios; read once.
[[nodiscard]] const std::vector<Benchmark>& benchmarks();

/// The cells of a path that goes from centre to centre.
[[nodiscard]] std::vector<Cell> cells_of(const Grid& grid, const Result& result);

/// Octile distances from one cell by the plainest Dijkstra there is.
[[nodiscard]] std::vector<double> plain_distances(const Grid& grid, Cell from);

}  // namespace kb::planners::testing
