#include "sim/world/geometry.h"

#include <gtest/gtest.h>

namespace kb::sim::testing {
namespace {

TEST(Geometry, PiecesThatCrossMeetAtAnyAngleThatMatters) {
  for (const double angle_rad : {1e-6, 0.1, 1.5, 3.0}) {
    const Spot ahead = direction(0.7), across = direction(0.7 + angle_rad);
    const auto meeting = meet(-1.0 * ahead, ahead, -3.0 * across, across);
    ASSERT_TRUE(meeting) << angle_rad;
    EXPECT_NEAR(meeting->along_a, 0.5, 1e-9);
    EXPECT_NEAR(meeting->along_b, 0.75, 1e-9);
  }
}

/// Rounding leaves an angle between them, and a place where such lines cross that may be anywhere.
TEST(Geometry, PiecesOfOneLineAreParallelHoweverItIsTurnedAndHoweverLongTheyAre) {
  for (int k = 0; k < 3600; ++k) {
    const Spot ahead = direction(k * kPi / 1800.0), begin{k * 0.37, -k * 0.11};
    for (const double long_m : {0.01, 1.0, 300.0}) {
      const Spot a1 = begin + long_m * ahead, b0 = begin + 1.25 * long_m * ahead, b1 = begin + 2.0 * long_m * ahead;
      EXPECT_FALSE(meet(begin, a1, b0, b1)) << k << " " << long_m;
      EXPECT_NEAR(gap_between(begin, a1, b0, b1), 0.25 * long_m, 1e-9) << k << " " << long_m;
    }
  }
}

}  // namespace
}  // namespace kb::sim::testing
