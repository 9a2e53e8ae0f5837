// A compact mind beside the ordinary one where ticks are long: patience.kb beside this file.
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

}  // namespace
}  // namespace patience
