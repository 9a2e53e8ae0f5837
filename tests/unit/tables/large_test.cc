// Programs so large that the summaries of the engine's sets have layers (see note [summaries] in runtime/bits.h), beside the
// interpreter; and what a large program is indexed by.
#include <gtest/gtest.h>

#include <string>

#include "compiler/program/interpret.h"
#include "compiler/tables/tables.h"
#include "tests/unit/program/program_builder.h"
#include "tests/unit/stride.h"

namespace kb::tables {
namespace {

using namespace program::testing;
using program::Program;

/// Just over the 32,768 rules, timers, nodes and satellites from which on a summary has three layers.
constexpr int kMany = 32'900;

std::string nth(const char* group, int i) { return group + std::to_string(i); }

/// Rules that sleep, rules that are always awake, timers, nodes, and a reset.
Program many() {
  ProgramBuilder b({"think", "note", "control"});
  b.fact("All").fact("Off");
  for (int i = 0; i < kMany; ++i) {
    b.fact(nth("X", i)).satellite(nth("Y", i));
    const Expression own = seen(nth("X", i));
    b.when(nth("raise", i), "think", all({own, high("All")}), {raise(nth("Y", i))});
    b.when(nth("drop", i), "note", all({no(own), held(any({high(nth("Y", i)), low(nth("X", i))}), 200'000)}), {lower(nth("Y", i))});
  }
  b.when("clear", "think", high("Off"), {reset_all()});
  return b.build();
}

TEST(LargePrograms, DoAsTheInterpreterDoes) {
  const Program program = many();
  const Tables tables = build(program);
  for (const std::uint32_t members : {tables.shape.words * mts::kWordBits, tables.shape.timers, tables.shape.nodes, tables.shape.satellites}) {
    ASSERT_GT(members, 32'768u);
  }
  program::Interpreter oracle(program);
  Machine machine(program, tables);
  std::vector<float> now(program.facts, 0.0f);
  const auto set = [&](const std::string& fact, float value) { now[index(cell(program, fact))] = value; };
  std::size_t fired = 0;
  for (int tick = 0; tick < 30; tick += static_cast<int>(kb::testing::stride())) {
    // Members far apart, in the first and the last word of every summary; `All` wakes what is seen, `Off` clears it.
    for (const int i : {0, 31, 32, 1'023, 1'024, 32'767, 32'768, kMany - 1}) {
      if ((tick + i) % 3 == 0) set(nth("X", i), (tick / 3) % 2 == 0 ? 0.9f : -0.9f);
    }
    set("All", tick % 7 < 3 ? 0.9f : 0.0f);
    set("Off", tick % 13 == 12 ? 0.9f : 0.0f);
    const program::Tick expected = oracle.tick(now, 100'000), got = machine.tick(now, 100'000);
    ASSERT_TRUE(expected == got) << "tick " << tick;
    fired += got.fired.size();
  }
  EXPECT_GT(fired * kb::testing::stride(), 50u);
}

/// Compared each with each, these would take a quarter of a minute.
TEST(LargePrograms, MayWriteOneCellByAllTheirRules) {
  constexpr std::size_t kWriters = 30'000;
  ProgramBuilder b({"think", "control"});
  b.fact("All").satellite("Y");
  for (std::size_t i = 0; i < kWriters; ++i) b.when(nth("raise", static_cast<int>(i)), "think", high("All"), {raise("Y")});
  const Program program = b.build();
  const Tables tables = build(program);
  Machine machine(program, tables);
  static_cast<void>(machine.tick(std::vector<float>{0.0f}, 100'000));
  EXPECT_EQ(machine.tick(std::vector<float>{1.0f}, 100'000).fired.size(), kWriters);
}

/// What a rule sleeps under is its own fact, though `Mode`, one of an exclusive group, is as rare as one can tell: it is
/// shared by all.
TEST(LargePrograms, SleepUnderWhatFewShare) {
  ProgramBuilder b({"think", "control"});
  b.satellite("Mode").satellite("Other").exclusive({"Mode", "Other"});
  b.fact("Go");
  b.when("choose", "think", seen("Go"), {raise("Mode")});
  for (int i = 0; i < 200; ++i) {
    b.fact(nth("X", i)).satellite(nth("Y", i));
    b.when(nth("raise", i), "think", all({high("Mode"), seen(nth("X", i))}), {raise(nth("Y", i))});
  }
  const Program program = b.build();
  const Tables tables = build(program);
  for (std::size_t r = 1; r <= 200; ++r) EXPECT_EQ(tables.origins[tables.rule_key[r]].kind, AtomOrigin::Kind::kSeen);
}

/// Where no rule can sleep, an atom that some read has a list of them: it does not ask all.
TEST(LargePrograms, AskTheReadersWhereAllAreAwake) {
  ProgramBuilder b({"think", "control"});
  b.fact("Some");
  for (int i = 0; i < 4'000; ++i) {
    b.fact(nth("X", i)).satellite(nth("Y", i));
    std::vector<Expression> parts{no(high(nth("X", i)))};
    if (i < 2'000) parts.push_back(no(high("Some")));
    b.when(nth("raise", i), "think", all(parts), {raise(nth("Y", i))});
  }
  const Program program = b.build();
  const Tables tables = build(program);
  const I some = tables.cell_atoms[index(cell(program, "Some"))].high;
  EXPECT_TRUE(tables.broad.empty() || tables.broad[some] == 0);
  EXPECT_EQ(tables.atoms[some + 1].readers - tables.atoms[some].readers, (2'000 + 31) / 32);
}

/// The compiler counts what holds of a condition that is too long to be evaluated again at every change.
TEST(LargePrograms, CountLongConditions) {
  ProgramBuilder b({"think", "control"});
  std::vector<Expression> parts;
  for (int i = 0; i < 300; ++i) {
    b.fact(nth("X", i));
    parts.push_back(seen(nth("X", i)));
  }
  b.satellite("Y").satellite("Z");
  b.when("long", "think", all(parts), {raise("Y")});
  b.when("short", "think", seen("X1"), {raise("Z")});
  const Program program = b.build();
  const Tables tables = build(program);
  EXPECT_EQ(budget(tables, program).counted, 1u);
  program::Interpreter oracle(program);
  Machine machine(program, tables);
  std::vector<float> now(program.facts, 0.0f);
  for (int tick = 0; tick < 320; ++tick) {
    if (tick < 300) now[static_cast<std::size_t>(tick)] = 0.9f;
    else now[static_cast<std::size_t>(tick - 20)] = tick % 2 == 0 ? -0.9f : 0.9f;
    ASSERT_TRUE(oracle.tick(now, 100'000) == machine.tick(now, 100'000)) << "tick " << tick;
  }
  EXPECT_EQ(machine.value(cell(program, "Y")), 1.0f);
}

}  // namespace
}  // namespace kb::tables
