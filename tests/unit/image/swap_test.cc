// A running engine takes another image between two ticks.
#include <waymark/runtime/swap.h>

#include <gtest/gtest.h>

#include <algorithm>

#include "compiler/tables/tables.h"
#include "tests/unit/image/running.h"
#include "tests/unit/program/program_builder.h"
#include "tests/unit/program/random_program.h"
#include "tests/unit/stride.h"

namespace kb::tables {
namespace {

using testing::many_facts;
using testing::Running;
using testing::swapped;

constexpr std::uint64_t kPrograms = 200;
const std::uint64_t kStep = kb::testing::stride();
constexpr std::size_t kTicks = 30;

/// Runs a day twice, once with a swap to the same image after every tick for which `swaps` says so.
template <class Swaps>
void expect_the_same_day(std::uint64_t seed, const Limits& limits, Swaps swaps) {
  const program::Program program = program::testing::random_program(seed);
  const LoadedImage image(write_image(build(program, limits), program));
  ASSERT_EQ(image.status(), mts::ImageStatus::kOk) << mts::text(image.status()) << ", seed " << seed;
  image.visit([&]<class I>(const mts::Image<I>& view) {
    Running<I> calm(view);
    calm.engine().reset();
    auto swapping = std::make_unique<Running<I>>(view);
    swapping->engine().reset();
    std::size_t tick = 0;
    for (const auto& step : program::testing::random_trace(program, seed, kTicks)) {
      if (swaps(tick)) {
        mts::SwapReport report;
        swapping = swapped(*swapping, view, report);
        EXPECT_EQ(report.told, 0u);
        EXPECT_EQ(report.facts.lost + report.satellites.lost + report.strategies.lost + report.rules.lost + report.timers.lost, 0u);
        EXPECT_EQ(report.facts.fresh + report.satellites.fresh + report.strategies.fresh + report.rules.fresh + report.timers.fresh, 0u);
      }
      calm.tick(step.facts, step.dt_us);
      swapping->tick(step.facts, step.dt_us);
      ASSERT_EQ(swapping->trace(), calm.trace()) << "seed " << seed << ", tick " << tick << "\n" << program::print(program);
      ++tick;
    }
  });
}

TEST(Swap, ToTheSameImageAtEveryTickChangesNothing) {
  for (std::uint64_t seed = 1; seed <= kPrograms; seed += kStep) {
    expect_the_same_day(seed, {}, [](std::size_t) { return true; });
    expect_the_same_day(seed, {.large_group = 2, .broad = 0}, [](std::size_t) { return true; });
    if (HasFatalFailure()) return;
  }
}

TEST(Swap, ToTheSameImageAtAnyOneTickChangesNothing) {
  for (std::uint64_t seed = 1; seed <= kPrograms / 10; seed += kStep) {
    for (std::size_t at = 0; at < kTicks; ++at) {
      expect_the_same_day(seed, {}, [at](std::size_t tick) { return tick == at; });
      if (HasFatalFailure()) return;
    }
  }
}

/// Calls `then` with an engine on the image of one knowledge base, begun afresh, and with the image of another.
template <class Then>
void with_swap(const program::Program& old, const program::Program& now, Then then) {
  const LoadedImage from(write_image(build(old), old)), to(write_image(build(now), now));
  ASSERT_EQ(to.status(), mts::ImageStatus::kOk) << mts::text(to.status());
  from.visit([&]<class I>(const mts::Image<I>& from_view) {
    to.visit([&]<class J>(const mts::Image<J>& to_view) {
      Running<I> before(from_view);
      before.engine().reset();
      then(before, to_view);
    });
  });
}

/// The same knowledge base without its `nth` rule (not one of those that run strategies).
program::Program without_rule(program::Program program, std::size_t nth) {
  program.rules.erase(program.rules.begin() + static_cast<std::ptrdiff_t>(nth % program.rules.size()));
  return program;
}

TEST(Swap, ToAKnowledgeBaseWithoutARuleCarriesAllElse) {
  for (std::uint64_t seed = 1; seed <= kPrograms; seed += kStep) {
    const program::Program program = program::testing::random_program(seed);
    const program::Program changed = without_rule(program, seed);
    SCOPED_TRACE("seed " + std::to_string(seed));
    with_swap(program, changed, [&](auto& before, const auto& to) {
      const auto day = program::testing::random_trace(program, seed, kTicks);
      for (std::size_t i = 0; i < kTicks / 2; ++i) before.tick(day[i].facts, day[i].dt_us);
      mts::SwapReport report;
      const auto after = swapped(before, to, report);
      for (std::uint32_t c = 0; c < before.image.tables.shape.cells(); ++c) ASSERT_EQ(after->state.cf[c], before.state.cf[c]) << "seed " << seed;
      EXPECT_EQ(report.rules.lost, 1u);
      EXPECT_EQ(report.rules.carried, program.rules.size() - 1);
      EXPECT_EQ(after->state.ticks, before.state.ticks);
      EXPECT_EQ(after->state.now_us, before.state.now_us);
      // What was carried is consistent: carried on once more, it goes the same way.
      mts::SwapReport again;
      const auto twice = swapped(*after, to, again);
      EXPECT_EQ(again.told, 0u);
      for (std::size_t i = kTicks / 2; i < kTicks; ++i) {
        after->tick(day[i].facts, day[i].dt_us);
        twice->tick(day[i].facts, day[i].dt_us);
        ASSERT_EQ(twice->trace(), after->trace()) << "seed " << seed << ", tick " << i;
      }
    });
    if (HasFatalFailure()) return;
  }
}

/// Goes for one tick, and for as long as `idle` lets it go on.
program::Program goes(const std::string& idle, std::uint32_t hold_limit_us) {
  using namespace program::testing;
  ProgramBuilder b({"goal", "control"});
  b.settings.hold_limit_us = hold_limit_us;
  b.fact("On").strategy("Go").idle(idle);
  b.when("go", "goal", seen("On"), {raise("sat Go")});
  b.when("end", "goal", no(seen("On")), {lower("sat Go")});
  return b.build();
}

/// What a mind does that takes another image half a second after its strategy has ended, a tick later.
mts::Status status_after(const program::Program& old, const program::Program& now) {
  mts::Status status = mts::Status::kOk;
  with_swap(old, now, [&](auto& before, const auto& to_view) {
    for (const float on : {0.0f, 1.0f, 0.0f, 0.0f}) before.tick({on}, 500'000);
    mts::SwapReport report;
    std::vector<std::string> losses;
    const auto after = swapped(before, to_view, report, &losses);
    for (const std::string& loss : losses) EXPECT_FALSE(loss.starts_with("strategy")) << "it was neither active nor held: " << loss;
    after->tick({0.0f}, 100'000);
    EXPECT_EQ(after->state.strategy != 0, after->state.status == mts::Status::kHolding);
    status = after->state.status;
  });
  return status;
}

TEST(Swap, SetsOffNothingThatStands) {
  const program::Program stops = goes("stop", 5'000'000), briefly = goes("hold", 200'000), longer = goes("hold", 5'000'000);
  EXPECT_EQ(status_after(longer, longer), mts::Status::kHolding);
  EXPECT_EQ(status_after(longer, briefly), mts::Status::kHoldExpired);
  EXPECT_EQ(status_after(briefly, longer), mts::Status::kHoldExpired);
  EXPECT_EQ(status_after(stops, longer), mts::Status::kNoStrategy);
  EXPECT_EQ(status_after(stops, program::testing::ProgramBuilder({"goal", "control"}).fact("On").build()), mts::Status::kNoStrategy);
}

// What has fired must not fire again as long as its condition stands; what holds while a condition stands must take hold at once.
TEST(Swap, TakesARuleForAnotherOfTheSameNameIfOneFiresOnceAndTheOtherHolds) {
  using namespace program::testing;
  const auto lamp = [](bool holds) {
    ProgramBuilder b({"goal", "control"});
    b.fact("On").satellite("Lamp");
    if (holds) b.while_true("light", "goal", seen("On"), {raise("Lamp")});
    else b.when("light", "goal", seen("On"), {raise("Lamp")});
    return b.build();
  };
  const auto fires_again = [](const program::Program& old, const program::Program& now) {
    bool fires = false;
    with_swap(old, now, [&](auto& before, const auto& to_view) {
      for (const float on : {0.0f, 1.0f, 1.0f}) before.tick({on}, 100'000);
      mts::SwapReport report;
      const auto after = swapped(before, to_view, report);
      EXPECT_EQ(report.rules.carried, 1u);
      after->tick({1.0f}, 100'000);
      fires = after->state.fired != 0;
    });
    return fires;
  };
  const program::Program once = lamp(false), holds = lamp(true);
  EXPECT_FALSE(fires_again(once, once));
  EXPECT_TRUE(fires_again(once, holds));
  EXPECT_TRUE(fires_again(holds, holds)) << "it fires on every tick";
  EXPECT_TRUE(fires_again(holds, once)) << "it has not fired as a rule that fires once";
}

TEST(Swap, TellsOfAnIdleStrategyThatDroveAndIsGone) {
  const auto parks = [](const std::string& where) {
    using namespace program::testing;
    return ProgramBuilder({"goal", "control"}).fact("On").strategy("Go").strategy(where).idle(where).when("go", "goal", seen("On"), {raise("sat Go")}).build();
  };
  const program::Program old = parks("Park"), now = parks("Stand");
  with_swap(old, now, [&](auto& before, const auto& to_view) {
    mts::SwapReport report;
    std::vector<std::string> losses;
    static_cast<void>(swapped(before, to_view, report, &losses));
    EXPECT_EQ(losses, std::vector<std::string>()) << "it has not driven yet";
    before.tick({0.0f}, 100'000);
    static_cast<void>(swapped(before, to_view, report, &losses));
    ASSERT_EQ(losses.size(), 1u);
    EXPECT_TRUE(losses.front().starts_with("strategy Park")) << losses.front();
  });
}

TEST(Swap, TellsOfATimerThatIsGoneByItsLevel) {
  using namespace program::testing;
  const auto waits = [](std::uint32_t above_us, std::uint32_t below_us) {
    ProgramBuilder b({"goal", "route", "map", "control"});
    b.fact("Seen").satellite("Above").satellite("Below");
    b.when("above", "goal", held(seen("Seen"), above_us), {raise("Above")});
    b.when("below", "map", held(seen("Seen"), below_us), {raise("Below")});
    return b.build();
  };
  const program::Program old = waits(100'000, 900'000), now = waits(200'000, 800'000);
  with_swap(old, now, [&](auto& before, const auto& to_view) {
    for (int tick = 0; tick < 4; ++tick) before.tick({1.0f}, 100'000);
    mts::SwapReport report;
    std::vector<std::string> losses;
    static_cast<void>(swapped(before, to_view, report, &losses));
    std::sort(losses.begin(), losses.end());
    EXPECT_EQ(losses, (std::vector<std::string>{"timer goal 1", "timer map 0"})) << "one is over, one runs";
  });
}

TEST(Swap, LeavesARobotStandingWhoseStrategyIsGone) {
  const program::Program old = goes("hold", 5'000'000), now = program::testing::ProgramBuilder({"goal", "control"}).fact("On").build();
  with_swap(old, now, [&](auto& before, const auto& to_view) {
    for (const float on : {0.0f, 1.0f, 0.0f}) {
      before.tick({on}, 500'000);
      mts::SwapReport report;
      const auto after = swapped(before, to_view, report);
      EXPECT_EQ(after->state.strategy, 0u);
      EXPECT_EQ(after->state.status, mts::Status::kNoStrategy);
      EXPECT_EQ(after->state.driving, mts::Status::kNoStrategy) << "between the swap and the next tick";
    }
    EXPECT_EQ(before.state.driving, mts::Status::kHolding);
  });
}

TEST(Swap, BetweenNarrowAndWideImagesCarriesWhatBothHave) {
  const program::Program little = many_facts(1'000), much = many_facts(33'000);
  const LoadedImage small(write_image(build(little), little)), large(write_image(build(much), much));
  ASSERT_EQ(small.status(), mts::ImageStatus::kOk) << mts::text(small.status());
  ASSERT_EQ(large.status(), mts::ImageStatus::kOk) << mts::text(large.status());
  ASSERT_EQ(small.head().index_bytes, 2u);
  ASSERT_EQ(large.head().index_bytes, 4u);
  small.visit([&]<class I>(const mts::Image<I>& narrow) {
    large.visit([&]<class J>(const mts::Image<J>& wide) {
      Running<I> calm(narrow);
      calm.engine().reset();
      auto here = std::make_unique<Running<I>>(narrow);
      here->engine().reset();
      std::vector<float> facts(33'000, 0.0f);
      for (std::size_t i = 0; i < 24; ++i) {
        facts[i] = 1.0f;
        if (i % 3 == 0) facts[i / 2] = 0.0f;
        mts::SwapReport there, back;
        const auto away = swapped(*here, wide, there);
        EXPECT_EQ(there.told, 0u);
        EXPECT_EQ(there.facts.carried, 1'000u);
        EXPECT_EQ(there.facts.fresh, 32'000u);
        here = swapped(*away, narrow, back);
        EXPECT_EQ(back.told, 0u);
        EXPECT_EQ(back.facts.lost, 32'000u);
        calm.tick(facts, 100'000);
        here->tick(facts, 100'000);
        ASSERT_EQ(here->trace(), calm.trace()) << "tick " << i;
        away->tick(facts, 100'000);
        ASSERT_EQ(away->state.strategy, calm.state.strategy) << "tick " << i;
        ASSERT_EQ(away->state.fired, calm.state.fired) << "tick " << i;
      }
    });
  });
}

}  // namespace
}  // namespace kb::tables
