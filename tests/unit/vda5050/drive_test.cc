// Stretches: what the robot is told to drive, and what the master is told of it (VDA 5050 2.1, 6.10.2 and 6.10.3).
#include "tests/unit/vda5050/yard.h"

#include "tests/unit/stride.h"

namespace kb::vda5050 {
namespace {

using Stretches = AtTheFirst;

TEST_F(Stretches, NodesLeaveTheStateAsTheirSignsAreRead) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  EXPECT_EQ(state["driving"], true);
  EXPECT_EQ(left(), "n2 n3");
  pass();
  EXPECT_EQ(left(), "n3");
  EXPECT_EQ(state["edgeStates"].size(), 1u);
  EXPECT_EQ(state["lastNodeId"], "n2");
  EXPECT_EQ(state["lastNodeSequenceId"], 2);
  pass();
  EXPECT_EQ(left(), "");
  EXPECT_EQ(state["driving"], true) << "it is there, and still comes to rest";
  stop();
  EXPECT_EQ(state["driving"], false);
  EXPECT_EQ(way(), "");
}

TEST_F(Stretches, AnEdgeMayRunOverLandmarksThatAreNoNodes) {
  progress.here = "L3";
  look();
  say("order", order("A", 0, {"n3", "n5", "n6"}));
  EXPECT_EQ(way(), "L3.E L4.E L5.E L6");
  set_off();
  progress.since_m = 5.9;
  look();
  pass();
  EXPECT_EQ(state["lastNodeId"], "n3");
  progress.since_m = 2.0;
  progress.at = Whereabouts{{"L4", "E"}, 2.0};
  instruct("s", "stateRequest");
  look();
  instruct("t", "stateRequest");
  EXPECT_NEAR(state["distanceSinceLastNode"], 7.9, 1e-9);
  EXPECT_NEAR(state["agvPosition"]["x"], 20.0, 1e-9) << "2 m after L4";
  pass();
  EXPECT_EQ(state["lastNodeId"], "n5");
  EXPECT_EQ(state["distanceSinceLastNode"], 0.0);
}

TEST_F(Stretches, TwoNodesAtOneLandmarkAreReachedTogether) {
  say("order", order("A", 0, {"n1", "n2", "n2b", "n3"}));
  EXPECT_EQ(way(), "L1.E L2.E L3");
  set_off();
  pass();
  EXPECT_EQ(state["lastNodeId"], "n2b");
  EXPECT_EQ(left(), "n3");
}

TEST_F(Stretches, AStretchThatIsOnlyAnotherNameOfThePlaceNeedsNoRobot) {
  progress.here = "L2";
  look();
  Json json = order("A", 0, {"n2", "n2b"});
  json["nodes"][1]["actions"] = Json::array({action("b", "beep")});
  say("order", json);
  EXPECT_EQ(vehicle.task().number, 0u);
  EXPECT_EQ(state["lastNodeId"], "n2b");
  EXPECT_EQ(status("b"), "RUNNING");
}

TEST_F(Stretches, ANodeWhereItStandsKeepsItFromTheNextOneAtTheSamePlace) {
  progress.here = "L2";
  look();
  Json json = order("A", 0, {"n2", "n2b", "n3"});
  json["nodes"][0]["actions"] = Json::array({action("b", "beep")});
  say("order", json);
  EXPECT_EQ(state["lastNodeId"], "n2");
  look(2.0);
  EXPECT_EQ(state["lastNodeId"], "n2b");
  EXPECT_EQ(way(), "L2.E L3");
}

TEST_F(Stretches, AStretchEndsWhereTheVehicleHasToStand) {
  Json json = order("A", 0, {"n1", "n2", "n3", "n4"});
  json["nodes"][1]["actions"] = Json::array({action("b", "beep", "NONE")});
  json["nodes"][2]["actions"] = Json::array({action("p", "pick", "SOFT")});
  say("order", json);
  EXPECT_EQ(way(), "L1.E L2.E L3") << "NONE at n2 lets it pass";
  EXPECT_EQ(vehicle.task().number, 1u);
  set_off();
  pass();
  EXPECT_EQ(status("b"), "RUNNING");
  EXPECT_EQ(way(), "L1.E L2.E L3") << "what comes after the stop is another task";
  pass();
  EXPECT_EQ(status("p"), "WAITING") << "it still drives";
  stop();
  EXPECT_EQ(host_actions(), "p");
  look(5);
  EXPECT_EQ(way(), "");
  words = {{"p", "finished"}};
  look();
  EXPECT_EQ(way(), "L3.E L4");
  EXPECT_EQ(vehicle.task().number, 2u);
}

TEST_F(Stretches, TheTaskGrowsWhileTheRobotIsOnItsWay) {
  say("order", order("A", 0, {"n1", "n2", "n3"}, 2));
  EXPECT_EQ(state["newBaseRequest"], true);
  set_off();
  say("order", order("A", 1, {"n2", "n3", "n4"}, 3, 2));
  EXPECT_EQ(way(), "L1.E L2.E L3.E L4");
  EXPECT_EQ(vehicle.task().number, 1u) << "the robot does not stop";
  EXPECT_EQ(state["newBaseRequest"], false);
  pass();
  pass();
  pass();
  EXPECT_EQ(state["lastNodeId"], "n4");
  EXPECT_EQ(left(), "");
}

TEST_F(Stretches, ARobotThatStoppedBeforeItHeardThatItsWayGrewSetsOffAgain) {
  say("order", order("A", 0, {"n1", "n2", "n3"}, 2));
  set_off();
  say("order", order("A", 1, {"n2", "n3"}, 2, 2));
  progress.reached = 2;
  stop();
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(vehicle.task().number, 2u);
  EXPECT_EQ(way(), "L2.E L3");
  drive();
  EXPECT_EQ(state["lastNodeId"], "n3");
}

TEST_F(Stretches, WhereAnOlderOrderGrewTheNextOneMayNotStop) {
  say("order", order("A", 0, {"n1", "n2", "n3"}, 2));
  set_off();
  say("order", order("A", 1, {"n2", "n3"}, 2, 2));
  pass();
  pass();
  stop();
  progress.here = "L3";
  look();
  say("order", order("B", 0, {"n3", "n4", "n5"}));
  set_off();
  pass();
  stop();
  EXPECT_EQ(errors(), "cannotGoOn");
}

TEST_F(Stretches, ABaseRequestComesBeforeTheLastNodeOfTheBase) {
  say("order", order("A", 0, {"n1", "n2", "n3", "n4"}, 3));
  EXPECT_EQ(state["newBaseRequest"], false);
  set_off();
  pass();
  EXPECT_EQ(state["newBaseRequest"], true);
}

TEST_F(Stretches, ARobotThatGivesUpNeedsHelpUntilTheOrderIsCancelled) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  progress.reports = {"Help.lost"};
  look();
  EXPECT_EQ(errors(), "Help.lost");
  EXPECT_EQ(state["errors"][0]["errorLevel"], "WARNING");
  stop();
  EXPECT_EQ(errors(), "Help.lost cannotGoOn");
  EXPECT_EQ(state["errors"][1]["errorLevel"], "FATAL");
  EXPECT_EQ(left(), "n2 n3");
  EXPECT_EQ(way(), "");
  progress.reports.clear();
  look(10);
  EXPECT_EQ(way(), "") << "it does not try again by itself";
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(left(), "");
}

