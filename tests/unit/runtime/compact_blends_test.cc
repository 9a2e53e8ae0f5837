// When a compact mind needs double: dimmer.kb and twilight.kb beside this file. What asks is what stands in the emitted source.
#include <gtest/gtest.h>

#include "dimmer.kb.cc"
#include "twilight.kb.cc"

namespace {

TEST(CompactMind, BlendsInWholeNumbersUnlessRulesDisagreeAboutSomethingElse) {
  static_assert(mts::CompactTables<dimmer::Knowledge>::kWholeValues, "0.5 is written and begun with, but by all rules alike");
  static_assert(!mts::CompactTables<twilight::Knowledge>::kWholeValues);
}

TEST(CompactMind, KeepsAValueThatRulesAgreeAbout) {
  dimmer::Mind mind;
  EXPECT_EQ(mind.value(dimmer::Satellite::Lamp), 0.5f);
  mind.tick(mts::milliseconds(20));
  EXPECT_EQ(mind.value(dimmer::Satellite::Lamp), -1.0f);
  mind.give(dimmer::Fact::Dark, 0.9f);
  mind.give(dimmer::Fact::Late, 0.6f);
  mind.tick(mts::milliseconds(20));
  EXPECT_EQ(mind.value(dimmer::Satellite::Lamp), 0.5f);
}

TEST(CompactMind, BlendsWhatRulesDisagreeAbout) {
  twilight::Mind mind;
  mind.give(twilight::Fact::Dark, 1.0f);
  mind.give(twilight::Fact::Late, 0.5f);
  const auto decision = mind.tick(mts::milliseconds(20));
  ASSERT_EQ(decision.conflicts().size(), 1u);
  EXPECT_EQ(mind.value(twilight::Satellite::Lamp), 0.0f) << "(1 * 0.5 + 0.5 * -1) / 1.5";
}

}  // namespace
