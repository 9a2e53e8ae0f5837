// Cancelling orders (VDA 5050 2.1, 6.6.3).
#include "tests/unit/vda5050/yard.h"

namespace kb::vda5050 {
namespace {

using Cancelling = AtTheFirst;

TEST_F(Cancelling, ACancelledOrderEndsAtTheNextNode) {
  Json json = order("A", 0, {"n1", "n2", "n3", "n4"}, 3);
  json["nodes"][1]["actions"] = Json::array({action("b", "beep", "NONE")});
  say("order", json);
  set_off();
  const std::uint64_t task = vehicle.task().number;
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "RUNNING");
  EXPECT_EQ(status("b"), "FAILED");
  EXPECT_EQ(left(), "n2") << "where it stops";
  EXPECT_EQ(way(), "L1.E L2");
  EXPECT_EQ(vehicle.task().number, task);
  pass();
  EXPECT_EQ(status("c"), "RUNNING") << "it still drives";
  EXPECT_EQ(way(), "L1.E L2");
  stop();
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(status("b"), "FAILED");
  EXPECT_EQ(left(), "");
  EXPECT_EQ(state["orderId"], "A") << "its name stays";
  EXPECT_EQ(state["lastNodeId"], "n2");
  say("order", order("A", 1, {"n2", "n3"}, 2, 2));
  EXPECT_EQ(errors(), "orderUpdateError") << "a cancelled order does not go on";
  say("order", order("B", 0, {"n2", "n3"}));
  say("order", order("B", 1, {"n3", "n4"}, 2, 2));
  EXPECT_EQ(state["orderUpdateId"], 1);
}

TEST_F(Cancelling, AnOrderThatHasNotSetOffIsCancelledAtOnce) {
  say("order", order("A", 0, {"n1", "n2"}));
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(way(), "");
  EXPECT_EQ(state["lastNodeId"], "n1");
}

TEST_F(Cancelling, ACancelledOrderEndsAtItsFirstNodeIfTheRobotHasNotComeThereYet) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  progress.task = vehicle.task().number;
  progress.on_mission = true;
  progress.speed_m_s = 0.5;
  look();
  instruct("c", "cancelOrder");
  EXPECT_EQ(way(), "L1");
  EXPECT_EQ(left(), "");
  EXPECT_EQ(status("c"), "RUNNING") << "it drives";
  pass();
  stop();
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(state["lastNodeId"], "n1");
  say("order", order("B", 0, {"n1", "n2"}));
  EXPECT_EQ(way(), "L1.E L2");
}

TEST_F(Cancelling, CancellingWaitsForWhatIsBeingDone) {
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][0]["actions"] = Json::array({action("w", "waitForTrigger", "NONE"), action("p", "pick", "SOFT"), action("h", "drop", "HARD")});
  say("order", json);
  instruct("c", "cancelOrder");
  instruct("d", "cancelOrder");
  EXPECT_EQ(status("w"), "FAILED") << "nothing will trigger it (6.8.2)";
  EXPECT_EQ(status("h"), "FAILED");
  EXPECT_EQ(status("p"), "RUNNING");
  EXPECT_EQ(status("c"), "RUNNING");
  say("order", order("B", 0, {"n1", "n2"}));
  EXPECT_EQ(errors(), "orderError");
  words = {{"p", "finished"}};
  look();
  EXPECT_EQ(status("p"), "FINISHED");
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(status("d"), "FINISHED");
}

TEST_F(Cancelling, TheHostIsAskedToGiveUpWhatItDoesAlsoInAPause) {
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][0]["actions"] = Json::array({action("b", "beep", "SOFT"), action("p", "pick", "SOFT")});
  say("order", json);
  instruct("s", "startPause");
  EXPECT_FALSE(vehicle.host_actions().at(0).cancel);
  instruct("c", "cancelOrder");
  EXPECT_TRUE(vehicle.host_actions().at(0).cancel);
  EXPECT_EQ(status("b"), "FAILED") << "nobody does it";
  EXPECT_EQ(status("c"), "RUNNING");
  words = {{"p", "failed"}};
  look();
  EXPECT_EQ(status("p"), "FAILED");
  EXPECT_EQ(errors(), "") << "the master has cancelled it";
  EXPECT_EQ(status("c"), "FINISHED");
}

