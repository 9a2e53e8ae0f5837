#include "planners/clearance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

namespace kb::planners {
namespace {

Point nearest_on_segment(Point p, Point a, Point b) {
  const Point along = b - a;
  const double square = dot(along, along);
  const double t = square > 0.0 ? std::clamp(dot(p - a, along) / square, 0.0, 1.0) : 0.0;
  return a + t * along;
}

bool inside(std::span<const Point> corners, Point p) {
  bool in = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Point a = corners[i], b = corners[j];
    if ((a.y > p.y) != (b.y > p.y) && p.x < (b.x - a.x) * (p.y - a.y) / (b.y - a.y) + a.x) in = !in;
  }
  return in;
}

void take(Nearest& best, Point from, Point to) {
  const double d = distance(from, to);
  if (d < best.distance_m) best = {d, to};
}

double distance_of_point(Point p, std::span<const Point> corners) {
  if (inside(corners, p)) return 0.0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    least = std::min(least, distance(p, nearest_on_segment(p, corners[j], corners[i])));
  }
  return least;
}

bool cross_each_other(Point a, Point b, Point c, Point d) {
  const auto splits = [](Point from, Point to, Point p, Point q) {
    return (cross(to - from, p - from) > 0.0) != (cross(to - from, q - from) > 0.0);
  };
  return splits(a, b, c, d) && splits(c, d, a, b);
}

// Of two bodies apart, a corner of one is nearest to the other. A body of two corners is a segment.
double distance_between(std::span<const Point> one, std::span<const Point> other) {
  for (std::size_t i = 0, j = one.size() - 1; i < one.size(); j = i++) {
    for (std::size_t k = 0, l = other.size() - 1; k < other.size(); l = k++) {
      if (cross_each_other(one[j], one[i], other[l], other[k])) return 0.0;
    }
  }
  double least = std::numeric_limits<double>::infinity();
  for (const Point p : one) least = std::min(least, distance_of_point(p, other));
  for (const Point p : other) least = std::min(least, distance_of_point(p, one));
  return least;
}

}  // namespace

GridClearance::GridClearance(const Grid& grid, double reach_m)
    : grid_(&grid), reach_m_(reach_m), reach_cells_(static_cast<std::int32_t>(std::ceil(reach_m / grid.cell_m())) + 1),
      first_(grid.size(), 0), squares_(1) {}

// Collects the squares near a cell when it is first asked for: a drive comes into few cells of a large map, and a time budget, which is
// checked at each step of a drive, would not bound the work for all cells at once.
void GridClearance::collect(Cell cell) const {
  // A square can be nearest to a point of the cell only if its least distance is not above another's greatest.
  double bound = reach_m_ / grid_->cell_m();
  std::vector<std::pair<double, Cell>> seen;
  const auto gap = [](int d) { return std::max(0, std::abs(d) - 1); };
  for (std::int32_t dy = -reach_cells_; dy <= reach_cells_; ++dy) {
    for (std::int32_t dx = -reach_cells_; dx <= reach_cells_; ++dx) {
      const Cell other{cell.x + dx, cell.y + dy};
      // Outside of the map only the cells of its border count; all others are farther away.
      if (other.x < -1 || other.y < -1 || other.x > grid_->width() || other.y > grid_->height()) continue;
      if (grid_->free(other)) continue;
      const double least = std::hypot(gap(dx), gap(dy));
      if (least > bound) continue;
      seen.emplace_back(least, other);
      // The distance from the farthest corner of the cell to this square.
      bound = std::min(bound, std::hypot(std::abs(dx), std::abs(dy)));
    }
  }
  const std::size_t head = squares_.size();
  first_[grid_->index(cell)] = static_cast<std::uint32_t>(head);
  squares_.emplace_back();
  for (const auto& [least, other] : seen) {
    if (least <= bound) squares_.push_back(other);
  }
  squares_[head].x = static_cast<std::int32_t>(squares_.size() - head - 1);
}

Nearest GridClearance::nearest(Point at) const {
  const Cell cell = grid_->cell_at(at);
  if (grid_->blocked(cell)) return {0.0, at};
  Nearest best;
  const double side = grid_->cell_m();
  const std::uint32_t& head = first_[grid_->index(cell)];
  if (head == 0) collect(cell);
  for (const Cell square : std::span(squares_).subspan(head + 1, static_cast<std::size_t>(squares_[head].x))) {
    const Point low{grid_->origin_m().x + square.x * side, grid_->origin_m().y + square.y * side};
    take(best, at, {std::clamp(at.x, low.x, low.x + side), std::clamp(at.y, low.y, low.y + side)});
  }
  return best.distance_m <= reach_m_ ? best : Nearest{};
}

double GridClearance::distance_of(std::span<const Point> body) const {
  Cell low = grid_->cell_at(body.front()), high = low;
  for (const Point corner : body) {
    const Cell cell = grid_->cell_at(corner);
    if (grid_->blocked(cell)) return 0.0;
    low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
    high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
  }
  const double side = grid_->cell_m();
  double least = std::numeric_limits<double>::infinity();
  // Outside of the map only the cells of its border count; all others are farther away.
  for (std::int32_t y = std::max(low.y - reach_cells_, -1); y <= std::min(high.y + reach_cells_, grid_->height()); ++y) {
    for (std::int32_t x = std::max(low.x - reach_cells_, -1); x <= std::min(high.x + reach_cells_, grid_->width()); ++x) {
      if (grid_->free({x, y})) continue;
      const Point at{grid_->origin_m().x + x * side, grid_->origin_m().y + y * side};
      const std::array<Point, 4> square = {at, at + Point{side, 0.0}, at + Point{side, side}, at + Point{0.0, side}};
      least = std::min(least, distance_between(body, square));
    }
  }
  return least <= reach_m_ ? least : std::numeric_limits<double>::infinity();
}

void ShapeClearance::add_disc(Point centre, double radius_m) { discs_.push_back({centre, radius_m}); }
void ShapeClearance::add_segment(Point a, Point b) { segments_.emplace_back(a, b); }
void ShapeClearance::add_polygon(std::vector<Point> corners) { polygons_.push_back(std::move(corners)); }

Nearest ShapeClearance::nearest(Point at) const {
  Nearest best;
  for (const Disc& disc : discs_) {
    const double d = distance(at, disc.centre);
    if (d <= disc.radius_m) return {0.0, at};
    take(best, at, disc.centre + (disc.radius_m / d) * (at - disc.centre));
  }
  for (const auto& [a, b] : segments_) take(best, at, nearest_on_segment(at, a, b));
  for (const auto& corners : polygons_) {
    if (corners.size() < 3) continue;
    if (inside(corners, at)) return {0.0, at};
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      take(best, at, nearest_on_segment(at, corners[j], corners[i]));
    }
  }
  return best;
}

double ShapeClearance::distance_of(std::span<const Point> body) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Disc& disc : discs_) least = std::min(least, std::max(0.0, distance_of_point(disc.centre, body) - disc.radius_m));
  for (const auto& [a, b] : segments_) least = std::min(least, distance_between(body, std::array{a, b}));
  for (const auto& corners : polygons_) {
    if (corners.size() >= 3) least = std::min(least, distance_between(body, corners));
  }
  return least;
}

}  // namespace kb::planners
