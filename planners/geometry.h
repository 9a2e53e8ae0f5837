// Places, and the eight directions of a move.
//
// In the world's frame x points right and y up, in metres. Angles are in radians, counter-clockwise positive, in (-pi, pi].
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

namespace kb::planners {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kSqrt2 = 1.41421356237309504880;

/// A place in the world, or a vector, in metres.
struct Point {
  double x = 0.0, y = 0.0;
  friend bool operator==(const Point&, const Point&) = default;
  friend Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y}; }
  friend Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y}; }
  friend Point operator*(double s, Point a) { return {s * a.x, s * a.y}; }
};

[[nodiscard]] inline double dot(Point a, Point b) { return a.x * b.x + a.y * b.y; }
/// Positive if `b` lies to the left of `a`.
[[nodiscard]] inline double cross(Point a, Point b) { return a.x * b.y - a.y * b.x; }
[[nodiscard]] inline double norm(Point a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline double distance(Point a, Point b) { return norm(a - b); }
[[nodiscard]] inline bool is_finite(Point a) { return std::isfinite(a.x) && std::isfinite(a.y); }
/// The angle wrapped to (-pi, pi].
[[nodiscard]] inline double wrap_angle(double angle_rad) {
  const double turned = std::remainder(angle_rad, 2.0 * kPi);
  return turned <= -kPi ? turned + 2.0 * kPi : turned;
}

/// Column and row of a cell; (0, 0) is at the lower left.
struct Cell {
  std::int32_t x = 0, y = 0;
  friend bool operator==(const Cell&, const Cell&) = default;
};

/// Direction k points at k * 45 degrees; 0 is along +x. Odd directions are diagonals.
inline constexpr std::array<Cell, 8> kDirections = {{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
/// Length of a move in each direction, in cells: 1 or sqrt(2).
inline constexpr std::array<double, 8> kMoveLengths = {1.0, kSqrt2, 1.0, kSqrt2, 1.0, kSqrt2, 1.0, kSqrt2};

[[nodiscard]] inline Cell operator+(Cell a, Cell b) { return {a.x + b.x, a.y + b.y}; }

/// Length in cells of the shortest path of such moves on a grid without obstacles, which is a lower bound on every grid.
[[nodiscard]] inline double octile_distance(Cell a, Cell b) {
  const double dx = std::abs(static_cast<double>(a.x) - b.x), dy = std::abs(static_cast<double>(a.y) - b.y);
  return dx < dy ? dy + (kSqrt2 - 1.0) * dx : dx + (kSqrt2 - 1.0) * dy;
}

}  // namespace kb::planners
