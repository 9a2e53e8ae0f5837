// What a vehicle says of its base and of its actions, and how an answer tells it of actions.
#include "tools/kbc/wire/vehicle.h"

#include <gtest/gtest.h>

#include <string>
#include <variant>

#include "tests/unit/wire/lines.h"
#include "tools/kbc/wire/answer.h"

namespace kb::wire {
namespace {

/// The same, and the bytes it stands at.
std::string wrong_at(std::string_view text) {
  const source::Span at = std::get<Mistake>(read_line(text)).span;
  return wrong(text) + " at " + std::string(text.substr(at.begin, at.end - at.begin));
}

TEST(Vehicle, SaysWhatStopsItAndHowFullItsBatteryIs) {
  vda5050::Condition condition;
  put(good(R"({"t":1,"vehicle":{"battery":62.5,"charging":true,"e_stop":"REMOTE","field_violation":true,"mode":"SERVICE"}})").vehicle, condition);
  EXPECT_EQ(condition.battery_percent, 62.5);
  EXPECT_TRUE(condition.charging);
  EXPECT_EQ(condition.e_stop, "REMOTE");
  EXPECT_TRUE(condition.field_violation);
  EXPECT_EQ(condition.mode, "SERVICE");
}

TEST(Vehicle, IsAsItWasWhereALineDoesNotSpeakOfIt) {
  const vda5050::Condition told{7.0, true, "REMOTE", true, "MANUAL"};
  for (const char* text : {R"({"t":1})", R"({"t":1,"vehicle":null})", R"({"t":1,"vehicle":{}})",
                           R"({"t":1,"vehicle":{"battery":null,"charging":null,"e_stop":null,"field_violation":null,"mode":null}})"}) {
    vda5050::Condition condition = told;
    put(good(text).vehicle, condition);
    EXPECT_EQ(condition.battery_percent, 7.0) << text;
    EXPECT_TRUE(condition.charging && condition.field_violation) << text;
    EXPECT_EQ(condition.e_stop + condition.mode, "REMOTEMANUAL") << "who speaks of its battery has not been let go: " << text;
  }
}

TEST(Vehicle, SaysHowFarActionsAre) {
  const std::string_view text = R"({"t":1,"actions":[{"id":"a1","status":"running"},{"status":"failed","result":"no pallet","id":"a2"}]})";
  const Line line = good(text);
  ASSERT_EQ(line.actions.size(), 2u);
  EXPECT_EQ(line.actions[0].id, "a1");
  EXPECT_EQ(line.actions[0].status, "running");
  EXPECT_EQ(line.actions[0].result, "");
  EXPECT_EQ(line.actions[1].status, "failed");
  EXPECT_EQ(line.actions[1].result, "no pallet");
  EXPECT_TRUE(good(R"({"t":1,"actions":[]})").actions.empty());
}

TEST(Vehicle, IsToldOfMistakesAsOfThoseInOtherFields) {
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"batery":5}})"),
            "KB1371 vehicle.batery: there is no field `vehicle.batery`; there are `battery`, `charging`, `e_stop`, `field_violation`, `mode`; did you mean `battery`? at \"batery\"");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"battery":101}})"), "KB1373 vehicle.battery: `vehicle.battery` is 101; a number from 0 to 100 is wanted at 101");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"charging":1}})"), "KB1373 vehicle.charging: `vehicle.charging` is 1; a truth value is wanted at 1");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"field_violation":"no"}})"), "KB1373 vehicle.field_violation: `vehicle.field_violation` is a string; a truth value is wanted at \"no\"");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"e_stop":true}})"), "KB1373 vehicle.e_stop: `vehicle.e_stop` is true; a string is wanted at true");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"e_stop":"remote"}})"),
            "KB1373 vehicle.e_stop: `vehicle.e_stop` is `remote`; one of `NONE`, `AUTOACK`, `MANUAL`, `REMOTE` is wanted; did you mean `REMOTE`? at \"remote\"");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"mode":"AUTO\n"}})"),
            "KB1373 vehicle.mode: `vehicle.mode` is `AUTO\\x0a`; one of `AUTOMATIC`, `SEMIAUTOMATIC`, `MANUAL`, `SERVICE`, `TEACHIN` is wanted at \"AUTO\\n\"");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":{"mode":"MANUAL","mode":"MANUAL"}})").substr(0, 54), "KB1372 vehicle.mode: `vehicle.mode` is there twice at ");
  EXPECT_EQ(wrong_at(R"({"t":1,"vehicle":[]})"), "KB1373 vehicle: `vehicle` is a list of 0; an object is wanted at [");
  EXPECT_EQ(wrong_at(R"({"t":1,"actions":{}})"), "KB1373 actions: `actions` is an object; a list is wanted at {");
  EXPECT_EQ(wrong_at(R"({"t":1,"actions":[{"id":"a","status":"running"},7]})"), "KB1373 actions[1]: `actions[1]` is 7; an object is wanted at 7");
  EXPECT_EQ(wrong_at(R"({"t":1,"actions":[{"id":"a","status":"done"}]})"),
            "KB1373 actions[0].status: `actions[0].status` is `done`; one of `running`, `paused`, `finished`, `failed` is wanted at \"done\"");
  EXPECT_EQ(wrong_at(R"({"t":1,"actions":[{"status":"failed"}]})"), "KB1374 actions[0].id: `actions[0].id` is missing; the answer that told of the action says it at {");
  EXPECT_EQ(wrong_at(R"({"t":1,"actions":[{"id":"a"}]})"), "KB1374 actions[0].status: `actions[0].status` is missing; it says how far the action is at {");
  EXPECT_EQ(wrong_at(R"({"t":1,"actions":[{"id":"a","status":"failed","why":""}]})"),
            "KB1371 actions[0].why: there is no field `actions[0].why`; there are `id`, `status`, `result` at \"why\"");
}

