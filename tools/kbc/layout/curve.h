// Curves of layouts as points. Private to this folder.
#pragma once

#include <utility>
#include <vector>

#include "tools/kbc/layout/layout.h"

namespace kb::layout {

/// A rational B-spline as in LIF and VDA 5050: `knots` are points + degree + 1 numbers in ascending order, equal ones allowed.
struct Spline {
  std::size_t degree = 1;
  std::vector<double> knots;
  std::vector<Point> points;
  std::vector<double> weights;   ///< one for each point, above 0
};

/// Whether it is a valid spline.
[[nodiscard]] bool is_sound(const Spline& spline);
/// Points on a sound spline, without its two ends: the corners of a polygon (degree 1), else as many in each section, three to 63, that it is
/// nowhere farther than 6 cm from the straight pieces between them, and one between sections. De Boor's algorithm (The NURBS Book, Piegl and Tiller, A4.1, by repeated interpolation).
[[nodiscard]] std::vector<Point> points_within(const Spline& spline);
/// Where a sound spline begins and ends. That is not at its first and last point if the end knots are not repeated often enough.
[[nodiscard]] std::pair<Point, Point> ends_of(const Spline& spline);
/// Bezier curves of the third degree, one after the other; `points` are 3n + 1. Sound.
[[nodiscard]] Spline bezier(std::vector<Point> points);

}  // namespace kb::layout
