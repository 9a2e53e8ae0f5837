// Events and attention: section 3 of the model.
#include <gtest/gtest.h>

#include <limits>

#include "tests/unit/program/program_builder.h"

namespace kb::program::testing {
namespace {

using Strings = std::vector<std::string>;

/// One fact, `Sign`, attended or not, and nothing else.
Program watcher() {
  ProgramBuilder b({"control"});
  b.fact("Sign");
  return b.build();
}

/// On which of the ticks after the first (of no data) `Sign` was an event, given its certainties.
std::vector<int> events_of(const std::vector<float>& certainties, bool attended) {
  Trial run(watcher());
  if (attended) run.interpreter().poke(cell(run.program(), "sat Sign"), 1.0f);
  (void)run();
  std::vector<int> events;
  for (std::size_t i = 0; i < certainties.size(); ++i) {
    if (!run({{"Sign", certainties[i]}}).events.empty()) events.push_back(static_cast<int>(i));
  }
  return events;
}

TEST(Sight, AttendedFactIsNoticedAtSixTenths) { EXPECT_EQ(events_of({0.6f}, true), std::vector<int>{0}); }
TEST(Sight, UnattendedFactIsNotNoticedAtSixTenths) { EXPECT_TRUE(events_of({0.6f}, false).empty()); }
TEST(Sight, UnattendedFactThatRisesIsNoticedAboveThePlainThreshold) {
  EXPECT_EQ(events_of({0.4f, 0.6f, 0.8f}, false), std::vector<int>{2});
}
TEST(Sight, AttendedFactThatRisesIsNoticedAboveTheLowerThreshold) {
  EXPECT_EQ(events_of({0.4f, 0.6f, 0.8f}, true), std::vector<int>{1});
}
TEST(Sight, ThresholdsAreStrict) {
  EXPECT_TRUE(events_of({0.75f}, false).empty());
  EXPECT_TRUE(events_of({0.5f}, true).empty());
}
TEST(Sight, ChatterRoundTheThresholdIsOneEventUntilItFallsToTheLowerOne) {
  EXPECT_EQ(events_of({0.76f, 0.74f, 0.76f, 0.74f, 0.51f, 0.76f}, false), std::vector<int>{0});
  EXPECT_EQ(events_of({0.76f, 0.5f, 0.76f}, false), (std::vector<int>{0, 2}));
}

TEST(Sight, SatelliteSwitchedOnWhileTheCertaintyStandsGivesExactlyOneEvent) {
  Trial run(watcher());
  EXPECT_TRUE(run({{"Sign", 0.6f}}).events.empty());
  EXPECT_TRUE(run({{"Sign", 0.6f}}).events.empty());
  run.interpreter().poke(cell(run.program(), "sat Sign"), 1.0f);
  EXPECT_EQ(run({{"Sign", 0.6f}}).events.size(), 1u);
  EXPECT_TRUE(run({{"Sign", 0.6f}}).events.empty());
}

TEST(Sight, WithdrawnAttentionIsNoLoss) {
  Trial run(watcher());
  run.interpreter().poke(cell(run.program(), "sat Sign"), 1.0f);
  (void)run();
  (void)run({{"Sign", 0.6f}});
  run.interpreter().poke(cell(run.program(), "sat Sign"), -1.0f);
  EXPECT_TRUE(run({{"Sign", 0.6f}}).lost.empty());
  EXPECT_EQ(run({{"Sign", 0.4f}}).lost.size(), 1u);
  EXPECT_TRUE(run({{"Sign", 0.6f}}).events.empty());
}

TEST(Sight, FirstTickSettlesWhatIsSeenAndMakesNoEvents) {
  Trial run(watcher());
  EXPECT_TRUE(run({{"Sign", 1.0f}}).events.empty());
  EXPECT_TRUE(run.interpreter().seen(cell(run.program(), "Sign")));
  EXPECT_TRUE(run({{"Sign", 1.0f}}).events.empty());
  EXPECT_EQ(run({{"Sign", -1.0f}}).lost.size(), 1u);
}

TEST(Sight, AnyOfSeveralSatellitesDrawsAttention) {
  ProgramBuilder b({"control"});
  b.fact("Line").satellite("Line_in").satellite("Line_out").of("Line_in", "Line").of("Line_out", "Line");
  Trial run(b.build());
  (void)run();
  EXPECT_TRUE(run({{"Line", 0.6f}}).events.empty());
  run.interpreter().poke(cell(run.program(), "Line_out"), 0.5f);
  EXPECT_EQ(run({{"Line", 0.6f}}).events.size(), 1u);
}

TEST(Sight, AttentionIsThatOfTheLastTickNotOfThisOne) {
  ProgramBuilder b({"goal", "control"});
  b.fact("Start").fact("Sign");
  b.when("look", "goal", event("Start"), {raise("sat Sign")});
  Trial run(b.build());
  (void)run();
  EXPECT_EQ(names(run.program(), run({{"Start", 1.0f}, {"Sign", 0.6f}}).events), Strings{"Start"});
  EXPECT_EQ(names(run.program(), run({{"Sign", 0.6f}}).events), Strings{"Sign"});
}

TEST(Sight, FactHasItsOwnThresholdsRoundedOnceFromWhatWasWritten) {
  ProgramBuilder b({"control"});
  b.fact("Line", 0.6, 0.1);
  const Program program = b.build();
  const Thresholds limits = thresholds(program.cells[0]);
  EXPECT_EQ(limits.plain, 0.6f);
  EXPECT_EQ(limits.attended, 0.5f);  // not 0.6f - 0.1f
}

TEST(Facts, BadValuesAreCountedAndMadeGood) {
  ProgramBuilder b({"control"});
  b.fact("A").fact("B").fact("C").fact("D");
  Trial run(b.build());
  const Tick tick = run({{"A", std::numeric_limits<float>::quiet_NaN()}, {"B", 1.5f}, {"C", -7.0f}, {"D", 1.0f}});
  EXPECT_EQ(tick.bad_facts, 3u);
  EXPECT_EQ(tick.status, Status::kBadFact);
  EXPECT_EQ(run.value("A"), 0.0f);
  EXPECT_EQ(run.value("B"), 1.0f);
  EXPECT_EQ(run.value("C"), -1.0f);
  EXPECT_EQ(run().bad_facts, 0u);
}

}  // namespace
}  // namespace kb::program::testing
