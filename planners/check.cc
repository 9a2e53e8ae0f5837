#include "planners/check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kb::planners {
namespace {

// In cells. Far from the origin of the world, where maps in survey coordinates lie, rounding of places in metres is more than a tiny
// share of a cell.
double tolerance_of(const Grid& grid) {
  constexpr double kLeast = 1e-9, kMost = 1e-3, kRoundings = 4.0 * std::numeric_limits<double>::epsilon();
  const double far_cells = std::max(std::abs(grid.origin_m().x), std::abs(grid.origin_m().y)) / grid.cell_m();
  return std::clamp(kRoundings * far_cells, kLeast, kMost);
}

struct Pieces {
  // The free cells of a piece of the path: one if it runs inside of a cell, up to two if it runs along an edge.
  std::array<Cell, 2> cells{};
  int count = 0;
};

// The cells at a point given in units of cells: one if it lies inside of a cell, two on an edge, four at a corner.
int cells_at(Point p, double tolerance, std::array<Cell, 4>& cells) {
  const auto near = [tolerance](double v, std::array<int, 2>& out) {
    if (std::abs(v - std::round(v)) <= tolerance) {
      out = {static_cast<int>(std::round(v)) - 1, static_cast<int>(std::round(v))};
      return 2;
    }
    out[0] = static_cast<int>(std::floor(v));
    return 1;
  };
  std::array<int, 2> xs{}, ys{};
  const int nx = near(p.x, xs), ny = near(p.y, ys);
  int count = 0;
  for (int i = 0; i < nx; ++i) {
    for (int j = 0; j < ny; ++j) {
      cells[static_cast<std::size_t>(count++)] = {xs[static_cast<std::size_t>(i)], ys[static_cast<std::size_t>(j)]};
    }
  }
  return count;
}

// Walks along a path given in units of cells. Every piece between two lines of the grid lies in one cell, or along one edge. A piece without
// length, which may lie on the corner of four cells, touches nothing that its ends do not touch.
class PathWalker {
 public:
  PathWalker(const Grid& grid, Touch touch) : grid_(grid), touch_(touch), tolerance_(tolerance_of(grid)) {}

  // What is wrong with the piece from `a` to `b`; empty if nothing is.
  std::string_view walk(Point a, Point b) {
    cuts_.clear();
    add_cuts(a.x, b.x);
    add_cuts(a.y, b.y);
    cuts_.push_back(1.0);
    std::sort(cuts_.begin(), cuts_.end());
    double from = 0.0;
    const double length = distance(a, b);
    if (const auto fault = pass_point(a); !fault.empty()) return fault;
    for (const double to : cuts_) {
      if ((to - from) * length > tolerance_) {
        if (const auto fault = pass_piece(a + 0.5 * (from + to) * (b - a)); !fault.empty()) return fault;
      }
      if (const auto fault = pass_point(a + to * (b - a)); !fault.empty()) return fault;
      from = to;
    }
    return {};
  }

 private:
  void add_cuts(double from, double to) {
    if (std::abs(to - from) <= tolerance_) return;
    const double low = std::min(from, to), high = std::max(from, to);
    for (double line = std::ceil(low); line <= high; line += 1.0) {
      const double t = (line - from) / (to - from);
      if (t > 0.0 && t < 1.0) cuts_.push_back(t);
    }
  }

  std::string_view pass_piece(Point middle) {
    std::array<Cell, 4> cells{};
    const int count = cells_at(middle, tolerance_, cells);
    Pieces free;
    for (int i = 0; i < count; ++i) {
      const Cell cell = cells[static_cast<std::size_t>(i)];
      if (grid_.free(cell) && free.count < 2) free.cells[static_cast<std::size_t>(free.count++)] = cell;
    }
    if (free.count == 0 || (touch_ == Touch::kApart && free.count < count)) return "it crosses a blocked cell";
    if (pinched_ && before_.count > 0 && !share(before_, free)) return "it slips between two cells that touch at a corner";
    before_ = free;
    pinched_ = false;
    return {};
  }

