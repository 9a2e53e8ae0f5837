// Instant actions: pausing, asking, and what the robot can do at once (VDA 5050 2.1, 6.8, 6.9).
#include "tests/unit/vda5050/yard.h"

namespace kb::vda5050 {
namespace {

class Instants : public AtTheFirst {
 protected:
  /// Told to be `x` metres along the row, facing east; what has become of it.
  std::string init(const std::string& id, const std::string& last, double x = 8.0) {
    Json one = action(id, "initPosition", "NONE");
    one["actionParameters"] = Json::array({{{"key", "x"}, {"value", x}}, {{"key", "y"}, {"value", 0.1}}, {{"key", "theta"}, {"value", 0.0}}, {{"key", "mapId"}, {"value", "yard"}},
                                           {{"key", "lastNodeId"}, {"value", last}}});
    say("instantActions", with_header({{"actions", Json::array({one})}}));
    return status(id);
  }
};

TEST_F(Instants, ASignBehindTheRobotDoesNotContradictThePositionThatItWasGiven) {
  progress.here.clear();
  progress.at.reset();
  look();
  EXPECT_EQ(init("i", "n2", 1.0), "FINISHED") << "it faces n2, and stands near n1";
  progress.at = vehicle.take_place();
  say("order", order("A", 0, {"n2", "n3"}));
  begin();
  progress.here = "L1";
  look();
  EXPECT_EQ(errors(), "");
  progress.at = Whereabouts{{"L1", "W"}, 0.5, false};   // read from the other side: it faces n1
  look();
  EXPECT_EQ(errors(), "orderError cannotGoOn");
}

TEST_F(Instants, APauseHoldsTheRobotAndItsActions) {
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][0]["actions"] = Json::array({action("b", "beep", "NONE"), action("p", "pick", "NONE")});
  say("order", json);
  set_off();
  instruct("s", "startPause");
  EXPECT_EQ(state["paused"], true);
  EXPECT_EQ(status("s"), "RUNNING") << "it still drives";
  EXPECT_TRUE(vehicle.task().paused);
  EXPECT_EQ(way(), "L1.E L2") << "it keeps its task";
  EXPECT_EQ(status("b"), "PAUSED");
  EXPECT_TRUE(vehicle.host_actions().at(0).pause);
  EXPECT_EQ(status("p"), "RUNNING") << "the host has not paused it yet";
  words = {{"p", "paused"}};
  look();
  EXPECT_EQ(status("p"), "PAUSED");
  progress.speed_m_s = 0.0;
  look(10);
  EXPECT_EQ(status("s"), "FINISHED");
  EXPECT_EQ(status("b"), "PAUSED") << "no time passes";
  instruct("t", "stopPause");
  EXPECT_EQ(status("t"), "FINISHED");
  EXPECT_EQ(state["paused"], false);
  EXPECT_FALSE(vehicle.task().paused);
  EXPECT_FALSE(vehicle.host_actions().at(0).pause);
  words = {{"p", "running"}};
  look();
  EXPECT_EQ(status("p"), "RUNNING");
  look(2);
  EXPECT_EQ(status("b"), "FINISHED");
}

TEST_F(Instants, ARobotThatRestsItsMissionDuringAPauseHasNotGivenUp) {
  say("order", order("A", 0, {"n1", "n2"}));
  set_off();
  instruct("s", "startPause");
  stop();
  instruct("t", "stopPause");
  look();
  EXPECT_EQ(errors(), "");
  progress.on_mission = true;
  look();
  stop();
  EXPECT_EQ(errors(), "cannotGoOn");
}

TEST_F(Instants, WhatASwitchOnTheRobotHoldsNoMasterLetsGo) {
  instruct("s", "startPause");
  progress.held = true;
  look();
  instruct("t", "stopPause");
  EXPECT_EQ(status("t"), "FAILED");
  EXPECT_EQ(state["paused"], true);
  EXPECT_FALSE(vehicle.task().paused) << "its own pause is over";
}

TEST_F(Instants, NothingBeginsDuringAPause) {
  instruct("s", "startPause");
  EXPECT_EQ(status("s"), "FINISHED") << "it stands already";
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][0]["actions"] = Json::array({action("n", "beep", "NONE")});
  say("order", json);
  look();
  EXPECT_EQ(status("n"), "WAITING");
  EXPECT_EQ(way(), "");
  instruct("t", "stopPause");
  EXPECT_EQ(status("n"), "RUNNING");
  EXPECT_EQ(way(), "L1.E L2");
}

TEST_F(Instants, TheStateAndTheFactsheetAreSentOnRequest) {
  const int before = states;
  instruct("s", "stateRequest");
  EXPECT_EQ(states, before + 1);
  EXPECT_EQ(status("s"), "FINISHED");
  instruct("f", "factsheetRequest");
  EXPECT_EQ(status("f"), "FINISHED");
  const auto& [message, sheet] = sent[sent.size() - 2];
  EXPECT_EQ(message.topic, "factsheet");
  EXPECT_TRUE(message.retained);
  EXPECT_EQ(sheet["headerId"], 0);
  EXPECT_NE(sheet["protocolFeatures"]["agvActions"].dump().find("waitForTrigger"), std::string::npos);
}

