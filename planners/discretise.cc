#include "planners/discretise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace kb::planners {
namespace {

// Squared distances of one line to the nearest zero of `line`, which holds squared distances across: the lower envelope of
// the parabolas (x - i)^2 + line[i].
class Envelope {
 public:
  void transform(std::vector<double>& line) {
    const std::size_t n = line.size();
    roots_.assign(n, 0);
    borders_.assign(n + 1, 0.0);
    std::size_t last = 0;
    borders_[0] = -kInfinity;
    borders_[1] = kInfinity;
    for (std::size_t i = 1; i < n; ++i) {
      double cut = crossing(line, roots_[last], i);
      while (last > 0 && cut <= borders_[last]) cut = crossing(line, roots_[--last], i);
      roots_[++last] = i;
      borders_[last] = cut;
      borders_[last + 1] = kInfinity;
    }
    values_.resize(n);
    for (std::size_t i = 0, k = 0; i < n; ++i) {
      while (borders_[k + 1] < static_cast<double>(i)) ++k;
      const double d = static_cast<double>(i) - static_cast<double>(roots_[k]);
      values_[i] = d * d + line[roots_[k]];
    }
    line = values_;
  }

 private:
  static constexpr double kInfinity = std::numeric_limits<double>::infinity();
  static double crossing(const std::vector<double>& line, std::size_t i, std::size_t j) {
    const auto a = static_cast<double>(i), b = static_cast<double>(j);
    return (line[j] + b * b - line[i] - a * a) / (2.0 * (b - a));
  }
  std::vector<std::size_t> roots_;
  std::vector<double> borders_, values_;
};

bool covers(std::span<const Point> corners, Point low, Point high) {
  // Two convex shapes are apart if and only if an edge of one of them has the whole other on its outer side.
  const std::array<Point, 4> box = {low, {high.x, low.y}, high, {low.x, high.y}};
  const auto apart_along = [&](Point axis) {
    const auto range = [&](auto points) {
      double least = std::numeric_limits<double>::infinity(), most = -least;
      for (const Point p : points) {
        least = std::min(least, dot(p, axis));
        most = std::max(most, dot(p, axis));
      }
      return std::pair(least, most);
    };
    const auto [a, b] = range(corners);
    const auto [c, d] = range(std::span<const Point>(box));
    return b <= c || d <= a;
  };
  if (apart_along({1, 0}) || apart_along({0, 1})) return false;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point edge = corners[(i + 1) % corners.size()] - corners[i];
    if (norm(edge) > 0.0 && apart_along({-edge.y, edge.x})) return false;
  }
  return true;
}

template <class Covered>
void block_within(Grid& grid, Point low, Point high, const Covered& covered) {
  const Cell first = grid.cell_at(low), last = grid.cell_at(high);
  for (std::int32_t y = std::max(first.y, 0); y <= std::min(last.y, grid.height() - 1); ++y) {
    for (std::int32_t x = std::max(first.x, 0); x <= std::min(last.x, grid.width() - 1); ++x) {
      const Point corner = grid.centre({x, y}) - Point{0.5 * grid.cell_m(), 0.5 * grid.cell_m()};
      if (covered(corner, corner + Point{grid.cell_m(), grid.cell_m()})) grid.set_blocked({x, y}, true);
    }
  }
}

}  // namespace

std::optional<GridStep> grid_step(double least_dimension_m, double eta) {
  if (!(least_dimension_m > 0.0) || !std::isfinite(least_dimension_m) || !(eta >= 1.0) || !std::isfinite(eta)) {
    return std::nullopt;
  }
  return GridStep{eta * least_dimension_m, eta < 1.1 || eta > 1.5};
}

std::int32_t inflation_cells(double robot_radius_m, double cell_m) {
  const double cells = std::ceil((robot_radius_m - 0.5 * cell_m) / cell_m);
  return cells > 0.0 ? static_cast<std::int32_t>(std::min(cells, 1.0e6)) : 0;
}

