// The courses of ways and roads as chains of points. Private to this folder.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/kbc/layout/layout.h"

namespace kb::layout {

constexpr double kOver_m = 0.15;   ///< a road runs over a place that is no farther than this from its middle

/// A length or a speed as maps and layouts have it: rounded to tenths of a millimetre, and never -0.
[[nodiscard]] inline double as_written(double metres) { return std::round(metres * 1e4) / 1e4 + 0.0; }

/// Where along a piece, from 0 to 1, it is nearest to a point, and the distance there.
struct Near { double share = 0.0, distance_m = 0.0; };
[[nodiscard]] Near nearest(Point p, Point a, Point b);

/// From the beginning of a way along its bends to its end.
[[nodiscard]] std::vector<Point> chain_of(Point from, const std::vector<Point>& through, Point to);
[[nodiscard]] std::vector<Point> course_of(const Layout& layout, std::uint32_t from, const std::vector<Point>& through, std::uint32_t to);
[[nodiscard]] std::vector<Point> course_of(const Layout& layout, const Road& road);
/// The chain without bends that make no difference: those at its ends, or on the straight line between others. Its ends stay. Linear.
[[nodiscard]] std::vector<Point> plain(const std::vector<Point>& chain);
/// Its bends alone.
[[nodiscard]] std::vector<Point> bends_of(const std::vector<Point>& chain);

/// Whether a road coincides with a course from place `from`, one end of the road, to the other end: to a millimetre, as curves that are
/// driven there and back differ in their last digits.
[[nodiscard]] bool lies_on(const Layout& layout, const Road& road, std::uint32_t from, const std::vector<Point>& course);
[[nodiscard]] std::vector<Point> reversed(const std::vector<Point>& points);

/// For two chains as returned by plain() that leave their first point in one direction: whether the first departs to the left of the other.
[[nodiscard]] bool parts_to_the_left(std::span<const Point> a, std::span<const Point> b);

}  // namespace kb::layout
