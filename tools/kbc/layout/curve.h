// Curves of layouts as points. Private to this folder.
#pragma once

#include <utility>
#include <vector>

#include "tools/kbc/layout/layout.h"

namespace kb::layout {

/// A rational B-spline as LIF and VDA 5050 have it: `knots` are points + degree + 1 numbers that do not fall.
struct Spline {
  std::size_t degree = 1;
  std::vector<double> knots;
  std::vector<Point> points;
  std::vector<double> weights;   ///< one for each point, above 0
};

/// Whether it is one.
[[nodiscard]] bool is_sound(const Spline& spline);
/// Points on a sound spline, without its two ends: of a polygon (degree 1) its corners, else three in each of its sections and one
/// between two of them. De Boor's algorithm (The NURBS Book, Piegl and Tiller, A4.1, by repeated interpolation).
[[nodiscard]] std::vector<Point> points_within(const Spline& spline);
/// Where a sound spline begins and ends: not at its first and last point if the knots do not say them often enough.
[[nodiscard]] std::pair<Point, Point> ends_of(const Spline& spline);
/// Bezier curves of the third degree, one after the other; `points` are 3n + 1. Sound.
[[nodiscard]] Spline bezier(std::vector<Point> points);

}  // namespace kb::layout
