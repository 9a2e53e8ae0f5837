// How fast the program may drive: slow_road.kb beside this file.
#include <gtest/gtest.h>

#include <limits>

#include "slow_road.kb.h"

namespace slow_road {
namespace {

constexpr float kNone = std::numeric_limits<float>::infinity();

TEST(SpeedLimit, IsThatOfTheRoadOfThePresentLeg) {
  Mind mind;
  Facts facts;
  mind.tick(facts, mts::milliseconds(20));
  EXPECT_EQ(speed_limit_m_per_s(mind), kNone) << "on no mission";
  facts.Go = 0.9f;
  mind.tick(facts, mts::milliseconds(20));
  EXPECT_EQ(speed_limit_m_per_s(mind), 0.15f) << "the lowest of all, on an unknown road to the first landmark";
  facts.Dock = 0.9f;
  mind.tick(facts, mts::milliseconds(20));
  EXPECT_EQ(speed_limit_m_per_s(mind), 0.3f);
}

TEST(SpeedLimit, OfARoadWithoutOneIsInfinite) {
  Mind to_shelf, to_yard;
  to_shelf.set(Satellite::Errand_2_Arch_Shelf, 1.0f);
  EXPECT_EQ(speed_limit_m_per_s(to_shelf), 0.15f);
  to_yard.set(Satellite::Errand_3_Shelf_Yard, 1.0f);
  EXPECT_EQ(speed_limit_m_per_s(to_yard), kNone);
}

}  // namespace
}  // namespace slow_road
