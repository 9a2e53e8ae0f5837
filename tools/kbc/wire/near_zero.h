// note [odometry of any zero]
// A host's odometry may count from anywhere and for ever, and a float that is 100 km from zero moves in steps of 8 mm: the way driven would come out
// a tenth too long. So places are read as double, and counted from a zero near by before they become floats. Where that zero moves, the place
// leaps, and mts::Odometer takes the speed for one period.
#pragma once

#include <cmath>

#include "sim/world/geometry.h"

namespace kb::wire {

class NearZero {
 public:
  [[nodiscard]] float of(double value_m) {
    if (std::abs(value_m - zero_m_) > kFar_m) zero_m_ = std::round(value_m / kStep_m) * kStep_m;
    return static_cast<float>(value_m - zero_m_);
  }

 private:
  static constexpr double kFar_m = 2048.0, kStep_m = 1024.0;   // there a float moves in steps of 0.1 to 0.2 mm
  double zero_m_ = 0.0;
};

/// The same of an angle, of which whole turns do not matter.
[[nodiscard]] inline float near_zero(double angle_rad) {
  constexpr double kFar_rad = 1000.0;
  return static_cast<float>(std::abs(angle_rad) > kFar_rad ? sim::wrap(angle_rad) : angle_rad);
}

}  // namespace kb::wire
