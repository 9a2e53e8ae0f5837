#include "compiler/fuzzy/shape.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kb::fuzzy {
namespace {

// Rises in a straight line from 0 at a to 1 at b; a vertical edge belongs to the core.
double rising(double x, double a, double b) { return x >= b ? 1.0 : x <= a ? 0.0 : (x - a) / (b - a); }
double falling(double x, double c, double d) { return x <= c ? 1.0 : x >= d ? 0.0 : (d - x) / (d - c); }

// How far x lies from the core [low, high], in spreads.
double distance(double x, double low, double high, double left, double right) {
  return x < low ? (low - x) / left : x > high ? (x - high) / right : 0.0;
}

std::string spread(double value) { return std::isinf(value) ? "inf" : fmt::format("{}", value); }

}  // namespace

double middle(const Shape& shape) {
  const auto& p = shape.p;
  switch (shape.kind) {
    case ShapeKind::kTriangle: return 0.5 * (p[0] + p[2]);
    case ShapeKind::kTrapezoid: return 0.5 * (p[0] + p[3]);
    case ShapeKind::kGaussian: {
      const double rise = 1.0 / p[2], fall = 1.0 / p[3], aside = rise != fall ? (rise - fall) / (rise + fall) * (shape.period - (p[1] - p[0])) : 0.0;
      return 0.5 * (p[0] + p[1] + aside);
    }
    default: return p[0];
  }
}

std::string_view word(ShapeKind kind) {
  switch (kind) {
    case ShapeKind::kTriangle: return "triangle";
    case ShapeKind::kTrapezoid: return "trapezoid";
    case ShapeKind::kGaussian: return "gaussian";
    case ShapeKind::kBell: return "bell";
    case ShapeKind::kSigmoid: return "sigmoid";
    case ShapeKind::kRamp: return "ramp";
    case ShapeKind::kSingleton: return "singleton";
  }
  return "";
}

double wrapped(double x, double low, double period) {
  const double inside = x - period * std::floor((x - low) / period);
  return inside < low || inside >= low + period ? low : inside;
}

double shortest_difference(double to, double from, double period) {
  return std::remainder(to - from, period);
}

double mu(const Shape& shape, double x) {
  const auto& p = shape.p;
  if (shape.circular()) x = middle(shape) + shortest_difference(x, middle(shape), shape.period);
  switch (shape.kind) {
    case ShapeKind::kTriangle: return std::min(rising(x, p[0], p[1]), falling(x, p[1], p[2]));
    case ShapeKind::kTrapezoid: return std::min(rising(x, p[0], p[1]), falling(x, p[2], p[3]));
    case ShapeKind::kGaussian: {
      const double u = distance(x, p[0], p[1], p[2], p[3]);
      return std::exp(-0.5 * u * u);
    }
    case ShapeKind::kBell: return 1.0 / (1.0 + std::pow(std::fabs((x - p[0]) / p[1]), 2.0 * p[2]));
    case ShapeKind::kSigmoid: return 1.0 / (1.0 + std::exp(-p[1] * (x - p[0])));
    case ShapeKind::kRamp: return p[0] <= p[1] ? rising(x, p[0], p[1]) : falling(x, p[1], p[0]);
    case ShapeKind::kSingleton: return x == p[0] ? 1.0 : 0.0;
  }
  return 0.0;
}

std::string text(const Shape& shape) {
  const auto& p = shape.p;
  switch (shape.kind) {
    case ShapeKind::kTriangle: return fmt::format("triangle({}, {}, {})", p[0], p[1], p[2]);
    case ShapeKind::kTrapezoid: return fmt::format("trapezoid({}, {}, {}, {})", p[0], p[1], p[2], p[3]);
    case ShapeKind::kGaussian: {
      const std::string mean = p[0] == p[1] ? fmt::format("{}", p[0]) : fmt::format("{}..{}", p[0], p[1]);
      if (p[2] == p[3]) return fmt::format("gaussian({}, {})", mean, spread(p[2]));
      return fmt::format("gaussian({}, left {}, right {})", mean, spread(p[2]), spread(p[3]));
    }
    case ShapeKind::kBell: return fmt::format("bell({}, {}, {})", p[0], p[1], p[2]);
    case ShapeKind::kSigmoid: return fmt::format("sigmoid({}, {})", p[0], p[1]);
    case ShapeKind::kRamp: return fmt::format("ramp({}, {})", p[0], p[1]);
    case ShapeKind::kSingleton: return fmt::format("singleton({})", p[0]);
  }
  return {};
}

}  // namespace kb::fuzzy
