#include "tests/unit/planners/separate_obstacles.h"

#include <random>

namespace kb::planners::testing {
namespace {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  std::int32_t from_to(std::int32_t low, std::int32_t high) {
    return low + static_cast<std::int32_t>(engine_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  std::mt19937_64 engine_;
};

// Whether the cell (i, j) of an obstacle of width w and height h is part of it.
bool belongs(int shape, std::int32_t i, std::int32_t j, std::int32_t w, std::int32_t h) {
  switch (shape) {
    case 0: return true;
    case 1: return i < (w + 1) / 2 || j < (h + 1) / 2;               // an ell
    case 2: return i == 0 || i == w - 1 || j == 0;                   // a cup, open above
    default: {                                                       // a disc
      const double x = (2.0 * i + 1.0 - w) / w, y = (2.0 * j + 1.0 - h) / h;
      return x * x + y * y <= 1.0;
    }
  }
}

bool has_room(const Grid& grid, Cell corner, std::int32_t w, std::int32_t h) {
  for (std::int32_t y = corner.y - 1; y <= corner.y + h; ++y) {
    for (std::int32_t x = corner.x - 1; x <= corner.x + w; ++x) {
      if (grid.blocked({x, y})) return false;
    }
  }
  return true;
}

}  // namespace

ObstacleWorld make_separate_obstacles(const SeparateObstacles& kind, std::uint64_t seed) {
  Dice dice(seed);
  ObstacleWorld world{Grid(kind.side, kind.side), {}, {}, 0};
  for (int tries = 0; tries < 200 * kind.count && world.placed < kind.count; ++tries) {
    const std::int32_t w = dice.from_to(kind.least, kind.most), h = dice.from_to(kind.least, kind.most);
    const Cell corner{dice.from_to(2, kind.side - 3 - w), dice.from_to(2, kind.side - 3 - h)};
    const int shape = dice.from_to(0, 3);
    if (!has_room(world.grid, corner, w, h)) continue;
    for (std::int32_t j = 0; j < h; ++j) {
      for (std::int32_t i = 0; i < w; ++i) {
        if (belongs(shape, i, j, w, h)) world.grid.set_blocked({corner.x + i, corner.y + j}, true);
      }
    }
    ++world.placed;
  }
  do {
    world.start = {dice.from_to(0, kind.side - 1), dice.from_to(0, kind.side - 1)};
    world.goal = {dice.from_to(0, kind.side - 1), dice.from_to(0, kind.side - 1)};
  } while (world.grid.blocked(world.start) || world.grid.blocked(world.goal) ||
           octile_distance(world.start, world.goal) < 0.6 * kind.side);
  return world;
}

}  // namespace kb::planners::testing
