#include "tests/unit/planners/patrols.h"

#include <algorithm>
#include <vector>

#include "planners/shortest.h"

namespace kb::planners::testing {

Cell free_cell(const Grid& grid, Dice& dice) {
  for (;;) {
    const Cell cell{static_cast<std::int32_t>(dice.below(static_cast<std::size_t>(grid.width()))),
                    static_cast<std::int32_t>(dice.below(static_cast<std::size_t>(grid.height())))};
    if (grid.free(cell)) return cell;
  }
}

Movers make_patrols(const Grid& grid, int count, std::uint32_t period, Cell spared, std::uint64_t seed) {
  Dice dice(seed, 77);
  Movers movers(grid, period);
  Astar search(grid);
  for (int made = 0; made < count;) {
    const Cell from = free_cell(grid, dice), to = free_cell(grid, dice);
    const std::vector<Cell> way = search.search(from, to);
    if (way.empty()) continue;
    const std::size_t half = period / 2, phase = dice.below(period);
    std::vector<Cell> route;
    for (std::size_t t = 0; t < period; ++t) {
      const std::size_t at = (t + phase) % period, out = at < half ? at : period - 1 - at;
      route.push_back(way[std::min({out, way.size() - 1, half - 1})]);
    }
    if (route[0] == spared) continue;
    movers.add(route);
    ++made;
  }
  return movers;
}

}  // namespace kb::planners::testing
