// Somebody comes from the side so that both would meet: the robot stops before his lane and goes on behind him; and what stands is nobody.
#include <waymark/controllers/steady_ranges.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/unit/controllers/plant.h"

namespace mts::plant {
namespace {

constexpr double kStep_s = 0.01, kPeriod_s = 0.05, kFan = 0.2094395;   // three rays of a range finder, 12 degrees apart

/// A robot that drives along x at `asked_m_s`, brakes with 1.5 m/s2, and reads its range finders 20 times a second.
struct Street {
  double asked_m_s = 0.4, noise_m = 0.01;
  double x = 0.0, speed = 0.4, t = 0.0;
  Point walker{100.0, 0.0}, walks{};   // a disc of 20 cm radius, m/s
  double radius = 0.2;
  std::vector<Segment> walls{};
  std::mt19937 random{1};
  SteadyRanges steady{};
  Senses senses{};
  double gap_m = 1e9, slowest = 1e9;
  int alarms = 0;

  [[nodiscard]] double ray(double angle) const {
    const double ux = std::cos(angle), uy = std::sin(angle), wx = walker.x - x, wy = walker.y;
    double range = static_cast<double>(kOutOfRange);
    const double along = wx * ux + wy * uy, across = wx * uy - wy * ux;
    if (along > 0.0 && std::abs(across) < radius) range = std::min(range, along - std::sqrt(radius * radius - across * across));
    for (const Segment& wall : walls) {
      const double sx = wall.to.x - wall.from.x, sy = wall.to.y - wall.from.y, turned = ux * sy - uy * sx;
      if (std::abs(turned) < 1e-9) continue;
      const double fx = wall.from.x - x, fy = wall.from.y;
      const double to = (fx * sy - fy * sx) / turned, share = (fx * uy - fy * ux) / turned;
      if (to > 0.0 && share >= 0.0 && share <= 1.0) range = std::min(range, to);
    }
    return range;
  }
  void read() {
    std::normal_distribution<double> bell(0.0, noise_m);
    for (std::size_t i = 0; i < kRangeFinders; ++i) {
      const double at = static_cast<double>(range_finder_rad(i)), nearest = std::min({ray(at - kFan), ray(at), ray(at + kFan)});
      senses.range_m[i] = nearest < static_cast<double>(kOutOfRange) ? static_cast<float>(std::max(nearest + bell(random), 0.0)) : kOutOfRange;
    }
    senses.range_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
  }
  /// `listens`: to what `SteadyRanges` has to say.
  void step(bool listens = true) {
    if (std::fmod(t + 1e-6, kPeriod_s) < kStep_s) read();
    senses.speed_m_s = static_cast<float>(speed);
    Senses heard_now = steady.step(senses, static_cast<float>(kStep_s));
    if (heard_now.met_m < kOutOfRange) ++alarms;
    if (!listens) heard_now.met_m = kOutOfRange;
    const double wanted = static_cast<double>(braked({static_cast<float>(asked_m_s), 0.0f}, heard_now, Body{}).speed_m_s);
    speed += std::clamp(wanted - speed, -1.5 * kStep_s, 1.5 * kStep_s);
    slowest = std::min(slowest, speed);
    x += speed * kStep_s;
    walker.x += walks.x * kStep_s;
    walker.y += walks.y * kStep_s;
    t += kStep_s;
    gap_m = std::min(gap_m, std::hypot(walker.x - x, walker.y) - radius - static_cast<double>(Body{}.radius_m));
  }
  void drive(double seconds, bool listens = true) {
    for (const double until = t + seconds; t < until;) step(listens);
  }
};

/// Who would meet the robot's centre 2.4 m from where it begins, if it went on.
Street meeting(double walk, double degrees, double side) {
  Street street;
  const double seconds = std::min(2.4 / street.asked_m_s, 2.5 / walk);
  street.walks = {walk * std::cos(degrees / 57.29578), side * walk * std::sin(degrees / 57.29578)};
  street.x = 2.4 - street.asked_m_s * seconds;
  street.walker = {2.4 - street.walks.x * seconds, -street.walks.y * seconds};
  return street;
}

TEST(Comers, WhoeverWouldMeetItIsLetPass) {
  for (const double walk : {0.2, 0.3, 0.4, 0.5, 0.6, 0.8}) {
    for (const double degrees : {90.0, 105.0}) {
      for (const double side : {1.0, -1.0}) {
        Street listens = meeting(walk, degrees, side), deaf = meeting(walk, degrees, side);
        listens.drive(12.0 + 2.0 / walk);
        deaf.drive(12.0 + 2.0 / walk, false);
        EXPECT_GT(listens.gap_m, 0.0) << walk << " m/s at " << degrees;
        EXPECT_LT(deaf.gap_m, 0.03) << walk << " m/s at " << degrees << ": he would have met it anyway";
        EXPECT_NEAR(listens.speed, listens.asked_m_s, 0.01) << walk << " m/s at " << degrees << ": it stands for ever";
      }
    }
  }
}

TEST(Comers, HowFarItHasDrivenBeforeDoesNotMatter) {
  for (const double before_km : {0.0, 8.0, 16.0, 33.0, 65.0}) {
    Street street = meeting(0.8, 90.0, 1.0);
    street.asked_m_s = street.speed = 0.3;   // 3 mm a step
    street.x = 2.4 - 0.3 * 2.5 / 0.8;
    Senses senses;
    senses.heading_known = senses.odometry_known = senses.turned_known = true;
    senses.speed_m_s = 10.0f;
    for (double m = 0.0; m < 1000.0 * before_km; m += 5.0) static_cast<void>(street.steady.step(senses, 0.5f));
    street.drive(12.0);
    EXPECT_GT(street.gap_m, 0.0) << before_km << " km";
    EXPECT_LT(street.slowest, 0.2) << before_km << " km";
  }
}

TEST(Comers, WhoPassesBehindItIsNotStoodInTheWayOf) {
  for (const double walk : {0.4, 0.6}) {
    for (const double side : {1.0, -1.0}) {
      Street street = meeting(walk, 90.0, side);
      street.x += 0.6;   // it is so far ahead of where they would have met
      street.drive(10.0);
      EXPECT_GT(street.slowest, 0.399) << walk << " m/s";
      EXPECT_GT(street.gap_m, 0.05) << walk << " m/s";
    }
  }
}

TEST(Comers, WhoStopsOnTheWayIsNotRunInto) {
  for (const double walk : {0.3, 0.5, 0.8, 1.2}) {
    Street street = meeting(walk, 90.0, 1.0);
    while (street.walker.y < 0.0) street.step();
    street.walks = {};
    street.drive(10.0);
    EXPECT_GT(street.gap_m, 0.03) << walk;
    EXPECT_LT(street.x, 2.4) << walk;
  }
}

TEST(Comers, WallsBesideItAreNobody) {
  // A corridor, a crossing with its four corners, a corridor.
  for (const double half : {0.3, 0.4}) {
    for (const double speed : {0.2, 0.3, 0.4}) {
      for (unsigned seed = 1; seed <= 20; ++seed) {
        Street street;
        street.asked_m_s = street.speed = speed;
        street.random.seed(seed);
        for (const double side : {1.0, -1.0}) {
          const double wall = side * half, far = 3.0 * side;
          street.walls.insert(street.walls.end(), {{{-2.0, wall}, {1.7, wall}}, {{1.7, wall}, {1.7, far}}, {{2.3, wall}, {2.3, far}}, {{2.3, wall}, {6.0, wall}}});
        }
        street.drive(3.0 / speed);
        EXPECT_GT(street.slowest, speed - 0.001) << half << " m, " << speed << " m/s, seed " << seed;
      }
    }
  }
}

TEST(Comers, WhatStandsBesideTheWayIsHardlyEverSomebody) {
  int slowed = 0;   // of 180: a round thing comes into sight edge first, and seems to come
  for (const double aside : {0.35, 0.5, 0.8}) {
    for (const double radius : {0.05, 0.1, 0.2}) {
      for (unsigned seed = 1; seed <= 20; ++seed) {
        Street street;
        street.random.seed(seed);
        street.radius = radius;
        street.walker = {2.0, aside + radius};
        street.drive(10.0);
        slowed += street.slowest < 0.399;
        EXPECT_NEAR(street.speed, street.asked_m_s, 0.001) << aside << " m, radius " << radius << ", seed " << seed;
      }
    }
  }
  EXPECT_LE(slowed, 5);
}

TEST(Comers, FalseEchoesAreNobody) {
  Street street;
  street.walls = {{{-2.0, 1.0}, {60.0, 1.0}}, {{-2.0, -1.0}, {60.0, -1.0}}};
  std::uniform_real_distribution<float> share(0.0f, 1.0f);
  for (int i = 0; i < 2000; ++i) {
    street.read();
    for (float& range : street.senses.range_m) range *= share(street.random) < 0.1f ? share(street.random) : 1.0f;
    street.senses.speed_m_s = 0.4f;
    street.x += 0.4 * kPeriod_s;
    street.alarms += street.steady.step(street.senses, static_cast<float>(kPeriod_s)).met_m < kOutOfRange;
  }
  EXPECT_EQ(street.alarms, 0);
}

TEST(Comers, NobodyIsBelievedInByWhatIsSilentOrRough) {
  Street street = meeting(0.4, 90.0, 1.0);
  while (street.alarms == 0 && street.t < 20.0) street.step();
  ASSERT_GT(street.alarms, 0);
  Senses silent = street.senses;
  silent.range_known = false;
  EXPECT_GE(street.steady.step(silent, 0.01f).met_m, kOutOfRange);
  EXPECT_LT(street.steady.step(street.senses, 0.01f).met_m, kOutOfRange) << "a moment ago he came";
  for (int i = 0; i < 60; ++i) static_cast<void>(street.steady.step(silent, 0.01f));
  EXPECT_GE(street.steady.step(street.senses, 0.01f).met_m, kOutOfRange);

  Street rough = meeting(0.4, 90.0, 1.0);
  rough.noise_m = 0.15;
  rough.walls = {{{-9.0, 2.0}, {60.0, 2.0}}, {{-9.0, -2.0}, {60.0, -2.0}}};
  const Point comes = rough.walker;
  rough.walker.x = 100.0;
  rough.asked_m_s = rough.speed = 0.0;
  rough.walks = {};
  rough.drive(20.0);   // its roughness is known
  ASSERT_TRUE(rough.steady.rough());
  rough.alarms = 0;
  rough.walker = comes;
  rough.walks = {0.0, 0.4};
  rough.drive(5.0);
  EXPECT_EQ(rough.alarms, 0);
}

TEST(Braked, StopsBeforeTheLaneOfWhoComes) {
  Senses senses;
  senses.range_known = senses.odometry_known = true;
  for (float& range : senses.range_m) range = kOutOfRange;
  const Body body;
  const auto speed = [&](float met_m) {
    senses.met_m = met_m;
    return braked({0.5f, 0.3f}, heard(senses), body);
  };
  EXPECT_EQ(speed(kOutOfRange).speed_m_s, 0.5f);
  EXPECT_EQ(speed(std::numeric_limits<float>::quiet_NaN()).speed_m_s, 0.5f) << "nobody has said anything";
  EXPECT_EQ(speed(std::numeric_limits<float>::infinity()).speed_m_s, 0.5f);
  EXPECT_EQ(speed(0.3f).speed_m_s, fastest_that_stops(0.3f - body.radius_m - 0.06f, body));
  EXPECT_EQ(speed(-0.1f).speed_m_s, 0.0f) << "in his lane";
  EXPECT_EQ(speed(-std::numeric_limits<float>::infinity()).speed_m_s, 0.0f);
  EXPECT_EQ(speed(-0.1f).turn_rad_s, 0.3f);
  EXPECT_EQ(braked({-0.2f, 0.0f}, heard(senses), body).speed_m_s, -0.2f) << "it backs away";
}

}  // namespace
}  // namespace mts::plant
