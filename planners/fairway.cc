#include "planners/fairway.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "planners/methods.h"
#include "planners/shortest.h"

namespace kb::planners {
namespace {

bool is_over(const Watch* watch) { return watch != nullptr && watch->why() != Stop::kNone; }

// In passes over all cells: a look every 4096 of them.
bool is_stopped_at(CellIndex at, Watch* watch) { return at % 4096 == 0 && is_stopped(watch, 4096); }

// The length of the shortest moves to the nearest blocked cell, at most `cap`, found in two passes over the cells (chamfer).
std::vector<float> chamfer(const Grid& grid, float cap, Watch* watch) {
  std::vector<float> d(grid.size());
  for (std::size_t i = 0; i < d.size(); ++i) d[i] = grid.all_blocked()[i] != 0 ? 0.0f : cap;
  constexpr float kRoot = 1.41421356f;
  const auto first = grid.index({0, 0}), last = grid.index({grid.width() - 1, grid.height() - 1});
  const auto at = [&](CellIndex i, int k) { return d[grid.neighbour(i, static_cast<std::size_t>(k))]; };
  for (CellIndex i = first; i <= last; ++i) {
    if (is_stopped_at(i, watch)) return d;
    if (d[i] == 0.0f) continue;
    d[i] = std::min({d[i], at(i, 4) + 1.0f, at(i, 6) + 1.0f, at(i, 5) + kRoot, at(i, 7) + kRoot});
  }
  for (CellIndex i = last + 1; i-- > first;) {
    if (is_stopped_at(i, watch)) return d;
    if (d[i] == 0.0f) continue;
    d[i] = std::min({d[i], at(i, 0) + 1.0f, at(i, 2) + 1.0f, at(i, 1) + kRoot, at(i, 3) + kRoot});
  }
  return d;
}

std::uint8_t steepest(const Grid& grid, const std::vector<float>& u, CellIndex at) {
  constexpr std::array<float, 8> kPerLength = {1.0f, 0.70710678f, 1.0f, 0.70710678f, 1.0f, 0.70710678f, 1.0f, 0.70710678f};
  const float here = u[at];
  float best = 0.0f;
  unsigned pointer = Basin::kNoPointer;
  for (unsigned open = grid.all_moves()[at]; open != 0; open &= open - 1) {
    const auto k = static_cast<unsigned>(std::countr_zero(open));
    const float slope = (here - u[grid.neighbour(at, k)]) * kPerLength[k];
    const bool steeper = slope > best;   // unpredictable, so computed without a branch
    best = steeper ? slope : best;
    pointer = steeper ? k : pointer;
  }
  return static_cast<std::uint8_t>(pointer);
}

}  // namespace

std::vector<float> cell_potential(const Grid& grid, Cell goal, Watch* watch) {
  constexpr PotentialParameters parameters;
  const auto zone = static_cast<float>(parameters.zone_cells);
  const float k_r = repelling_gain(static_cast<float>(parameters.balance_cells), zone);
  std::vector<float> u = chamfer(grid, zone + 1.0f, watch);
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    if (is_stopped(watch, static_cast<std::size_t>(grid.width()))) return u;
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      float& value = u[grid.index({x, y})];
      if (value == 0.0f) continue;
      const float p = value - 0.5f;   // to the edge of the blocked cell
      const auto dx = static_cast<float>(x - goal.x), dy = static_cast<float>(y - goal.y);
      value = static_cast<float>(parameters.gain) * std::sqrt(dx * dx + dy * dy);
      if (p < zone) value += repelling_potential(k_r, p, zone);
    }
  }
  for (std::size_t i = 0; i < u.size(); ++i) {
    if (grid.all_blocked()[i] != 0) u[i] = std::numeric_limits<float>::infinity();
  }
  return u;
}

