// The courses of ways and roads, as chains of points. Private to this folder.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "tools/kbc/layout/layout.h"

namespace kb::layout {

constexpr double kOver_m = 0.15;   ///< a place is not farther from the middle of a road that runs over it

/// Where a piece is nearest to a point, from 0 to 1, and how far that is.
struct Near { double share = 0.0, distance_m = 0.0; };
[[nodiscard]] Near nearest(Point p, Point a, Point b);

/// From the place where a way begins to the one where it ends, as its bends lead.
[[nodiscard]] std::vector<Point> chain_of(Point from, const std::vector<Point>& through, Point to);
[[nodiscard]] std::vector<Point> course_of(const Layout& layout, std::uint32_t from, const std::vector<Point>& through, std::uint32_t to);
[[nodiscard]] std::vector<Point> course_of(const Layout& layout, const Road& road);
/// Without what says nothing of where it leads: bends that lie at its ends, or on the straight way between others. Its ends stay. Linear.
[[nodiscard]] std::vector<Point> plain(const std::vector<Point>& chain);
/// Its bends alone.
[[nodiscard]] std::vector<Point> bends_of(const std::vector<Point>& chain);

/// Whether chains lie on each other, to a millimetre: curves that are driven there and back differ in their last digits.
[[nodiscard]] bool same_ground(std::span<const Point> a, std::span<const Point> b);
/// Whether a road lies where a course leads that begins at place `from`, one end of it, and ends at the other.
[[nodiscard]] bool lies_on(const Layout& layout, const Road& road, std::uint32_t from, const std::vector<Point>& course);
[[nodiscard]] std::vector<Point> reversed(const std::vector<Point>& points);

/// Of two chains that leave their first point in one direction, as plain() has them: whether the first parts to the left of the other.
[[nodiscard]] bool parts_to_the_left(std::span<const Point> a, std::span<const Point> b);

}  // namespace kb::layout
