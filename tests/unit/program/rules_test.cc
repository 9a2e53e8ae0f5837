// Rules, levels and the tick: sections 2, 4 and 5 of the model.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/program/program_builder.h"

namespace kb::program::testing {
namespace {

using Strings = std::vector<std::string>;

TEST(Terms, HoldFromTheFiringMembershipOn) {
  for (const auto& [cf, expected] : std::map<float, Strings>{{0.5f, {"high", "zero"}},
                                                             {std::nextafter(0.5f, 1.0f), {"high"}},
                                                             {std::nextafter(0.5f, 0.0f), {"zero"}},
                                                             {0.0f, {"zero"}},
                                                             {-0.5f, {"low", "zero"}},
                                                             {-0.75f, {"low"}}}) {
    ProgramBuilder b({"goal", "control"});
    b.fact("F");
    b.while_true("high", "goal", high("F"), {raise("sat F")});
    b.while_true("low", "goal", low("F"), {raise("sat F")});
    b.while_true("zero", "goal", zero("F"), {raise("sat F")});
    Trial run(b.build());
    Strings fired = run.fired({{"F", cf}});
    std::sort(fired.begin(), fired.end());
    EXPECT_EQ(fired, expected) << cf;
  }
}

TEST(Terms, NothingIsBothHighAndNotHigh) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F");
  b.while_true("both", "goal", all({high("F"), no(high("F"))}), {raise("sat F")});
  Trial run(b.build());
  for (const float cf : {0.5f, std::nextafter(0.5f, 0.0f), 1.0f, 0.0f}) EXPECT_TRUE(run.fired({{"F", cf}}).empty());
}

TEST(WhenRule, FiresOnceWhileItsConditionHoldsAndAgainAfterItFailed) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("S");
  b.when("r", "goal", high("F"), {raise("S")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"r"});
  EXPECT_TRUE(run.fired({{"F", 1.0f}}).empty());
  EXPECT_TRUE(run.fired({{"F", 0.0f}}).empty());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"r"});
}

TEST(WhenRule, FiresWhenTheWholeConditionBecomesTrueInWhateverOrder) {
  ProgramBuilder b({"goal", "control"});
  b.fact("A").fact("B").satellite("S");
  b.when("r", "goal", all({seen("A"), seen("B")}), {raise("S")});
  Trial run(b.build());
  EXPECT_TRUE(run.fired({{"B", 1.0f}}).empty());
  EXPECT_EQ(run.fired({{"A", 1.0f}, {"B", 1.0f}}), Strings{"r"});
  EXPECT_TRUE(run.fired({{"A", 1.0f}}).empty());
  EXPECT_EQ(run.fired({{"A", 1.0f}, {"B", 1.0f}}), Strings{"r"});
}

TEST(WhenRule, ThatSwitchesOffItsOwnConditionCanFireOnTheNextTick) {
  ProgramBuilder b({"goal", "route", "control"});
  b.fact("F").satellite("S");
  b.while_true("set", "goal", high("F"), {raise("S")});
  b.when("take", "route", high("S"), {lower("S")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), (Strings{"set", "take"}));
  EXPECT_EQ(run.fired({{"F", 1.0f}}), (Strings{"set", "take"}));
}

TEST(WhileRule, FiresOnEveryTick) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("S");
  b.while_true("r", "goal", high("F"), {raise("S")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"r"});
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"r"});
}

TEST(Levels, RulesReadTheCellsAsTheirLevelFoundThem) {
  ProgramBuilder b({"goal", "control"});
  b.satellite("A", 1.0f).satellite("B");
  b.when("swap1", "goal", all({high("A"), no(high("B"))}), {lower("A")});
  b.when("swap2", "goal", all({high("A"), no(high("B"))}), {raise("B")});
  Trial run(b.build());
  EXPECT_EQ(run.fired(), (Strings{"swap1", "swap2"}));
}

TEST(Levels, TheNextLevelSeesWhatTheOneBeforeWrote) {
  ProgramBuilder b({"goal", "route", "control"});
  b.fact("F").satellite("A").satellite("B").strategy("Go");
  b.when("three", "route", high("B"), {raise("sat Go")});
  b.when("two", "route", high("A"), {raise("B")});
  b.when("one", "goal", high("F"), {raise("A")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), (Strings{"one", "two"}));
  const Tick tick = run({{"F", 1.0f}});
  EXPECT_EQ(names(run.program(), tick.fired), (Strings{"three", "run[Go]"}));
  EXPECT_EQ(tick.strategy, cell(run.program(), "Go"));
}

