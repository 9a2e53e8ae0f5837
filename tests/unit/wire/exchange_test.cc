// `kbc drive` without its process: one answer for each line, whatever the line.
#include "tools/kbc/wire/exchange.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "sim/random.h"
#include "tests/unit/stride.h"
#include "tests/unit/wire/cab.h"

namespace kb::wire {
namespace {

using Json = nlohmann::json;

TEST(Exchange, HearsReadingsUntilTheyAreStale) {
  Cab cab;
  static_cast<void>(cab.say(0.05, R"(,"readings":{"load":40,"badge":"anna","range":[null,null,null,null,null,null,null,null,3.5,null]})"));
  const Json soon = cab.say(0.15), late = cab.say(10.0);
  EXPECT_TRUE(saw(soon, "Loaded") && saw(soon, "Anna") && saw(soon, "Far"));
  EXPECT_FALSE(late.contains("seen")) << "after a pause it stands and does not tick";
  static_cast<void>(cab.say(10.05, R"(,"buttons":["Go"])"));
  const Json then = cab.say(10.15);
  EXPECT_FALSE(saw(then, "Loaded"));
  EXPECT_TRUE(saw(then, "Anna")) << then;
}

TEST(Exchange, HearsTheReadingsOfALineWithAWrongTimeAsOfNow) {
  Cab cab;
  for (int i = 0; i < 10; ++i) static_cast<void>(cab.say(0.05 + 0.1 * i));
  static_cast<void>(cab.say(100.0, R"(,"readings":{"load":40})"));
  bool loaded = false;
  static_cast<void>(cab.say(1.05));
  for (int i = 11; i < 45; ++i) {
    const Json answer = cab.say(0.05 + 0.1 * i);
    loaded = saw(answer, "Loaded");
    EXPECT_TRUE(loaded || i != 13);
  }
  EXPECT_FALSE(loaded) << "it is stale after two seconds";
}

TEST(Exchange, RefusesReadingsThatAreThereTwiceOrOfTheRobotItself) {
  Cab cab;
  const auto code = [&](std::string_view readings) { return cab.say(0.05, fmt::format(R"(,"readings":{})", readings))["error"]["code"]; };
  EXPECT_EQ(code(R"({"range":[null,null,null,null,null,null,null,null,1,2],"range[9]":1})"), "KB1372");
  EXPECT_EQ(code(R"({"range[3]":1})"), "KB1385");
  EXPECT_EQ(code(R"({"badge":[true]})"), "KB1373");
}

TEST(Exchange, DrivesWhenACommandIsPressed) {
  Cab cab;
  set_off(cab);
  const Json answer = cab.say(1.0);
  EXPECT_TRUE(answer["mission"]);
  EXPECT_EQ(answer["strategy"], "Move.mark");
  EXPECT_EQ(answer["controller"], "follow_line");
  EXPECT_EQ(answer["goal"], "Well");
  EXPECT_GT(answer["speed"], 0.1);
}

TEST(Exchange, FollowsALineThatIsMeasuredAndTheSameForLong) {
  Cab cab;
  for (int i = 0; i < 250; ++i) {   // it stands for half a second, while the place is never the same, then drives for metres, while it always is
    const double left_m = i < 25 ? 1e-4 * (i % 3) : 0.01;
    const Json answer = cab.say(fmt::format(R"({{"t":{},"line":{{"left_m":{}}},"range_m":[4,4,4,4,4,4,4,4],"compass_rad":0,"odometry_m_s":{},"odometry_turned_rad":0,"tag":{{}}{}}})",
                                            0.02 * i, left_m, i < 40 ? 0.0 : 0.3, i >= 30 && i < 40 ? R"(,"buttons":["Go"])" : ""));
    if (i < 60) continue;
    EXPECT_EQ(answer["controller"], "follow_line") << i;
    EXPECT_GT(answer["turn"], 0.1) << i;
  }
}

TEST(Exchange, TicksAtMultiplesBeforeTheFirstLineThatIsLater) {
  Cab cab;
  EXPECT_FALSE(cab.say(12.34).contains("mind"));
  EXPECT_FALSE(cab.say(12.4).contains("mind")) << "the tick of 12.4 comes before the first line that is later";
  EXPECT_EQ(cab.say(12.41)["mind"]["tick"], 1);
  EXPECT_FALSE(cab.say(12.5).contains("mind"));
  EXPECT_EQ(cab.say(12.52)["mind"]["t"], 0.1);
  EXPECT_EQ(cab.say(12.89)["mind"]["t"], 0.4) << "one tick for a line, as long as what has passed";
}

TEST(Exchange, APressBetweenTwoTicksCounts) {
  Cab cab;
  for (int i = 0; i < 10; ++i) static_cast<void>(cab.say(0.02 * i));
  static_cast<void>(cab.say(0.22));
  static_cast<void>(cab.say(0.24, R"(,"buttons":["Go"])"));
  static_cast<void>(cab.say(0.26));
  const Json ticked = cab.say(0.32);
  EXPECT_EQ(ticked["mind"]["events"], Json({"Go"}));
  EXPECT_EQ(cab.say(0.42)["mind"]["lost"], Json({"Go"}));
}

TEST(Exchange, AFactOfTheHostGoesBeforeWhatIsPerceived) {
  Cab cab;
  set_off(cab);
  EXPECT_GT(cab.say(1.0)["speed"], 0.1);
  static_cast<void>(cab.say(1.02));
  static_cast<void>(cab.say(1.04, R"(,"facts":{"Obst":0.9,"Fire":0.8})"));
  static_cast<void>(cab.say(1.06, R"(,"facts":{"Fire":null})"));
  const Json ticked = cab.say(1.12);
  EXPECT_EQ(ticked["mind"]["events"], Json({"Obst"})) << "the last word on Fire was none";
}

TEST(Exchange, AfterAPauseItStandsUntilSomebodyPressesSomething) {
  Cab cab;
  set_off(cab);
  EXPECT_GT(cab.say(1.4)["speed"], 0.0) << "0.42 s are no pause";
  EXPECT_EQ(cab.say(1.92, R"(,"buttons":["Go"])")["speed"], 0.0) << "in the line after the pause it stands whatever is pressed";
  EXPECT_EQ(cab.say(1.94, R"(,"buttons":["Go"])")["speed"], 0.0) << "somebody stood beside it and pressed, and the mind has not heard what";
  static_cast<void>(cab.say(2.01));
  EXPECT_GT(cab.say(2.03)["speed"], 0.0);
}

TEST(Exchange, TheRedButtonAfterAPauseMovesNothing) {
  for (const char* red : {R"(,"buttons":["Abort"])", R"(,"facts":{"Abort":0.9})"}) {
    Cab cab;
    set_off(cab);
    EXPECT_TRUE(cab.say(1.92)["waits"]);
    for (int i = 0; i < 30; ++i) EXPECT_EQ(cab.say(1.94 + 0.02 * i, red)["speed"], 0.0) << red;
    EXPECT_EQ(cab.say(2.6)["mission"], false) << red;
  }
}

TEST(Exchange, ARedButtonOfWhichAHostSaysThatItIsNotPressedIsNotPressed) {
  Cab cab;
  set_off(cab);
  EXPECT_TRUE(cab.say(1.92)["waits"]);
  for (int i = 0; i < 30; ++i) EXPECT_TRUE(cab.say(1.94 + 0.02 * i, R"(,"facts":{"Abort":-1})")["waits"]) << "it would drive on";
  EXPECT_EQ(cab.say(2.6)["mission"], true);
}

TEST(Exchange, WhatWasHeldAllTheTimeDoesNotStartItAgain) {
  Cab cab;
  set_off(cab);
  static_cast<void>(cab.say(1.02, R"(,"buttons":["Fire"])"));
  Json answer = cab.say(1.60, R"(,"buttons":["Fire"])");
  EXPECT_TRUE(answer["waits"]);
  EXPECT_EQ(answer["speed"], 0.0);
  EXPECT_EQ(answer["reports"], Json({"Help.power"}));
  for (int i = 0; i < 50; ++i) {
    answer = cab.say(1.62 + 0.02 * i);
    EXPECT_EQ(answer["speed"], 0.0);
    EXPECT_FALSE(answer.contains("mind"));
  }
  EXPECT_TRUE(answer["mission"]) << "the mission is kept";
  for (int i = 0; i < 30; ++i) answer = cab.say(2.62 + 0.02 * i, i < 10 ? R"(,"buttons":["Go"])" : "");
  EXPECT_FALSE(answer.contains("waits"));
  EXPECT_GT(answer["speed"], 0.1);
  EXPECT_EQ(answer["strategy"], "Move.mark");
}

TEST(Exchange, AMalformedLineStopsTheWheelsAndKeepsTheMission) {
  Cab cab;
  set_off(cab);
  EXPECT_TRUE(cab.line_was_taken());
  EXPECT_EQ(cab.say("what?")["error"]["code"], "KB1370");
  EXPECT_FALSE(cab.line_was_taken()) << "the line before is not heard again";
  EXPECT_EQ(cab.say(0.98)["error"]["code"], "KB1375") << "as late as the line before";
  EXPECT_EQ(cab.say(0.5)["error"]["field"], "t");
  EXPECT_EQ(cab.say(1.0, R"(,"buttons":["Fier"])")["error"]["message"], "there is no fact `Fier`; did you mean `Fire`?");
  EXPECT_EQ(cab.say(R"({"t":1,"tag":{"landmark":"Well","exit":"N"}})")["error"]["field"], "tag.exit");
  EXPECT_EQ(cab.say(R"({"t":1,"tag":{"landmark":"Well","exit":"W","closed":["N"]}})")["error"]["field"], "tag.closed");
  EXPECT_GT(cab.say(1.0)["speed"], 0.1);
}

TEST(Exchange, EveryTruncationOfALineIsAnswered) {
  const std::string line = R"({"t":0.5,"line":[0.05,0.1,0.95,1e-3,null],"range_m":[4,4,null,4,4,4,4,4],"compass_rad":-0.5,"odometry_x_m":0,"odometry_y_m":0,"odometry_m_s":0,)"
                           R"("odometry_turned_rad":0,"touched":false,"tag":{"landmark":"Well","exit":"W","safe":true,"closed":["E"]},"buttons":["Go"],"facts":{"Fire":-0.5}})";
  Cab cab;
  for (std::size_t size = 0; size < line.size(); ++size) EXPECT_EQ(cab.say(line.substr(0, size))["error"]["code"], "KB1370") << line.substr(0, size);
  EXPECT_FALSE(cab.say(line).contains("error"));
}

TEST(Exchange, RandomBytesAreAnswered) {
  const std::string line = R"({"t":1.5,"line":[0.05,0.1,0.95,0,0],"range_m":[4,4,4,4,4,4,4,4],"tag":{"landmark":"Well","exit":"W"},"buttons":["Go"],"facts":{"Fire":-0.5}})";
  sim::Random random(11);
  Cab cab;
  for (std::uint64_t i = 0; i < 20'000; i += kb::testing::stride()) {
    std::string spoilt = line;
    for (std::uint64_t k = random.next() % 4 + 1; k > 0; --k) {
      const std::size_t at = random.next() % spoilt.size();
      if (random.chance(0.3f)) spoilt.erase(at, random.next() % 8);
      else if (random.chance(0.5f)) spoilt.insert(at, spoilt.substr(random.next() % spoilt.size(), random.next() % 12));
      else spoilt[at] = static_cast<char>(random.next());
      if (spoilt.empty()) spoilt = "{";
    }
    static_cast<void>(cab.say(spoilt));
  }
}

TEST(Exchange, TheCorpusOfOddLinesIsAnswered) {
  std::ifstream corpus(KB_PROJECT_ROOT "/tests/golden/drive/odd_lines.jsonl");
  ASSERT_TRUE(corpus);
  Cab cab;
  int lines = 0;
  for (std::string line; std::getline(corpus, line); ++lines) static_cast<void>(cab.say(line));
  EXPECT_GT(lines, 30);
}

TEST(Exchange, TheSameLinesAreAnsweredAlike) {
  std::string first, second;
  for (std::string* all : {&first, &second}) {
    Cab cab;
    set_off(cab);
    *all = cab.say(1.0).dump() + cab.say(1.1).dump();
  }
  EXPECT_EQ(first, second);
}

}  // namespace
}  // namespace kb::wire
