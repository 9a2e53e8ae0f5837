// Points and straight pieces on the floor. Metres; angles counter-clockwise from east, in radians.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "sim/recording.h"

namespace kb::sim {

inline constexpr double kPi = std::numbers::pi;

[[nodiscard]] constexpr Spot operator+(Spot a, Spot b) { return {a.x_m + b.x_m, a.y_m + b.y_m}; }
[[nodiscard]] constexpr Spot operator-(Spot a, Spot b) { return {a.x_m - b.x_m, a.y_m - b.y_m}; }
[[nodiscard]] constexpr Spot operator*(double k, Spot a) { return {k * a.x_m, k * a.y_m}; }
[[nodiscard]] constexpr double dot(Spot a, Spot b) { return a.x_m * b.x_m + a.y_m * b.y_m; }
/// Positive if `b` lies counter-clockwise of `a`.
[[nodiscard]] constexpr double cross(Spot a, Spot b) { return a.x_m * b.y_m - a.y_m * b.x_m; }
/// A quarter turn counter-clockwise: to the left.
[[nodiscard]] constexpr Spot left_of(Spot a) { return {-a.y_m, a.x_m}; }
[[nodiscard]] inline double length(Spot a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline double distance(Spot a, Spot b) { return length(b - a); }
[[nodiscard]] inline double heading(Spot a) { return std::atan2(a.y_m, a.x_m); }
[[nodiscard]] inline Spot direction(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad)}; }
/// The same angle in (-pi, pi].
[[nodiscard]] inline double wrap(double angle_rad) {
  const double turns = std::floor((kPi - angle_rad) / (2.0 * kPi));
  return angle_rad + turns * 2.0 * kPi;
}

/// The point of the piece from `a` to `b` that is nearest to `p`: how far along it lies (0 at `a`, 1 at `b`), and its distance.
struct Nearest { double along = 0.0, distance_m = 0.0; };
[[nodiscard]] inline Nearest nearest_on(Spot a, Spot b, Spot p) {
  const Spot d = b - a;
  const double square = dot(d, d);
  const double along = square > 0.0 ? std::clamp(dot(p - a, d) / square, 0.0, 1.0) : 0.0;
  return {along, distance(a + along * d, p)};
}

/// Where two pieces cross or touch, as shares of the length of each. Nothing if their directions differ by less than 1e-9 rad: that is
/// rounding between parallel ones.
struct Meeting { double along_a = 0.0, along_b = 0.0; Spot at; };
[[nodiscard]] inline std::optional<Meeting> meet(Spot a0, Spot a1, Spot b0, Spot b1) {
  const Spot a = a1 - a0, b = b1 - b0;
  const double det = cross(a, b);
  if (std::abs(det) <= 1e-9 * length(a) * length(b)) return std::nullopt;
  const double along_a = cross(b0 - a0, b) / det, along_b = cross(b0 - a0, a) / det;
  if (along_a < 0.0 || along_a > 1.0 || along_b < 0.0 || along_b > 1.0) return std::nullopt;
  return Meeting{along_a, along_b, a0 + along_a * a};
}

/// A point of the second piece that is nearest to the first.
[[nodiscard]] inline Spot nearest_of(Spot a0, Spot a1, Spot b0, Spot b1) {
  if (const auto meeting = meet(a0, a1, b0, b1)) return meeting->at;
  Spot best = b0;
  const auto take = [&](Spot spot) {
    if (nearest_on(a0, a1, spot).distance_m < nearest_on(a0, a1, best).distance_m) best = spot;
  };
  take(b1);
  for (const Spot end : {a0, a1}) take(b0 + nearest_on(b0, b1, end).along * (b1 - b0));
  return best;
}

/// The smallest distance between two pieces, 0 if they meet.
[[nodiscard]] inline double gap_between(Spot a0, Spot a1, Spot b0, Spot b1) {
  if (meet(a0, a1, b0, b1)) return 0.0;
  return std::min({nearest_on(a0, a1, b0).distance_m, nearest_on(a0, a1, b1).distance_m,
                   nearest_on(b0, b1, a0).distance_m, nearest_on(b0, b1, a1).distance_m});
}

/// The length of a chain of pieces.
[[nodiscard]] inline double length_of(const std::vector<Spot>& chain) {
  double sum = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) sum += distance(chain[i - 1], chain[i]);
  return sum;
}

/// The point `along_m` from the beginning of a chain, and the heading there; beyond an end, that end.
struct OnChain { Spot at; double heading_rad = 0.0; };
[[nodiscard]] inline OnChain point_on(const std::vector<Spot>& chain, double along_m) {
  double rest = std::max(along_m, 0.0);
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Spot piece = chain[i] - chain[i - 1];
    const double long_m = length(piece);
    if (rest <= long_m || i + 1 == chain.size()) {
      const double share = long_m > 0.0 ? std::min(rest / long_m, 1.0) : 0.0;
      return {chain[i - 1] + share * piece, heading(piece)};
    }
    rest -= long_m;
  }
  return {chain.empty() ? Spot{} : chain.front(), 0.0};
}

/// The part of a chain between two distances from its beginning.
[[nodiscard]] inline std::vector<Spot> part_of(const std::vector<Spot>& chain, double from_m, double to_m) {
  std::vector<Spot> part{point_on(chain, from_m).at};
  double passed = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    passed += distance(chain[i - 1], chain[i]);
    if (passed > from_m + 1e-9 && passed < to_m - 1e-9) part.push_back(chain[i]);
  }
  part.push_back(point_on(chain, to_m).at);
  return part;
}

/// The same chain (at least one point, and no two equal neighbours) with its corners rounded to arcs, as far as its pieces have room.
[[nodiscard]] inline std::vector<Spot> rounded(const std::vector<Spot>& chain, double bend_radius_m) {
  constexpr double kArcStep = kPi / 12.0;
  std::vector<Spot> out{chain.front()};
  for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
    const Spot in = chain[i] - chain[i - 1], next = chain[i + 1] - chain[i];
    const double bend = wrap(heading(next) - heading(in));
    const double room_m = 0.45 * std::min(length(in), length(next));
    const double cut_m = std::min(bend_radius_m * std::tan(0.5 * std::abs(bend)), room_m);
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(bend) / kArcStep)));
    const Spot begin = chain[i] - (cut_m / length(in)) * in;
    if (std::abs(bend) < 1e-6) continue;
    const double radius_m = cut_m / std::tan(0.5 * std::abs(bend));
    const double side = bend > 0.0 ? 1.0 : -1.0;
    const Spot centre = begin + (side * radius_m) * left_of(direction(heading(in)));
    for (int k = 0; k <= steps; ++k) {
      const double angle = heading(in) - side * kPi / 2.0 + bend * k / steps;
      out.push_back(centre + radius_m * direction(angle));
    }
  }
  out.push_back(chain.back());
  return out;
}

/// How far along a chain its point nearest to `p` lies, and how far away that is.
struct Along { double along_m = 0.0, distance_m = 0.0; };
[[nodiscard]] inline Along nearest_along(const std::vector<Spot>& chain, Spot p) {
  Along best{0.0, chain.empty() ? 0.0 : distance(chain.front(), p)};
  double passed = 0.0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const Nearest near = nearest_on(chain[i - 1], chain[i], p);
    const double piece_m = distance(chain[i - 1], chain[i]);
    if (near.distance_m < best.distance_m) best = {passed + near.along * piece_m, near.distance_m};
    passed += piece_m;
  }
  return best;
}

}  // namespace kb::sim
