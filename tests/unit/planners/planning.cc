#include "tests/unit/planners/planning.h"

#include <functional>
#include <queue>
#include <random>
#include <stdexcept>

#include "compiler/diagnostics/consumers.h"
#include "planners/shortest.h"

namespace kb::planners::testing {

Grid draw(const std::vector<std::string_view>& rows) {
  const auto height = static_cast<std::int32_t>(rows.size());
  Grid grid(static_cast<std::int32_t>(rows.at(0).size()), height);
  for (std::int32_t row = 0; row < height; ++row) {
    const std::string_view text = rows[static_cast<std::size_t>(row)];
    for (std::size_t x = 0; x < text.size(); ++x) {
      grid.set_blocked({static_cast<std::int32_t>(x), height - 1 - row}, text[x] == '#');
    }
  }
  return grid;
}

Cell find(const std::vector<std::string_view>& rows, char letter) {
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const std::size_t x = rows[row].find(letter);
    if (x != std::string_view::npos) {
      return {static_cast<std::int32_t>(x), static_cast<std::int32_t>(rows.size() - 1 - row)};
    }
  }
  throw std::invalid_argument("no such letter in the drawing");
}

Grid random_grid(std::int32_t width, std::int32_t height, double share, std::uint64_t seed) {
  std::mt19937_64 dice(seed);
  Grid grid(width, height);
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x < width; ++x) {
      grid.set_blocked({x, y}, static_cast<double>(dice() >> 11) * 0x1p-53 < share);
    }
  }
  return grid;
}

Problem problem_between(const Grid& grid, Cell start, Cell goal) {
  Problem problem;
  problem.grid = &grid;
  problem.start = grid.centre(start);
  problem.goal = grid.centre(goal);
  return problem;
}

Benchmark load_benchmark(const std::string& map, const std::vector<std::string>& scenarios) {
  const std::string folder = KB_PROJECT_ROOT "/data/movingai/";
  const source::RealFileSystem files;
  source::Sources sources;
  diagnostics::CountingConsumer consumer;
  diagnostics::Diagnostics messages(sources, consumer);
  auto read = read_map(folder + map, files, sources, messages);
  if (!read) throw std::runtime_error("cannot read " + map);
  Benchmark benchmark{map.substr(0, map.find('.')), std::move(read->grid), {}};
  for (const std::string& name : scenarios) {
    const auto file = diagnostics::open_file(folder + name, files, sources, messages);
    auto rows = file ? read_scenarios(*file, benchmark.grid, messages) : std::nullopt;
    if (!rows) throw std::runtime_error("cannot read " + name);
    benchmark.scenarios.insert(benchmark.scenarios.end(), rows->begin(), rows->end());
  }
  return benchmark;
}

const std::vector<Benchmark>& benchmarks() {
  static const std::vector<Benchmark> all = {
      load_benchmark("arena.map", {"arena.map.scen"}),
      load_benchmark("den312d.map", {"den312d.map.scen"}),
      load_benchmark("maze-32-32-2.map", {"maze-32-32-2-even-1.scen", "maze-32-32-2-random-1.scen"}),
      load_benchmark("random-32-32-10.map", {"random-32-32-10-random-1.scen"}),
  };
  return all;
}

std::vector<Cell> cells_of(const Grid& grid, const Result& result) {
  std::vector<Cell> cells;
  for (const Point p : result.path) cells.push_back(grid.cell_at(p));
  return cells;
}

std::vector<double> plain_distances(const Grid& grid, Cell from) {
  std::vector<double> distance(grid.size(), kUnreached);
  using Entry = std::pair<double, CellIndex>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  distance[grid.index(from)] = 0.0;
  open.emplace(0.0, grid.index(from));
  while (!open.empty()) {
    const auto [d, at] = open.top();
    open.pop();
    if (d > distance[at]) continue;
    const Cell here = grid.cell(at);
    for (int k = 0; k < 8; ++k) {
      const Cell step = kDirections[static_cast<std::size_t>(k)], to = here + step;
      if (grid.blocked(to) || grid.blocked({here.x, to.y}) || grid.blocked({to.x, here.y})) continue;
      const double next = d + (k % 2 == 1 ? kSqrt2 : 1.0);
      if (next < distance[grid.index(to)]) {
        distance[grid.index(to)] = next;
        open.emplace(next, grid.index(to));
      }
    }
  }
  return distance;
}

}  // namespace kb::planners::testing