  std::string_view pass_point(Point at) {
    std::array<Cell, 4> cells{};
    const int count = cells_at(at, tolerance_, cells);
    int blocked = 0;
    for (int i = 0; i < count; ++i) blocked += grid_.blocked(cells[static_cast<std::size_t>(i)]) ? 1 : 0;
    if (touch_ == Touch::kApart && blocked > 0) return count == 4 ? "it cuts a corner" : "it touches a blocked cell";
    if (blocked == count) return "it crosses a blocked cell";
    if (count == 4 && blocked == 2 && grid_.blocked(cells[0]) == grid_.blocked(cells[3])) pinched_ = true;
    return {};
  }

  static bool share(const Pieces& a, const Pieces& b) {
    for (int i = 0; i < a.count; ++i) {
      for (int j = 0; j < b.count; ++j) {
        if (a.cells[static_cast<std::size_t>(i)] == b.cells[static_cast<std::size_t>(j)]) return true;
      }
    }
    return false;
  }

  const Grid& grid_;
  Touch touch_;
  double tolerance_;
  std::vector<double> cuts_;
  Pieces before_;
  bool pinched_ = false;
};

}  // namespace

std::optional<Objection> check_path(const Grid& grid, const std::vector<Point>& path, Touch touch) {
  if (path.empty()) return Objection{"it has no points", 0};
  const double tolerance = tolerance_of(grid);
  const auto in_cells = [&](Point p) { return (1.0 / grid.cell_m()) * (p - grid.origin_m()); };
  for (std::size_t i = 0; i < path.size(); ++i) {
    if (!is_finite(path[i])) return Objection{"a coordinate is no finite number", i};
    const Point p = in_cells(path[i]);
    if (p.x < -tolerance || p.y < -tolerance || p.x > grid.width() + tolerance || p.y > grid.height() + tolerance) {
      return Objection{"it leaves the map", i};
    }
  }
  PathWalker walker(grid, touch);
  if (path.size() == 1) {
    const auto fault = walker.walk(in_cells(path[0]), in_cells(path[0]));
    return fault.empty() ? std::nullopt : std::optional(Objection{fault, 0});
  }
  for (std::size_t i = 1; i < path.size(); ++i) {
    const auto fault = walker.walk(in_cells(path[i - 1]), in_cells(path[i]));
    if (!fault.empty()) return Objection{fault, i - 1};
  }
  return std::nullopt;
}

std::optional<Objection> check_path(const Grid& grid, const std::vector<Point>& path, Touch touch, Point start, Point goal,
                                    double tolerance_m) {
  if (path.empty()) return Objection{"it has no points", 0};
  if (!(distance(path.front(), start) <= tolerance_m)) return Objection{"it does not begin at the start", 0};
  if (!(distance(path.back(), goal) <= tolerance_m)) return Objection{"it does not end at the goal", path.size() - 1};
  return check_path(grid, path, touch);
}

std::optional<Objection> check_walk(const Grid& grid, const Movers* movers, const std::vector<Cell>& cells) {
  if (cells.empty()) return Objection{"it has no points", 0};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (grid.blocked(cells[i])) return Objection{"it crosses a blocked cell", i};
    if (movers != nullptr && movers->taken(cells[i], i)) return Objection{"it meets a moving obstacle", i};
    if (i == 0) continue;
    const Cell from = cells[i - 1], to = cells[i];
    const Cell side{from.x, to.y}, other{to.x, from.y};
    if (std::abs(to.x - from.x) > 1 || std::abs(to.y - from.y) > 1) return Objection{"it jumps", i - 1};
    if (grid.blocked(side) || grid.blocked(other)) return Objection{"it cuts a corner", i - 1};
    if (movers != nullptr && movers->swaps(from, to, i - 1)) return Objection{"it changes places with a moving obstacle", i - 1};
  }
  return std::nullopt;
}

}  // namespace kb::planners
