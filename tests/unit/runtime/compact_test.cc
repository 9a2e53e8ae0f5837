// A compact mind where it is not made as the ordinary one is: patience.kb beside this file.
#include <waymark/runtime/compact_mind.h>

#include <gtest/gtest.h>

#include "patience.kb.h"

namespace patience {
namespace {

TEST(CompactMind, CountsATickOfMoreThan35MinutesAs35) {
  Mind mind;
  mind.give(Fact::Quiet, 1.0f);
  mind.tick(mts::milliseconds(20));
  EXPECT_FALSE(mind.tick(mts::milliseconds(1'000'000)).drives());
  EXPECT_TRUE(mind.tick(mts::microseconds(0xFFFF'FFFF)).drives()) << "32 bits of time have gone round";
  EXPECT_EQ(mind.decision().time_us(), 1'000'000'000 + std::int64_t{0x7FFF'FFFF});
}

TEST(CompactMind, TakesAllFactsFromFactsWhateverItWasGivenBefore) {
  Mind mind;
  Facts facts;
  for (int i = 0; i < 3; ++i) {
    mind.give(Fact::Quiet, 1.0f);
    mind.tick(facts, mts::milliseconds(10));
    EXPECT_EQ(mind.value(Fact::Quiet), 0.0f) << "tick " << i;
  }
}

TEST(CompactMind, KeepsItsDecisionWhenASatelliteIsSet) {
  Mind mind;
  mind.give(Fact::Quiet, 1.0f);
  const auto decision = mind.tick(mts::milliseconds(10));
  ASSERT_EQ(decision.changed().size(), 1u);
  EXPECT_TRUE(mind.set(Satellite::sat_Leave, 0.5f));
  ASSERT_EQ(decision.changed().size(), 1u);
  EXPECT_EQ(decision.changed()[0].cell, Knowledge::kShape.facts + static_cast<std::uint32_t>(Satellite::Bored));
  EXPECT_EQ(decision.changed()[0].value, 1.0f);
  EXPECT_EQ(mind.tick(mts::milliseconds(10)).changed().size(), 0u);
  EXPECT_TRUE(mind.decision().drives());
}

TEST(CompactMind, KeepsItsDecisionWhenAFactIsGiven) {
  Mind mind;
  const auto decision = mind.tick(mts::milliseconds(10));
  mind.give(Fact::Quiet, 7.0f);
  EXPECT_EQ(decision.bad_facts(), 0u);
  EXPECT_NE(decision.status(), mts::Status::kBadFact);
  mind.tick(mts::milliseconds(10));
  EXPECT_EQ(decision.bad_facts(), 1u);
  EXPECT_EQ(decision.status(), mts::Status::kBadFact);
}

TEST(CompactMind, RefusesToSetASatelliteThatNoRuleWrites) {
  Mind mind;
  EXPECT_FALSE(mind.set(Satellite::sat_Quiet, 1.0f));
  EXPECT_EQ(mind.value(Satellite::sat_Quiet), -1.0f);
  mind.tick(mts::milliseconds(10));
  EXPECT_FALSE(mind.attended(Fact::Quiet));
  EXPECT_TRUE(mind.set(Satellite::Bored, 1.0f));
  EXPECT_TRUE(mind.high(Satellite::Bored));
}

}  // namespace
}  // namespace patience
