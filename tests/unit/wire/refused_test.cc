// What lines that are wrong, or odd, still say.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/unit/wire/cab.h"
#include "tools/kbc/wire/fields.h"
#include "tools/kbc/wire/named.h"

namespace kb::wire {
namespace {

using Json = nlohmann::json;
using Names = std::vector<std::string>;

TEST(RefusedLine, NamesItsButtonsWhateverIsWrongWithIt) {
  EXPECT_EQ(named_in(R"({"t":1,"buttons":["Abort","Go"],"tag":7})"), (Names{"Abort", "Go"}));
  EXPECT_EQ(named_in(R"({"t":1,"buttons":"Abort"})"), Names{"Abort"});
  EXPECT_EQ(named_in(R"({"t":1,"buttons":[1,null,"Abort"]})"), Names{"Abort"});
  EXPECT_EQ(named_in(R"({"facts":{"Abort":0.9,"Pause":-1,"Fire":true}})"), (Names{"Abort", "Fire"}));
  EXPECT_EQ(named_in(R"({"t":NaN, "buttons" : [ "Abort" , "Go" ]})"), (Names{"Abort", "Go"})) << "no JSON";
  EXPECT_EQ(named_in(R"({"t":1,"buttons":["Abort)"), Names{}) << "cut off in the name";
  EXPECT_EQ(named_in(R"({"t":1,"buttons":["Abort","Resu)"), Names{"Abort"});
  EXPECT_EQ(named_in(R"({"facts":{"Pause":-1,"Abort":1},"t":)"), Names{"Abort"});
  EXPECT_EQ(named_in(R"({"facts":{"Fire":false,"Abort":true},"t":NaN})"), (Names{"Abort"}));
  EXPECT_EQ(named_in(R"({"facts":{"Odd":{"a":[1,2],"b":"}"},"Abort":1},"t":NaN})"), (Names{"Abort"})) << "behind a value that has parts";
  EXPECT_EQ(named_in(R"({"facts":{"Abort":)"), Names{});
  EXPECT_EQ(named_in(R"([{"buttons":["Abort"]}])"), Names{}) << "JSON that has no field of this name";
  for (const char* text : {"", "{", "[]", "7", R"("buttons")", R"({"t":1}})", R"({"buttons":)"}) EXPECT_EQ(named_in(text), Names{}) << text;
}

TEST(RefusedLine, AbortInTheBeginningOfALineThatIsTooLongIsHeard) {
  const std::string odd = R"(,"buttons":["Abort"],"load":")" + std::string(kLongestLine, 'x');   // what `LineChannel` leaves of it
  Cab cab;
  set_off(cab);
  EXPECT_TRUE(cab.say(1.0, odd).contains("error"));
  for (int i = 1; i < 25; ++i) static_cast<void>(cab.say(1.0 + 0.02 * i));
  EXPECT_EQ(cab.say(1.5)["mission"], false);
}

TEST(RefusedLine, AbortOfALineThatCannotBeUsedEndsTheMission) {
  for (const char* odd : {R"(,"compass":1,"buttons":["Abort"])", R"(,"buttons":["Fier","Abort"])", R"(,"vehicle":{"battery":NaN},"buttons":["Abort"])",
                          R"(,"facts":{"Abort":0.9},"readings":{"lode":1})"}) {
    Cab cab;
    set_off(cab);
    for (int i = 0; i < 15; ++i) EXPECT_TRUE(cab.say(1.0 + 0.02 * i, odd).contains("error")) << odd;
    for (int i = 15; i < 25; ++i) static_cast<void>(cab.say(1.0 + 0.02 * i));
    const Json answer = cab.say(1.5);
    EXPECT_EQ(answer["mission"], false) << odd;
    EXPECT_EQ(answer["speed"], 0.0) << odd;
  }
}

TEST(RefusedLine, AbortIsHeardAfterItsLinesHaveBecomeAPause) {
  Cab cab;
  set_off(cab);
  for (int i = 0; i < 50; ++i) static_cast<void>(cab.say(1.0 + 0.02 * i, R"(,"lime":1,"buttons":["Abort"])"));
  Json answer;
  for (int i = 50; i < 60; ++i) {
    answer = cab.say(1.0 + 0.02 * i);
    EXPECT_EQ(answer["speed"], 0.0);
  }
  EXPECT_EQ(answer["mission"], false);
}

TEST(RefusedLine, ACommandOfALineThatCannotBeUsedStartsNothing) {
  Cab cab;
  for (int i = 0; i < 50; ++i) static_cast<void>(cab.say(0.02 * i, i >= 20 && i < 30 ? R"(,"lime":1,"buttons":["Go"])" : ""));
  EXPECT_EQ(cab.say(1.0)["mission"], false);
}

TEST(OddLine, ATagOfAnotherPlantIsNone) {
  Cab cab;
  set_off(cab);
  const Json answer = cab.say(R"({"t":1,"line":[0,0,1,0,0],"range_m":[4,4,4,4,4,4,4,4],"compass_rad":0,"odometry_m_s":0.2,"tag":{"landmark":"Wel","exit":"W"}})");
  EXPECT_GT(answer["speed"], 0.1);
  EXPECT_EQ(warned(cab), "KB1500");
  EXPECT_EQ(message_of(*cab.exchange().warning()), "there is no landmark `Wel` on the map, so this tag counts as none; did you mean `Well`?");
  static_cast<void>(cab.say(R"({"t":1.02,"tag":{"landmark":"Wel","exit":"W"}})"));
  EXPECT_EQ(warned(cab), "") << "once for each name";
  static_cast<void>(cab.say(R"({"t":1.04,"tag":{"landmark":"Kiosk","exit":"Up","closed":["Down"]}})"));
  EXPECT_EQ(warned(cab), "KB1500");
}

TEST(OddLine, ACompassThatCountsOnBeyondATurnIsTakenWithoutWholeTurns) {
  Cab cab;
  static_cast<void>(cab.say(R"({"t":1,"compass_rad":6.4})"));
  EXPECT_EQ(warned(cab), "KB1502");
  ASSERT_TRUE(cab.line_was_taken());
  EXPECT_NEAR(cab.exchange().line()->senses.heading_rad, 0.116815f, 1e-5f);
  static_cast<void>(cab.say(R"({"t":1.02,"compass_rad":-100})"));
  EXPECT_EQ(warned(cab), "");
  EXPECT_NEAR(cab.exchange().line()->senses.heading_rad, 0.530965f, 1e-5f);
}

TEST(OddLine, AReadingOutOfItsRangeIsToldOfOnceForEachSensor) {
  Cab cab;
  static_cast<void>(cab.say(0.05, R"(,"readings":{"load":50,"range[8]":-1})"));
  EXPECT_EQ(message_of(*cab.exchange().warning()), "`readings.range[8]` is -1, outside of its range, and counts as 0; where it means that nothing was measured, declare the sensor `strict`");
  static_cast<void>(cab.say(0.07, R"(,"readings":{"load":4500000,"range[9]":-1})"));
  EXPECT_EQ(message_of(*cab.exchange().warning()), "`readings.load` is 4.5e+06, outside of its range, and counts as 50; where it means that nothing was measured, declare the sensor `strict`");
  static_cast<void>(cab.say(0.09, R"(,"readings":{"load":-3})"));
  EXPECT_EQ(warned(cab), "");
}

}  // namespace
}  // namespace kb::wire
