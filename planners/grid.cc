#include "planners/grid.h"

#include <algorithm>

namespace kb::planners {

Grid::Grid(std::int32_t width, std::int32_t height, double cell_m, Point origin_m) {
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) return;
  if (static_cast<std::int64_t>(width) * height > kMaxCells) return;
  if (!(cell_m > 0.0) || !std::isfinite(cell_m) || !is_finite(origin_m)) return;
  width_ = width;
  height_ = height;
  stride_ = width + 2;
  cell_m_ = cell_m;
  origin_m_ = origin_m;
  free_cells_ = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  for (std::size_t k = 0; k < 8; ++k) steps_[k] = kDirections[k].y * stride_ + kDirections[k].x;
  const std::size_t entries = static_cast<std::size_t>(stride_) * static_cast<std::size_t>(height + 2);
  blocked_.assign(entries, 1);
  moves_.assign(entries, 0);
  for (std::int32_t y = 0; y < height; ++y) {
    const auto row = blocked_.begin() + static_cast<std::ptrdiff_t>(index({0, y}));
    std::fill(row, row + width, std::uint8_t{0});
  }
  for (std::int32_t y = 0; y < height; ++y) {
    for (std::int32_t x = 0; x < width; ++x) mend_moves({x, y});
  }
}

void Grid::mend_moves(Cell cell) {
  if (!contains(cell)) return;
  const CellIndex at = index(cell);
  const auto is_free = [&](std::size_t k) { return blocked_[neighbour(at, k % 8)] == 0; };
  unsigned moves = 0;
  for (std::size_t k = 0; k < 8 && blocked_[at] == 0; ++k) {
    const bool diagonal = k % 2 == 1;
    if (is_free(k) && (!diagonal || (is_free(k - 1) && is_free(k + 1)))) moves |= 1u << k;
  }
  moves_[at] = static_cast<std::uint8_t>(moves);
}

void Grid::set_blocked(Cell cell, bool blocked) {
  if (!contains(cell) || this->blocked(cell) == blocked) return;
  blocked_[index(cell)] = blocked ? 1 : 0;
  free_cells_ = blocked ? free_cells_ - 1 : free_cells_ + 1;
  mend_moves(cell);
  for (const Cell step : kDirections) mend_moves(cell + step);
}

Cell Grid::cell_at(Point point_m) const {
  const auto clamp = [](double value) {
    return static_cast<std::int32_t>(std::clamp(std::floor(value), -1.0e6, 1.0e6));
  };
  return {clamp((point_m.x - origin_m_.x) / cell_m_), clamp((point_m.y - origin_m_.y) / cell_m_)};
}

std::vector<std::uint32_t> label_components(const Grid& grid) {
  std::vector<std::uint32_t> labels(grid.size(), 0);
  std::vector<CellIndex> open;
  std::uint32_t last = 0;
  for (CellIndex first = 0; first < grid.size(); ++first) {
    if (grid.all_blocked()[first] != 0 || labels[first] != 0) continue;
    labels[first] = ++last;
    open.push_back(first);
    while (!open.empty()) {
      const CellIndex at = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < 8; k += 2) {   // straight moves suffice: a legal diagonal can be replaced by two
        if ((grid.all_moves()[at] >> k & 1) == 0) continue;
        const auto to = grid.neighbour(at, k);
        if (labels[to] != 0) continue;
        labels[to] = last;
        open.push_back(to);
      }
    }
  }
  return labels;
}

bool is_connected(const Grid& grid, Cell from, Cell to) {
  const auto labels = label_components(grid);
  return labels[grid.index(from)] == labels[grid.index(to)];
}

}  // namespace kb::planners
