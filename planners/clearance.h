// How far away the nearest obstacle is, and where: what repulsion is made of.
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "planners/grid.h"

namespace kb::planners {

struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();   ///< 0 inside of an obstacle
  Point at;                                                      ///< the nearest point of an obstacle; free if infinite
};

class Clearance {
 public:
  virtual ~Clearance() = default;
  /// The nearest obstacle, if it is within reach; infinitely far otherwise. Ties: the first.
  [[nodiscard]] virtual Nearest nearest(Point at) const = 0;
};

/// Blocked cells as squares, exactly; the outside of the map counts as blocked. For each free cell that was asked of, the squares
/// are kept that can be nearest to some point of it, so that a question looks at two or three of them. Questions write what they
/// keep: no two threads may ask one at the same time.
class GridClearance final : public Clearance {
 public:
  /// Obstacles farther than `reach_m` away are not seen. Four bytes a cell, set to 0, to make; the first question in a cell takes
  /// O(reach^2). The grid must outlive it, and not change.
  GridClearance(const Grid& grid, double reach_m);
  [[nodiscard]] Nearest nearest(Point at) const override;
  [[nodiscard]] const Grid& grid() const { return *grid_; }

 private:
  void collect(Cell cell) const;
  const Grid* grid_;
  double reach_m_;
  std::int32_t reach_cells_;
  // By index: where what is kept of the cell begins in squares_, first their number, as x of a cell, then they; 0: not asked yet.
  mutable std::vector<std::uint32_t> first_;
  mutable std::vector<Cell> squares_;
};

/// Discs, segments and polygons (sphere worlds and star worlds of the paper), exactly.
class ShapeClearance final : public Clearance {
 public:
  void add_disc(Point centre, double radius_m);
  void add_segment(Point a, Point b);
  /// A closed polygon, corners in order; its inside is an obstacle.
  void add_polygon(std::vector<Point> corners);
  [[nodiscard]] Nearest nearest(Point at) const override;

 private:
  struct Disc {
    Point centre;
    double radius_m;
  };
  std::vector<Disc> discs_;
  std::vector<std::pair<Point, Point>> segments_;
  std::vector<std::vector<Point>> polygons_;
};

}  // namespace kb::planners
