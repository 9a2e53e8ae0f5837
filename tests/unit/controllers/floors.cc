#include <cmath>
#include <numbers>

#include "tests/unit/controllers/plant.h"

namespace mts::plant {
namespace {

std::vector<Point> corners(Point from, const std::vector<Piece>& pieces, double aside) {
  std::vector<Point> points;
  double before = static_cast<double>(pieces.front().heading_rad);
  for (std::size_t i = 0; i <= pieces.size(); ++i) {
    const double after = i < pieces.size() ? static_cast<double>(pieces[i].heading_rad) : before;
    const double half = 0.5 * std::remainder(after - before, 2.0 * std::numbers::pi), middle = before + half;
    points.push_back({from.x - aside / std::cos(half) * std::sin(middle), from.y + aside / std::cos(half) * std::cos(middle)});
    if (i == pieces.size()) break;
    const double length = static_cast<double>(pieces[i].length_m);
    from = {from.x + length * std::cos(after), from.y + length * std::sin(after)};
    before = after;
  }
  return points;
}

void round_corner(std::vector<Point>& out, Point a, Point b, Point c, double radius) {
  const double in = std::atan2(b.y - a.y, b.x - a.x), turn = std::remainder(std::atan2(c.y - b.y, c.x - b.x) - in, 2.0 * std::numbers::pi);
  if (radius < 0.01 || std::fabs(turn) < 1e-6) {
    out.push_back(b);
    return;
  }
  const double tangent = radius * std::tan(0.5 * std::fabs(turn)), side = turn < 0.0 ? -1.0 : 1.0;
  const Point centre{b.x - tangent * std::cos(in) - side * radius * std::sin(in), b.y - tangent * std::sin(in) + side * radius * std::cos(in)};
  constexpr int kParts = 24;
  for (int i = 0; i <= kParts; ++i) {
    const double angle = in + turn * i / kParts - side * 0.5 * std::numbers::pi;
    out.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
}

}  // namespace

std::vector<Point> parallel_line(Point from, const std::vector<Piece>& pieces, double radius, double aside) {
  const std::vector<Point> points = corners(from, pieces, aside);
  std::vector<Point> out{points.front()};
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double turn = std::remainder(static_cast<double>(pieces[i].heading_rad - pieces[i - 1].heading_rad), 2.0 * std::numbers::pi);
    round_corner(out, points[i - 1], points[i], points[i + 1], radius > 0.0 ? radius - (turn < 0.0 ? -aside : aside) : 0.0);
  }
  out.push_back(points.back());
  return out;
}

std::vector<Point> middle_line(Point from, const std::vector<Piece>& pieces, double radius) {
  return parallel_line(from, pieces, radius, 0.0);
}

double left_of(const std::vector<Point>& line, Point p) {
  double nearest = 1e9, side = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) {
    const double far = distance_to({line[i - 1], line[i]}, p);
    if (far >= nearest) continue;
    nearest = far;
    side = (line[i].x - line[i - 1].x) * (p.y - line[i - 1].y) - (line[i].y - line[i - 1].y) * (p.x - line[i - 1].x);
  }
  return side < 0.0 ? -nearest : nearest;
}

Floor crossing_floor(const CrossingPlan& plan) {
  constexpr double kLength = 1.5;
  const double w = 0.5 * plan.width;
  Floor floor;
  for (unsigned i = 0; i < 4; ++i) {
    const double angle = plan.slant_rad + 0.5 * std::numbers::pi * i, c = std::cos(angle), s = std::sin(angle);
    const auto at = [&](double ahead, double left) { return Point{ahead * c - left * s, ahead * s + left * c}; };
    if ((plan.roads >> i & 1u) == 0) {
      if (plan.walls) floor.add_walls({at(w, -w), at(w, w)});
      continue;
    }
    if (plan.lines) floor.add_path({at(0.0, 0.0), at(kLength, 0.0)}, 0.03);
    floor.add_path({at(0.5 * plan.span, -w), at(0.5 * plan.span, w)}, 0.05);
    if (!plan.walls) continue;
    floor.add_walls({at(w, w), at(kLength, w)});
    floor.add_walls({at(w, -w), at(kLength, -w)});
  }
  return floor;
}

}  // namespace mts::plant
