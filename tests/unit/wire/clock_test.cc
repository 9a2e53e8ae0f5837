// Which `t` a host may say, and what comes of others.
#include <gtest/gtest.h>

#include <string>

#include "tests/unit/wire/cab.h"

namespace kb::wire {
namespace {

using Json = nlohmann::json;

TEST(WireClock, OneTimeFarAheadIsNoPause) {
  Cab cab;
  set_off(cab);
  EXPECT_TRUE(cab.say(5e9)["waits"]) << "nobody knows better yet";
  EXPECT_EQ(cab.exchange().now_us(), 980'000);
  EXPECT_EQ(cab.say(1.02)["error"]["code"], "KB1375") << "one line may have been sent before and have come late";
  EXPECT_EQ(cab.exchange().now_us(), 980'000);
  const Json answer = cab.say(1.04);
  EXPECT_EQ(warned(cab), "KB1378");
  EXPECT_FALSE(answer.contains("waits"));
  EXPECT_GT(answer["speed"], 0.1);
  EXPECT_EQ(answer["mind"]["t"], 1.0) << "the mind's time goes on as well";
  static_cast<void>(cab.say(1.06));
  EXPECT_EQ(warned(cab), "");
  EXPECT_TRUE(cab.say(1.6)["waits"]) << "a pause is one still";
  EXPECT_TRUE(cab.say(1.62)["waits"]);
}

TEST(WireClock, AClockThatWasSetBackGoesOnAsAfterAPause) {
  Cab cab;
  set_off(cab, 100.0);
  EXPECT_EQ(cab.say(2.0)["error"]["code"], "KB1375");
  const Json answer = cab.say(2.02);
  EXPECT_TRUE(answer["waits"]);
  EXPECT_EQ(answer["t"], 2.02);
  EXPECT_EQ(answer["speed"], 0.0);
  Json later;
  for (int i = 0; i < 20; ++i) later = cab.say(2.04 + 0.02 * i, i < 10 ? R"(,"buttons":["Go"])" : "");
  EXPECT_GT(later["speed"], 0.1);
  EXPECT_EQ(later["strategy"], "Move.mark");
}

TEST(WireClock, LinesThatOvertakeOneAnotherAreNoPause) {
  Cab cab;
  set_off(cab);
  EXPECT_GT(cab.say(1.06)["speed"], 0.1);
  for (const double t_s : {1.0, 1.02, 1.04}) EXPECT_EQ(cab.say(t_s)["error"]["code"], "KB1375") << t_s;
  EXPECT_GT(cab.say(1.08)["speed"], 0.1);
}

TEST(WireClock, ATimeInMillisecondsIsToldOf) {
  Cab cab;
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(cab.say(5000.0 + 20.0 * i));
    EXPECT_EQ(warned(cab), i == 5 ? "KB1379" : "") << i;
  }
}

TEST(WireClock, ALineThatComesLateAfterAPauseTurnsNoWheel) {
  Cab cab;
  set_off(cab);
  EXPECT_TRUE(cab.say(61.0)["waits"]);
  EXPECT_EQ(cab.say(1.0)["error"]["code"], "KB1375") << "it was sent before the pause";
  const Json answer = cab.say(61.02);
  EXPECT_TRUE(answer["waits"]);
  EXPECT_EQ(answer["speed"], 0.0);
  EXPECT_EQ(warned(cab), "");
}

TEST(WireClock, ALeapIsUndoneOnlyWhereTimeGoesOnWithinAPause) {
  Cab cab;
  set_off(cab);
  EXPECT_TRUE(cab.say(10.0)["waits"]);
  EXPECT_EQ(cab.say(5.0)["error"]["code"], "KB1375");
  const Json answer = cab.say(5.02);
  EXPECT_EQ(warned(cab), "") << "4 s have passed, whichever of the times is wrong";
  EXPECT_TRUE(answer["waits"]);
  EXPECT_EQ(answer["speed"], 0.0);
}

TEST(WireClock, ALineThatComesTwiceIsAnsweredTwiceAndNotThreeTimes) {
  Cab cab;
  set_off(cab);
  const Json answer = cab.say(1.0);
  EXPECT_GT(answer["speed"], 0.1);
  EXPECT_EQ(cab.say(1.0), answer);
  EXPECT_EQ(cab.say(1.0)["error"]["code"], "KB1375") << "a host that hangs and repeats itself must not drive";
  EXPECT_EQ(cab.say(1.02)["mission"], true);
}

}  // namespace
}  // namespace kb::wire
