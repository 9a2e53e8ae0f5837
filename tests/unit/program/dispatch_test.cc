// Which strategy runs: the control level's rules, idle policies, and the status of a tick.
#include <gtest/gtest.h>

#include "compiler/program/conditions.h"
#include "tests/unit/program/program_builder.h"

namespace kb::program::testing {
namespace {

/// Strategies A > B > C, each wanted while its fact of the small letter is high.
ProgramBuilder three() {
  ProgramBuilder b({"goal", "control"});
  b.settings.hold_limit_us = 250'000;
  for (const std::string name : {"A", "B", "C"}) {
    const std::string want = name == "A" ? "a" : name == "B" ? "b" : "c";
    b.fact(want).strategy(name);
    b.while_true("want_" + want, "goal", high(want), {raise("sat " + name)});
    b.while_true("drop_" + want, "goal", no(high(want)), {lower("sat " + name)});
  }
  return b;
}

std::string ran(Trial& run, const std::map<std::string, float>& values) {
  const Tick tick = run(values);
  return std::string(tick.strategy == CellId::kNone ? "-" : run.program()[tick.strategy].name) + " " + status_text(tick.status);
}

TEST(Dispatch, TheHighestThatIsWantedRunsAlone) {
  Trial run(three().build());
  EXPECT_EQ(ran(run, {{"c", 1.0f}}), "C ok");
  EXPECT_EQ(ran(run, {{"b", 1.0f}, {"c", 1.0f}}), "B ok");
  EXPECT_EQ(run({{"a", 1.0f}, {"b", 1.0f}, {"c", 1.0f}}).active.size(), 1u);
  EXPECT_EQ(ran(run, {}), "- no_strategy");
}

TEST(Dispatch, AnySatelliteOfAStrategyCallsForIt) {
  ProgramBuilder b({"goal", "control"});
  b.strategy("Stop").strategy("Go").satellite("Gate").of("Gate", "Stop");
  Trial run(b.build());
  run.interpreter().poke(cell(run.program(), "sat Go"), 1.0f);
  EXPECT_EQ(ran(run, {}), "Go ok");
  run.interpreter().poke(cell(run.program(), "Gate"), 1.0f);
  EXPECT_EQ(ran(run, {}), "Stop ok");
}

TEST(Dispatch, HoldGoesOnForALimitedTime) {
  ProgramBuilder b = three();
  b.idle("hold");
  Trial run(b.build());
  EXPECT_EQ(ran(run, {}), "- no_strategy");
  EXPECT_EQ(ran(run, {{"b", 1.0f}}), "B ok");
  EXPECT_EQ(ran(run, {}), "B holding");       // 100 ms
  EXPECT_EQ(ran(run, {}), "B holding");       // 200 ms
  EXPECT_EQ(ran(run, {}), "- hold_expired");  // 300 ms > 250 ms
  EXPECT_EQ(ran(run, {}), "- hold_expired");
  EXPECT_EQ(ran(run, {{"c", 1.0f}}), "C ok");
  EXPECT_EQ(ran(run, {}), "C holding");
}

TEST(Dispatch, NamedStrategyRunsWhenNoneIsActive) {
  ProgramBuilder b = three();
  b.idle("C");
  Trial run(b.build());
  EXPECT_EQ(ran(run, {}), "C no_strategy");
  EXPECT_EQ(ran(run, {{"a", 1.0f}}), "A ok");
  EXPECT_EQ(ran(run, {}), "C no_strategy");
}

TEST(Dispatch, TwoActiveStrategiesAreAFaultThatPrioritySettles) {
  // Only a program that was not made by the compiler can do that: here one without conditions on those before.
  Program program = three().build();
  for (Rule& rule : program.rules) {
    if (rule.name == "run[C]") rule.condition = program[rule.condition].children.front();
  }
  ASSERT_TRUE(verify(program).empty());
  Interpreter interpreter(program);
  const Tick tick = interpreter.tick(facts(program, {{"b", 1.0f}, {"c", 1.0f}}), 0);
  EXPECT_EQ(tick.strategy, cell(program, "B"));
  EXPECT_EQ(tick.active, (std::vector<CellId>{cell(program, "B"), cell(program, "C")}));
  EXPECT_EQ(tick.status, Status::kTwoStrategies);
}

TEST(ControlRules, AreWrittenOutForFewStrategies) {
  const Program program = three().build();
  EXPECT_EQ(print_condition(program, program[rule(program, "run[A]")].condition), "sat A");
  EXPECT_EQ(print_condition(program, program[rule(program, "run[C]")].condition), "sat C and not sat A and not sat B");
}

TEST(ControlRules, ShareTheirConditionsWhereStrategiesAreMany) {
  ProgramBuilder b({"control"});
  constexpr int kMany = 3000;
  for (int i = 0; i < kMany; ++i) b.strategy("U" + std::to_string(i));
  Trial run(b.build());
  std::size_t parts = 0;
  for (const Cond& cond : run.program().conds) parts += cond.children.size();
  EXPECT_LT(parts, std::size_t{kMany} * 70);
  for (const int wanted : {2999, 2048, 1024, 1023, 33, 32, 31, 0}) {
    run.interpreter().poke(cell(run.program(), "sat U" + std::to_string(wanted)), 1.0f);
    const Tick tick = run();
    EXPECT_EQ(tick.strategy, cell(run.program(), "U" + std::to_string(wanted)));
    EXPECT_EQ(tick.active.size(), 1u);
  }
}

}  // namespace
}  // namespace kb::program::testing