TEST_F(Instants, TheListMayBeCalledAsBeforeVersion2) {
  say("instantActions", with_header({{"instantActions", Json::array({action("s", "stateRequest", "NONE")})}}));
  EXPECT_EQ(status("s"), "FINISHED");
}

TEST_F(Instants, WhatDrivesCanOnlyDoWhatIsDoneMeanwhile) {
  say("order", order("A", 0, {"n1", "n2"}));
  set_off();
  instruct("n", "pick", "NONE");
  instruct("h", "pick", "HARD");
  EXPECT_EQ(status("n"), "RUNNING");
  EXPECT_EQ(host_actions(), "n");
  EXPECT_EQ(status("h"), "FAILED");
  EXPECT_EQ(errors(), "instantActionError");
}

TEST_F(Instants, WhatIsDoneAtOnceKeepsTheVehicleWhereItStands) {
  instruct("h", "pick", "HARD");
  say("order", order("A", 0, {"n1", "n2"}));
  EXPECT_EQ(way(), "");
  EXPECT_EQ(status("h"), "RUNNING") << "a new order does not end it";
  words = {{"h", "finished"}};
  look();
  EXPECT_EQ(way(), "L1.E L2");
}

TEST_F(Instants, HardIsDoneAloneOrNotAtOnce) {
  instruct("n", "pick", "NONE");
  instruct("h", "drop", "HARD");
  EXPECT_EQ(status("h"), "FAILED") << "something else is being done";
  words = {{"n", "finished"}};
  look();
  instruct("i", "drop", "HARD");
  instruct("m", "pick", "NONE");
  EXPECT_EQ(status("i"), "RUNNING");
  EXPECT_EQ(status("m"), "FAILED") << "nothing is done beside it";
  words = {{"i", "finished"}};
  look();
  instruct("s", "startPause");
  instruct("q", "pick", "NONE");
  EXPECT_EQ(status("q"), "FAILED") << "nor during a pause";
}

TEST_F(Instants, TooManyAtOnceAreRefused) {
  for (int i = 0; i < 101; ++i) instruct(std::to_string(i), "pick");
  EXPECT_EQ(state["actionStates"].size(), 100u);
  EXPECT_EQ(errors(), "instantActionError");
  EXPECT_EQ(reference("actionId"), "100");
}

TEST_F(Instants, AMasterMaySayWhereTheVehicleStands) {
  EXPECT_EQ(init("behind", "n2"), "FINISHED");
  const std::optional<Whereabouts> place = vehicle.take_place();
  ASSERT_TRUE(place);
  EXPECT_EQ(place->road, (Visit{"L2", "E"}));
  EXPECT_NEAR(place->along_m, 2.0, 1e-9);
  EXPECT_FALSE(vehicle.take_place()) << "it is told once";
  progress.at = place;
  progress.here.clear();
  look();
  EXPECT_EQ(state["lastNodeId"], "n2");
  EXPECT_NEAR(state["agvPosition"]["x"], 8.0, 1e-9);
  EXPECT_EQ(init("ahead", "n3"), "FINISHED");
  EXPECT_EQ(state["lastNodeId"], "n3");
  EXPECT_EQ(init("elsewhere", "n5"), "FAILED");
  EXPECT_EQ(state["lastNodeId"], "n3");
  condition.mode = "MANUAL";
  look();
  EXPECT_EQ(init("in hand", "n2"), "FAILED");
  condition.mode = "AUTOMATIC";
  look();
  say("order", order("A", 0, {"n3", "n4"}));
  EXPECT_EQ(vehicle.task().start, Start::kBefore) << "its next sign is that of n3";
  EXPECT_EQ(init("late", "n2"), "FAILED");
}

TEST_F(Instants, WhatCannotBeDoneFailsWithAReason) {
  instruct("x", "danceWaltz");
  instruct("i", "initPosition");
  for (const char* id : {"x", "i"}) EXPECT_EQ(status(id), "FAILED");
  EXPECT_EQ(errors(), "instantActionError instantActionError");
  EXPECT_EQ(state["actionStates"][0]["resultDescription"], "this vehicle cannot do `danceWaltz`");
}

TEST_F(Instants, AnInstantActionThatComesTwiceIsDoneOnce) {
  instruct("p", "pick");
  instruct("p", "pick");
  EXPECT_EQ(state["actionStates"].size(), 1u);
  EXPECT_EQ(errors(), "");
  instruct("p", "drop");
  EXPECT_EQ(errors(), "validationError");
}

TEST_F(Instants, NoOrderBeginsInACrossing) {
  progress.at = Whereabouts{{"L2"}};
  progress.in_crossing = true;
  progress.here = "L2";
  look();
  say("order", order("A", 0, {"n2", "n3"}));
  EXPECT_EQ(errors(), "noRouteError");
  EXPECT_EQ(way(), "");
  EXPECT_EQ(init("i", "n2"), "FINISHED");
  say("order", order("A", 0, {"n2", "n3"}));
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(way(), "L2.E L3");
}

}  // namespace
}  // namespace kb::vda5050