TEST(Levels, StrategiesReadAsTheyRanOnTheLastTickUntilTheControlLevel) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").strategy("Go").satellite("Above").satellite("At_control");
  b.while_true("want", "goal", high("F"), {raise("sat Go")});
  b.while_true("above", "goal", high("Go"), {raise("Above")});
  b.while_true("at_control", "control", high("Go"), {raise("At_control")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), (Strings{"want", "run[Go]"}));
  EXPECT_EQ(run.fired(), (Strings{"above", "run[Go]"}));
}

TEST(Blend, WritersThatAgreeWriteTheValueItself) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").fact("G").satellite("S");
  b.while_true("a", "goal", high("F"), {assign("S", 0.3f)});
  b.while_true("b", "goal", high("G"), {assign("S", 0.3f)});
  b.while_true("c", "goal", high("G"), {assign("S", 0.3f)});
  Trial run(b.build());
  const Tick tick = run({{"F", 0.7f}, {"G", 0.9f}});
  EXPECT_EQ(run.value("S"), 0.3f);
  EXPECT_TRUE(tick.conflicts.empty());
}

TEST(Blend, IsTheMeanWeightedByStrength) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").fact("G").satellite("S");
  b.while_true("a", "goal", high("F"), {assign("S", 1.0f)});
  b.while_true("b", "goal", all({high("G"), high("F")}), {assign("S", 0.2f)});
  Trial run(b.build());
  const Tick tick = run({{"F", 0.9f}, {"G", 0.6f}});
  EXPECT_FLOAT_EQ(run.value("S"), (0.9f * 1.0f + 0.6f * 0.2f) / 1.5f);
  EXPECT_TRUE(tick.conflicts.empty());
  EXPECT_EQ(tick.status, Status::kNoStrategy);
}

TEST(Blend, StrengthIsTheLeastOfAllAndTheMostOfAlternativesAndOneForBits) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").fact("G").fact("H").satellite("S");
  b.while_true("a", "goal", any({high("F"), high("G")}), {assign("S", 1.0f)});                 // 0.8
  b.while_true("b", "goal", all({no(high("H")), seen("G"), zero("H")}), {assign("S", 0.0f)});  // 1 - 0.25
  Trial run(b.build());
  (void)run({{"F", 0.6f}, {"G", 0.8f}, {"H", -0.25f}});
  EXPECT_FLOAT_EQ(run.value("S"), 0.8f / (0.8f + 0.75f));
}

TEST(Contradiction, IsReportedAndLeavesItsRulesArmed) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").fact("G").satellite("S", 0.0f).satellite("T");
  b.when("up", "goal", seen("F"), {raise("S"), raise("T")});
  b.when("down", "goal", seen("G"), {lower("S")});
  Trial run(b.build());
  const RuleId up = rule(run.program(), "up");
  const Tick tick = run({{"F", 1.0f}, {"G", 1.0f}});
  ASSERT_EQ(tick.conflicts.size(), 1u);
  EXPECT_EQ(tick.conflicts[0].cell, cell(run.program(), "S"));
  EXPECT_EQ(names(run.program(), tick.conflicts[0].rules), (Strings{"up", "down"}));
  EXPECT_EQ(tick.status, Status::kConflict);
  EXPECT_EQ(run.value("S"), 0.0f);
  EXPECT_EQ(run.value("T"), 1.0f);  // what nobody contradicts is written
  EXPECT_TRUE(run.interpreter().armed(up));
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"up"});
  EXPECT_EQ(run.value("S"), 1.0f);
  EXPECT_TRUE(run.fired({{"F", 1.0f}}).empty());
}

TEST(Contradiction, ArisesWhenTwoMembersOfAnExclusiveGroupAreRaised) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("A").satellite("B").satellite("C").exclusive({"A", "B", "C"});
  b.when("a", "goal", seen("F"), {raise("A")});
  b.when("b", "goal", seen("F"), {raise("B")});
  Trial run(b.build());
  const Tick tick = run({{"F", 1.0f}});
  EXPECT_EQ(tick.conflicts.size(), 2u);
  EXPECT_EQ(run.value("A"), 0.0f);
  EXPECT_EQ(run.value("B"), 0.0f);
  EXPECT_EQ(run.value("C"), -1.0f);
}

TEST(Contradiction, DoesNotArmARuleThatFiredBefore) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").fact("G").satellite("S");
  b.when("up", "goal", seen("F"), {raise("S")});
  b.when("down", "goal", seen("G"), {lower("S")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"up"});
  const Tick tick = run({{"F", 1.0f}, {"G", 1.0f}});
  EXPECT_EQ(names(run.program(), tick.fired), Strings{"down"});
  EXPECT_TRUE(tick.conflicts.empty());
}

