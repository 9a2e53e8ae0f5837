#include "compiler/fuzzy/certainty.h"

#include <algorithm>
#include <cmath>

namespace kb::fuzzy {
namespace {

/// The distance, in spreads, at which a Gaussian has fallen to `level`.
double reach(double level) { return level >= 1.0 ? 0.0 : std::sqrt(-2.0 * std::log(level)); }

/// The level in (0, 1) up to which `holds` is true; above it, it must be false.
template <class Holds>
double highest(Holds holds) {
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 60; ++i) {
    const double level = 0.5 * (low + high);
    (holds(level) ? low : high) = level;
  }
  return low;
}

/// The numbers with mu(x) >= level, level in (0, 1], from `low` to `high`, which may be infinite. A circle is laid
/// out straight as the shape is written. Not for bells and sigmoids.
struct Cut { double low = 0.0, high = 0.0; };
Cut cut(const Shape& shape, double level) {
  const auto& p = shape.p;
  switch (shape.kind) {
    case ShapeKind::kTriangle: return {p[0] + (p[1] - p[0]) * level, p[2] - (p[2] - p[1]) * level};
    case ShapeKind::kTrapezoid: return {p[0] + (p[1] - p[0]) * level, p[3] - (p[3] - p[2]) * level};
    case ShapeKind::kGaussian: {
      const double g = reach(level);
      return {g == 0.0 ? p[0] : p[0] - p[2] * g, g == 0.0 ? p[1] : p[1] + p[3] * g};
    }
    case ShapeKind::kRamp: {
      const double at = p[0] + (p[1] - p[0]) * level;
      return p[0] <= p[1] ? Cut{at, kInfinity} : Cut{-kInfinity, at};
    }
    case ShapeKind::kSingleton: return {p[0], p[0]};
    case ShapeKind::kBell:
    case ShapeKind::kSigmoid: break;
  }
  return {-kInfinity, kInfinity};
}

// The fit on a line.
Fit straight_fit(const Shape& shape, double d, double spread) {
  Fit fit;
  fit.possibility = highest([&](double level) {
    const Cut c = cut(shape, level);
    const double r = spread * reach(level);
    return d + r >= c.low && d - r <= c.high;
  });
  fit.necessity = highest([&](double level) {
    const Cut c = cut(shape, level);
    const double r = spread * reach(1.0 - level);
    return d - r >= c.low && d + r <= c.high;
  });
  return fit;
}

}  // namespace

Fit fit(const Shape& shape, double value, double spread) {
  if (!(spread > 0.0)) {
    const double exact = mu(shape, value);
    return {exact, exact};
  }
  if (!shape.circular()) return straight_fit(shape, value, spread);
  const double d = shortest_difference(value, middle(shape), shape.period);
  const Fit one = straight_fit(shape, middle(shape) + d, spread);
  const Fit other = straight_fit(shape, middle(shape) + d + (d > 0.0 ? -shape.period : shape.period), spread);
  return {std::max(one.possibility, other.possibility), std::max(one.necessity, other.necessity)};
}

double certainty(const Shape& shape, double value, double spread) {
  const Fit f = fit(shape, value, spread);
  return f.possibility + f.necessity - 1.0;
}

}  // namespace kb::fuzzy
