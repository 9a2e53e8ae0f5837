// Actions at nodes and on edges (VDA 5050 2.1, 6.10.2 and 6.12).
#include "tests/unit/vda5050/yard.h"

namespace kb::vda5050 {
namespace {

class Actions : public AtTheFirst {
 protected:
  void order_at_first(const std::vector<Json>& actions) {
    Json json = order("A", 0, {"n1", "n2"});
    json["nodes"][0]["actions"] = actions;
    say("order", json);
  }
  void tell(const std::string& id, const std::string& word, const std::string& result = "") {
    words = {{id, word, result}};
    look();
  }
};

TEST_F(Actions, HardRunsAlone) {
  order_at_first({action("s", "drop", "SOFT"), action("n", "pick", "NONE"), action("h", "pick", "HARD"), action("l", "drop", "NONE")});
  EXPECT_EQ(host_actions(), "s n");
  EXPECT_EQ(status("h"), "WAITING");
  tell("s", "finished");
  EXPECT_EQ(host_actions(), "n");
  tell("n", "finished");
  look();
  EXPECT_EQ(host_actions(), "h");
  EXPECT_EQ(status("l"), "WAITING");
  EXPECT_EQ(way(), "");
  tell("h", "finished", "42");
  EXPECT_EQ(host_actions(), "l");
  EXPECT_EQ(way(), "L1.E L2") << "NONE goes on while it drives";
  EXPECT_EQ(state["actionStates"][2]["resultDescription"], "42");
}

TEST_F(Actions, AnOrderIsNotOverBeforeItsActionsAre) {
  order_at_first({action("n", "pick", "NONE")});
  drive();
  say("order", order("B", 0, {"n2", "n3"}));
  EXPECT_EQ(errors(), "orderError");
  tell("n", "finished");
  say("order", order("B", 0, {"n2", "n3"}));
  EXPECT_EQ(state["orderId"], "B");
  EXPECT_TRUE(state["actionStates"].empty()) << "they belong to the order before";
}

TEST_F(Actions, WhatNobodyDoesIsOverInTime) {
  order_at_first({action("b", "beep")});
  EXPECT_EQ(status("b"), "RUNNING");
  EXPECT_EQ(host_actions(), "");
  look(1.9);
  EXPECT_EQ(status("b"), "RUNNING");
  look(0.1);
  EXPECT_EQ(status("b"), "FINISHED");
}

TEST_F(Actions, AClockThatIsSetBackChangesNothing) {
  order_at_first({action("b", "beep")});
  look(1.0);
  us -= 3'600'000'000;
  const int before = states;
  look(0.1);
  EXPECT_EQ(states, before + 1) << "nor is the master left alone for an hour";
  look(0.8);
  EXPECT_EQ(status("b"), "RUNNING");
  look(0.3);
  EXPECT_EQ(status("b"), "FINISHED");
}

TEST_F(Actions, TheHostIsGivenParametersAndSaysHowFarItIs) {
  Json pick = action("p", "pick");
  pick["actionParameters"] = Json::parse(R"([{"key":"height","value":1.20},{"key":"of","value":{"a":["\n",null,true]}}])");
  order_at_first({pick});
  ASSERT_EQ(vehicle.host_actions().size(), 1u);
  EXPECT_EQ(vehicle.host_actions()[0].type, "pick");
  EXPECT_EQ(vehicle.host_actions()[0].parameters, R"({"height":1.2,"of":{"a":["\n",null,true]}})");
  tell("p", "paused");
  EXPECT_EQ(status("p"), "PAUSED");
  instruct("s", "startPause");
  instruct("t", "stopPause");
  EXPECT_EQ(status("p"), "PAUSED") << "the host has not gone on";
  tell("p", "running", "half");
  EXPECT_EQ(status("p"), "RUNNING");
  EXPECT_EQ(state["actionStates"][0]["resultDescription"], "half");
  tell("p", "perhaps");
  tell("x", "finished");
  EXPECT_EQ(status("p"), "RUNNING");
}

TEST_F(Actions, AnActionWithMoreParametersThanALineOfTheHostHoldsIsRefused) {
  const auto with = [](const std::string& id, std::size_t bytes) {
    Json message = order(id, 0, {"n1"});
    message["nodes"][0]["actions"] = Json::array({action("a" + id, "pick")});
    message["nodes"][0]["actions"][0]["actionParameters"] = Json::array({{{"key", "k"}, {"value", std::string(bytes, 'x')}}});
    return message;
  };
  look();
  say("order", with("A", 70'000));
  EXPECT_EQ(last_error(), "nodes[0].actions[0].actionParameters are longer than 65536 bytes");
  EXPECT_EQ(host_actions(), "");
  say("order", with("B", 60'000));
  look();
  EXPECT_EQ(host_actions(), "aB");
}

TEST_F(Actions, AnActionThatFailsIsAnErrorAndTheOrderGoesOn) {
  order_at_first({action("p", "pick")});
  tell("p", "failed", "no load");
  EXPECT_EQ(status("p"), "FAILED");
  EXPECT_EQ(errors(), "actionFailed");
  EXPECT_EQ(reference("actionId"), "p");
  EXPECT_EQ(way(), "L1.E L2");
}

TEST_F(Actions, AnActionOfAnEdgeLastsAsLongAsTheEdge) {
  Json json = order("A", 0, {"n1", "n2", "n3"});
  json["edges"][0]["actions"] = Json::array({action("e", "pick", "NONE")});
  json["edges"][1]["actions"] = Json::array({action("f", "beep", "NONE")});
  say("order", json);
  look();
  EXPECT_EQ(status("e"), "WAITING") << "it has not set off";
  progress.task = vehicle.task().number;
  progress.on_mission = true;
  look();
  EXPECT_EQ(status("e"), "WAITING") << "it does not drive yet (6.10.2)";
  set_off();
  EXPECT_EQ(host_actions(), "e");
  EXPECT_EQ(status("f"), "WAITING");
  pass();
  EXPECT_EQ(host_actions(), "");
  EXPECT_EQ(status("e"), "FINISHED");
  EXPECT_EQ(status("f"), "RUNNING");
  look(2.0);
  EXPECT_EQ(status("f"), "FINISHED");
}

TEST_F(Actions, NoMoreThanTenThousandWait) {
  const auto many = [](const char* prefix, int count, const char* type) {
    Json out = Json::array();
    for (int i = 0; i < count; ++i) out.push_back(action(prefix + std::to_string(i), type, "NONE"));
    return out;
  };
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][1]["actions"] = many("a", 9'000, "beep");
  say("order", json);
  EXPECT_EQ(state["actionStates"].size(), 9'000u);
  json = order("A", 1, {"n2", "n3"}, 2, 2);
  json["nodes"][1]["actions"] = many("b", 1'001, "beep");
  say("order", json);
  EXPECT_EQ(errors(), "orderError");
  drive();
  look(2.0);
  EXPECT_EQ(state["actionStates"].size(), 1'000u) << "and what was over long ago is forgotten";
}

TEST_F(Actions, WhatWasOverLongAgoIsForgotten) {
  for (int i = 0; i < 150; ++i) instruct(std::to_string(i), "stateRequest");
  EXPECT_EQ(state["actionStates"].size(), 100u);
  EXPECT_EQ(state["actionStates"][99]["actionId"], "149");
  say("order", order("A", 0, {"n1", "n2"}));
  EXPECT_TRUE(state["actionStates"].empty());
}

}  // namespace
}  // namespace kb::vda5050
