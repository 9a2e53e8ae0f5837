#include "sim/mind/sight.h"

#include <gtest/gtest.h>

namespace kb::sim::testing {
namespace {

constexpr float kPeriod = 0.02f;

/// Readings for `periods`: with noise each is another one.
void read(Sight<2>& sight, int periods, bool noise, float way_m) {
  for (int i = 0; i < periods; ++i) {
    const float elements[2] = {0.05f, noise ? 0.05f + 0.001f * static_cast<float>(i % 7) : 0.05f};
    sight.hear(true, elements, true, way_m, kPeriod);
  }
}

TEST(Sight, WhatWasNoisyAndSaysTheSameWhileTheWheelsTurnIsStuck) {
  Sight<2> sight;
  read(sight, 50, true, 0.0f);
  EXPECT_TRUE(sight.sees());
  read(sight, 50, false, 0.008f);
  EXPECT_TRUE(sight.stuck());
  EXPECT_FALSE(sight.sees());
  read(sight, 2, true, 0.008f);
  EXPECT_TRUE(sight.sees());
}

TEST(Sight, WhatStandsMaySayTheSameForEver) {
  Sight<2> sight;
  read(sight, 50, true, 0.0f);
  read(sight, 5000, false, 0.0f);
  EXPECT_TRUE(sight.sees());
}

TEST(Sight, WhatHasNoNoiseMaySeeTheSameForMetres) {
  Sight<2> sight;
  read(sight, 50, false, 0.0f);
  read(sight, 50, true, 0.008f);   // a line that it follows
  read(sight, 500, false, 0.008f);
  EXPECT_TRUE(sight.sees());
}

TEST(Sight, WhatSaysNothingDoesNotSee) {
  Sight<2> sight;
  const float elements[2] = {};
  EXPECT_FALSE(sight.sees());
  sight.hear(false, elements, true, 0.0f, kPeriod);
  EXPECT_FALSE(sight.sees());
  sight.hear(true, elements, true, 0.0f, kPeriod);
  EXPECT_TRUE(sight.sees());
}

TEST(Sight, WhatCouldSayNothingElseIsNotStuck) {
  Sight<2> sight;
  read(sight, 50, true, 0.0f);
  const float elements[2] = {4.0f, 4.0f};
  for (int i = 0; i < 100; ++i) sight.hear(true, elements, false, 0.008f, kPeriod);
  EXPECT_TRUE(sight.sees());
}

}  // namespace
}  // namespace kb::sim::testing