Basin find_basin(const Grid& grid, Cell goal, const std::vector<float>& potential, Watch* watch) {
  Basin basin;
  basin.pointer.assign(grid.size(), Basin::kNoPointer);
  basin.rest.assign(grid.size(), std::numeric_limits<float>::infinity());
  if (grid.blocked(goal)) return basin;
  constexpr std::uint8_t kUnknown = 254;
  std::fill(basin.pointer.begin(), basin.pointer.end(), kUnknown);
  const CellIndex end = grid.index(goal);
  basin.pointer[end] = Basin::kNoPointer;
  basin.rest[end] = 0.0f;
  std::vector<CellIndex> open = {end};
  while (!open.empty()) {
    if (is_stopped(watch)) return basin;
    const CellIndex at = open.back();
    open.pop_back();
    ++basin.cells;
    for (unsigned moves = grid.all_moves()[at]; moves != 0; moves &= moves - 1) {
      const auto k = static_cast<std::size_t>(std::countr_zero(moves));
      const CellIndex from = grid.neighbour(at, k);
      // Cells beside the goal all point to it.
      if (basin.pointer[from] == kUnknown) basin.pointer[from] = at == end ? static_cast<std::uint8_t>((k + 4) % 8) : steepest(grid, potential, from);
      if (basin.has(from) || basin.pointer[from] != (k + 4) % 8) continue;
      basin.rest[from] = basin.rest[at] + static_cast<float>(kMoveLengths[k]);
      open.push_back(from);
    }
  }
  for (std::uint8_t& pointer : basin.pointer) {
    if (pointer == kUnknown) pointer = Basin::kNoPointer;
  }
  return basin;
}

Fairway find_fairway(const Grid& grid, Cell start, Cell goal, Watch* watch) {
  Fairway fairway;
  const std::vector<float> potential = cell_potential(grid, goal, watch);
  if (is_over(watch)) return fairway;
  const Basin basin = find_basin(grid, goal, potential, watch);
  fairway.basin_cells = basin.cells;
  if (is_over(watch)) return fairway;
  fairway.cells = shortest_to_entry(grid, start, basin.rest, watch);
  if (fairway.cells.empty()) return fairway;
  fairway.approach = fairway.cells.size() - 1;
  for (CellIndex at = grid.index(fairway.cells.back()); at != grid.index(goal);) {
    at = grid.neighbour(at, basin.pointer[at]);
    fairway.cells.push_back(grid.cell(at));
  }
  return fairway;
}

Result run_fairway(const Problem& problem, const RunOptions& run) {
  const Grid& grid = *problem.grid;
  Watch watch(run);
  const Fairway fairway = find_fairway(grid, problem.start_cell(), problem.goal_cell(), &watch);
  Result result = fairway.cells.empty() ? ended_without_path(watch) : reached(grid, fairway.cells);
  result.statistics.steps = fairway.cells.empty() ? 0 : fairway.cells.size() - 1;
  result.statistics.cells = fairway.basin_cells;
  const double all = static_cast<double>(grid.free_cells());
  result.statistics.more.emplace_back("basin share", static_cast<double>(fairway.basin_cells) / all);
  if (!fairway.cells.empty()) {
    const std::vector<Cell> approach(fairway.cells.begin(),
                                     fairway.cells.begin() + static_cast<std::ptrdiff_t>(fairway.approach) + 1);
    const double share = result.length_m > 0.0 ? reached(grid, approach).length_m / result.length_m : 0.0;
    result.statistics.more.emplace_back("approach share", share);
  }
  return result;
}

Picture draw_fairway(const Problem& problem, const Result&) {
  const Grid& grid = *problem.grid;
  const std::vector<float> potential = cell_potential(grid, problem.goal_cell());
  Picture picture;
  picture.field.assign(potential.begin(), potential.end());
  const Basin basin = find_basin(grid, problem.goal_cell(), potential);
  for (CellIndex at = 0; at < grid.size(); ++at) picture.basin.push_back(basin.has(at) ? 1 : 0);
  const int every = std::max(2, static_cast<int>(std::lround(std::sqrt(static_cast<double>(grid.free_cells()) / 500.0))));
  for (std::int32_t y = every / 2; y < grid.height(); y += every) {
    for (std::int32_t x = every / 2; x < grid.width(); x += every) {
      if (grid.blocked({x, y}) || !basin.has(grid.index({x, y}))) continue;
      std::vector<Cell> line = {{x, y}};
      while (line.back() != problem.goal_cell()) {
        line.push_back(line.back() + kDirections[basin.pointer[grid.index(line.back())]]);
      }
      picture.lines.push_back(centres(grid, line));
    }
  }
  picture.remarks.push_back("shade: potential; green: the basin of the goal; thin: its lines of force");
  return picture;
}

}  // namespace kb::planners
