// Rough range finders made steady: what is left of the roughness, what stays as it was read, and how late it is.
#include <waymark/controllers/steady_ranges.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <random>

namespace mts {
namespace {

constexpr float kPeriod_s = 0.02f;
constexpr int kHeld = 3;   // periods of a reading, about 20 a second

/// Stands, drives or turns in a corridor along x with walls `half_m` aside; its range finders read with `noise_m`.
struct Corridor {
  float half_m = 0.6f, noise_m = 0.0f, speed_m_s = 0.0f, turn_rad_s = 0.0f, ahead_m = kOutOfRange;
  float x_m = 0.0f, heading_rad = 0.0f;
  std::mt19937 random{7};
  Senses senses{};
  int period = 0;

  [[nodiscard]] float truth(std::size_t i) const {
    const float direction = heading_rad + range_finder_rad(i), across = std::sin(direction);
    const float wall = std::abs(across) < 0.05f ? kOutOfRange : half_m / std::abs(across);
    return std::min({wall, i == 0 ? ahead_m : kOutOfRange, kOutOfRange});
  }
  Senses step() {
    x_m += speed_m_s * kPeriod_s;
    heading_rad += turn_rad_s * kPeriod_s;
    senses.range_known = senses.heading_known = senses.turned_known = senses.odometry_known = true;
    senses.heading_rad = senses.turned_rad = wrapped_angle(heading_rad);
    senses.speed_m_s = speed_m_s;
    std::normal_distribution<float> bell(0.0f, 1.0f);
    for (std::size_t i = 0; i < kRangeFinders && period % kHeld == 0; ++i) {
      const float range = truth(i);
      senses.range_m[i] = range < kOutOfRange ? std::clamp(range + noise_m * bell(random), 0.02f, kOutOfRange) : kOutOfRange;
    }
    ++period;
    return senses;
  }
};

bool same_ranges(const Senses& a, const Senses& b) {
  return std::equal(std::begin(a.range_m), std::end(a.range_m), std::begin(b.range_m));
}

TEST(SteadyRanges, HandsOnWhatIsNotRough) {
  for (const float noise_m : {0.0f, 0.01f, 0.02f}) {
    Corridor corridor;
    corridor.noise_m = noise_m;
    corridor.speed_m_s = 0.3f;
    SteadyRanges steady;
    for (int i = 0; i < 1000; ++i) {
      const Senses raw = corridor.step();
      EXPECT_TRUE(same_ranges(steady.step(raw, kPeriod_s), raw)) << i;
    }
    EXPECT_FALSE(steady.rough());
  }
}

TEST(SteadyRanges, MeasuresTheSpreadWhetherItStandsOrDrives) {
  for (const float noise_m : {0.1f, 0.15f}) {
    for (const float speed_m_s : {0.0f, 0.4f}) {
      Corridor corridor;
      corridor.noise_m = noise_m;
      corridor.speed_m_s = speed_m_s;
      SteadyRanges steady;
      for (int i = 0; i < 1000; ++i) static_cast<void>(steady.step(corridor.step(), kPeriod_s));
      EXPECT_NEAR(steady.spread_m(), noise_m, 0.25f * noise_m);
    }
  }
}

TEST(SteadyRanges, LeavesAThirdOfTheNoiseBesideAWall) {
  for (const float turn_rad_s : {0.0f, 0.3f}) {
    Corridor corridor;
    corridor.noise_m = 0.15f;
    corridor.turn_rad_s = turn_rad_s;
    SteadyRanges steady;
    float raw_sum = 0.0f, sum = 0.0f;
    for (int i = 0; i < 1500; ++i) {
      const Senses raw = corridor.step();
      const Senses heard = steady.step(raw, kPeriod_s);
      if (i < 150 || std::abs(std::sin(corridor.heading_rad)) > 0.2f) continue;
      const auto square = [](float x) { return x * x; };
      raw_sum += square(raw.range_m[2] - corridor.truth(2));
      sum += square(heard.range_m[2] - corridor.truth(2));
    }
    EXPECT_LT(std::sqrt(sum), 0.45f * std::sqrt(raw_sum));
  }
}

TEST(SteadyRanges, WhatAppearsIsHeardOfWithinASecond) {
  Corridor corridor;
  corridor.noise_m = 0.15f;
  SteadyRanges steady;
  for (int i = 0; i < 300; ++i) static_cast<void>(steady.step(corridor.step(), kPeriod_s));
  corridor.ahead_m = 0.5f;
  int periods = 0;
  while (steady.step(corridor.step(), kPeriod_s).range_m[0] > 1.0f && periods < 200) ++periods;
  EXPECT_LT(periods, 50);
}

TEST(SteadyRanges, WhatLeavesIsForgottenWithinASecondEvenIfNothingElseIsSeen) {
  Corridor hall;
  hall.noise_m = 0.15f;
  hall.half_m = 20.0f;
  hall.ahead_m = 2.5f;
  SteadyRanges steady;
  for (int i = 0; i < 600; ++i) static_cast<void>(steady.step(hall.step(), kPeriod_s));
  ASSERT_TRUE(steady.rough());
  hall.ahead_m = kOutOfRange;
  for (int i = 0; i < 50; ++i) static_cast<void>(steady.step(hall.step(), kPeriod_s));
  for (const float range_m : steady.step(hall.step(), kPeriod_s).range_m) EXPECT_EQ(range_m, kOutOfRange);
}

TEST(SteadyRanges, SilenceAndNonsenseAreForgotten) {
  Corridor corridor;
  corridor.noise_m = 0.15f;
  SteadyRanges steady;
  for (int i = 0; i < 300; ++i) static_cast<void>(steady.step(corridor.step(), kPeriod_s));
  ASSERT_TRUE(steady.rough());
  Senses raw = corridor.step();
  for (float& range : raw.range_m) range = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(steady.step(raw, kPeriod_s).range_known);
  corridor.period = 0;   // reads anew
  const Senses next = corridor.step();
  const Senses first = steady.step(next, kPeriod_s);                  // of one reading there is nothing to average
  for (std::size_t i = 0; i < kRangeFinders; ++i) EXPECT_NEAR(first.range_m[i], next.range_m[i], 1e-3f) << i;
}

TEST(SteadyRanges, ARangeFinderThatSaysNothingIsNoWitnessForTheOthers) {
  Corridor corridor;
  corridor.noise_m = 0.15f;
  SteadyRanges steady;
  for (int i = 0; i < 1000; ++i) {
    Senses raw = corridor.step();
    if (i > 300) raw.range_m[2] = std::numeric_limits<float>::quiet_NaN();
    if (i == 400) corridor.turn_rad_s = 1.0f;   // the others come to look where it looked a moment ago
    const Senses senses = steady.step(raw, kPeriod_s);
    EXPECT_TRUE(senses.range_known);
    EXPECT_EQ(senses.ranges_unknown, i > 300 ? 4u : 0u);
    for (std::size_t k = 0; k < kRangeFinders && i > 300; ++k) {
      const float truth = corridor.truth(k);
      EXPECT_FALSE(std::isnan(senses.range_m[k]));
      // Near to a wall, and not at the edge of what is seen at all.
      if (k == 2 || truth > 0.9f) continue;
      EXPECT_LT(senses.range_m[k], 2.0f) << i << ' ' << k;
    }
  }
}

}  // namespace
}  // namespace mts
