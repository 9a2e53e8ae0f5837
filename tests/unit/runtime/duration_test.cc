// The time between two ticks, and what it is made from.
#include <waymark/runtime/mind.h>

#include <gtest/gtest.h>

#include <bit>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <ratio>
#include <type_traits>

namespace mts {
namespace {

TEST(Duration, IsTheLongestThereIsWhereATimeDoesNotFit) {
  static_assert(milliseconds(4'294'967).us == 4'294'967'000u);
  static_assert(milliseconds(4'294'968).us == 0xFFFF'FFFFu);
  static_assert(milliseconds(5'000'000'000).us == 0xFFFF'FFFFu);
  static_assert(microseconds(0xFFFF'FFFF).us == 0xFFFF'FFFFu);
  static_assert(microseconds(0x1'0000'0000).us == 0xFFFF'FFFFu);
  static_assert(seconds(4294.9673).us == 0xFFFF'FFFFu);
  EXPECT_EQ(microseconds(static_cast<std::uint64_t>(std::chrono::microseconds(std::chrono::minutes(72)).count())).us, 0xFFFF'FFFFu);
}

TEST(Duration, IsNoneWhereATimeIsNegative) {
  static_assert(milliseconds(-5).us == 0);
  static_assert(microseconds(std::int64_t{-1}).us == 0);
  static_assert(seconds(-0.1).us == 0);
  static_assert(seconds(std::numeric_limits<double>::quiet_NaN()).us == 0);
}

template <class T>
concept Time = requires(T n) { milliseconds(n); microseconds(n); };
static_assert(Time<int> && Time<std::uint64_t> && !Time<double> && !Time<float>, "0.02 milliseconds would be none");
static_assert(!std::is_convertible_v<int, Duration>);
static_assert(std::is_constructible_v<Duration, std::uint32_t> && std::is_constructible_v<Duration, std::uint16_t>);
static_assert(!std::is_constructible_v<Duration, int> && !std::is_constructible_v<Duration, double> && !std::is_constructible_v<Duration, std::uint64_t>,
              "-1, 0.02 and 2^32 would be other times");

TEST(Duration, OfSecondsIsToTheNearestMicrosecond) {
  static_assert(seconds(0.02).us == 20'000);
  static_assert(seconds(0.1).us == 100'000);
  static_assert(seconds(1e-6).us == 1);
}

TEST(Duration, OfSecondsInAFloatIsWhatItIsInADouble) {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN(), kInfinite = std::numeric_limits<float>::infinity();
  static_assert(seconds(0.02f).us == 20'000);
  static_assert(seconds(0.1f).us == 100'000);
  static_assert(seconds(4e-7f).us == 0 && seconds(6e-7f).us == 1);
  static_assert(seconds(0.0f).us == 0 && seconds(-0.0f).us == 0 && seconds(-0.1f).us == 0 && seconds(-kInfinite).us == 0);
  static_assert(seconds(kNaN).us == 0 && seconds(-kNaN).us == 0);
  static_assert(seconds(kInfinite).us == 0xFFFF'FFFFu && seconds(1e30f).us == 0xFFFF'FFFFu);
  static_assert(seconds(std::numeric_limits<float>::denorm_min()).us == 0);
  for (std::uint32_t word = 0; word < 0x7F80'0000u; word += 10'007) {   // all exponents, 840 fractions each
    const auto s = std::bit_cast<float>(word);
    ASSERT_EQ(seconds(s).us, seconds(static_cast<double>(s)).us) << s;
  }
  for (const float s : {std::nextafter(4294.967295f, 0.0f), 4294.967295f, std::nextafter(4294.967295f, 5e3f), 8191.9995f, 8192.0f}) {
    EXPECT_EQ(seconds(s).us, seconds(static_cast<double>(s)).us) << s;
  }
}

TEST(Duration, OfWholeSecondsIsExact) {
  static_assert(seconds(2).us == 2'000'000 && seconds(4'294u).us == 4'294'000'000u);
  static_assert(seconds(4'295).us == 0xFFFF'FFFFu && seconds(std::int64_t{1} << 40).us == 0xFFFF'FFFFu);
  static_assert(seconds(-1).us == 0 && seconds(2.0L).us == 2'000'000);
}

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

TEST(Duration, IsTakenFromTheStandardLibrary) {
  static_assert(Duration(20ms).us == 20'000 && Duration(3s).us == 3'000'000 && Duration(1h).us == 3'600'000'000u);
  static_assert(std::is_convertible_v<Clock::duration, Duration>, "mind.tick(facts, now - before)");
  static_assert(!std::is_convertible_v<Clock::time_point, Duration> && !std::is_convertible_v<Duration, std::chrono::milliseconds>);
  static_assert(Duration(-20ms).us == 0 && Duration(0s).us == 0);
}

TEST(Duration, OfFinerPartsIsToTheNearestMicrosecond) {
  static_assert(Duration(499ns).us == 0 && Duration(500ns).us == 1 && Duration(20'000'499ns).us == 20'000);
  using Picoseconds = std::chrono::duration<std::int64_t, std::pico>;
  static_assert(Duration(Picoseconds(1'499'999)).us == 1 && Duration(Picoseconds(1'500'000)).us == 2);
  using Frames = std::chrono::duration<std::uint32_t, std::ratio<1, 60>>;
  static_assert(Duration(Frames(1)).us == 16'667 && Duration(Frames(2)).us == 33'333 && Duration(Frames(60)).us == 1'000'000);
}

TEST(Duration, OfTheStandardLibraryIsTheLongestThereIsWhereItDoesNotFit) {
  static_assert(Duration(71min).us == 4'260'000'000u && Duration(72min).us == 0xFFFF'FFFFu);
  static_assert(Duration(4'294'967'295us).us == 0xFFFF'FFFFu && Duration(4'294'967'294'600ns).us == 0xFFFF'FFFFu);
  static_assert(Duration(4'294'967'294'400ns).us == 0xFFFF'FFFEu);
  static_assert(Duration(std::chrono::nanoseconds::max()).us == 0xFFFF'FFFFu && Duration(std::chrono::hours::max()).us == 0xFFFF'FFFFu);
  static_assert(Duration(std::chrono::years(1)).us == 0xFFFF'FFFFu);
}

TEST(Duration, TakesFractionsOfTheStandardLibrary) {
  static_assert(Duration(0.02s).us == 20'000 && Duration(0.4ms).us == 400 && Duration(1.5min).us == 90'000'000);
  static_assert(Duration(std::chrono::duration<float>(0.02f)).us == 20'000);
  static_assert(Duration(std::chrono::duration<double>(std::numeric_limits<double>::quiet_NaN())).us == 0);
  static_assert(Duration(-0.5s).us == 0 && Duration(1e9s).us == 0xFFFF'FFFFu);
}

TEST(Elapsed, IsRightThoughTheCounterHasWrapped) {
  static_assert(elapsed(std::uint8_t{3}, std::uint8_t{250}) == 9);
  static_assert(elapsed(std::uint16_t{5}, std::uint16_t{65'530}) == 11);
  static_assert(elapsed(std::uint32_t{5}, 0xFFFF'FFFAu) == 11);
  static_assert(milliseconds(elapsed(std::uint16_t{5}, std::uint16_t{65'530})).us == 11'000);
  static_assert(milliseconds(std::uint16_t{5} - std::uint16_t{65'530}).us == 0, "what it is there for");
}

}  // namespace
}  // namespace mts