TEST(Reset, WritesEverySatelliteItsInitialValueButTheKept) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("A", 0.25f).satellite("B").satellite("K", -1.0f, true);
  b.when("set", "goal", high("F"), {assign("A", 0.9f), raise("B"), raise("K")});
  b.when("back", "goal", low("F"), {reset_all()});
  Trial run(b.build());
  (void)run({{"F", 1.0f}});
  (void)run({{"F", -1.0f}});
  EXPECT_EQ(run.value("A"), 0.25f);
  EXPECT_EQ(run.value("B"), -1.0f);
  EXPECT_EQ(run.value("K"), 1.0f);
}

TEST(Reset, SilencesItsLevelAndLeavesTheOthersArmed) {
  ProgramBuilder b({"goal", "route", "control"});
  b.fact("F").fact("Abort").satellite("S").satellite("Below");
  b.when("set", "goal", high("F"), {raise("S")});
  b.while_true("abort", "goal", high("Abort"), {reset_all()});
  b.when("below", "route", high("F"), {raise("Below")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}, {"Abort", 1.0f}}), (Strings{"abort", "below"}));
  EXPECT_EQ(run.value("S"), -1.0f);
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"set"});
  EXPECT_EQ(run.value("S"), 1.0f);
}

TEST(Timer, HoldsOnceItsConditionHasHeldForSoLong) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("S");
  b.when("r", "goal", held(high("F"), 300'000), {raise("S")});
  Trial run(b.build());
  EXPECT_TRUE(run.fired({{"F", 1.0f}}).empty());
  EXPECT_TRUE(run.fired({{"F", 1.0f}}).empty());
  EXPECT_TRUE(run.fired({{"F", 1.0f}}, 199'999).empty());
  EXPECT_EQ(run.fired({{"F", 1.0f}}, 1), Strings{"r"});
}

TEST(Timer, BeginsAgainWhenItsConditionFails) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("S");
  b.when("r", "goal", held(high("F"), 200'000), {raise("S")});
  Trial run(b.build());
  (void)run({{"F", 1.0f}});
  (void)run({{"F", 1.0f}});
  (void)run({{"F", 0.0f}});
  EXPECT_TRUE(run.fired({{"F", 1.0f}}).empty());
  EXPECT_TRUE(run.fired({{"F", 1.0f}}).empty());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"r"});
}

TEST(Timer, RunsWhetherOrNotTheRestOfTheRuleHolds) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").fact("G").satellite("S");
  b.when("r", "goal", all({high("G"), held(high("F"), 200'000)}), {raise("S")});
  Trial run(b.build());
  (void)run({{"F", 1.0f}});
  (void)run({{"F", 1.0f}});
  EXPECT_EQ(run.fired({{"F", 1.0f}, {"G", 1.0f}}), Strings{"r"});
}

TEST(Timer, IsOneForEachLevelAndSamplesWhatThatLevelReads) {
  ProgramBuilder b({"goal", "route", "control"});
  b.fact("F").satellite("A").satellite("High").satellite("Low");
  b.when("above", "goal", held(high("A"), 100'000), {raise("High")});
  b.when("raise", "goal", high("F"), {raise("A")});
  b.when("below", "route", held(high("A"), 100'000), {raise("Low")});
  Trial run(b.build());
  EXPECT_EQ(run.fired({{"F", 1.0f}}), Strings{"raise"});
  EXPECT_EQ(run.fired(), Strings{"below"});
  EXPECT_EQ(run.fired(), Strings{"above"});
}

TEST(Timer, GoesByTheTicksOwnClockWhichBeginsAtTheFirstTick) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("S");
  b.when("r", "goal", held(high("F"), 1'000'000), {raise("S")});
  Trial run(b.build());
  EXPECT_EQ(run({{"F", 1.0f}}, 5'000'000).time_us, 0);
  const Tick tick = run({{"F", 1.0f}}, 1'000'000);
  EXPECT_EQ(tick.time_us, 1'000'000);
  EXPECT_EQ(names(run.program(), tick.fired), Strings{"r"});
}

TEST(Tick, NamesTheSatellitesThatChanged) {
  ProgramBuilder b({"goal", "route", "control"});
  b.fact("F").satellite("Up").satellite("Twice").satellite("Same", 1.0f);
  b.when("a", "goal", high("F"), {raise("Up"), raise("Twice"), raise("Same")});
  b.when("b", "route", high("Twice"), {lower("Twice")});
  Trial run(b.build());
  const Tick tick = run({{"F", 1.0f}});
  EXPECT_EQ(tick.set, (std::vector<CellValue>{{cell(run.program(), "Up"), 1.0f}}));
}

TEST(Tick, StartsOverAfterReset) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").strategy("Go").idle("hold");
  b.when("r", "goal", high("F"), {raise("sat Go")});
  Trial run(b.build());
  const Tick first = run({{"F", 1.0f}});
  (void)run();
  run.interpreter().reset();
  EXPECT_EQ(run({{"F", 1.0f}}), first);
}

}  // namespace
}  // namespace kb::program::testing
