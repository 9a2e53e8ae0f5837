// Lines with senses and answers with wheel speeds: what is written is read back bit by bit, and nothing that comes crashes the reader.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "sim/random.h"
#include "tests/unit/stride.h"
#include "tests/unit/wire/lines.h"
#include "tools/kbc/wire/answer.h"

namespace kb::wire {
namespace {

using diagnostics::Kind;

bool same_bits(float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b) || (std::isnan(a) && std::isnan(b)); }

TEST(Line, SaysWhatEachSensorSays) {
  const Line line = good(R"({"t":1.25,"line":[0,0.25,0.5,0.75,1],"range_m":[4,1,2,3,4,5,0.5,null],"compass_rad":-1.5,"odometry_x_m":2,"odometry_y_m":-3,)"
                         R"("odometry_m_s":0.25,"odometry_turned_rad":7,"touched":true,"tag":{"landmark":"LM5","exit":"W","safe":false,"closed":["E"]},)"
                         R"("buttons":["Start1"],"facts":{"Fire":0.5,"Smoke":null},"answered":{"speed":1}})");
  EXPECT_EQ(line.t_us, 1'250'000);
  EXPECT_TRUE(line.senses.line_known && line.senses.range_known && line.senses.heading_known && line.senses.odometry_known && line.senses.turned_known);
  EXPECT_EQ(line.senses.line[3], 0.75f);
  EXPECT_EQ(line.senses.range_m[6], 0.5f);
  EXPECT_TRUE(std::isnan(line.senses.range_m[7]));
  EXPECT_EQ(line.senses.heading_rad, -1.5f);
  EXPECT_EQ(line.senses.y_m, -3.0f);
  EXPECT_TRUE(line.senses.touched);
  EXPECT_TRUE(line.reader);
  EXPECT_EQ(line.tag->landmark.text, "LM5");
  EXPECT_FALSE(line.tag->safe);
  EXPECT_EQ(line.tag->closed.front().text, "E");
  EXPECT_EQ(line.buttons.front().text, "Start1");
  EXPECT_EQ(line.facts[0].value, 0.5f);
  EXPECT_FALSE(line.facts[1].value);
}

TEST(Line, SaysWhereALineIsInPlaceOfDarknesses) {
  const Line there = good(R"({"t":1,"line":{"left_m":-0.0125}})"), across = good(R"({"t":1,"line":{"across":true,"left_m":null}})"), none = good(R"({"t":1,"line":{}})");
  EXPECT_EQ(there.guide->left_m, -0.0125f);
  EXPECT_FALSE(there.guide->across || there.senses.line_known);
  EXPECT_TRUE(across.guide->across && !across.guide->left_m);
  EXPECT_TRUE(none.guide && !none.guide->left_m && !none.guide->across);
  EXPECT_FALSE(good(R"({"t":1,"line":null})").guide);
}

TEST(Line, LeavesOutWhatIsNotKnown) {
  for (const char* text : {R"({"t":0})", R"({"t":0,"line":null,"range_m":null,"compass_rad":null,"odometry_m_s":null,"tag":null,"buttons":null,"facts":null,"touched":null})"}) {
    const Line line = good(text);
    EXPECT_FALSE(line.senses.line_known || line.senses.range_known || line.senses.heading_known || line.senses.odometry_known || line.reader);
    EXPECT_EQ(line.senses.range_m[0], mts::kOutOfRange);
  }
  EXPECT_TRUE(good(R"({"t":0,"tag":{}})").reader);
  EXPECT_FALSE(good(R"({"t":0,"tag":{}})").tag);
  EXPECT_TRUE(std::isnan(good(R"({"t":0,"odometry_m_s":0.1})").senses.x_m)) << "without a place the speed counts";
}

TEST(Line, TakesWhatIsTooSmallForAFloatAsNothing) {
  EXPECT_EQ(good(R"({"t":0,"range_m":[1e-60,4,4,4,4,4,4,4]})").senses.range_m[0], 0.0f) << "not as out of range";
}

TEST(Line, NamesWhatIsWrongAndWhere) {
  EXPECT_EQ(wrong(R"({"rnage_m":[1]})").substr(0, 23), "KB1371 rnage_m: there i");
  EXPECT_EQ(wrong(R"({"t":0,"t":1})"), "KB1372 t: `t` is there twice");
  EXPECT_EQ(wrong(R"({"t":"0"})"), "KB1373 t: `t` is a string; a number is wanted");
  EXPECT_EQ(wrong(R"({"t":-1})"), "KB1373 t: `t` is -1; a number from 0 to 1e+11 is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"range_m":[1,2,3]})"), "KB1373 range_m: `range_m` is a list of 3; a list of 8 is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"range_m":[NaN,4]})"), "KB1370 : this is no line of JSON: syntax error while parsing value - invalid literal; did you mean `null`?");
  EXPECT_EQ(wrong(R"({"t":0,"compass_rad":-Infinity})"), "KB1370 : this is no line of JSON: syntax error while parsing value - invalid number; expected digit after '-'; did you mean `null`?");
  EXPECT_EQ(wrong(R"({"t":0,"line":[0,0,"NaN",0,0]})"), "KB1373 line[2]: `line[2]` is a string; a number is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"line":{"left_m":12}})"), "KB1373 line.left_m: `line.left_m` is 12; a number from -1 to 1 is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"line":{"across":1}})"), "KB1373 line.across: `line.across` is 1; a truth value is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"line":{"left":0}})"), "KB1371 line.left: there is no field `line.left`; there are `left_m`, `across`; did you mean `left_m`?");
  EXPECT_EQ(wrong(R"({"t":0,"compass_rad":1e7})"), "KB1373 compass_rad: `compass_rad` is 1e7; a number from -1e+06 to 1e+06 is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"touched":1})"), "KB1373 touched: `touched` is 1; a truth value is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"facts":{"Fire":1.5}})"), "KB1373 facts.Fire: `facts.Fire` is 1.5; a number from -1 to 1 is wanted");
  EXPECT_EQ(wrong(R"({"t":0,"facts":{"Fire":1,"Fire":0}})"), "KB1372 facts.Fire: `facts.Fire` is there twice");
  EXPECT_EQ(wrong(R"({"t":0,"tag":{"exit":"W"}})").substr(0, 45), "KB1374 tag.landmark: `tag.landmark` is missin");
  EXPECT_EQ(wrong(R"({"t":0,"tag":{"landmark":"A","exti":"W"}})").substr(0, 46), "KB1371 tag.exti: there is no field `tag.exti`;");
  EXPECT_EQ(wrong(R"({"line":[0,0,0,0,0]})"), "KB1374 t: `t` is missing; each line says its time, in s");
  EXPECT_EQ(wrong(R"({"t":0,"odometry_x_m":1})").substr(0, 35), "KB1374 odometry_y_m: `odometry_y_m`");
  EXPECT_EQ(wrong(R"({"t":0,"odometry_x_m":1,"odometry_y_m":1})").substr(0, 35), "KB1374 odometry_m_s: `odometry_m_s`");
  EXPECT_EQ(wrong(R"({"t":1e999})").substr(0, 9), "KB1370 : ");
  EXPECT_EQ(wrong(R"([1])").substr(0, 9), "KB1370 : ");
  EXPECT_EQ(wrong("{\"t\":0,\"buttons\":[\"\xFF\"]}").substr(0, 9), "KB1370 : ");
  EXPECT_EQ(wrong(std::string(100'000, '[')).substr(0, 9), "KB1370 : ");
}

TEST(Line, ReadsBackAsTheSameFloats) {
  sim::Random random(7);
  sim::TagHeard tag;
  for (std::uint64_t i = 0; i < 20'000; i += kb::testing::stride()) {
    mts::Senses senses;
    const auto any = [&](double most) {
      if (random.chance(0.02f)) return -0.0f;
      return static_cast<float>(most * static_cast<double>(random.signed_unit())) * std::ldexp(1.0f, -static_cast<int>(random.next() % 24));
    };
    for (float& dark : senses.line) dark = std::abs(any(1.0));
    for (float& range_m : senses.range_m) range_m = random.chance(0.1f) ? std::numeric_limits<float>::quiet_NaN() : any(5.0);
    senses.heading_rad = any(3.14);
    senses.x_m = any(1000.0);
    senses.y_m = any(1000.0);
    senses.speed_m_s = any(0.6);
    senses.turned_rad = any(100.0);
    senses.line_known = senses.range_known = senses.heading_known = senses.odometry_known = senses.turned_known = true;
    const auto t_us = static_cast<std::int64_t>(random.next() % 100'000'000'000'000ull);
    const Line line = good(print_line(t_us, senses, tag, {}));
    ASSERT_EQ(line.t_us, t_us);
    for (std::size_t k = 0; k < mts::kLineSensors; ++k) ASSERT_TRUE(same_bits(line.senses.line[k], senses.line[k])) << senses.line[k];
    for (std::size_t k = 0; k < mts::kRangeFinders; ++k) ASSERT_TRUE(same_bits(line.senses.range_m[k], senses.range_m[k])) << senses.range_m[k];
    ASSERT_TRUE(same_bits(line.senses.heading_rad, senses.heading_rad) && same_bits(line.senses.x_m, senses.x_m) && same_bits(line.senses.turned_rad, senses.turned_rad));
    Answer answer;
    answer.wheels = {any(0.6), any(3.0)};
    const auto back = read_answer(print_answer(answer));
    ASSERT_TRUE(std::holds_alternative<Answer>(back));
    ASSERT_TRUE(same_bits(std::get<Answer>(back).wheels.speed_m_s, answer.wheels.speed_m_s) && same_bits(std::get<Answer>(back).wheels.turn_rad_s, answer.wheels.turn_rad_s));
  }
}

TEST(Line, IsRecordedWithItsAnswerInPlaceOfAnOlderOne) {
  for (const auto& [line, recorded] : {std::pair(R"({"t":1})", R"({"t":1,"answered":{"speed":2}})"), std::pair(R"({"t":1,"answered":{"answered":[1,"}"]}} )", R"({"t":1,"answered":{"speed":2}})"),
                                       std::pair(R"({"answered":"x,\"y" , "t":1,"tag":{}})", R"({ "t":1,"tag":{},"answered":{"speed":2}})"),
                                       std::pair(R"({"t":1,"answered":null,"tag":{}})", R"({"t":1,"tag":{},"answered":{"speed":2}})"),
                                       std::pair(R"({"t":1,"facts":{"answered":null}})", R"({"t":1,"facts":{"answered":null},"answered":{"speed":2}})"),
                                       std::pair(R"({"\u0061nswered":{"answered":0},"\u0074":1})", R"({"\u0074":1,"answered":{"speed":2}})")}) {
    EXPECT_EQ(with_answer(line, R"({"speed":2})"), recorded) << line;
    EXPECT_EQ(good(recorded).t_us, 1'000'000);
  }
}

TEST(Answer, OfAStudentNeedsOnlyTheWheels) {
  const auto few = read_answer(R"({"turn": -1, "speed": 0.3, "thoughts": [1, {"a": null}]})");
  ASSERT_TRUE(std::holds_alternative<Answer>(few));
  EXPECT_EQ(std::get<Answer>(few).wheels.turn_rad_s, -1.0f);
  EXPECT_FALSE(std::get<Answer>(few).mission);
  for (const char* bad : {"", "{}", R"({"speed":1})", R"({"speed":"1","turn":0})", R"({"speed":1,"turn":null})", R"({"speed":1,"turn":1e39})", "[0.3,0]",
                          R"({"speed":1,"turn":0,"mission":1})", R"({"speed":1,"turn":0,"reports":"Help.lost"})", R"({"speed":NaN,"turn":0})"}) {
    EXPECT_TRUE(std::holds_alternative<Mistake>(read_answer(bad))) << bad;
  }
}

TEST(Answer, CarriesTheTickAsItWasWritten) {
  Answer answer;
  answer.mind = R"({"tick":3,"t":0.2,"events":["a\"}b"],"cf":{"X":0.1}})";
  answer.seen = {"X", "In.N"};
  answer.mission = true;
  answer.reports = {"Help.lost"};
  const auto back = read_answer(print_answer(answer));
  ASSERT_TRUE(std::holds_alternative<Answer>(back));
  EXPECT_EQ(std::get<Answer>(back).mind, answer.mind);
  EXPECT_EQ(std::get<Answer>(back).seen, answer.seen);
  EXPECT_EQ(std::get<Answer>(back).reports, answer.reports);
  EXPECT_TRUE(*std::get<Answer>(back).mission);
}

}  // namespace
}  // namespace kb::wire
