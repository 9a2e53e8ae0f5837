#include "tools/kbc/layout/curve.h"

#include <algorithm>
#include <cmath>

#include "tools/kbc/layout/chain.h"

namespace kb::layout {
namespace {

// A road lies so near to its curve: well within what a place may be beside it (kOver_m). Half of that would make the first piece of a turn with
// a radius of 3 m too short for a stop line, and so the whole floor larger.
constexpr double kOff_m = 0.06;
constexpr int kFewest = 4, kMost = 64;   // pieces of a section
constexpr int kLooks = 8;                // at a piece, for its distance from the curve

struct Weighted {
  double x, y, w;
};

// In [knots[k], knots[k + 1]), which is not empty.
Point at(const Spline& s, std::size_t k, double u) {
  std::vector<Weighted> d;
  for (std::size_t i = k - s.degree; i <= k; ++i) d.push_back({s.points[i].x_m * s.weights[i], s.points[i].y_m * s.weights[i], s.weights[i]});
  for (std::size_t r = 1; r <= s.degree; ++r) {
    for (std::size_t j = s.degree; j >= r; --j) {
      const std::size_t i = k - s.degree + j;
      const double a = (u - s.knots[i]) / (s.knots[i + s.degree - r + 1] - s.knots[i]);
      d[j] = {std::lerp(d[j - 1].x, d[j].x, a), std::lerp(d[j - 1].y, d[j].y, a), std::lerp(d[j - 1].w, d[j].w, a)};
    }
  }
  const Weighted& end = d[s.degree];
  return {end.x / end.w, end.y / end.w};
}

/// Whether the section in [knots[k], knots[k + 1]) is that near to so many pieces, equally long by its parameter.
bool is_near(const Spline& s, std::size_t k, int pieces) {
  const auto point = [&](int i) { return at(s, k, std::lerp(s.knots[k], s.knots[k + 1], static_cast<double>(i) / (pieces * kLooks))); };
  for (int piece = 0; piece < pieces; ++piece) {
    const Point a = point(piece * kLooks), b = point((piece + 1) * kLooks);
    for (int i = 1; i < kLooks; ++i) {
      if (nearest(point(piece * kLooks + i), a, b).distance_m > kOff_m) return false;
    }
  }
  return true;
}

int pieces_of(const Spline& s, std::size_t k) {
  if (s.degree == 1) return 1;
  int pieces = kFewest;
  while (pieces < kMost && !is_near(s, k, pieces)) ++pieces;
  return pieces;
}

}  // namespace

bool is_sound(const Spline& s) {
  return s.degree >= 1 && s.degree <= 16 && s.points.size() > s.degree && s.weights.size() == s.points.size() &&
         s.knots.size() == s.points.size() + s.degree + 1 && std::is_sorted(s.knots.begin(), s.knots.end()) &&
         s.knots[s.degree] < s.knots[s.points.size()] &&
         std::all_of(s.weights.begin(), s.weights.end(), [](double w) { return w > 0.0; });
}

std::vector<Point> points_within(const Spline& s) {
  std::vector<Point> out;
  for (std::size_t k = s.degree; k < s.points.size(); ++k) {
    const double from = s.knots[k], to = s.knots[k + 1];
    if (!(from < to)) continue;
    const int first = out.empty() && k == s.degree ? 1 : 0;   // the first point of all is an end
    const int pieces = pieces_of(s, k);
    for (int i = first; i < pieces; ++i) out.push_back(at(s, k, from + (to - from) * i / pieces));
  }
  return out;
}

std::pair<Point, Point> ends_of(const Spline& s) {
  std::size_t first = s.degree, last = s.points.size() - 1;
  while (!(s.knots[first] < s.knots[first + 1])) ++first;
  while (!(s.knots[last] < s.knots[last + 1])) --last;
  return {at(s, first, s.knots[first]), at(s, last, s.knots[last + 1])};
}

Spline bezier(std::vector<Point> points) {
  Spline s{3, {}, std::move(points), {}};
  s.weights.assign(s.points.size(), 1.0);
  const std::size_t sections = (s.points.size() - 1) / 3;
  for (std::size_t i = 0; i <= sections; ++i) {
    const std::size_t times = i == 0 || i == sections ? 4 : 3;
    s.knots.insert(s.knots.end(), times, static_cast<double>(i));
  }
  return s;
}

}  // namespace kb::layout