TEST_F(Stretches, APositionIsToldFromTheFirstSignOn) {
  EXPECT_FALSE(state.contains("agvPosition")) << "the name of a landmark is no place and no heading";
  progress.at = Whereabouts{{"L1", "E"}, 0.6, false};
  look();
  instruct("s", "stateRequest");
  EXPECT_EQ(state["agvPosition"]["x"], 0.6);
  EXPECT_NEAR(state["agvPosition"]["theta"], 3.1416, 1e-9);
  EXPECT_EQ(state["agvPosition"]["mapId"], "yard");
  progress.at = Whereabouts{{"L1"}};
  look();
  instruct("t", "stateRequest");
  EXPECT_EQ(state["agvPosition"]["x"], 0.0);
  EXPECT_NEAR(state["agvPosition"]["theta"], 3.1416, 1e-9) << "in the crossing, as it came";
  progress.at.reset();
  look();
  progress.at = Whereabouts{{"L1"}};
  look();
  instruct("u", "stateRequest");
  EXPECT_FALSE(state.contains("agvPosition")) << "it may face anywhere";
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  progress.at = Whereabouts{{"L2", "E"}, 3.0};
  pass();
  EXPECT_EQ(state["agvPosition"]["x"], 9.0);
  progress.at = Whereabouts{{"L3"}};
  pass();
  EXPECT_EQ(state["agvPosition"]["x"], 12.0);
  EXPECT_EQ(state["agvPosition"]["theta"], 0.0) << "in the crossing, as before";
}

