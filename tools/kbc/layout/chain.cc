#include "tools/kbc/layout/chain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace kb::layout {
namespace {

constexpr double kOnLine_m = 1e-6, kWritten_m = 1e-4, kSame_m = 1e-3, kStraight_rad = 1e-6;

/// Whether the points of `a` lie on `b`, in that order.
bool lies_along(std::span<const Point> a, std::span<const Point> b) {
  std::size_t piece = 1;
  double passed_m = 0.0;   // how far along the piece the last point lies
  return std::all_of(a.begin(), a.end(), [&](Point p) {
    for (; piece < b.size(); ++piece, passed_m = 0.0) {
      const Near near = nearest(p, b[piece - 1], b[piece]);
      const double along_m = near.share * distance(b[piece - 1], b[piece]);
      if (near.distance_m > kSame_m || along_m < passed_m - kSame_m) continue;
      passed_m = along_m;
      return true;
    }
    return false;
  });
}

/// By how much the chain turns to the right at its inner point `i`, from -pi to pi.
double turn_at(std::span<const Point> chain, std::size_t i) {
  const auto heading = [&](std::size_t k) { return std::atan2(chain[k + 1].y_m - chain[k].y_m, chain[k + 1].x_m - chain[k].x_m); };
  return std::remainder(heading(i - 1) - heading(i), 2.0 * std::numbers::pi);
}

}  // namespace

Near nearest(Point p, Point a, Point b) {
  const double dx = b.x_m - a.x_m, dy = b.y_m - a.y_m, square = dx * dx + dy * dy;
  const double share = square > 0.0 ? std::clamp(((p.x_m - a.x_m) * dx + (p.y_m - a.y_m) * dy) / square, 0.0, 1.0) : 0.0;
  return {share, distance(p, {std::lerp(a.x_m, b.x_m, share), std::lerp(a.y_m, b.y_m, share)})};
}

std::vector<Point> chain_of(Point from, const std::vector<Point>& through, Point to) {
  std::vector<Point> chain{from};
  chain.insert(chain.end(), through.begin(), through.end());
  chain.push_back(to);
  return chain;
}

std::vector<Point> course_of(const Layout& layout, std::uint32_t from, const std::vector<Point>& through, std::uint32_t to) {
  return chain_of(layout.places[from].at, through, layout.places[to].at);
}

std::vector<Point> course_of(const Layout& layout, const Road& road) { return course_of(layout, road.from, road.through, road.to); }

std::vector<Point> plain(const std::vector<Point>& chain) {
  std::size_t first = 1, last = chain.size() - 1;
  while (first < last && distance(chain[first], chain.front()) <= kOver_m) ++first;
  while (first < last && distance(chain[last - 1], chain.back()) <= kOver_m) --last;
  std::vector<Point> out{chain.front()};
  const auto add = [&](Point next) {
    while (out.size() > 1 && nearest(out.back(), out[out.size() - 2], next).distance_m <= kOnLine_m) out.pop_back();
    out.push_back(next);
  };
  for (std::size_t i = first; i < last; ++i) {
    if (distance(chain[i], out.back()) > kWritten_m) add(chain[i]);   // a map could not tell nearer ones apart
  }
  add(chain.back());
  return out;
}

std::vector<Point> bends_of(const std::vector<Point>& chain) { return {chain.begin() + 1, chain.end() - 1}; }

bool lies_on(const Layout& layout, const Road& road, std::uint32_t from, const std::vector<Point>& course) {
  const std::vector<Point> a = course_of(layout, road), b = road.from == from ? course : reversed(course);
  return lies_along(a, b) && lies_along(b, a);
}

std::vector<Point> reversed(const std::vector<Point>& points) { return {points.rbegin(), points.rend()}; }

bool parts_to_the_left(std::span<const Point> a, std::span<const Point> b) {
  for (std::size_t i = 1; i < a.size() && i < b.size(); ++i) {
    const double ahead_m = distance(a[i - 1], a[i]) - distance(b[i - 1], b[i]);
    const bool a_ends = i + 1 == a.size(), b_ends = i + 1 == b.size();
    if (ahead_m < -kSame_m) return !a_ends && turn_at(a, i) < 0.0;
    if (ahead_m > kSame_m) return !b_ends && turn_at(b, i) > 0.0;
    if (a_ends || b_ends) return false;
    const double difference = turn_at(a, i) - turn_at(b, i);
    if (std::abs(difference) > kStraight_rad) return difference < 0.0;
  }
  return false;
}

}  // namespace kb::layout