std::vector<float> room_of_cells(const Grid& grid) {
  // Between two squares lies a cell less, along each axis, than between their centres: as if the blocked ones were three cells wide.
  Grid wide = grid;
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      if (grid.free({x, y}) && std::any_of(kDirections.begin(), kDirections.end(), [&](Cell step) { return grid.blocked(Cell{x, y} + step); })) {
        wide.set_blocked({x, y}, true);
      }
    }
  }
  // The border has grown into the map, and its distance is that to the cells within it.
  std::vector<float> room = distance_to_blocked(wide);
  for (float& cells : room) cells *= static_cast<float>(grid.cell_m());
  return room;
}

Grid inflate(const Grid& grid, double robot_radius_m, InflationShape shape) {
  Grid grown = grid;
  if (shape == InflationShape::kWhole) {
    if (!(robot_radius_m > 0.0)) return grown;
    const std::vector<float> room = room_of_cells(grid);
    for (CellIndex at = 0; at < grid.size(); ++at) {
      // Single precision; what keeps the radius but for rounding keeps it.
      if (static_cast<double>(room[at]) < robot_radius_m * (1.0 - 1e-6) && grid.all_blocked()[at] == 0) grown.set_blocked(grid.cell(at), true);
    }
    return grown;
  }
  const std::int32_t reach = inflation_cells(robot_radius_m, grid.cell_m());
  if (reach == 0) return grown;
  const double radius = robot_radius_m / grid.cell_m();
  const std::vector<float> distances = distance_to_blocked(grid);
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      if (grid.blocked({x, y}) || distances[grid.index({x, y})] > 1.5f * static_cast<float>(reach) + 2.0f) continue;
      bool hit = false;
      for (std::int32_t dy = -reach; dy <= reach && !hit; ++dy) {
        for (std::int32_t dx = -reach; dx <= reach && !hit; ++dx) {
          if (grid.free({x + dx, y + dy})) continue;
          const double nx = std::max(0.0, std::abs(dx) - 0.5), ny = std::max(0.0, std::abs(dy) - 0.5);
          hit = shape == InflationShape::kSquare || nx * nx + ny * ny < radius * radius;
        }
      }
      if (hit) grown.set_blocked({x, y}, true);
    }
  }
  return grown;
}

void block_polygon(Grid& grid, std::span<const Point> corners) {
  if (grid.empty() || corners.size() < 3) return;
  Point low = corners[0], high = corners[0];
  for (const Point p : corners) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  block_within(grid, low, high, [&](Point a, Point b) { return covers(corners, a, b); });
}

void block_disc(Grid& grid, Point centre, double radius_m) {
  if (grid.empty() || !(radius_m > 0.0)) return;
  const Point reach{radius_m, radius_m};
  block_within(grid, centre - reach, centre + reach, [&](Point a, Point b) {
    const Point nearest{std::clamp(centre.x, a.x, b.x), std::clamp(centre.y, a.y, b.y)};
    return distance(nearest, centre) < radius_m;
  });
}

std::vector<float> distance_to_blocked(const Grid& grid) {
  std::vector<float> out(grid.size(), 0.0f);
  if (grid.empty()) return out;
  const auto columns = static_cast<std::size_t>(grid.width()) + 2, rows = static_cast<std::size_t>(grid.height()) + 2;
  const double far = static_cast<double>(columns + rows) * static_cast<double>(columns + rows);
  std::vector<double> squares(grid.size());
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = grid.all_blocked()[i] != 0 ? 0.0 : far;
  Envelope envelope;
  std::vector<double> line(rows);
  for (std::size_t x = 0; x < columns; ++x) {
    line.resize(rows);
    for (std::size_t y = 0; y < rows; ++y) line[y] = squares[y * columns + x];
    envelope.transform(line);
    for (std::size_t y = 0; y < rows; ++y) squares[y * columns + x] = line[y];
  }
  for (std::size_t y = 0; y < rows; ++y) {
    line.assign(squares.begin() + static_cast<std::ptrdiff_t>(y * columns),
                squares.begin() + static_cast<std::ptrdiff_t>((y + 1) * columns));
    envelope.transform(line);
    for (std::size_t x = 0; x < columns; ++x) out[y * columns + x] = static_cast<float>(std::sqrt(line[x]));
  }
  return out;
}

}  // namespace kb::planners
