// One reading against one prototype: the runtime's closed form and table beside bisection in double.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include <waymark/runtime/certainty.h>
#include "compiler/fuzzy/certainty.h"
#include "compiler/tables/fuzzy.h"
#include "compiler/tables/perception.h"

namespace kb::tables {
namespace {

fuzzy::Shape gaussian(double mean, double left, double right) {
  fuzzy::Shape shape;
  shape.kind = fuzzy::ShapeKind::kGaussian;
  shape.p = {mean, mean, left, right};
  return shape;
}

float certain(double value, double spread) {
  return mts::certainty(mts::gaussian(0.0f, 0.0f, 1.0f, 1.0f), static_cast<float>(value), static_cast<float>(spread));
}

// The model's table of prototype (0, 1) was made with a coarse bisection: by its own definition the certainty of (0, 0.5) is
// 0.7245 and not 0.726, and that of (0, 1) exactly 1/2, where P and 1 - D meet by symmetry, and not 0.501.
TEST(Certainty, has_the_check_values_of_the_model) {
  constexpr struct { double value, spread, cf; } kChecks[] = {
      {0, 0.1, 0.967}, {0, 3, 0.176}, {0, 10, 0.033}, {1, 0, 0.213}, {2, 0, -0.729}, {3, 0, -0.978}, {3, 3, -0.241}};
  for (const auto& check : kChecks) EXPECT_NEAR(certain(check.value, check.spread), check.cf, 1e-3) << check.value << ' ' << check.spread;
  EXPECT_NEAR(certain(0, 0.5), 0.726, 1.6e-3);
  EXPECT_NEAR(certain(0, 0.5), 0.72449, 1e-4);
  EXPECT_NEAR(certain(0, 1), 0.5, 1e-4);
}

TEST(Certainty, of_an_exact_reading_is_twice_its_membership_less_one) {
  for (double x = -4; x <= 4; x += 0.125) EXPECT_NEAR(certain(x, 0), 2.0 * std::exp(-0.5 * x * x) - 1.0, 5e-7);
}

TEST(Certainty, goes_to_unknown_as_a_reading_grows_wide) {
  float last = certain(0, 0.01);
  for (double spread = 0.02; spread < 1e4; spread *= 1.5) {
    EXPECT_LE(certain(0, spread), last + 1e-6f);
    last = certain(0, spread);
  }
  EXPECT_NEAR(last, 0.0f, 1e-3f);
  EXPECT_NEAR(certain(3, 1e5), 0.0f, 1e-3f) << "absent becomes unknown as well";
}

/// Shapes of every kind that can be a prototype, from narrow to wide, with open sides, flat cores and vertical edges.
struct Both { fuzzy::Shape shape; mts::Membership row; };
Both random_prototype(std::mt19937& random) {
  const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  const auto spread = [&] { return random() % 8 == 0 ? fuzzy::kInfinity : std::exp(number(-4, 3)); };
  Both made;
  auto& p = made.shape.p;
  const auto f = [](double x) { return static_cast<float>(x); };
  switch (random() % 4) {
    case 0:
      made.shape = gaussian(number(-5, 5), spread(), spread());
      made.shape.p[1] = made.shape.p[0] + (random() % 2 == 0 ? number(0, 2) : 0.0);
      made.row = mts::gaussian(f(p[0]), f(p[1]), f(p[2]), f(p[3]));
      break;
    case 1:
      made.shape.kind = fuzzy::ShapeKind::kTriangle;
      p = {number(-5, 0), 0.0, number(0, 5), 0.0};
      made.row = mts::triangle(f(p[0]), f(p[1]), f(p[2]));
      break;
    case 2:
      made.shape.kind = fuzzy::ShapeKind::kTrapezoid;
      p = {number(-5, -2), number(-2, 0), number(0, 2), number(2, 5)};
      made.row = mts::trapezoid(f(p[0]), f(p[1]), f(p[2]), f(p[3]));
      break;
    default:
      made.shape.kind = fuzzy::ShapeKind::kRamp;
      p = {number(-3, 3), number(-3, 3), 0.0, 0.0};
      made.row = mts::ramp(f(p[0]), f(p[1]));
      break;
  }
  for (double& x : p) x = static_cast<double>(f(x));  // the same numbers on both sides
  return made;
}

TEST(Certainty, is_that_of_bisection_in_double_to_within_the_stated_error) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-8, 8), scale(-5, 4);
  double worst = 0.0;
  for (int i = 0; i < 20'000; ++i) {
    const Both both = random_prototype(random);
    const auto x = static_cast<float>(value(random)), spread = static_cast<float>(std::exp(scale(random)));
    const mts::Fit got = mts::fit(both.row, x, spread);
    const fuzzy::Fit exact = fuzzy::fit(both.shape, static_cast<double>(x), static_cast<double>(spread));
    // The row's numbers are rounded to float, as 1 / spread is; a steep flank makes more of it.
    ASSERT_NEAR(got.possibility, exact.possibility, mts::kNecessityError + 2e-5) << fuzzy::text(both.shape) << " at " << x << ", " << spread;
    ASSERT_NEAR(got.necessity, exact.necessity, mts::kNecessityError + 2e-5) << fuzzy::text(both.shape) << " at " << x << ", " << spread;
    worst = std::max(worst, std::fabs(got.necessity - exact.necessity));
  }
  EXPECT_GT(worst, 0.0) << "compared with itself?";
}

