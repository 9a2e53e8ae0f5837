#include "compiler/analysis/satisfier.h"

#include <gtest/gtest.h>

#include "tests/unit/program/program_builder.h"
#include "tests/unit/program/random_program.h"

namespace kb::analysis {
namespace {

using namespace program::testing;
using program::Program;

/// Facts F, exclusive In.N, In.S; satellites A, B, C exclusive, X that nothing sets, Y; strategies U, V.
ProgramBuilder cells(double firing = 0.5) {
  ProgramBuilder b({"goal", "control"});
  b.settings.firing = firing;
  b.fact("F").fact("In.N").fact("In.S").exclusive({"In.N", "In.S"});
  b.satellite("A").satellite("B").satellite("C").exclusive({"A", "B", "C"}).satellite("X").satellite("Y");
  b.strategy("U").strategy("V");
  b.when("wantU", "goal", high("F"), {raise("sat U")});
  for (const char* name : {"A", "B", "C", "Y"}) {
    b.when(std::string("up") + name, "goal", high("F"), {raise(name)});
    b.when(std::string("down") + name, "goal", low("F"), {lower(name)});
  }
  return b;
}

Answer possible(const Expression& condition, double firing = 0.5, std::uint32_t level = 0) {
  ProgramBuilder b = cells(firing);
  b.when("asked", "goal", condition, {raise("Y")});
  const Program program = b.build();
  const Domains domains = find_domains(program);
  Satisfier satisfier(program, domains);
  const Goal goal{program[program::testing::rule(program, "asked")].condition, true};
  return satisfier.together({&goal, 1}, level);
}

TEST(Satisfier, KnowsThatTermsOverlapOnlyAsFiringLetsThem) {
  EXPECT_EQ(possible(all({high("F"), low("F")})), Answer::kNo);
  EXPECT_EQ(possible(all({high("F"), zero("F")})), Answer::kYes);  // at 0.5 exactly
  EXPECT_EQ(possible(all({high("F"), zero("F")}), 0.6), Answer::kNo);
  EXPECT_EQ(possible(all({no(high("F")), no(low("F")), no(zero("F"))})), Answer::kNo);
  EXPECT_EQ(possible(all({no(high("F")), no(low("F")), no(zero("F"))}), 0.6), Answer::kYes);
}

TEST(Satisfier, KnowsThatOneMemberOfAnExclusiveGroupIsHigh) {
  EXPECT_EQ(possible(all({high("A"), high("B")})), Answer::kNo);
  EXPECT_EQ(possible(all({high("A"), no(high("B"))})), Answer::kYes);
  EXPECT_EQ(possible(all({high("In.N"), high("In.S")})), Answer::kNo);
  EXPECT_EQ(possible(all({seen("In.N"), event("In.S")})), Answer::kNo);
  EXPECT_EQ(possible(all({high("U"), high("V")})), Answer::kNo);
}

TEST(Satisfier, KnowsHowSightingsHangTogether) {
  EXPECT_EQ(possible(all({event("F"), no(seen("F"))})), Answer::kNo);
  EXPECT_EQ(possible(all({lost("F"), seen("F")})), Answer::kNo);
  EXPECT_EQ(possible(all({lost("F"), event("F")})), Answer::kNo);
  EXPECT_EQ(possible(all({seen("F"), no(event("F"))})), Answer::kYes);
  EXPECT_EQ(possible(all({seen("F"), low("F")})), Answer::kNo);
  EXPECT_EQ(possible(all({no(seen("F")), high("F")})), Answer::kYes);  // 0.6, unattended
}

TEST(Satisfier, KnowsThatWhatHasHeldHolds) {
  EXPECT_EQ(possible(all({held(high("F"), 100), low("F")})), Answer::kNo);
  EXPECT_EQ(possible(all({no(held(high("F"), 100)), high("F")})), Answer::kYes);
  EXPECT_EQ(possible(all({no(held(high("F"), 0)), high("F")})), Answer::kNo);
}

TEST(Satisfier, KnowsThatAnEventDoesNotLast) {
  EXPECT_EQ(possible(held(event("F"), 1)), Answer::kNo);
  EXPECT_EQ(possible(held(all({lost("F"), high("Y")}), 100)), Answer::kNo);
  EXPECT_EQ(possible(held(event("F"), 0)), Answer::kYes);
  EXPECT_EQ(possible(held(any({event("F"), seen("F")}), 100)), Answer::kYes);
  EXPECT_EQ(possible(no(held(event("F"), 1))), Answer::kYes);
}

TEST(Satisfier, KnowsWhatNoRuleEverWrites) {
  EXPECT_EQ(possible(high("X")), Answer::kNo);
  EXPECT_EQ(possible(high("Y")), Answer::kYes);
}

TEST(Satisfier, KnowsThatNoStrategyRunsYetOnTheControlLevel) {
  EXPECT_EQ(possible(high("U"), 0.5, 0), Answer::kYes);
  EXPECT_EQ(possible(high("U"), 0.5, 1), Answer::kNo);
  EXPECT_EQ(possible(high("V"), 0.5, 0), Answer::kNo) << "nobody wants it";
}

TEST(Satisfier, SearchesAlternatives) {
  EXPECT_EQ(possible(all({any({high("A"), high("B")}), no(high("A")), any({low("Y"), high("C")})})), Answer::kYes);
  EXPECT_EQ(possible(all({any({high("A"), high("B")}), no(high("A")), high("C")})), Answer::kNo);
  EXPECT_EQ(possible(all({any({high("A"), high("B")}), any({high("B"), high("C")}), any({high("A"), high("C")})})),
            Answer::kNo);
  EXPECT_EQ(possible(all({no(all({high("F"), high("Y")})), high("F"), high("Y")})), Answer::kNo);
  EXPECT_EQ(possible(any({})), Answer::kNo);
  EXPECT_EQ(possible(no(all({}))), Answer::kNo);
}

/// What the interpreter saw happen the satisfier must not call impossible.
TEST(Satisfier, NeverRulesOutWhatHappens) {
  std::size_t asked = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Program program = random_program(seed);
    const bool promised = std::any_of(program.exclusive.begin(), program.exclusive.end(), [&](const auto& group) {
      return program[group.front()].kind == program::CellKind::kFact;
    });
    if (promised) continue;  // random facts keep no promise
    const Domains domains = find_domains(program);
    Satisfier satisfier(program, domains);
    program::Interpreter interpreter(program);
    for (const Step& step : random_trace(program, seed, 25)) {
      const program::Tick tick = interpreter.tick(step.facts, step.dt_us);
      for (std::size_t i = 0; i + 1 < tick.fired.size(); ++i) {
        const program::Rule& a = program[tick.fired[i]];
        const program::Rule& b = program[tick.fired[i + 1]];
        if (a.level != b.level || a.level + 1 == program.levels.size()) continue;
        const Goal goals[] = {{a.condition, true}, {b.condition, true}};
        ++asked;
        ASSERT_NE(satisfier.together(goals, a.level), Answer::kNo)
            << "seed " << seed << ": " << a.name << " and " << b.name << "\n"
            << print(program);
        ASSERT_TRUE(compatible(satisfier.demands(a.condition, a.level), satisfier.demands(b.condition, b.level)))
            << "seed " << seed;
      }
    }
  }
  EXPECT_GT(asked, 2'000u);
}

}  // namespace
}  // namespace kb::analysis
