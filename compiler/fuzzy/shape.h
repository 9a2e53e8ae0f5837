// Fuzzy numbers as the compiler keeps them, in double: what a shape of the language means, exactly. `runtime/shape.h` is the
// same in float, for the robot; compiler/tables makes its rows from these.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include "compiler/source/source.h"

namespace kb::fuzzy {

enum class ShapeKind : std::uint8_t { kTriangle, kTrapezoid, kGaussian, kBell, kSigmoid, kRamp, kSingleton };

/// The word that the language has for it: `triangle`.
[[nodiscard]] std::string_view word(ShapeKind kind);

/// A membership function. Numbers are in SI units (degrees kept), except the slopes of bells and sigmoids.
struct Shape {
  ShapeKind kind = ShapeKind::kSingleton;
  /// kTriangle: the corners a <= b <= c. kTrapezoid: a <= b <= c <= d. kRamp: from, to (from > to falls).
  /// kGaussian: mean, the mean's other end (the same number if it is no range), left spread, right spread; a spread may be
  /// infinite: that side stays 1. kBell: centre, width, slope. kSigmoid: inflection, slope. kSingleton: the number.
  std::array<double, 4> p{};
  double period = 0.0;     ///< above 0: the quantity goes round with this period
  double range_low = 0.0;  ///< where the range of a quantity that goes round begins
  source::Span span;       ///< of the shape as written

  [[nodiscard]] bool circular() const { return period > 0.0; }
};

inline constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The degree in [0, 1] to which x fits. On a circle x may be any number.
[[nodiscard]] double mu(const Shape& shape, double x);

/// The middle of a shape on a circle. Cut the circle open opposite to it, and the shape is equally low at both ends.
[[nodiscard]] double middle(const Shape& shape);

/// On a circle the number of [low, low + period) that x stands for.
[[nodiscard]] double wrapped(double x, double low, double period);

/// The shortest way round from `from` to `to`, in [-period/2, period/2].
[[nodiscard]] double shortest_difference(double to, double from, double period);

/// `gaussian(0.9, left 0.15, right inf)`: as the language writes it, without units.
[[nodiscard]] std::string text(const Shape& shape);

}  // namespace kb::fuzzy
