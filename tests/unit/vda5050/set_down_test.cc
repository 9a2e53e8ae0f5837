// Where an order is believed to begin: vehicles that were switched on, or set down by hand.
#include "tests/unit/vda5050/yard.h"

namespace kb::vda5050 {
namespace {

TEST_F(Yard, WhereNobodyKnowsWhereTheVehicleIsTheMasterDoes) {
  look();
  EXPECT_EQ(state["lastNodeId"], "");
  EXPECT_FALSE(state.contains("agvPosition"));
  say("order", order("A", 0, {"n6", "n7"}));
  EXPECT_EQ(state["lastNodeId"], "n6");
  EXPECT_EQ(way(), "L6.E L7");
}

TEST_F(Yard, WhatIsToBeDoneAtTheFirstNodeWaitsForItsSign) {
  look();
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][0]["actions"] = Json::array({action("p", "pick")});
  say("order", json);
  EXPECT_EQ(left(), "n1 n2");
  EXPECT_EQ(status("p"), "WAITING");
  EXPECT_EQ(way(), "L1");
  set_off();
  stop();
  EXPECT_EQ(left(), "n2");
  EXPECT_EQ(status("p"), "RUNNING");
  words = {{"p", "finished"}};
  look();
  EXPECT_EQ(way(), "L1.E L2");
}

TEST_F(Yard, AnOrderThatBeginsElsewhereThanTheFirstSignSaysIsGivenUp) {
  look();
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  progress.task = vehicle.task().number;
  progress.on_mission = true;
  progress.speed_m_s = 0.5;
  look();
  EXPECT_EQ(errors(), "");
  progress.here = "L2";
  look();
  EXPECT_EQ(errors(), "orderError cannotGoOn");
  EXPECT_EQ(state["errors"][0]["errorDescription"], "the order begins at node `n1`; the sign that the vehicle reads is that of `n2`");
  EXPECT_EQ(way(), "") << "it is not driven any farther";
  stop();
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(errors(), "orderError");
  look();
  EXPECT_EQ(state["lastNodeId"], "n2");
  say("order", order("B", 0, {"n2", "n3"}));
  EXPECT_EQ(errors(), "");
  drive();
  EXPECT_EQ(state["lastNodeId"], "n3");
}

TEST_F(Yard, AnOrderToStayThatTheFirstSignContradictsIsOver) {
  look();
  say("order", order("A", 0, {"n1"}));
  progress.here = "L2";
  look();
  EXPECT_EQ(errors(), "orderError") << "there is nothing to cancel";
  EXPECT_EQ(state["lastNodeId"], "n2");
}

/// A vehicle that somebody has set down somewhere and that has read one sign, of which it was told the side.
class SetDown : public Yard {
 protected:
  void read(const std::string& landmark, std::optional<Whereabouts> at) {
    progress.here = landmark;
    progress.at = std::move(at);
    look();
  }
};

TEST_F(SetDown, TheSignOfAnotherNodeBeforeTheFirstCrossingEndsTheOrder) {
  read("L1", std::nullopt);
  say("order", order("A", 0, {"n1", "n2", "n3"}, 2));
  begin();
  progress.reached = 1;
  look();
  EXPECT_EQ(errors(), "");
  read("L2", std::nullopt);   // it has been behind the first node all the time
  EXPECT_EQ(errors(), "orderError cannotGoOn");
  EXPECT_EQ(way(), "");
}

TEST_F(SetDown, AfterTheFirstCrossingSignsCountAsEver) {
  read("L1", Whereabouts{{"L1", "W"}, 0.6, false});
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  EXPECT_EQ(vehicle.task().start, Start::kBefore);
  EXPECT_EQ(left(), "n2 n3") << "it is at the node that it faces";
  set_off();
  read("L2", Whereabouts{{"L1", "E"}, 5.4});
  EXPECT_EQ(errors(), "");
}

TEST_F(SetDown, WhoKnowsThatTheFirstNodeIsBehindItDrivesOn) {
  read("L1", Whereabouts{{"L1", "E"}, 0.6});
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  EXPECT_EQ(vehicle.task().start, Start::kBeyond);
  begin();
  progress.reached = 1;
  read("L2", Whereabouts{{"L1", "E"}, 5.4});
  EXPECT_EQ(errors(), "");
  pass();
  EXPECT_EQ(state["lastNodeId"], "n2");
  say("order", order("A", 1, {"n3", "n4"}, 1, 4));
  pass();
  stop();
  read("L3", Whereabouts{{"L2", "E"}, 5.4});
  EXPECT_EQ(errors(), "") << "nor is the first node expected when the way is over";
}

TEST_F(SetDown, OrTurnsRound) {
  read("L2", Whereabouts{{"L2", "E"}, 0.6});
  say("order", order("A", 0, {"n2", "n1"}));
  EXPECT_EQ(vehicle.task().start, Start::kBack);
  EXPECT_EQ(left(), "n2 n1");
}

}  // namespace
}  // namespace kb::vda5050
