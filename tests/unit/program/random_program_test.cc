#include "tests/unit/program/random_program.h"

#include <gtest/gtest.h>

#include "compiler/program/net_effects.h"
#include "tests/unit/program/program_builder.h"
#include "tests/unit/stride.h"

namespace kb::program::testing {
namespace {

constexpr std::uint64_t kSeeds = 300;
const std::uint64_t kStep = kb::testing::stride();

TEST(RandomProgram, IsTheSameForTheSameSeed) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Program program = random_program(seed);
    EXPECT_EQ(print(program), print(random_program(seed)));
    EXPECT_EQ(random_trace(program, seed, 5).back().dt_us, random_trace(program, seed, 5).back().dt_us);
  }
}

TEST(RandomProgram, OnesTogetherDoWhatAProgramCan) {
  std::size_t fired = 0, conflicts = 0, events = 0, resets = 0, silent = 0, held = 0, bad = 0, switched_off = 0;
  for (std::uint64_t seed = 0; seed < kSeeds; ++seed) {
    const Program program = random_program(seed);
    Interpreter interpreter(program);
    for (const Step& step : random_trace(program, seed, 40)) {
      const Tick tick = interpreter.tick(step.facts, step.dt_us);
      fired += tick.fired.size();
      conflicts += tick.conflicts.size();
      events += tick.events.size() + tick.lost.size();
      held += tick.status == Status::kHolding || tick.status == Status::kHoldExpired ? 1 : 0;
      bad += tick.bad_facts;
      silent += tick.fired.empty() ? 1 : 0;
      for (const RuleId id : tick.fired) {
        resets += program[id].reset ? 1 : 0;
        switched_off += program[id].mode == Mode::kWhen && interpreter.armed(id) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(fired, 20'000u);
  EXPECT_GT(conflicts, 2'000u);
  EXPECT_GT(events, 2'000u);
  EXPECT_GT(resets, 20u);
  EXPECT_GT(silent, 500u);
  EXPECT_GT(held, 150u);
  EXPECT_GT(bad, 50u);
  EXPECT_GT(switched_off, 500u);
}

/// What can be said of every tick of every program.
TEST(RandomProgram, EveryTickKeepsThePromisesOfTheModel) {
  for (std::uint64_t seed = 0; seed < kSeeds; seed += kStep) {
    const Program program = random_program(seed);
    Interpreter interpreter(program);
    for (const Step& step : random_trace(program, seed, 40)) {
      const Tick tick = interpreter.tick(step.facts, step.dt_us);
      ASSERT_LE(tick.active.size(), 1u) << "seed " << seed;
      ASSERT_TRUE(std::is_sorted(tick.fired.begin(), tick.fired.end())) << "seed " << seed;
      for (std::uint32_t i = 0; i < program.cells.size(); ++i) {
        const float value = interpreter.value(CellId{i});
        ASSERT_TRUE(value >= -1.0f && value <= 1.0f) << "seed " << seed;
      }
      for (const std::vector<CellId>& group : program.exclusive) {
        if (program[group.front()].kind != CellKind::kSatellite) continue;
        std::size_t raised_by_rules = 0;
        for (const CellId member : group) {
          const bool changed =
              std::any_of(tick.set.begin(), tick.set.end(), [&](const CellValue& c) { return c.cell == member; });
          raised_by_rules += changed && interpreter.value(member) == 1.0f ? 1 : 0;
        }
        ASSERT_LE(raised_by_rules, 1u) << "seed " << seed;
      }
    }
  }
}

}  // namespace
}  // namespace kb::program::testing
