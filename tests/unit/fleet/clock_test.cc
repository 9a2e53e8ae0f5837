#include <waymark/fleet/clock.h>

#include <gtest/gtest.h>

#include <waymark/fleet/memory.h>

namespace {

TEST(FleetClock, CountsDifferentTimesAndKnowsWhichAreLongAgo) {
  mts::FleetClock clock({100'000, 100'000});   // the last is strict
  clock.advance(999);                          // the first tick is at 0, whatever is said
  clock.advance(50'000);
  clock.advance(0);                            // the same time again
  EXPECT_EQ(clock.stamp(), 1u);
  EXPECT_EQ(clock.ripe()[0], 0u);
  clock.advance(50'000);
  EXPECT_EQ(clock.now_us(), 100'000);
  EXPECT_EQ(clock.ripe()[0], 1u) << "the stamp of 0 is 100 ms old";
  EXPECT_EQ(clock.ripe()[1], 0u) << "but not older";
  clock.advance(1);
  EXPECT_EQ(clock.ripe()[1], 1u);
}

TEST(FleetClock, CountsItsMemoryWhichGrowsUpToTheLongestDuration) {
  mts::FleetClock clock({100'000, 1'000'000});
  for (int i = 0; i < 20; ++i) clock.advance(10'000);
  EXPECT_EQ(clock.bytes(), 20 * sizeof(std::int64_t));
  for (int i = 0; i < 1'000; ++i) clock.advance(10'000);
  EXPECT_GE(clock.bytes(), 100 * sizeof(std::int64_t));
  EXPECT_LE(clock.bytes(), 103 * sizeof(std::int64_t));
}

TEST(FleetClock, NumbersStampsAnewBeforeTheyRunOut) {
  constexpr std::uint32_t kNear = 0xC000'0000u - 2;
  mts::FleetClock clock({100'000, 1'000'000}, kNear);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(clock.renumber(), 0u);
    clock.advance(60'000);
  }
  EXPECT_EQ(clock.stamp(), kNear + 2);
  EXPECT_EQ(clock.ripe()[0], kNear + 1) << "the stamp of 0 is 120 ms old";
  EXPECT_EQ(clock.renumber(), 0x8000'0000u);
  EXPECT_EQ(clock.stamp(), 0x4000'0000u);
  EXPECT_EQ(clock.ripe()[0], 0x3FFF'FFFFu);
  EXPECT_EQ(clock.time_us(clock.stamp()), 120'000);
  EXPECT_EQ(clock.renumber(), 0u);
  clock.advance(60'000);
  EXPECT_EQ(clock.ripe()[0], 0x4000'0000u);
}

TEST(FleetMemory, KeepsStampsWhenTheyGetMoreBits) {
  mts::FleetMemory memory(2, {0, 0, 0, 1}, 1);
  memory.widen(0, 0, 3, 0);
  for (std::uint32_t lane = 0; lane < 8; ++lane) memory.put_stamp({1, lane * 60}, 0, 3, 13 + lane);   // 13 to 20, the newest 20
  memory.widen(0, 3, 6, 20);
  for (std::uint32_t lane = 0; lane < 8; ++lane) EXPECT_EQ(memory.stamp({1, lane * 60}, 0, 6), 13 + lane);
}

}  // namespace