TEST_F(Stretches, AnEdgeIsEnteredWhereTheSignOfTheNodeBeforeItIsRead) {
  progress.here = "";
  look();
  Json json = order("A", 0, {"n1", "n2"});
  json["edges"][0]["actions"] = Json::array({action("b", "beep", "NONE")});
  say("order", json);
  begin();
  look(3);
  EXPECT_EQ(status("b"), "WAITING") << "it has yet to come to the node";
  set_off();
  EXPECT_EQ(status("b"), "RUNNING");
}

TEST_F(Stretches, APositionThatNobodyKnowsAnyMoreIsNotTold) {
  say("order", order("A", 0, {"n1", "n2"}));
  set_off();
  EXPECT_FALSE(state.contains("agvPosition"));
}

TEST_F(Stretches, TheCrossingOfALandmarkThatIsNoNodeHasItsOwnPosition) {
  progress.here = "L3";
  look();
  say("order", order("A", 0, {"n3", "n5"}));
  progress.at = Whereabouts{{"L3", "E"}, 5.5};
  set_off();
  progress.at = Whereabouts{{"L4"}};
  pass();
  instruct("s", "stateRequest");
  EXPECT_EQ(state["lastNodeId"], "n3");
  EXPECT_EQ(state["agvPosition"]["x"], 18.0);
}

TEST_F(Stretches, WhatIsSaidOfAnotherTaskCountsForNothing) {
  say("order", order("A", 0, {"n1", "n2"}));
  progress.task = 99;
  progress.reached = 2;
  look();
  EXPECT_EQ(left(), "n2");
}

TEST_F(Stretches, AnOrderWithoutEndNeedsNoMoreMemory) {
  constexpr int kMore = 100;   // nodes of an update
  std::vector<std::string> nodes{"n1"};
  for (int i = 0; i < kMore; ++i) nodes.push_back(i % 2 == 0 ? "n2" : "n1");
  say("order", order("A", 0, nodes));
  std::size_t longest = 0;
  const int updates = 120 / static_cast<int>(kb::testing::stride());
  for (int i = 1; i < updates; ++i) {
    say("order", order("A", i, nodes, nodes.size(), 2 * kMore * i));
    ASSERT_EQ(state["orderUpdateId"], i) << last_error();
    if (progress.task != vehicle.task().number) set_off();
    progress.reached += kMore;
    look();
    longest = std::max(longest, vehicle.task().way.size());
    sent.clear();
  }
  EXPECT_EQ(state["lastNodeSequenceId"], 2 * kMore * (updates - 1));
  EXPECT_LE(longest, 3u * kMore);
  EXPECT_EQ(vehicle.task().number, 1u) << "it never stops";
}

TEST_F(Stretches, WhatGrowsForgetsWhatIsBehind) {
  say("order", order("A", 0, {"n1", "n2", "n3", "n5"}, 4));
  set_off();
  pass();
  pass();
  EXPECT_EQ(way(), "L1.E L2.E L3.E L4.E L5") << "it has not grown";
  say("order", order("A", 1, {"n5", "n6"}, 2, 6));
  EXPECT_EQ(way(), "L3.E L4.E L5.E L6");
  EXPECT_EQ(vehicle.task().passed, 2u);
  pass();
  EXPECT_EQ(state["lastNodeId"], "n3");
  pass();
  EXPECT_EQ(state["lastNodeId"], "n5");
  instruct("c", "cancelOrder");
  EXPECT_EQ(way(), "L3.E L4.E L5.E L6");
  EXPECT_EQ(left(), "n6");
  pass();
  stop();
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(state["lastNodeId"], "n6");
  EXPECT_EQ(errors(), "");
}

}  // namespace
}  // namespace kb::vda5050
