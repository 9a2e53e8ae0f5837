// Shares of runs as they are printed.
#include <gtest/gtest.h>

#include "sim/batch/ending.h"

namespace kb::sim::batch {
namespace {

TEST(SharesTest, have_one_decimal_place) {
  EXPECT_EQ(percent(0, 0), "-");
  EXPECT_EQ(percent(0, 8), "0.0 %");
  EXPECT_EQ(percent(8, 8), "100.0 %");
  EXPECT_EQ(percent(1, 3), "33.3 %");
  EXPECT_EQ(percent(1, 2000), "0.1 %");
}

TEST(SharesTest, are_never_rounded_to_all_or_none) {
  EXPECT_EQ(percent(9'996, 10'000), "99.96 %");
  EXPECT_EQ(percent(4, 10'000), "0.04 %");
  EXPECT_EQ(percent(9'999'999, 10'000'000), "99.99999 %");
  EXPECT_EQ(percent(1, 10'000'000), "0.00001 %");
}

TEST(SharesTest, have_bounds_that_are_never_rounded_to_all_or_none) {
  EXPECT_EQ(percent_between(8, 8), "100.0 % (67.6 to 100.0)");
  EXPECT_EQ(percent_between(0, 8), "0.0 % (0.0 to 32.4)");
  EXPECT_EQ(percent_between(1, 500), "0.2 % (0.04 to 1.1)");
  EXPECT_EQ(percent_between(499, 500), "99.8 % (98.9 to 99.96)");
  EXPECT_EQ(percent_between(10'000, 10'000), "100.0 % (99.96 to 100.0)");
  EXPECT_EQ(percent_between(0, 10'000), "0.0 % (0.0 to 0.04)");
}

}  // namespace
}  // namespace kb::sim::batch