TEST_F(Cancelling, WithoutOrderThereIsNothingToCancel) {
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "FAILED");
  EXPECT_EQ(errors(), "noOrderToCancel");
  EXPECT_EQ(reference("actionId"), "c");
  say("order", order("A", 0, {"n1", "n2"}));
  EXPECT_EQ(errors(), "");
}

TEST_F(Cancelling, AnUpdateOfAnOrderThatIsBeingCancelledIsRefused) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  instruct("c", "cancelOrder");
  say("order", order("A", 1, {"n2", "n3"}, 2, 2));
  EXPECT_EQ(errors(), "orderUpdateError");
  EXPECT_EQ(left(), "n2");
}

TEST_F(Cancelling, ACancelledOrderIsOverWhereARobotCannotGoOn) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  pass();
  progress.speed_m_s = 0.0;
  progress.reports = {"Help.refused"};
  look(10.0);
  EXPECT_EQ(left(), "n3") << "the road may be opened again";
  instruct("c", "cancelOrder");
  look();
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(left(), "");
  EXPECT_EQ(way(), "") << "what it drives is given up";
  progress.reports.clear();
  progress.on_mission = false;
  look();
  say("order", order("B", 0, {"n2", "n1"}));
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(way(), "L2.W L1");
}

TEST_F(Cancelling, InAPauseACancelledOrderIsOverAsSoonAsTheRobotStands) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  pass();
  instruct("s", "startPause");
  instruct("c", "cancelOrder");
  EXPECT_EQ(status("c"), "RUNNING") << "it still drives";
  progress.speed_m_s = 0.0;
  progress.at = Whereabouts{{"L2", "E"}, 2.0, true};
  look(0.2);
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(left(), "");
  EXPECT_EQ(way(), "") << "what it drives is given up";
  EXPECT_EQ(state["paused"], true);
  say("order", order("B", 0, {"n2", "n3"}));
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(way(), "") << "the pause is not over";
  instruct("t", "stopPause");
  EXPECT_EQ(way(), "L2.E L3");
}

TEST_F(Cancelling, InACrossingACancelledOrderWaitsForTheEndOfThePause) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  instruct("s", "startPause");
  progress.at = Whereabouts{{"L1"}};
  progress.in_crossing = true;
  progress.speed_m_s = 0.0;
  look();
  instruct("c", "cancelOrder");
  look(100.0);
  EXPECT_EQ(status("c"), "RUNNING") << "no order can begin there";
  EXPECT_EQ(way(), "L1.E L2");
  instruct("t", "stopPause");
  progress.in_crossing = false;
  progress.at = Whereabouts{{"L1", "E"}, 1.0, true};
  progress.speed_m_s = 0.5;
  look();
  pass();
  stop();
  EXPECT_EQ(status("c"), "FINISHED");
}

TEST_F(Cancelling, InACrossingACancelledOrderWaitsAMinuteForTheWayToBeFree) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  progress.at = Whereabouts{{"L1"}};
  progress.in_crossing = true;
  progress.speed_m_s = 0.0;
  progress.reports = {"Help.blocked"};
  look(10.0);
  instruct("c", "cancelOrder");
  look(45.0);
  EXPECT_EQ(status("c"), "RUNNING");
  EXPECT_EQ(way(), "L1.E L2");
  look(10.0);
  EXPECT_EQ(way(), "");
  progress.reports.clear();
  stop();
  EXPECT_EQ(status("c"), "FINISHED");
}

TEST_F(Cancelling, WhoTurnsOnTheSpotAndCallsForHelpCannotGoOn) {
  say("order", order("A", 0, {"n1", "n2"}));
  set_off();
  progress.speed_m_s = 0.0;
  progress.turn_rad_s = 0.5;
  progress.reports = {"Help.lost"};
  look(4.0);
  EXPECT_EQ(state["driving"], true);
  instruct("c", "cancelOrder");
  EXPECT_EQ(way(), "");
}

TEST_F(Cancelling, ACancelledOrderIsDrivenToTheNodeByARobotThatStandsForAMoment) {
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  progress.speed_m_s = 0.0;
  progress.reports = {"Help.no_line"};
  look(1.0);
  instruct("c", "cancelOrder");
  look(1.0);
  EXPECT_EQ(status("c"), "RUNNING");
  EXPECT_EQ(left(), "n2");
  progress.speed_m_s = 0.5;
  look(10.0);
  pass();
  stop();
  EXPECT_EQ(status("c"), "FINISHED");
  EXPECT_EQ(state["lastNodeId"], "n2");
}

}  // namespace
}  // namespace kb::vda5050
