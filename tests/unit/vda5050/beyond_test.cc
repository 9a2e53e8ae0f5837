// Orders that begin at the node behind the robot: see note [beyond a node].
#include "tests/unit/vda5050/yard.h"

namespace kb::vda5050 {
namespace {

class Beyond : public Yard {
 protected:
  /// Driven by hand 2 m after `landmark`, on the road that leaves it by `exit`, and let go again.
  void stand_on(const std::string& landmark, const std::string& exit, bool outwards = true) {
    progress.here = landmark;
    look();
    say("order", order("0", 0, {"n" + landmark.substr(1)}));
    progress.here.clear();
    progress.at = Whereabouts{{landmark, exit}, 2.0, outwards};
    look();
  }
  Json with_action(Json json) const {
    json["nodes"][0]["actions"] = Json::array({action("p", "pick")});
    return json;
  }
  /// Comes to the first node again.
  void come_back() {
    progress.reached = 1;
    progress.at->outwards = false;
    look();
  }
};

TEST_F(Beyond, TheSameRoadIsDrivenOn) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3", "n4", "n5"}));
  EXPECT_EQ(vehicle.task().start, Start::kBeyond);
  EXPECT_EQ(way(), "L3.E L4.E L5");
  EXPECT_EQ(left(), "n4 n5");
  drive();
  EXPECT_EQ(state["lastNodeId"], "n5");
}

TEST_F(Beyond, ASignThatIsNotReadForAMomentIsNotLeft) {
  progress.here = "L4";
  progress.at = Whereabouts{{"L3", "E"}, 5.5};
  look();
  EXPECT_EQ(state["lastNodeId"], "n4");
  const int before = states;
  progress.here.clear();
  look(2);
  progress.here = "L4";
  look(2);
  progress.here.clear();
  look(2);
  EXPECT_EQ(states, before);
  say("order", order("A", 0, {"n4", "n5"}));
  EXPECT_EQ(vehicle.task().start, Start::kBefore);
  EXPECT_EQ(way(), "L4.E L5");
}

TEST_F(Beyond, ByAnotherRoadItTurnsRoundAndComesToTheNodeAgain) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3", "n2"}));
  EXPECT_EQ(vehicle.task().start, Start::kBack);
  EXPECT_EQ(way(), "L3.W L2");
  EXPECT_EQ(left(), "n3 n2");
  EXPECT_EQ(state["edgeStates"].size(), 1u);
  EXPECT_EQ(state["lastNodeId"], "n3");
  progress.task = vehicle.task().number;
  progress.on_mission = true;
  progress.at = Whereabouts{{"L3", "E"}, 1.0, false};
  look();
  instruct("s", "stateRequest");
  EXPECT_EQ(left(), "n3 n2");
  EXPECT_NEAR(state["agvPosition"]["x"], 13.0, 1e-9);
  EXPECT_NEAR(state["agvPosition"]["theta"], 3.1416, 1e-9) << "it faces west";
  come_back();
  EXPECT_EQ(left(), "n2");
  pass();
  stop();
  EXPECT_EQ(state["lastNodeId"], "n2");
  EXPECT_EQ(errors(), "");
}

TEST_F(Beyond, WhatIsToBeDoneAtTheNodeIsDoneThere) {
  stand_on("L3", "E");
  say("order", with_action(order("A", 0, {"n3", "n4"})));
  EXPECT_EQ(vehicle.task().start, Start::kBack);
  EXPECT_EQ(way(), "L3") << "there it has to stand";
  EXPECT_EQ(left(), "n3 n4");
  EXPECT_EQ(status("p"), "WAITING");
  set_off();
  come_back();
  stop();
  EXPECT_EQ(host_actions(), "p");
  words = {{"p", "finished"}};
  look();
  EXPECT_EQ(vehicle.task().start, Start::kBefore);
  EXPECT_EQ(way(), "L3.E L4");
  EXPECT_EQ(left(), "n4");
  drive();
  EXPECT_EQ(state["lastNodeId"], "n4");
  EXPECT_EQ(status("p"), "FINISHED");
}

TEST_F(Beyond, AnOrderOfOneNodeLeadsBackOnlyIfThereIsSomethingToDo) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3"}));
  EXPECT_EQ(way(), "");
  EXPECT_EQ(left(), "");
  say("order", with_action(order("B", 0, {"n3"})));
  EXPECT_EQ(way(), "L3");
  EXPECT_EQ(left(), "n3");
  set_off();
  EXPECT_EQ(status("p"), "WAITING") << "its sign was read, and it still drives";
  stop();
  EXPECT_EQ(status("p"), "RUNNING");
}

TEST_F(Beyond, AVehicleThatTurnedBackAlreadyDoesNotTurnAgain) {
  stand_on("L3", "E", false);
  say("order", order("A", 0, {"n3", "n4"}));
  EXPECT_EQ(vehicle.task().start, Start::kBefore);
  EXPECT_EQ(left(), "n3 n4");
  set_off();
  EXPECT_EQ(left(), "n4");
}

