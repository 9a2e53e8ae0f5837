// What the tests of the controllers have in common: the grid of noise, seed and period, and a drive over the plant.
#pragma once

#include <cstdint>
#include <limits>
#include <string>

#include <waymark/controllers/any_controller.h>
#include "tests/unit/controllers/plant.h"
#include "tests/unit/stride.h"

namespace mts::plant {

inline constexpr double kQuarter = 1.57079632679489662;
inline constexpr double kDegree = kQuarter / 90.0;
inline constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

struct Trial { int level; std::uint64_t seed; double dt_s; };

/// Calls `test` for 3 levels of noise and `seeds` seeds, with periods of 5, 10 and 20 ms in turn, so that each level meets each; with a
/// stride (stride.h) for fewer seeds.
template <class Test>
void for_each_run(Test&& test, std::uint64_t seeds = 4) {
  constexpr double kPeriods[] = {0.005, 0.01, 0.02};
  const std::uint64_t stride = kb::testing::stride();
  for (int level = 0; level < 3; ++level) {
    for (std::uint64_t seed = 1; seed <= seeds; seed += stride) {
      test(Trial{level, seed, kPeriods[(static_cast<std::uint64_t>(level) + seed) % 3]});
    }
  }
}

inline std::string text(const Trial& run) {
  return "noise " + std::to_string(run.level) + ", seed " + std::to_string(run.seed) + ", period " +
         std::to_string(static_cast<int>(run.dt_s * 1000.0)) + " ms";
}

/// A bound that may grow with the level of noise.
struct Bound { double calm, usual, bad; };
inline double at(const Bound& bound, const Trial& run) { return run.level == 0 ? bound.calm : run.level == 1 ? bound.usual : bound.bad; }

/// Drives until `stop(t)` is true or `limit_s` has passed; the time that it took.
template <class Controller, class Stop>
double drive_until(Controller& controller, Plant& plant, double dt_s, double limit_s, Stop&& stop) {
  double t = 0.0;
  for (; t < limit_s && !stop(t); t += dt_s) plant.drive(controller.step(plant.sense(), static_cast<float>(dt_s)), dt_s);
  return t;
}

/// A number in [-1, 1] that a seed fixes.
inline double spread(std::uint64_t seed, std::uint64_t salt) {
  return static_cast<double>((seed * 2654435761u + salt * 40503u) % 1001u) / 500.0 - 1.0;
}

}  // namespace mts::plant