TEST(Certainty, goes_the_short_way_round_a_circle) {
  const mts::Membership south = mts::gaussian(0.0f, 0.0f, 20.0f, 20.0f, 360.0f, 0.0f);
  EXPECT_FLOAT_EQ(mts::certainty(south, 350.0f, 2.0f), mts::certainty(south, 10.0f, 2.0f));
  EXPECT_GT(mts::certainty(south, 355.0f, 2.0f), 0.5f);
  EXPECT_LT(mts::certainty(south, 180.0f, 2.0f), -0.99f);
}

// By the definition, with a reading as broad as a quarter of the circle, and prototypes whose flanks end anywhere on it.
TEST(Certainty, meets_a_prototype_either_way_round_a_circle) {
  std::mt19937 random(11);
  const auto number = [&](double low, double high) { return std::uniform_real_distribution<double>(low, high)(random); };
  for (int i = 0; i < 300; ++i) {
    fuzzy::Shape shape = gaussian(number(0, 360), number(5, 50), number(5, 50));
    if (i % 2 == 0) {
      shape.kind = fuzzy::ShapeKind::kTrapezoid;
      shape.p[0] = number(0, 360);
      for (std::size_t k = 1; k < 4; ++k) shape.p[k] = shape.p[k - 1] + number(0, 110);
    }
    shape.period = 360.0;
    const double value = number(0, 360), spread = number(5, 90);
    double possibility = 0.0, necessity = 1.0;
    for (double x = 0.0; x < 360.0; x += 0.1) {
      const double u = fuzzy::shortest_difference(x, value, 360.0) / spread, near = std::exp(-0.5 * u * u);
      possibility = std::max(possibility, std::min(fuzzy::mu(shape, x), near));
      necessity = std::min(necessity, std::max(fuzzy::mu(shape, x), 1.0 - near));
    }
    const fuzzy::Fit exact = fuzzy::fit(shape, value, spread);
    const mts::Fit robot = mts::fit(row(shape), static_cast<float>(value), static_cast<float>(spread));
    const std::string what = fmt::format("{} at {}, {}", fuzzy::text(shape), value, spread);
    EXPECT_NEAR(exact.possibility, possibility, 2e-2) << what;
    EXPECT_NEAR(exact.necessity, necessity, 2e-2) << what;
    EXPECT_NEAR(static_cast<double>(robot.possibility), exact.possibility, 2e-4) << what;
    EXPECT_NEAR(static_cast<double>(robot.necessity), exact.necessity, 2e-4) << what;
  }
}

TEST(Certainty, is_a_constant_where_its_arguments_are) {
  static_assert(mts::certainty(mts::triangle(0, 1, 2), 1.0f, 0.0f) == 1.0f);
  static_assert(mts::certainty(mts::gaussian(0, 0, 1, 1), 0.0f, 0.1f) > 0.96f);
}

}  // namespace
}  // namespace kb::tables
