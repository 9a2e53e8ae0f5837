#include "sim/world/nearby.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace kb::sim::testing {
namespace {

bool apart(const Bounds& a, const Bounds& b, double m) {
  return b.low.x_m - a.high.x_m > m || a.low.x_m - b.high.x_m > m || b.low.y_m - a.high.y_m > m || a.low.y_m - b.high.y_m > m;
}

TEST(Nearby, KnowsAllThatComeNearInAscendingOrderAndNoneThatAreFar) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> place(0.0, 20.0), long_m(0.0, 2.0);
  std::vector<Bounds> things;
  for (int i = 0; i < 500; ++i) {
    const Spot at{std::round(place(random)), place(random)};
    things.push_back(bounds_of(at, {at.x_m + std::round(long_m(random)), at.y_m - long_m(random)}));
  }
  const Nearby nearby(things);
  for (int i = 0; i < 200; ++i) {
    const Spot at{place(random), std::round(place(random))};
    const Bounds bounds = bounds_of({at, {at.x_m + long_m(random), at.y_m}, {at.x_m, at.y_m + 1.0}});
    const double within_m = i % 3 == 0 ? 0.0 : long_m(random);
    const std::vector<std::uint32_t> found = nearby.near(bounds, within_m);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    for (std::uint32_t t = 0; t < things.size(); ++t) {
      const bool far = apart(things[t], bounds, within_m);
      const bool here = std::binary_search(found.begin(), found.end(), t);
      EXPECT_TRUE(here || far) << t;
      EXPECT_FALSE(here && apart(things[t], bounds, within_m + 1e-5)) << t;
    }
  }
}

TEST(Nearby, WithNothingThereFindsNothing) { EXPECT_TRUE(Nearby({}).near(bounds_of(Spot{1.0, 2.0}), 5.0).empty()); }

TEST(Nearby, WhatTouchesIsNear) {
  const Nearby nearby({bounds_of(Spot{0.0, 0.0}, {1.0, 0.0})});
  EXPECT_EQ(nearby.near(bounds_of(Spot{1.0, 0.0}), 0.0).size(), 1u);
  EXPECT_EQ(nearby.near(bounds_of(Spot{1.5, 0.0}), 0.5).size(), 1u);
  EXPECT_EQ(nearby.near(bounds_of(Spot{1.6, 0.0}), 0.5).size(), 0u);
}

}  // namespace
}  // namespace kb::sim::testing
