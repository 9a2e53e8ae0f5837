#include "tests/unit/controllers/plant.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace mts::plant {

double distance_to(const Segment& s, Point p) {
  const double dx = s.to.x - s.from.x, dy = s.to.y - s.from.y, length2 = dx * dx + dy * dy;
  const double t = length2 > 0.0 ? std::clamp(((p.x - s.from.x) * dx + (p.y - s.from.y) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p.x - s.from.x - t * dx, p.y - s.from.y - t * dy);
}

void Floor::add_path(const std::vector<Point>& points, double width) {
  for (std::size_t i = 1; i < points.size(); ++i) paint.push_back({{points[i - 1], points[i]}, width});
}
void Floor::add_walls(const std::vector<Point>& points) {
  for (std::size_t i = 1; i < points.size(); ++i) walls.push_back({points[i - 1], points[i]});
}
void Floor::add_box(Point low, Point high) {
  add_walls({low, {high.x, low.y}, high, {low.x, high.y}, low});
}

Noise noise_of_level(int level) {
  constexpr double kDeg = std::numbers::pi / 180.0;
  if (level == 0) return {};
  if (level == 1) return {0.03, 0.005, 1.0 * kDeg, 0.5 * kDeg, 0.005, 0.01, 0.01, 0.01};
  return {0.10, 0.02, 3.0 * kDeg, 2.0 * kDeg, 0.02, 0.02, 0.03, 0.02};
}

Plant::Plant(Floor floor, const Noise& noise, std::uint64_t seed)
    : floor_(std::move(floor)), noise_(noise), dice_(seed) {
  left_scale_ = 1.0 + uniform(noise.wheel_scale);
  right_scale_ = left_scale_ + uniform(0.2 * noise.wheel_scale);   // wheels of one robot resemble each other
  bias_ = uniform(noise.compass_bias_rad);
  slip_ = 1.0 + uniform(noise.slip);
}

// The distributions of the standard library differ between implementations; these do not.
double Plant::uniform(double half) { return half * (2.0 * static_cast<double>(dice_() >> 11) * 0x1p-53 - 1.0); }
double Plant::normal(double sigma) {
  double sum = 0.0;
  for (int i = 0; i < 12; ++i) sum += uniform(0.5);
  return sigma * sum;
}

void Plant::place(double new_x, double new_y, double heading_rad) {
  x = new_x;
  y = new_y;
  heading = heading_rad;
  odo_x_ = odo_y_ = odo_turned_ = 0.0;
  left_m_s = right_m_s = 0.0;
  history_.clear();
  history_.push_back({t_, x, y, heading, 0.0, 0.0, 0.0, 0.0});
}

void Plant::drive(const Motion& motion, double dt_s) {
  constexpr double kStep = 0.001, kLag = 0.05;
  const double top = static_cast<double>(body.top_speed_m_s), base = static_cast<double>(body.wheel_base_m);
  const double most = static_cast<double>(body.top_acceleration_m_s2) * kStep;
  const double want_v = static_cast<double>(motion.speed_m_s), want_w = static_cast<double>(motion.turn_rad_s);
  const double want_left = std::clamp(slip_ * (want_v - 0.5 * want_w * base), -top, top);
  const double want_right = std::clamp(want_v + 0.5 * want_w * base, -top, top);
  const int steps = static_cast<int>(std::lround(dt_s / kStep));
  for (int i = 0; i < steps; ++i) {
    left_m_s += std::clamp((want_left - left_m_s) * kStep / kLag, -most, most);
    right_m_s += std::clamp((want_right - right_m_s) * kStep / kLag, -most, most);
    const double v = 0.5 * (left_m_s + right_m_s), w = (right_m_s - left_m_s) / base;
    x += v * kStep * std::cos(heading);
    y += v * kStep * std::sin(heading);
    heading = std::remainder(heading + w * kStep, 2.0 * std::numbers::pi);
    const double odo_left = left_m_s * left_scale_, odo_right = right_m_s * right_scale_;
    odo_turned_ += (odo_right - odo_left) / base * kStep;
    const double odo_v = 0.5 * (odo_left + odo_right);
    odo_x_ += odo_v * kStep * std::cos(odo_turned_);
    odo_y_ += odo_v * kStep * std::sin(odo_turned_);
    t_ += kStep;
    history_.push_back({t_, x, y, heading, odo_x_, odo_y_, odo_turned_, odo_v});
    for (const Segment& wall : floor_.walls) nearest_m = std::min(nearest_m, distance_to(wall, {x, y}) - static_cast<double>(body.radius_m));
  }
  touched = touched || nearest_m < 0.0;
}

Plant::Moment Plant::past() const {
  const std::size_t back = static_cast<std::size_t>(std::lround(noise_.delay_s / 0.001));
  return history_[history_.size() > back ? history_.size() - 1 - back : 0];
}

Point Plant::row() const {
  const double ahead = static_cast<double>(body.line_ahead_m);
  return {x + ahead * std::cos(heading), y + ahead * std::sin(heading)};
}

double Plant::range(const Moment& at, double angle) const {
  const double cx = std::cos(at.heading + angle), cy = std::sin(at.heading + angle);
  double nearest = static_cast<double>(out_of_range_m(body));
  for (const Segment& wall : floor_.walls) {
    const double ex = wall.to.x - wall.from.x, ey = wall.to.y - wall.from.y;
    const double det = cx * ey - cy * ex;
    if (std::fabs(det) < 1e-12) continue;
    const double fx = wall.from.x - at.x, fy = wall.from.y - at.y;
    const double along = (fx * ey - fy * ex) / det, part = (fx * cy - fy * cx) / det;
    if (along >= 0.0 && part >= 0.0 && part <= 1.0) nearest = std::min(nearest, along);
  }
  return nearest;
}

// A spot of 1 cm sees the edge of a stroke fade in.
double Plant::darkness(Point p) const {
  double dark = 0.0;
  for (const Stroke& stroke : floor_.paint) {
    dark = std::max(dark, std::clamp(0.5 + (0.5 * stroke.width - distance_to(stroke.along, p)) / 0.01, 0.0, 1.0));
  }
  return dark;
}

Senses Plant::sense() {
  const Moment at = past();
  Senses senses;
  for (std::size_t i = 0; i < kLineSensors; ++i) {
    const double ahead = static_cast<double>(body.line_ahead_m), left = static_cast<double>(body.line_sensor_left_m(i));
    const Point spot{at.x + ahead * std::cos(at.heading) - left * std::sin(at.heading),
                     at.y + ahead * std::sin(at.heading) + left * std::cos(at.heading)};
    senses.line[i] = static_cast<float>(std::clamp(darkness(spot) + normal(noise_.line), 0.0, 1.0));
  }
  for (std::size_t i = 0; i < kRangeFinders; ++i) {
    const double seen = range(at, static_cast<double>(range_finder_rad(i)));
    senses.range_m[i] = static_cast<float>(std::clamp(seen + normal(noise_.range_m), 0.0, static_cast<double>(out_of_range_m(body))));
  }
  senses.heading_rad = static_cast<float>(std::remainder(at.heading + bias_ + normal(noise_.compass_rad), 2.0 * std::numbers::pi));
  senses.x_m = static_cast<float>(at.odo_x);
  senses.y_m = static_cast<float>(at.odo_y);
  senses.turned_rad = static_cast<float>(at.odo_turned);
  senses.speed_m_s = static_cast<float>(at.speed + normal(noise_.speed_m_s));
  senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
  senses.touched = touched;
  return senses;
}

}  // namespace mts::plant
