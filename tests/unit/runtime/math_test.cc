// The bounds that runtime/math.h states, against double. The steps are primes, so that all mantissas get their turn.
#include <waymark/runtime/math.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mts {
namespace {

float from_bits(std::uint32_t bits) { return std::bit_cast<float>(bits); }

double wrong_by_ulp(float found, double exact) {
  const auto rounded = static_cast<float>(exact);
  const float size = std::fabs(rounded);
  const double ulp = static_cast<double>(std::nextafter(size, kInfinity)) - static_cast<double>(size);
  return std::fabs(static_cast<double>(found) - static_cast<double>(rounded)) / ulp;
}

TEST(Math, ExpIsWithinOneUlp) {
  double worst = 0.0;
  for (std::uint32_t bits = 0x8000'0000u; from_bits(bits) >= -87.3f; bits += 4'999) {
    const float x = from_bits(bits);
    worst = std::max(worst, wrong_by_ulp(exp_of_nonpositive(x), std::exp(static_cast<double>(x))));
  }
  EXPECT_LE(worst, 1.0);
}

TEST(Math, ExpEndsInZeroAndBeginsWithOne) {
  static_assert(exp_of_nonpositive(0.0f) == 1.0f);
  static_assert(exp_of_nonpositive(-0.0f) == 1.0f);
  static_assert(exp_of_nonpositive(-88.0f) == 0.0f);
  static_assert(exp_of_nonpositive(-kInfinity) == 0.0f);
  EXPECT_GT(exp_of_nonpositive(-87.3f), 0.0f);
}

TEST(Math, LogIsWithinTwoUlpOrTenToTheMinusSeven) {
  double worst = 0.0;
  for (std::uint32_t bits = 0x0080'0000u; bits < 0x7F80'0000u; bits += 4'999) {
    const float x = from_bits(bits);
    const double exact = std::log(static_cast<double>(x));
    if (std::fabs(static_cast<double>(log_of_positive(x)) - exact) <= 1e-7) continue;
    worst = std::max(worst, wrong_by_ulp(log_of_positive(x), exact));
  }
  EXPECT_LE(worst, 2.0);
}

TEST(Math, LogisticIsWithinThreeUlp) {
  double worst = 0.0;
  for (std::uint32_t bits = 0; from_bits(bits) <= 80.0f; bits += 4'999) {
    for (const float t : {from_bits(bits), -from_bits(bits)}) {
      worst = std::max(worst, wrong_by_ulp(logistic(t), 1.0 / (1.0 + std::exp(-static_cast<double>(t)))));
    }
  }
  EXPECT_LE(worst, 3.0);
  static_assert(logistic(kInfinity) == 1.0f && logistic(-kInfinity) == 0.0f && logistic(0.0f) == 0.5f);
}

TEST(Math, TheSquareRootIsCorrectlyRounded) {
  for (std::uint32_t bits = 1; bits < 0x7F80'0000u; bits += 9'973) {
    const float x = from_bits(bits);
    ASSERT_EQ(square_root(x), std::sqrt(x)) << x;
  }
  static_assert(square_root(2.25f) == 1.5f);
  static_assert(square_root(-1.0f) == 0.0f && square_root(0.0f) == 0.0f && square_root(kInfinity) == kInfinity);
}

TEST(Math, TellsNumbersFromWhatIsNone) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  static_assert(is_finite(0.0f) && is_finite(-3e38f) && !is_finite(kInfinity) && !is_finite(-kInfinity) && !is_finite(kNan));
  static_assert(is_nan(kNan) && is_nan(-kNan) && !is_nan(kInfinity) && !is_nan(1.0f));
}

}  // namespace
}  // namespace mts
