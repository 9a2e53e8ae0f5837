#include <waymark/runtime/shape.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace mts {
namespace {

TEST(Shape, ATriangleIsOneAtItsPeakAndZeroAtItsFeet) {
  constexpr Membership kTriangle = triangle(1.0f, 2.0f, 4.0f);
  static_assert(mu(kTriangle, 2.0f) == 1.0f);
  static_assert(mu(kTriangle, 1.0f) == 0.0f && mu(kTriangle, 4.0f) == 0.0f);
  static_assert(mu(kTriangle, 1.5f) == 0.5f && mu(kTriangle, 3.0f) == 0.5f);
  static_assert(mu(kTriangle, 0.0f) == 0.0f && mu(kTriangle, 1e30f) == 0.0f);
}

// See note [feet and cores are exact].
TEST(Shape, CornersAreExactForAllCorners) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(-10.0f, 10.0f);
  for (int i = 0; i < 20'000; ++i) {
    std::array<float, 4> at = {place(random), place(random), place(random), place(random)};
    std::sort(at.begin(), at.end());
    if (i % 3 == 0) at[1] = at[0];
    if (i % 5 == 0) at[2] = at[3];
    const Membership m = trapezoid(at[0], at[1], at[2], at[3]);
    EXPECT_EQ(mu(m, at[1]), 1.0f);
    EXPECT_EQ(mu(m, at[2]), 1.0f);
    // A foot, or the next number beyond a vertical edge, is outside.
    EXPECT_EQ(mu(m, at[0] < at[1] ? at[0] : std::nextafter(at[0], -100.0f)), 0.0f);
    EXPECT_EQ(mu(m, at[2] < at[3] ? at[3] : std::nextafter(at[3], 100.0f)), 0.0f);
  }
}

TEST(Shape, ASingletonFitsOneNumberOnly) {
  constexpr Membership kZero = singleton(0.0f);
  static_assert(mu(kZero, 0.0f) == 1.0f && mu(kZero, 1e-30f) == 0.0f && mu(kZero, -1e-30f) == 0.0f);
}

TEST(Shape, ARampStaysWhereItHasArrived) {
  constexpr Membership kUp = ramp(0.4f, 0.6f), kDown = ramp(0.6f, 0.4f);
  static_assert(mu(kUp, 0.4f) == 0.0f && mu(kUp, 0.6f) == 1.0f && mu(kUp, 1e9f) == 1.0f && mu(kUp, -1e9f) == 0.0f);
  static_assert(mu(kDown, 0.4f) == 1.0f && mu(kDown, 0.6f) == 0.0f && mu(kDown, 1e9f) == 0.0f && mu(kDown, -1e9f) == 1.0f);
  EXPECT_NEAR(mu(kUp, 0.45f) + mu(kDown, 0.45f), 1.0f, 2e-7f);
}

TEST(Shape, AGaussianMayHaveOneSideOnly) {
  constexpr Membership kDark = gaussian(0.9f, 0.9f, 0.15f, kInfinity);
  static_assert(mu(kDark, 0.9f) == 1.0f && mu(kDark, 1e6f) == 1.0f);
  EXPECT_NEAR(mu(kDark, 0.75f), std::exp(-0.5f), 1e-6f);
  constexpr Membership kWide = gaussian(0.2f, 0.4f, 0.1f, 0.2f);
  static_assert(mu(kWide, 0.2f) == 1.0f && mu(kWide, 0.3f) == 1.0f && mu(kWide, 0.4f) == 1.0f);
  EXPECT_NEAR(mu(kWide, 0.0f), std::exp(-2.0f), 1e-6f);
  EXPECT_NEAR(mu(kWide, 0.6f), std::exp(-0.5f), 1e-6f);
}

TEST(Shape, ABellIsAHalfAtItsWidth) {
  constexpr Membership kBell = bell(1.0f, 2.0f, 3.5f);
  static_assert(mu(kBell, 1.0f) == 1.0f);
  EXPECT_NEAR(mu(kBell, 3.0f), 0.5f, 2e-7f);
  EXPECT_NEAR(mu(kBell, -1.0f), 0.5f, 2e-7f);
  EXPECT_EQ(mu(kBell, 3e38f), 0.0f);
}

TEST(Shape, ASigmoidRisesOrFalls) {
  EXPECT_EQ(mu(sigmoid(2.0f, 4.0f), 2.0f), 0.5f);
  EXPECT_GT(mu(sigmoid(2.0f, 4.0f), 3.0f), 0.9f);
  EXPECT_LT(mu(sigmoid(2.0f, -4.0f), 3.0f), 0.1f);
}

TEST(Shape, OnACircleTheShortestWayCounts) {
  constexpr Membership kBehind = triangle(135.0f, 180.0f, 225.0f, 360.0f, -180.0f);
  static_assert(mu(kBehind, -180.0f) == 1.0f);
  static_assert(mu(kBehind, 157.5f) == 0.5f && mu(kBehind, -157.5f) == 0.5f);
  static_assert(mu(kBehind, 135.0f) == 0.0f && mu(kBehind, -135.0f) == 0.0f && mu(kBehind, 0.0f) == 0.0f);
  constexpr Membership kNorth = gaussian(0.0f, 0.0f, 20.0f, 40.0f, 360.0f, 0.0f);
  EXPECT_NEAR(mu(kNorth, 340.0f), std::exp(-0.5f), 1e-6f);
  EXPECT_NEAR(mu(kNorth, 40.0f), std::exp(-0.5f), 1e-6f);
}

