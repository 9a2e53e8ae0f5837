// How surely a measured value fits a shape, in double and by bisection. `runtime/certainty.h` must agree with it to within its
// stated error; the compiler's analyses use it.
#pragma once

#include "compiler/fuzzy/shape.h"

namespace kb::fuzzy {

/// How possible and how necessary it is that a Gaussian datum around `value` with this spread (>= 0; 0: exact) fits the shape.
struct Fit { double possibility = 0.0, necessity = 0.0; };
[[nodiscard]] Fit fit(const Shape& shape, double value, double spread);

/// Pi + N - 1, in [-1, 1].
[[nodiscard]] double certainty(const Shape& shape, double value, double spread);

}  // namespace kb::fuzzy