TEST(Vehicle, IsRecordedWithTheAnswerToIt) {
  const std::string line = R"({"t":1,"vehicle":{"battery":5},"actions":[{"id":"a","status":"finished"}]})";
  const std::string recorded = with_answer(line, R"({"speed":0,"turn":0})");
  const Line again = good(with_answer(recorded, R"({"speed":1,"turn":0})"));
  EXPECT_EQ(again.vehicle.battery_percent, 5.0);
  EXPECT_EQ(again.actions.front().status, "finished");
}

TEST(Answer, TellsOfActionsOnlyWhereThereAreAny) {
  Answer answer;
  EXPECT_EQ(print_answer(answer).find("actions"), std::string::npos);
  answer.actions = {{"a\"1", "pick", R"({"height":1.2,"side":["left"]})"}, {"a2", "beep", ""}};
  answer.mind = R"({"tick":3})";
  const Mistake mistake{diagnostics::Kind::kWireNotJson, {"it is empty", {}, {}}, {}, {}};
  EXPECT_NE(print_answer(mistake, 1, answer.actions).find(R"(},"actions":[{"id":"a\"1",)"), std::string::npos) << "a mistake in a line ends no action";
  EXPECT_EQ(print_answer(mistake, 1).find("actions"), std::string::npos);
  const std::string text = print_answer(answer);
  EXPECT_NE(text.find(R"(,"actions":[{"id":"a\"1","type":"pick","parameters":{"height":1.2,"side":["left"]}},{"id":"a2","type":"beep","parameters":{}}],"mind":)"), std::string::npos) << text;
  const auto back = read_answer(text);
  ASSERT_TRUE(std::holds_alternative<Answer>(back)) << "who drives by a line passes over them";
  EXPECT_EQ(std::get<Answer>(back).mind, answer.mind);
}

}  // namespace
}  // namespace kb::wire