// The circle is cut where the shape is lowest, not opposite to its core.
TEST(Shape, OnACircleAFlankMayReachFartherThanHalfRound) {
  constexpr Membership kLong = triangle(0.0f, 10.0f, 270.0f, 360.0f, 0.0f);
  static_assert(mu(kLong, 10.0f) == 1.0f && mu(kLong, 140.0f) == 0.5f && mu(kLong, 270.0f) == 0.0f && mu(kLong, 359.0f) == 0.0f);
  EXPECT_NEAR(mu(kLong, 205.0f), 0.25f, 1e-6f);
  EXPECT_NEAR(mu(kLong, 257.0f), 0.05f, 1e-6f);
  constexpr Membership kBroad = gaussian(300.0f, 320.0f, 20.0f, 80.0f, 360.0f, 0.0f);   // 3.4 spreads to 232 on both sides
  EXPECT_NEAR(mu(kBroad, 200.0f), std::exp(-0.5f * 3.0f * 3.0f), 1e-6f);
  EXPECT_NEAR(mu(kBroad, 231.9f), mu(kBroad, 232.1f), 1e-4f);
  static_assert(mu(gaussian(10.0f, 10.0f, 20.0f, kInfinity, 360.0f, 0.0f), 350.0f) == 1.0f, "a side that stays 1 does so all the way round");
}

TEST(Shape, WrappingGivesANumberOfTheRange) {
  static_assert(wrapped(190.0f, -180.0f, 360.0f) == -170.0f);
  static_assert(wrapped(-190.0f, -180.0f, 360.0f) == 170.0f);
  static_assert(wrapped(180.0f, -180.0f, 360.0f) == -180.0f);
  static_assert(wrapped(725.0f, 0.0f, 360.0f) == 5.0f);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> anything(-1e9f, 1e9f);
  for (int i = 0; i < 20'000; ++i) {
    const float x = wrapped(anything(random), -180.0f, 360.0f);
    EXPECT_TRUE(x >= -180.0f && x < 180.0f) << x;
  }
  static_assert(wrapped(3e38f, 0.0f, 360.0f) == 0.0f);
}

// The accuracy that is stated for `mu`: the formulas of shape.h in double, on the same row and the same x.
double exact_mu(const Membership& m, float x) {
  double d = static_cast<double>(x - m.centre);
  if (m.period > 0.0f) d = static_cast<double>(shortest_difference(x, m.centre, m.period));
  const double rise = static_cast<double>(m.rise), fall = static_cast<double>(m.fall);
  const double low = static_cast<double>(m.low), high = static_cast<double>(m.high);
  const double slope = static_cast<double>(m.slope);
  switch (m.profile) {
    case Profile::kLinear: return std::clamp(std::min((d - low) * rise, (high - d) * fall), 0.0, 1.0);
    case Profile::kSigmoid: return 1.0 / (1.0 + std::exp(-(d - low) * slope));
    default: break;
  }
  const double u = std::max({(low - d) * rise, (d - high) * fall, 0.0});
  return m.profile == Profile::kGaussian ? std::exp(-0.5 * u * u) : 1.0 / (1.0 + std::pow(u, 2.0 * slope));
}

TEST(Shape, DegreesAreWithinTheStatedErrorOfExactArithmetic) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-3.0f, 3.0f), width(0.05f, 3.0f);
  std::array<double, 4> worst = {};
  for (int i = 0; i < 4'000; ++i) {
    std::array<float, 4> at = {place(random), place(random), place(random), place(random)};
    std::sort(at.begin(), at.end());
    const bool circle = i % 2 == 0;
    const float period = circle ? 16.0f : 0.0f;
    const Membership rows[] = {trapezoid(at[0], at[1], at[2], at[3], period, -8.0f), ramp(at[1], at[3]),
                               gaussian(at[1], at[2], width(random), width(random), period, -8.0f),
                               bell(at[1], width(random), 3.0f * width(random), period, -8.0f),
                               sigmoid(at[1], place(random) * 4.0f)};
    for (const Membership& row : rows) {
      for (int j = 0; j < 25; ++j) {
        const float x = 2.0f * place(random);
        const auto found = static_cast<double>(mu(row, x));
        double& so_far = worst[static_cast<std::size_t>(row.profile)];
        so_far = std::max(so_far, std::fabs(found - exact_mu(row, x)));
      }
    }
  }
  EXPECT_LE(worst[0], 1.2e-7);
  EXPECT_LE(worst[1], 2e-7);
  EXPECT_LE(worst[2], 1.2e-6) << "slopes up to 9";
  EXPECT_LE(worst[3], 2e-7);
}

}  // namespace
}  // namespace mts
