// `kbc drive` without its process: one answer for each line, whatever the line.
#include "tools/kbc/wire/exchange.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <string>

#include "compiler/diagnostics/consumers.h"
#include "compiler/driver/compile.h"
#include "sim/random.h"
#include "tests/unit/stride.h"

namespace kb::wire {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kTown = R"(
import std.navigation
map Town {
    landmark Inn  at (0, 0)
    landmark Well at (3, 0)
    landmark Mill at (6, 0)
    road Inn.E -- Well.W by mark
    road Well.E -- Mill.W by mark
}
command Go
fact Fire
sensor load  0..50 noise 0.5 stale 2 s
sensor badge text
sensor range[10] 0..4 m
fact Loaded = load ~ ramp(5, 10)
fact Anna   = badge ~ "anna"
fact Far    = range[8] ~ ramp(1 m, 2 m)
route Errand on Town by Go: Well -> Mill
)";

/// A knowledge base at the wheel.
class Cab {
 public:
  explicit Cab(ExchangeOptions options = {}) {
    driver::Options how;
    how.library = KB_PROJECT_ROOT "/stdlib_rules";
    compiled_ = driver::compile("town.kb", source::OneFileMore("town.kb", kTown, files_), how, diagnostics::ErrorLines::make, &said_);
    diagnostics::ErrorLines lines(compiled_->sources, said_);
    diagnostics::Diagnostics messages(compiled_->sources, lines);
    labyrinth_ = sim::lay_out(compiled_->model, {}, messages);
    knowledge_ = sim::prepare(compiled_->model, compiled_->program, compiled_->tables, messages);
    if (!said_.empty()) throw std::runtime_error(said_);
    exchange_.emplace(*knowledge_, *labyrinth_, robot_, std::move(options));
  }
  /// The answer to a line, which is always one object in one line.
  Json say(std::string_view line) {
    const std::string answer = exchange_->answer(line, ++lines_);
    EXPECT_EQ(answer.find('\n'), std::string::npos);
    const Json json = Json::parse(answer);
    EXPECT_TRUE(json.contains("speed") && json.contains("turn")) << answer;
    if (exchange_->mistake()) {
      EXPECT_EQ(json["speed"], 0) << answer;
      EXPECT_EQ(json["turn"], 0) << answer;
      EXPECT_EQ(json["error"]["line"], lines_);
      EXPECT_TRUE(json["error"]["column"] >= 1 && json["error"]["column"] <= line.size() + 1) << answer;
    }
    return json;
  }
  /// The same of senses all of which are there: on a line, nothing near, at rest, looking east.
  Json say(double t_s, std::string_view more = "") {
    return say(fmt::format(R"({{"t":{},"line":[0.05,0.05,0.95,0.05,0.05],"range_m":[4,4,4,4,4,4,4,4],"compass_rad":0,"odometry_x_m":0,"odometry_y_m":0,)"
                           R"("odometry_m_s":0,"odometry_turned_rad":0,"touched":false,"tag":{{}}{}}})", t_s, more));
  }

  [[nodiscard]] const Exchange& exchange() const { return *exchange_; }
  [[nodiscard]] bool line_was_taken() const { return exchange_->line().has_value(); }

 private:
  source::RealFileSystem files_;
  std::string said_;
  std::unique_ptr<driver::Compilation> compiled_;
  std::optional<sim::Labyrinth> labyrinth_;
  std::optional<sim::Knowledge> knowledge_;
  sim::Scenario robot_;
  std::optional<Exchange> exchange_;
  std::uint64_t lines_ = 0;
};

/// On its way, at 1 s.
void set_off(Cab& cab, double from_s = 0.0) {
  for (int i = 0; i < 50; ++i) static_cast<void>(cab.say(from_s + 0.02 * i, i >= 20 && i < 30 ? R"(,"buttons":["Go"])" : ""));
}

/// Whether the last tick of `answer` saw the fact.
bool saw(const Json& answer, std::string_view fact) {
  const Json& seen = answer["seen"];
  return std::find(seen.begin(), seen.end(), fact) != seen.end();
}

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
  for (int i = 10; i < 45; ++i) {
    const Json answer = cab.say(0.05 + 0.1 * i);
    loaded = saw(answer, "Loaded");
    EXPECT_TRUE(loaded || i != 12);
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

/// The code of what is told of the clock with a line.
std::string clock_code(const Cab& cab) { return cab.exchange().warning() ? diagnostics::code_text(cab.exchange().warning()->kind) : ""; }

TEST(Exchange, OneTimeFarAheadIsNoPause) {
  Cab cab;
  set_off(cab);
  EXPECT_TRUE(cab.say(5e9)["waits"]) << "nobody knows better yet";
  EXPECT_EQ(cab.exchange().now_us(), 980'000);
  const Json answer = cab.say(1.02);
  EXPECT_EQ(clock_code(cab), "KB1378");
  EXPECT_FALSE(answer.contains("waits"));
  EXPECT_GT(answer["speed"], 0.1);
  EXPECT_EQ(answer["mind"]["t"], 1.0) << "the mind's time goes on as well";
  static_cast<void>(cab.say(1.04));
  EXPECT_EQ(clock_code(cab), "");
  EXPECT_TRUE(cab.say(1.6)["waits"]) << "a pause is one still";
  EXPECT_TRUE(cab.say(1.62)["waits"]);
}

TEST(Exchange, AClockThatWasSetBackGoesOnAsAfterAPause) {
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

TEST(Exchange, LinesThatOvertakeOneAnotherAreNoPause) {
  Cab cab;
  set_off(cab);
  EXPECT_GT(cab.say(1.06)["speed"], 0.1);
  for (const double t_s : {1.0, 1.02, 1.04}) EXPECT_EQ(cab.say(t_s)["error"]["code"], "KB1375") << t_s;
  EXPECT_GT(cab.say(1.08)["speed"], 0.1);
}

TEST(Exchange, ATimeInMillisecondsIsToldOf) {
  Cab cab;
  for (int i = 0; i < 20; ++i) {
    static_cast<void>(cab.say(5000.0 + 20.0 * i));
    EXPECT_EQ(clock_code(cab), i == 5 ? "KB1379" : "") << i;
  }
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
  EXPECT_EQ(cab.say(R"({"t":1,"tag":{"landmark":"Wel","exit":"W"}})")["error"]["field"], "tag.landmark");
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
