#include <waymark/controllers/liveness.h>

#include <gtest/gtest.h>

namespace mts {
namespace {

constexpr float kPeriod = 0.02f;

/// Readings for `periods`: with noise each is another one.
void read(Liveness<2>& sense, int periods, bool noise, float way_m) {
  for (int i = 0; i < periods; ++i) {
    const float elements[2] = {0.05f, noise ? 0.05f + 0.001f * static_cast<float>(i % 7) : 0.05f};
    sense.step(true, elements, true, way_m, kPeriod);
  }
}

TEST(Liveness, WhatWasNoisyAndSaysTheSameWhileTheWheelsTurnIsStuck) {
  Liveness<2> sense;
  read(sense, 50, true, 0.0f);
  EXPECT_TRUE(sense.sees());
  read(sense, 50, false, 0.008f);
  EXPECT_TRUE(sense.stuck());
  EXPECT_FALSE(sense.sees());
  read(sense, 2, true, 0.008f);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatStandsMaySayTheSameForEver) {
  Liveness<2> sense;
  read(sense, 50, true, 0.0f);
  read(sense, 5000, false, 0.0f);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatHasNoNoiseMaySeeTheSameForMetres) {
  Liveness<2> sense;
  read(sense, 50, false, 0.0f);
  read(sense, 50, true, 0.008f);   // a line that it follows
  read(sense, 500, false, 0.008f);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatMovesSlowlyInShortPeriodsDoesNotStand) {
  Liveness<2> sense;
  for (int i = 0; i < 1000; ++i) {   // at 0.1 m/s over a floor with paint
    const float elements[2] = {0.0f, i % 7 == 0 ? 1.0f : 0.0f};
    sense.step(true, elements, true, 0.0005f, 0.005f);
  }
  read(sense, 500, false, 0.008f);
  EXPECT_TRUE(sense.sees()) << "it has no noise";
}

TEST(Liveness, WhatSaysNothingDoesNotSee) {
  Liveness<2> sense;
  const float elements[2] = {};
  EXPECT_FALSE(sense.sees());
  sense.step(false, elements, true, 0.0f, kPeriod);
  EXPECT_FALSE(sense.sees());
  sense.step(true, elements, true, 0.0f, kPeriod);
  EXPECT_TRUE(sense.sees());
}

TEST(Liveness, WhatCouldSayNothingElseIsNotStuck) {
  Liveness<2> sense;
  read(sense, 50, true, 0.0f);
  const float elements[2] = {4.0f, 4.0f};
  for (int i = 0; i < 100; ++i) sense.step(true, elements, false, 0.008f, kPeriod);
  EXPECT_TRUE(sense.sees());
}

}  // namespace
}  // namespace mts
