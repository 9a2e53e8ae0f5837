// The tables and the interpreter give the same trace, for random knowledge bases and random days.
#include <gtest/gtest.h>

#include "compiler/program/interpret.h"
#include "compiler/tables/tables.h"
#include "tests/unit/program/random_program.h"

namespace kb::tables {
namespace {

using program::Interpreter;
using program::Program;
using program::Tick;
using program::testing::count_from;

::testing::AssertionResult agree(const Program& program, std::uint64_t seed, std::size_t ticks,
                                   const Limits& limits = {}) {
  const Tables tables = build(program, limits);
  Interpreter oracle(program);
  Machine machine(program, tables);
  std::size_t n = 0;
  for (const auto& step : program::testing::random_trace(program, seed, ticks)) {
    ++n;
    const Tick expected = oracle.tick(step.facts, step.dt_us);
    const Tick got = machine.tick(step.facts, step.dt_us);
    if (expected == got) {
      bool same = true;
      for (std::size_t i = 0; i < program.cells.size(); ++i) {
        const program::CellId cell{static_cast<std::uint32_t>(i)};
        same = same && oracle.value(cell) == machine.value(cell);
      }
      if (same) continue;
    }
    return ::testing::AssertionFailure() << "seed " << seed << ", tick " << n << "\ninterpreter: "
                                         << print_json(program, expected) << "\ntables:      "
                                         << print_json(program, got) << "\nprogram:\n" << program::print(program);
  }
  return ::testing::AssertionSuccess();
}

TEST(TablesAndInterpreter, GiveTheSameTraceForRandomKnowledgeBases) {
  const std::uint64_t first = count_from("KB_RANDOM_SEED", 1);
  const std::uint64_t count = count_from("KB_RANDOM_COUNT", 2'000);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    const Program program = program::testing::random_program(seed);
    ASSERT_TRUE(agree(program, seed, 40));
    if (seed % 4 == 0) {
      ASSERT_TRUE(agree(program, seed, 40, {.large_group = 2, .broad = 0})) << "as if it were large";
    }
    if (seed % 4 == 1) {
      ASSERT_TRUE(agree(program, seed, 40, {.longest = 1, .crowd = 1})) << "with every condition counted";
    }
    if (seed % 4 == 2) {
      ASSERT_TRUE(agree(program, seed, 40, {.broad = 0, .crowd = 0})) << "with other keys";
    }
  }
}

TEST(TablesAndInterpreter, StartAgainTheSameAfterAReset) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Program program = program::testing::random_program(seed);
    const Tables tables = build(program);
    Machine used(program, tables), fresh(program, tables);
    for (const auto& step : program::testing::random_trace(program, seed, 30)) (void)used.tick(step.facts, step.dt_us);
    used.reset();
    for (const auto& step : program::testing::random_trace(program, seed + 1000, 30)) {
      ASSERT_EQ(used.tick(step.facts, step.dt_us), fresh.tick(step.facts, step.dt_us)) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace kb::tables
