// The typed interface of a compiled knowledge base: lamp.kb beside this file.
#include <waymark/runtime/mind.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <new>
#include <string>
#include <type_traits>
#include <vector>

#include "lamp.kb.h"

namespace lamp {
namespace {

using mts::microseconds;
using mts::seconds;
using mts::Duration;
using mts::milliseconds;
using mts::Status;

TEST(Facts, AreSetAndReadByName) {
  Facts facts;
  facts.Dark = 0.5f;
  facts.Button.left = -1.0f;
  facts.class_ = 1.0f;
  EXPECT_EQ(static_cast<float>(facts.Dark), 0.5f);
  EXPECT_EQ(facts.get(Fact::Dark), 0.5f);
  EXPECT_EQ(facts.get(Fact::Button_left), -1.0f);
  facts.set(Fact::Button_right, 0.25f);
  EXPECT_EQ(static_cast<float>(facts.Button.right), 0.25f);
  facts.Dark = facts.Button.right;
  EXPECT_EQ(facts.get(Fact::Dark), 0.25f);
  facts.clear();
  EXPECT_EQ(facts.get(Fact::class_), 0.0f);
}

TEST(Facts, AreCopiedByValue) {
  Facts first, second;
  first.Dark = 0.5f;
  second = first;
  first.Dark = 1.0f;
  EXPECT_EQ(second.get(Fact::Dark), 0.5f);
  second.Dark = first.Dark;
  EXPECT_EQ(second.get(Fact::Dark), 1.0f);
}

TEST(Names, AreThoseOfTheKnowledgeBase) {
  EXPECT_STREQ(name(Fact::Button_left), "Button.left");
  EXPECT_STREQ(name(Satellite::sat_Drive_left), "sat Drive.left");
  EXPECT_STREQ(name(Strategy::Stop), "Stop");
  EXPECT_STREQ(name(Rule::press_left), "press[left]");
}

TEST(Names, OfWhatIsNoMemberAreAQuestionMark) {
  const Mind mind;
  ASSERT_FALSE(mind.decision().drives());
  EXPECT_STREQ(name(mind.decision().strategy()), "?") << "a log that does not ask whether it drives";
  EXPECT_STREQ(name(static_cast<Fact>(4)), "?");
  EXPECT_STREQ(name(static_cast<Rule>(0xFFFF)), "?");
}

TEST(Mind, FirstTickMakesNoEvents) {
  Mind mind;
  Facts facts;
  facts.Button.left = 1.0f;
  const auto decision = mind.tick(facts, milliseconds(10));
  EXPECT_TRUE(decision.events().empty());
  EXPECT_FALSE(decision.drives());
  EXPECT_EQ(decision.status(), Status::kNoStrategy);
  EXPECT_EQ(decision.tick(), 1u);
  EXPECT_EQ(decision.time_us(), 0);
}

/// What it decides as its left button is pressed.
auto press_left(Mind& mind) {
  Facts facts;
  mind.tick(facts, milliseconds(10));
  facts.Button.left = 1.0f;
  return mind.tick(facts, milliseconds(10));
}

TEST(Mind, DecidesAndSaysWhatItDid) {
  Mind mind;
  const auto decision = press_left(mind);
  ASSERT_TRUE(decision.drives());
  EXPECT_EQ(decision.strategy(), Strategy::Drive_left);
  EXPECT_EQ(decision.status(), Status::kOk);
  ASSERT_EQ(decision.events().size(), 1u);
  EXPECT_EQ(decision.events()[0], Fact::Button_left);
  ASSERT_EQ(decision.fired().size(), 2u);
  EXPECT_EQ(decision.fired()[0], Rule::press_left);
  EXPECT_EQ(decision.fired()[1], Rule::run_Drive_left);
  EXPECT_EQ(decision.changed().size(), 2u);
  EXPECT_TRUE(mind.high(Satellite::Waiting));
  EXPECT_TRUE(mind.attended(Fact::Dark));
  EXPECT_TRUE(mind.ran(Strategy::Drive_left));
}

TEST(Mind, GivesListsForAlgorithmsAndContainers) {
  Mind mind;
  const auto decision = press_left(mind);
  const auto fired = decision.fired();
  const std::vector<Rule> kept(fired.begin(), fired.end());
  EXPECT_EQ(kept, (std::vector{Rule::press_left, Rule::run_Drive_left}));
  EXPECT_NE(std::find(fired.begin(), fired.end(), Rule::press_left), fired.end());
  const auto is_raised = [](const auto& change) { return change.value > 0.0f; };
  EXPECT_EQ(std::count_if(decision.changed().begin(), decision.changed().end(), is_raised), std::ranges::count_if(decision.changed(), is_raised));
}

TEST(Mind, TakesNaNAsNoDataAndClampsTheRest) {
  Mind mind;
  Facts facts;
  facts.Dark = std::nanf("");
  facts.class_ = 7.0f;
  auto decision = mind.tick(facts, milliseconds(10));
  EXPECT_EQ(decision.bad_facts(), 2u);
  EXPECT_EQ(decision.status(), Status::kBadFact);
  EXPECT_EQ(mind.value(Fact::Dark), 0.0f);
  EXPECT_EQ(mind.value(Fact::class_), 1.0f);
  facts.Dark = 0.5f;
  facts.class_ = 0.0f;
  decision = mind.tick(facts, milliseconds(10));
  EXPECT_EQ(decision.bad_facts(), 0u);
}

TEST(Mind, KeepsItsDecisionWhenAFactIsGiven) {
  Mind mind;
  mind.give(Fact::class_, 7.0f);
  const auto decision = mind.tick(milliseconds(10));
  const auto status = decision.status();
  mind.give(Fact::Dark, std::nanf(""));
  EXPECT_EQ(decision.bad_facts(), 1u);
  mind.give(Fact::class_, 0.0f);
  EXPECT_EQ(decision.bad_facts(), 1u);
  EXPECT_EQ(decision.status(), status);
  mind.give(Fact::Dark, 0.0f);
  EXPECT_EQ(decision.status(), status);
  mind.tick(milliseconds(10));
  EXPECT_EQ(decision.bad_facts(), 0u);
  EXPECT_NE(decision.status(), Status::kBadFact);
}

TEST(Mind, DoesNotSayOfAStrategyThatIsHeldThatItRan) {
  Mind mind;
  mind.tick(milliseconds(10));
  mind.give(Fact::Button_left, 1.0f);
  EXPECT_TRUE(mind.tick(milliseconds(10)).drives() && mind.ran(Strategy::Drive_left));
  mind.give(Fact::Button_left, -1.0f);
  const auto decision = mind.tick(milliseconds(10));
  ASSERT_TRUE(decision.holding() && decision.drives());
  EXPECT_EQ(decision.strategy(), Strategy::Drive_left);
  EXPECT_FALSE(mind.ran(Strategy::Drive_left)) << "no rule runs it, and conditions do not see it";
  EXPECT_TRUE(decision.active().empty());
}

TEST(Mind, HoldsTheLastControllerForTheLimitAndThenStops) {
  Mind mind;
  Facts facts;
  mind.tick(facts, milliseconds(10));
  facts.Button.left = 1.0f;
  mind.tick(facts, milliseconds(10));
  facts.Button.left = -1.0f;
  auto decision = mind.tick(facts, milliseconds(10));
  EXPECT_EQ(decision.status(), Status::kHolding);
  EXPECT_EQ(decision.strategy(), Strategy::Drive_left);
  for (int i = 0; i < 99; ++i) decision = mind.tick(facts, milliseconds(10));
  EXPECT_EQ(decision.status(), Status::kHolding) << "1 s after it was last active, and no longer";
  decision = mind.tick(facts, milliseconds(10));
  EXPECT_EQ(decision.status(), Status::kHoldExpired);
  EXPECT_FALSE(decision.drives());
}

TEST(Mind, SaysThatItHoldsThoughSomeFactIsBad) {
  Mind mind;
  Facts facts;
  mind.tick(facts, milliseconds(10));
  EXPECT_FALSE(mind.decision().holding() || mind.decision().hold_expired()) << "nothing has run that could be held";
  facts.Button.left = 1.0f;
  EXPECT_FALSE(mind.tick(facts, milliseconds(10)).holding());
  facts.Button.left = -1.0f;
  facts.Dark = std::nanf("");
  const auto decision = mind.tick(facts, milliseconds(10));
  EXPECT_EQ(decision.status(), Status::kBadFact);
  EXPECT_TRUE(decision.holding() && decision.drives() && !decision.hold_expired());
  mind.tick(facts, seconds(2));
  EXPECT_EQ(decision.status(), Status::kBadFact);
  EXPECT_TRUE(decision.hold_expired() && !decision.drives() && !decision.holding());
  facts.Dark = 0.0f;
  EXPECT_EQ(mind.tick(facts, milliseconds(10)).status(), Status::kHoldExpired);
}

TEST(Mind, ReadsTheFactsThatItIsGivenWhoeverHasReadThemBefore) {
  Mind first, second;
  Facts shared, other;
  first.tick(shared, milliseconds(10));
  second.tick(shared, milliseconds(10));
  shared.Button.left = 1.0f;
  EXPECT_EQ(first.tick(shared, milliseconds(10)).events().size(), 1u);
  EXPECT_EQ(second.tick(shared, milliseconds(10)).events().size(), 1u) << "the first has read the change, not this one";
  EXPECT_EQ(first.tick(other, milliseconds(10)).lost().size(), 1u) << "other facts: the button is not down there";
  EXPECT_EQ(first.tick(shared, milliseconds(10)).events().size(), 1u);
}

TEST(Mind, IsCopiedWithItsState) {
  Mind mind;
  Facts facts;
  mind.tick(facts, milliseconds(10));
  facts.Button.right = 1.0f;
  mind.tick(facts, milliseconds(10));
  Mind copy = mind;
  EXPECT_TRUE(copy.ran(Strategy::Drive_right));
  mind.reset();
  EXPECT_FALSE(mind.ran(Strategy::Drive_right));
  EXPECT_TRUE(copy.tick(facts, milliseconds(10)).drives());
}

TEST(Mind, ThatIsAssignedReadsItsFactsAgain) {
  Mind first, second;
  Facts dark, bright;
  dark.Dark = 1.0f;
  bright.Dark = -1.0f;
  first.tick(bright, milliseconds(10));
  second.tick(dark, milliseconds(10));
  first = second;
  first.tick(bright, milliseconds(10));
  EXPECT_EQ(first.value(Fact::Dark), -1.0f) << "as many ticks as the one before it, but it has read other facts";
}

TEST(Mind, ReadsItsFactsAgainWhicheverOfItsFuturesIsRestored) {
  Mind mind;
  Facts facts;
  mind.tick(facts, milliseconds(10));
  const Mind now = mind;
  facts.Dark = 1.0f;
  mind.tick(facts, milliseconds(10));
  const Mind best = mind;
  mind = now;
  facts.Dark = 0.0f;
  mind.tick(facts, milliseconds(10));
  mind = best;
  mind.tick(facts, milliseconds(10));
  EXPECT_EQ(mind.value(Fact::Dark), 0.0f) << "as many ticks as the one before it, and the same facts, but other values";
}

TEST(Mind, ReadsFactsThatLieWhereOthersHaveLain) {
  alignas(Facts) std::byte place[sizeof(Facts)];
  Mind mind;
  const Mind now = mind;
  auto* facts = new (place) Facts;
  facts->Dark = 1.0f;
  mind.tick(*facts, milliseconds(10));
  const Mind best = mind;
  mind = now;
  facts = new (place) Facts;
  facts->Dark = -1.0f;
  mind.tick(*facts, milliseconds(10));
  mind = best;
  mind.tick(*facts, milliseconds(10));
  EXPECT_EQ(mind.value(Fact::Dark), -1.0f);
}

TEST(Mind, ReadsFactsAgainThatWereAssigned) {
  Mind mind;
  Facts facts;
  facts.Dark = 1.0f;
  mind.tick(facts, milliseconds(10));
  const Facts saved = facts;
  mind.reset();
  facts.Dark = 0.0f;
  mind.tick(facts, milliseconds(10));
  facts = saved;
  mind.tick(facts, milliseconds(10));
  EXPECT_EQ(mind.value(Fact::Dark), 1.0f);
}

TEST(Mind, ReadsItsFactsAgainAfterAReset) {
  Mind mind;
  Facts facts;
  facts.Dark = 1.0f;
  mind.tick(facts, milliseconds(10));
  mind.reset();
  mind.tick(milliseconds(10));
  mind.tick(facts, milliseconds(10));
  EXPECT_EQ(mind.value(Fact::Dark), 1.0f) << "as many ticks as before, but it has forgotten what it had read";
}

TEST(Mind, TakesAllFactsFromFactsWhateverItWasGivenBefore) {
  Mind mind;
  Facts facts;
  for (int i = 0; i < 3; ++i) {
    mind.give(Fact::Dark, 1.0f);
    mind.tick(facts, milliseconds(10));
    EXPECT_EQ(mind.value(Fact::Dark), 0.0f) << "tick " << i;
  }
}

TEST(Mind, IsRestoredByAssigningACopy) {
  Mind mind;
  Facts facts;
  mind.tick(facts, milliseconds(10));
  facts.Button.left = 1.0f;
  facts.Dark = 1.0f;
  mind.tick(facts, milliseconds(10));
  mind.tick(facts, milliseconds(10));   // what was raised is timed from the tick after
  const Mind saved = mind;
  for (int i = 0; i < 2; ++i) {
    mind.tick(facts, milliseconds(490));
    EXPECT_FALSE(mind.high(Satellite::Lamp));
    mind.tick(facts, milliseconds(20));
    EXPECT_TRUE(mind.high(Satellite::Lamp)) << "the timer goes on from where it was";
    mind = saved;
  }
}

TEST(Mind, TakesASatelliteThatIsSetAsItTakesAFact) {
  Mind mind;
  Facts facts;
  EXPECT_TRUE(mind.set(Satellite::Lamp, 7.0f));
  EXPECT_EQ(mind.value(Satellite::Lamp), 1.0f);
  mind.set(Satellite::Lamp, -INFINITY);
  EXPECT_EQ(mind.value(Satellite::Lamp), -1.0f);
  mind.set(Satellite::Lamp, std::nanf(""));
  EXPECT_EQ(mind.value(Satellite::Lamp), 0.0f);
}

/// Writes down what it is asked for.
struct Log {
  void drive(const Drive& how) {
    said = "drive " + std::to_string(how.speed_m_per_s) + (how.side == Drive::Side::left ? " left" : " right");
  }
  void run(Run<Strategy::Stop>) { said = "stop"; }
  void idle() { said = "idle"; }
  std::string said;
};

TEST(Controllers, GetTheirArguments) {
  Mind mind;
  Facts facts;
  Log log;
  drive(mind.tick(facts, milliseconds(10)), log);
  EXPECT_EQ(log.said, "idle");
  facts.Button.right = 1.0f;
  drive(mind.tick(facts, milliseconds(10)), log);
  EXPECT_EQ(log.said, "drive 0.200000 right");
  facts.class_ = 1.0f;
  drive(mind.tick(facts, milliseconds(10)), log);
  EXPECT_EQ(log.said, "stop");
}

TEST(Controllers, AreDataAsWell) {
  Mind mind;
  Facts facts;
  EXPECT_EQ(control_line(mind.tick(facts, milliseconds(10))), nullptr) << "nothing drives";
  facts.Button.right = 1.0f;
  const mts::ControlLine* line = control_line(mind.tick(facts, milliseconds(10)));
  ASSERT_NE(line, nullptr);
  EXPECT_EQ(line, control_line(Strategy::Drive_right));
  EXPECT_STREQ(line->controller, "drive");
  ASSERT_EQ(line->count, 3u);
  EXPECT_STREQ(line->arguments[0].name, "speed");
  EXPECT_STREQ(line->arguments[0].word, "");
  EXPECT_EQ(line->arguments[0].number, 0.2f);
  EXPECT_STREQ(line->arguments[0].unit, "m/s");
  EXPECT_STREQ(line->arguments[1].word, "right");
  EXPECT_STREQ(line->arguments[2].unit, "deg");
  EXPECT_EQ(control_line(Strategy::Drive_left)->count, 2u);
  EXPECT_EQ(control_line(Strategy::Stop), nullptr) << "no line names its controller";
  EXPECT_EQ(control_line(static_cast<Strategy>(77)), nullptr);
}

}  // namespace
}  // namespace lamp
