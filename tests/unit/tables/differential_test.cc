// The tables and the interpreter give the same trace, for random knowledge bases and random days.
#include <gtest/gtest.h>

#include <deque>
#include <iterator>
#include <vector>

#include "compiler/program/interpret.h"
#include "compiler/tables/tables.h"
#include "tests/unit/program/random_program.h"

namespace kb::tables {
namespace {

using program::Interpreter;
using program::Program;
using program::Tick;
using program::testing::count_from;

/// A way to lay out the tables.
struct Form {
  const char* name;
  Limits limits;
};

/// The way of the compiler, and for one program in eight each of those that it keeps for larger ones.
std::vector<Form> forms_for(std::uint64_t seed) {
  static const Form others[] = {{"as if it were large", {.large_group = 2, .broad = 0}},
                                {"with every condition counted", {.longest = 1, .crowd = 1}},
                                {"with other keys", {.broad = 0, .crowd = 0}}};
  std::vector<Form> forms = {{"as it is", {}}};
  if (seed % 8 < std::size(others)) forms.push_back(others[seed % 8]);
  return forms;
}

bool same_values(const Program& program, const Interpreter& oracle, const Machine& machine) {
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) {
    if (oracle.value(program::CellId{i}) != machine.value(program::CellId{i})) return false;
  }
  return true;
}

::testing::AssertionResult agree(const Program& program, std::uint64_t seed, std::size_t ticks) {
  const std::vector<Form> forms = forms_for(seed);
  std::deque<Tables> tables;
  std::deque<Machine> machines;   // they do not move
  for (const Form& form : forms) machines.emplace_back(program, tables.emplace_back(build(program, form.limits)));
  Interpreter oracle(program);
  std::size_t n = 0;
  for (const auto& step : program::testing::random_trace(program, seed, ticks)) {
    ++n;
    const Tick expected = oracle.tick(step.facts, step.dt_us);
    for (std::size_t i = 0; i < forms.size(); ++i) {
      const Tick got = machines[i].tick(step.facts, step.dt_us);
      if (expected == got && same_values(program, oracle, machines[i])) continue;
      return ::testing::AssertionFailure() << "seed " << seed << ", tick " << n << ", tables " << forms[i].name << "\ninterpreter: "
                                           << print_json(program, expected) << "\ntables:      " << print_json(program, got)
                                           << "\nprogram:\n" << program::print(program);
    }
  }
  return ::testing::AssertionSuccess();
}

TEST(TablesAndInterpreter, GiveTheSameTraceForRandomKnowledgeBases) {
  const std::uint64_t first = count_from("KB_RANDOM_SEED", 1);
  const std::uint64_t count = count_from("KB_RANDOM_COUNT", 2'000);
  for (std::uint64_t seed = first; seed < first + count; ++seed) {
    ASSERT_TRUE(agree(program::testing::random_program(seed), seed, 40));
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
