#include "planners/room.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace kb::planners {
namespace {

// Replaces the squared distances of a line, measured across it, by those in both directions: the lower envelope of the
// parabolas (x - i)^2 + line[i] (Felzenszwalb and Huttenlocher's distance transform).
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

}  // namespace

std::vector<float> room_of_cells(const Grid& grid) {
  // The gap between two squares is one cell less, along each axis, than the distance of their centres: as if the blocked ones were three
  // cells wide and distances were measured to centres.
  Grid wide = grid;
  for (std::int32_t y = 0; y < grid.height(); ++y) {
    for (std::int32_t x = 0; x < grid.width(); ++x) {
      if (grid.free({x, y}) && std::any_of(kDirections.begin(), kDirections.end(), [&](Cell step) { return grid.blocked(Cell{x, y} + step); })) {
        wide.set_blocked({x, y}, true);
      }
    }
  }
  // The border of the map has grown inwards by this too.
  std::vector<float> room = distance_to_blocked(wide);
  for (float& cells : room) cells *= static_cast<float>(grid.cell_m());
  return room;
}

Grid inflate(const Grid& grid, double robot_radius_m) {
  Grid grown = grid;
  if (!(robot_radius_m > 0.0)) return grown;
  const std::vector<float> room = room_of_cells(grid);
  for (CellIndex at = 0; at < grid.size(); ++at) {
    // `room` is in single precision: a cell that falls short of the radius only by rounding stays free.
    if (static_cast<double>(room[at]) < robot_radius_m * (1.0 - 1e-6) && grid.all_blocked()[at] == 0) grown.set_blocked(grid.cell(at), true);
  }
  return grown;
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