TEST_F(Beyond, WhereItCannotTurnBackOnlyTheSameRoadLeadsOn) {
  stand_on("L8", "E");
  say("order", order("A", 0, {"n8", "n7"}));
  EXPECT_EQ(last_error(), "the order begins at node `n8`, which is behind the vehicle; it is on the road that leaves by `L8.E`, and cannot turn back there");
  say("order", with_action(order("B", 0, {"n8"})));
  EXPECT_EQ(errors(), "noRouteError noRouteError");
  say("order", order("C", 0, {"n8", "n9"}));
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(way(), "L8.E L9");
}

TEST_F(Beyond, AnUpdateThatLeadsBackWhereItCannotTurnIsGivenUp) {
  stand_on("L8", "E");
  say("order", order("A", 0, {"n8", "n9"}, 1));
  say("order", order("A", 1, {"n8", "n7"}));
  EXPECT_EQ(errors(), "cannotGoOn");
  EXPECT_EQ(way(), "");
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "FINISHED");
}

TEST_F(Beyond, AnUpdateMayLeadOnFromTheNodeBehindIt) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3", "n4"}, 1));
  EXPECT_EQ(left(), "(n4)");
  say("order", order("A", 1, {"n3", "n2"}));
  EXPECT_EQ(vehicle.task().start, Start::kBack);
  EXPECT_EQ(left(), "n3 n2");
}

TEST_F(Beyond, ALandmarkThatIsNoNodeOfTheOrderIsTheOneBehindIt) {
  progress.here = "L3";
  look();
  say("order", order("A", 0, {"n3", "n5"}));
  set_off();
  pass();
  progress.at = Whereabouts{{"L4", "E"}, 2.0};
  look();
  EXPECT_EQ(state["lastNodeId"], "n3");
  condition.mode = "MANUAL";
  look();
  condition.mode = "AUTOMATIC";
  look();
  say("order", order("B", 0, {"n3", "n4"}));
  EXPECT_EQ(last_error(), "the order begins at node `n3`, which is at `L3`; the vehicle is at `L4`") << "it drives yet";
  stop();
  EXPECT_EQ(state["lastNodeId"], "n4");
  say("order", order("C", 0, {"n4", "n5"}));
  EXPECT_EQ(vehicle.task().start, Start::kBeyond);
}

TEST_F(Beyond, AnotherNodeAtTheSamePlaceIsBehindItToo) {
  stand_on("L2", "E");
  Json json = order("A", 0, {"n2", "n2b", "n3"});
  json["nodes"][1]["actions"] = Json::array({action("p", "pick")});
  say("order", json);
  EXPECT_EQ(left(), "n2 n2b n3");
  EXPECT_EQ(status("p"), "WAITING");
  EXPECT_EQ(vehicle.task().start, Start::kBack);
  EXPECT_EQ(way(), "L2");
  set_off();
  come_back();
  EXPECT_EQ(state["lastNodeId"], "n2b");
  stop();
  EXPECT_EQ(host_actions(), "p");
}

TEST_F(Beyond, TheWayBackGrowsAsAnyOther) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3", "n2", "n1"}, 2));
  say("order", order("A", 1, {"n2", "n1"}, 2, 2));
  EXPECT_EQ(way(), "L3.W L2.W L1");
  EXPECT_EQ(vehicle.task().number, 1u);
  set_off();
  come_back();
  EXPECT_EQ(left(), "n2 n1");
}

TEST_F(Beyond, AnOrderThatIsCancelledOnTheWayBackEndsAtTheNode) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3", "n2"}));
  progress.task = vehicle.task().number;
  progress.on_mission = true;
  progress.speed_m_s = 0.4;
  look();
  instruct("c", "cancelOrder");
  EXPECT_EQ(way(), "L3");
  EXPECT_EQ(left(), "n3");
  come_back();
  stop();
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(left(), "");
  EXPECT_EQ(state["lastNodeId"], "n3");
}

TEST_F(Beyond, OneThatIsCancelledBeforeItSetsOutIsOver) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3", "n2"}));
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(left(), "");
  EXPECT_EQ(way(), "");
}

TEST_F(Beyond, WhoHasJustComeByTheRoadThatLeavesTheNodeStandsAtIt) {
  stand_on("L3", "E");
  say("order", order("A", 0, {"n3", "n2"}, 1));
  say("order", with_action(order("A", 1, {"n3"}, 1)));
  EXPECT_EQ(way(), "") << "an update says nothing new of the node where it begins";
  say("order", order("A", 2, {"n3", "n4"}));
  EXPECT_EQ(vehicle.task().start, Start::kBeyond);
}

}  // namespace
}  // namespace kb::vda5050
