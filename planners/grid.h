// The occupancy grid that all planners work on.
//
// Cell (i, j) is the square of side `cell_m` whose centre is origin + ((i + 0.5) cell_m, (j + 0.5) cell_m); j counts up.
// Everything outside the grid is blocked. A robot moves from centre to centre, and a diagonal move also needs both cells beside it
// free: no corner is cut. (This is the rule of the MovingAI benchmarks, so that lengths can be compared with theirs. Darintsev and
// Migranov have moves of length 1 and sqrt(2) and do not mention corners.)
//
// Algorithms that work on all cells use indices. The cells lie row by row, with a blocked border of one cell round them, so every
// neighbour of a free cell has an index.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "planners/geometry.h"

namespace kb::planners {

/// Place of a cell in arrays of `Grid::size()` entries.
using CellIndex = std::uint32_t;

class Grid {
 public:
  /// The most cells in a row or a column; keeps every index within 32 bits.
  static constexpr std::int32_t kMaxSide = 32766;
  /// The most cells in a grid.
  static constexpr std::int64_t kMaxCells = std::int64_t{1} << 28;

  /// A grid without cells.
  Grid() = default;
  /// All cells are free. Sides below 1 or beyond the limits, or a cell size that is not positive and finite, give a grid without cells.
  Grid(std::int32_t width, std::int32_t height, double cell_m = 1.0, Point origin_m = {});

  [[nodiscard]] std::int32_t width() const { return width_; }
  [[nodiscard]] std::int32_t height() const { return height_; }
  [[nodiscard]] double cell_m() const { return cell_m_; }
  [[nodiscard]] Point origin_m() const { return origin_m_; }
  [[nodiscard]] bool empty() const { return width_ == 0; }
  [[nodiscard]] std::size_t free_cells() const { return free_cells_; }

  [[nodiscard]] bool contains(Cell cell) const {
    return cell.x >= 0 && cell.y >= 0 && cell.x < width_ && cell.y < height_;
  }
  [[nodiscard]] bool blocked(Cell cell) const { return !contains(cell) || blocked_[index(cell)] != 0; }
  [[nodiscard]] bool free(Cell cell) const { return !blocked(cell); }
  /// Blocks or frees a cell of the grid, and updates the moves round it. O(1).
  void set_blocked(Cell cell, bool blocked);

  /// Bit k is set if a robot in the cell can move in direction k; 0 for a blocked cell.
  [[nodiscard]] std::uint8_t moves(Cell cell) const { return contains(cell) ? moves_[index(cell)] : std::uint8_t{0}; }
  [[nodiscard]] bool can_move(Cell cell, int direction) const { return (moves(cell) >> direction & 1) != 0; }

  // ---- by index
  /// Number of entries in an array over all cells, including the border.
  [[nodiscard]] std::size_t size() const { return blocked_.size(); }
  [[nodiscard]] CellIndex index(Cell cell) const {
    return static_cast<CellIndex>((cell.y + 1) * stride_ + cell.x + 1);
  }
  [[nodiscard]] Cell cell(CellIndex index) const {
    const auto at = static_cast<std::int32_t>(index);
    return {at % stride_ - 1, at / stride_ - 1};
  }
  [[nodiscard]] std::span<const std::uint8_t> all_moves() const { return moves_; }
  [[nodiscard]] std::span<const std::uint8_t> all_blocked() const { return blocked_; }
  /// For each direction, what to add to an index to go one cell.
  [[nodiscard]] const std::array<std::int32_t, 8>& steps() const { return steps_; }
  /// The cell one move away; `at` must have that neighbour.
  [[nodiscard]] CellIndex neighbour(CellIndex at, std::size_t k) const {
    return static_cast<CellIndex>(static_cast<std::int32_t>(at) + steps_[k]);
  }

  // ---- in the world
  [[nodiscard]] Point centre(Cell cell) const {
    return {origin_m_.x + (cell.x + 0.5) * cell_m_, origin_m_.y + (cell.y + 0.5) * cell_m_};
  }
  /// The cell that holds a point; on the line between two cells, the right or upper one. A point far outside gives some cell outside.
  [[nodiscard]] Cell cell_at(Point point_m) const;
  [[nodiscard]] bool contains(Point point_m) const { return is_finite(point_m) && contains(cell_at(point_m)); }

 private:
  void mend_moves(Cell cell);
  std::int32_t width_ = 0, height_ = 0, stride_ = 0;
  double cell_m_ = 1.0;
  Point origin_m_;
  std::size_t free_cells_ = 0;
  std::array<std::int32_t, 8> steps_{};
  std::vector<std::uint8_t> blocked_, moves_;
};

/// Numbers the connected components of the free cells. Entries by index: 0 for blocked cells, then 1, 2, ... in the order of the
/// components' first cells. O(cells).
[[nodiscard]] std::vector<std::uint32_t> label_components(const Grid& grid);
/// Whether there is a path from one free cell to another. O(cells).
[[nodiscard]] bool is_connected(const Grid& grid, Cell from, Cell to);

}  // namespace kb::planners
