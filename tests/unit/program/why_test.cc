#include "compiler/program/why.h"

#include <gtest/gtest.h>

#include "tests/unit/program/program_builder.h"
#include "tests/unit/program/random_program.h"

namespace kb::program::testing {
namespace {

using Facts = std::map<std::string, float>;

/// Runs `ticks` (100 ms apart) and answers for the last.
class Asked {
 public:
  Asked(const ProgramBuilder& builder, const std::vector<Facts>& ticks)
      : program_(builder.build()), recorder_(program_, ticks.size()) {
    Interpreter interpreter(program_);
    interpreter.observe(&recorder_);
    for (const Facts& values : ticks) {
      recorder_.tick_ended(interpreter.tick(facts(program_, values), 100'000), interpreter);
    }
  }
  [[nodiscard]] std::string rule_text(const std::string& name) const { return story(name).text; }
  [[nodiscard]] RuleStory story(const std::string& name) const {
    return explain_rule(program_, recorder_.record(), rule(program_, name));
  }
  [[nodiscard]] std::string cell_text(const std::string& name) const {
    return explain_cell(program_, recorder_.record(), cell(program_, name)).text;
  }
  [[nodiscard]] std::string strategy_text(const std::string& name) const {
    return explain_strategy(program_, recorder_.record(), cell(program_, name)).text;
  }

 private:
  Program program_;
  Recorder recorder_;
};

ProgramBuilder crossing() {
  ProgramBuilder b({"goal", "control"});
  b.fact("Safe").fact("Line").satellite("Gate", 1.0f).satellite("Other").strategy("Stop").strategy("Cross");
  b.when("enter", "goal", all({high("Gate"), high("Safe"), held(high("Gate"), 300'000)}), {raise("sat Cross")});
  b.when("line", "goal", event("Line"), {raise("Other")});
  b.when("seen", "goal", seen("Line"), {raise("Other")});
  b.when("clear", "goal", no(seen("Line")), {lower("Other")});
  b.while_true("abort", "goal", low("Safe"), {reset_all()});
  return b;
}

TEST(Why, NamesWhatFailsWithNumbersAndThatAllElseHolds) {
  const Asked asked(crossing(), {{}, {}, {}, {{"Safe", 0.1f}}});
  EXPECT_EQ(asked.rule_text("enter"), "`enter` did not fire at tick 4: `Safe` is 0.10, needs 0.50; all else holds");
  const RuleStory story = asked.story("enter");
  ASSERT_EQ(story.reasons.size(), 3u);
  EXPECT_TRUE(story.reasons[0].holds);
  EXPECT_EQ(story.reasons[0].text, "`Gate` is 1.00");
  EXPECT_EQ(story.reasons[2].text, "`Gate` held for 0.30 s (asked: 0.30 s)");
}

TEST(Why, ShowsAsManyDigitsAsItTakesToTellTheNumbersApart) {
  const Asked asked(crossing(), {{}, {}, {}, {{"Safe", 0.4999f}}});
  EXPECT_EQ(asked.rule_text("enter"), "`enter` did not fire at tick 4: `Safe` is 0.4999, needs 0.5; all else holds");
}

TEST(Why, SaysHowLongATimerHasHeld) {
  const Asked asked(crossing(), {{}, {{"Safe", 1.0f}}});
  EXPECT_EQ(asked.rule_text("enter"),
            "`enter` did not fire at tick 2: `Gate` held for 0.10 s of 0.30 s; all else holds");
}

TEST(Why, TellsATimeThatIsNearlyOverFromTheWhole) {
  ProgramBuilder b({"goal", "control"});
  b.fact("A").satellite("S");
  b.when("late", "goal", held(high("A"), 200'001), {raise("S")});
  EXPECT_EQ(Asked(b, {{{"A", 1.0f}}, {{"A", 1.0f}}, {{"A", 1.0f}}}).rule_text("late"),
            "`late` did not fire at tick 3: `A` held for 0.2 s of 0.200001 s");
}

TEST(Why, TellsACellThatIsNearlyHighFromOneThatIs) {
  ProgramBuilder b({"goal", "control"});
  b.satellite("Nearly", 0.499f).satellite("Hardly", -0.003f);
  const Asked asked(b, {{}});
  EXPECT_EQ(asked.cell_text("Nearly"), "`Nearly` is 0.499 after tick 1: no rule has written it since the start");
  EXPECT_EQ(asked.cell_text("Hardly"), "`Hardly` is 0.00 after tick 1: no rule has written it since the start");
}

TEST(Why, SaysWhenARuleIsNotArmed) {
  const Asked asked(crossing(), {{}, {{"Line", 1.0f}}, {{"Line", 1.0f}}, {{"Line", 1.0f}}});
  EXPECT_EQ(
      asked.rule_text("seen"),
      "`seen` did not fire at tick 4: it is not armed, for it has fired at tick 2 and its condition was not found false since");
}

TEST(Why, SaysWhenAResetSilencedTheLevel) {
  const Asked asked(crossing(), {{}, {{"Line", 1.0f}, {"Safe", -1.0f}}});
  EXPECT_EQ(asked.rule_text("seen"),
            "`seen` did not fire at tick 2: its condition holds, but the `reset` of `abort` silenced level `goal`");
  EXPECT_EQ(asked.rule_text("abort"), "`abort` fired at tick 2");
}

TEST(Why, TellsSightingsWithTheThresholdInForce) {
  EXPECT_EQ(Asked(crossing(), {{}, {{"Line", 0.6f}}}).rule_text("line"),
            "`line` did not fire at tick 2: `Line` is not seen, at 0.60, needs above 0.75");
  EXPECT_EQ(Asked(crossing(), {{}, {{"Line", 1.0f}}, {{"Line", 0.5f}}}).rule_text("seen"),
            "`seen` did not fire at tick 3: `Line` went out of view, at 0.50, needs above 0.50");
  EXPECT_EQ(Asked(crossing(), {{}, {{"Line", 1.0f}}, {{"Line", 1.0f}}}).rule_text("line"),
            "`line` did not fire at tick 3: `Line` is seen, at 1.00, but it was seen before");
  EXPECT_EQ(Asked(crossing(), {{{"Line", 1.0f}}}).rule_text("line"),
            "`line` did not fire at tick 1: `Line` is seen, at 1.00, but the first tick makes no events");
}

TEST(Why, SaysWhatIsNeededWhereSomethingMustNotBe) {
  EXPECT_EQ(Asked(crossing(), {{}, {{"Line", 1.0f}}, {{"Line", 0.6f}}}).rule_text("clear"),
            "`clear` did not fire at tick 3: `Line` is seen, at 0.60, must not be above 0.50");
  ProgramBuilder b({"goal", "control"});
  b.fact("A").fact("B").satellite("S");
  b.when("none", "goal", no(any({high("A"), high("B")})), {raise("S")});
  b.when("brief", "goal", no(held(high("A"), 100'000)), {raise("S")});
  b.when("left", "goal", lost("A"), {raise("S")});
  const Asked asked(b, {{}, {{"A", 0.9f}}, {{"A", 0.9f}, {"B", 0.8f}}});
  EXPECT_EQ(asked.rule_text("none"),
            "`none` did not fire at tick 3: `A` is 0.90, must be below 0.50; `B` is 0.80, must be below 0.50");
  EXPECT_EQ(asked.rule_text("brief"), "`brief` did not fire at tick 3: `A` held for 0.10 s, must be less than 0.10 s");
  EXPECT_EQ(asked.rule_text("left"),
            "`left` did not fire at tick 3: `A` is seen, at 0.90, but must go out of view");
  EXPECT_EQ(Asked(b, {{}, {{"A", 0.9f}}}).rule_text("left"),
            "`left` did not fire at tick 2: `A` came into view, at 0.90, but must go out of view");
}

TEST(Why, SaysWhenARuleWasContradicted) {
  ProgramBuilder b({"goal", "control"});
  b.fact("F").satellite("S");
  b.when("up", "goal", seen("F"), {raise("S")});
  b.when("down", "goal", seen("F"), {lower("S")});
  const Asked asked(b, {{{"F", 1.0f}}});
  EXPECT_EQ(asked.story("up").outcome, Outcome::kFiredContradicted);
  EXPECT_EQ(asked.cell_text("S"),
            "`S` is 0.00 after tick 1: last written at tick 1 by `up` (1.00), `down` (-1.00), which were not of one mind");
}

TEST(Why, SaysWhoWroteACellLast) {
  const Asked asked(crossing(), {{}, {{"Line", 1.0f}}, {{"Line", 1.0f}}});
  EXPECT_EQ(asked.cell_text("Other"), "`Other` is 1.00 after tick 3: last written at tick 2 by `line`, `seen`");
  EXPECT_EQ(asked.cell_text("Gate"), "`Gate` is 1.00 after tick 3: no rule has written it since the start");
  EXPECT_EQ(asked.cell_text("Line"), "`Line` is 1.00 after tick 3: given from outside; it is seen");
}

TEST(Why, SaysWhyAStrategyDidNotRun) {
  ProgramBuilder b({"goal", "control"});
  b.fact("a").fact("b").strategy("Stop").strategy("Go");
  b.while_true("stop", "goal", high("a"), {raise("sat Stop")});
  b.while_true("go", "goal", high("b"), {raise("sat Go")});
  const Asked asked(b, {{{"a", 1.0f}, {"b", 1.0f}}});
  EXPECT_EQ(asked.strategy_text("Stop"), "`Stop` ran at tick 1: it is wanted, and nothing before it is");
  EXPECT_EQ(asked.strategy_text("Go"),
            "`Go` did not run at tick 1: `sat Stop` is 1.00, must be below 0.50; all else holds");
}

/// The story of every rule agrees with what the interpreter did, and false rules have a false reason.
TEST(Why, AgreesWithTheInterpreterOnRandomPrograms) {
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Program program = random_program(seed);
    Interpreter interpreter(program);
    const std::uint64_t wanted = 1 + seed % 12;
    Recorder recorder(program, wanted);
    interpreter.observe(&recorder);
    for (const Step& step : random_trace(program, seed, wanted)) {
      recorder.tick_ended(interpreter.tick(step.facts, step.dt_us), interpreter);
    }
    const std::vector<RuleId>& fired = recorder.record().tick.fired;
    for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
      const RuleStory story = explain_rule(program, recorder.record(), RuleId{i});
      const bool did = std::find(fired.begin(), fired.end(), RuleId{i}) != fired.end();
      ASSERT_EQ(did, story.outcome == Outcome::kFired || story.outcome == Outcome::kFiredContradicted)
          << "seed " << seed;
      const bool all_hold =
          std::all_of(story.reasons.begin(), story.reasons.end(), [](const Reason& r) { return r.holds; });
      ASSERT_EQ(all_hold, story.outcome != Outcome::kFalse) << "seed " << seed;
      for (const Reason& reason : story.reasons) ASSERT_FALSE(reason.text.empty());
    }
  }
}

}  // namespace
}  // namespace kb::program::testing
