// Where the nearest obstacle is and how far away: the input of the repulsion.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "planners/grid.h"

namespace kb::planners {

struct Nearest {
  double distance_m = std::numeric_limits<double>::infinity();   ///< 0 inside an obstacle
  Point at;                                                      ///< the nearest point of an obstacle; meaningless if infinite
};

class Clearance {
 public:
  virtual ~Clearance() = default;
  /// The nearest obstacle if it is within reach, else infinitely far. Of equally near ones, the first.
  [[nodiscard]] virtual Nearest nearest(Point at) const = 0;
  /// Distance of a convex body, with its corners in order, to the nearest obstacle: 0 if they touch or one lies in the other, infinite if
  /// nothing is within reach. O(corners) for each obstacle that may be near; far more than `nearest`.
  [[nodiscard]] virtual double distance_of(std::span<const Point> body) const = 0;
};

/// Blocked cells as exact squares; the outside of the map counts as blocked. The first question in a free cell stores the squares that
/// can be nearest to some point of the cell, so that later questions look at two or three. Since questions write this store, two threads
/// must not ask the same object at the same time.
class GridClearance final : public Clearance {
 public:
  /// Obstacles farther than `reach_m` away are not seen. Construction clears four bytes a cell; the first question in a cell takes
  /// O(reach^2). The grid must outlive the object and must not change.
  GridClearance(const Grid& grid, double reach_m);
  [[nodiscard]] Nearest nearest(Point at) const override;
  [[nodiscard]] double distance_of(std::span<const Point> body) const override;
  [[nodiscard]] const Grid& grid() const { return *grid_; }

 private:
  void collect(Cell cell) const;
  const Grid* grid_;
  double reach_m_;
  std::int32_t reach_cells_;
  // By index: where the cell's entry in squares_ begins: the number of squares, as x of a cell, then the squares; 0: not asked yet.
  mutable std::vector<std::uint32_t> first_;
  mutable std::vector<Cell> squares_;
};

/// Exact discs, segments and polygons (the paper's sphere worlds and star worlds).
class ShapeClearance final : public Clearance {
 public:
  void add_disc(Point centre, double radius_m);
  void add_segment(Point a, Point b);
  /// A closed polygon with its corners in order; its inside is an obstacle.
  void add_polygon(std::vector<Point> corners);
  [[nodiscard]] Nearest nearest(Point at) const override;
  [[nodiscard]] double distance_of(std::span<const Point> body) const override;

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
