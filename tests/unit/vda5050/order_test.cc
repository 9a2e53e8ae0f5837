// Orders and their updates: what is taken, what is refused, and that a refusal changes nothing (VDA 5050 2.1, 6.6).
#include "tests/unit/vda5050/yard.h"

namespace kb::vda5050 {
namespace {

class Orders : public AtTheFirst {
 protected:
  /// Refused, with the type of its error, and nothing else has changed.
  void refuses(const Json& order, const std::string& type, const std::string& why) {
    const Json before = state;
    say("order", order);
    EXPECT_EQ(state["errors"].back()["errorType"], type) << last_error();
    EXPECT_NE(last_error().find(why), std::string::npos) << last_error();
    EXPECT_EQ(state["errors"].back()["errorLevel"], "WARNING");
    for (const char* key : {"orderId", "orderUpdateId", "nodeStates", "edgeStates", "actionStates", "lastNodeId"}) EXPECT_EQ(state[key], before[key]) << key;
  }
};

TEST_F(Orders, AnOrderIsTakenWithBaseAndHorizonAndItsFirstNodeIsReached) {
  say("order", order("A", 0, {"n1", "n2", "n3", "n4"}, 3));
  EXPECT_EQ(state["orderId"], "A");
  EXPECT_EQ(state["orderUpdateId"], 0);
  EXPECT_EQ(state["lastNodeId"], "n1");
  EXPECT_EQ(state["lastNodeSequenceId"], 0);
  EXPECT_EQ(left(), "n2 n3 (n4)");
  EXPECT_EQ(state["edgeStates"].size(), 3u);
  EXPECT_EQ(state["edgeStates"][2]["released"], false);
  EXPECT_EQ(way(), "L1.E L2.E L3") << "the base, not the horizon";
}

TEST_F(Orders, OneNodeIsAnOrder) {
  say("order", order("A", 0, {"n1"}));
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(left(), "");
  EXPECT_EQ(way(), "");
  say("order", order("B", 0, {"n1"}));
  EXPECT_EQ(state["orderId"], "B") << "the one before is over";
}

TEST_F(Orders, AnOrderWithAMistakeIsRefused) {
  const auto changed = [](auto change) {
    Json json = order("A", 0, {"n1", "n2", "n3"}, 2);
    change(json);
    return json;
  };
  const std::string bad = "validationError";
  refuses(changed([](Json& j) { j.erase("edges"); }), bad, "edges is missing");
  refuses(changed([](Json& j) { j["nodes"] = nullptr; }), bad, "nodes is null");
  refuses(changed([](Json& j) { j["nodes"] = Json::array(); }), bad, "nodes is empty");
  refuses(changed([](Json& j) { j["nodes"].erase(2); }), bad, "2 nodes need 1 edges");
  refuses(changed([](Json& j) { j["nodes"][1]["sequenceId"] = 3; }), bad, "sequenceId 3, not 2");
  refuses(changed([](Json& j) { j["edges"][0]["sequenceId"] = 2; }), bad, "sequenceId 2, not 1");
  refuses(changed([](Json& j) { j["edges"][0]["startNodeId"] = "n2"; }), bad, "leads from `n2`");
  refuses(changed([](Json& j) { j["nodes"][0]["released"] = false; }), bad, "not released");
  refuses(changed([](Json& j) { j["nodes"][1]["released"] = false; }), bad, "is released, but not both its nodes");
  refuses(changed([](Json& j) { j["nodes"][2]["released"] = true; }), bad, "but not the edge that leads to it");
  refuses(changed([](Json& j) { j["nodes"][1]["nodeId"] = 5; }), bad, "nodes[1].nodeId is a number, not a string");
  refuses(changed([](Json& j) { j["orderUpdateId"] = -1; }), bad, "not a whole number");
  refuses(changed([](Json& j) { j["orderUpdateId"] = 4294967296.0; }), bad, "not a whole number");
  refuses(changed([](Json& j) { j["orderUpdateId"] = 0.5; }), bad, "not a whole number");
  refuses(changed([](Json& j) { j["orderId"] = ""; }), bad, "orderId is empty");
  refuses(changed([](Json& j) { j["orderId"] = std::string(257, 'x'); }), bad, "longer than 256 bytes");
  refuses(order("A", 0, {"n1", "n2"}, 2, 1), bad, "odd sequenceId 1");
  refuses(changed([](Json& j) { j["nodes"][0]["actions"] = Json::array({action("a", "pick", "MAYBE")}); }), bad, "MAYBE");
  refuses(changed([](Json& j) { j["nodes"][0]["actions"] = j["nodes"][1]["actions"] = Json::array({action("a", "pick")}); }), bad, "two actions");
  refuses(changed([](Json& j) { j["nodes"] = Json(10'001, Json::object()); }), bad, "nodes has 10001 parts; 10000 are the most");
  refuses(changed([](Json& j) {
    j["nodes"][0]["actions"] = Json::array({action("a", "pick")});
    j["nodes"][0]["actions"][0]["actionParameters"] = Json::parse(R"([{"key":"k","value":1},{"key":"k","value":2}])");
  }), bad, "`k` is there twice");
}

TEST_F(Orders, WhatTheVehicleCannotDoIsRefused) {
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][1]["actions"] = Json::array({action("z", "danceWaltz")});
  refuses(json, "orderError", "cannot do `danceWaltz`");
  EXPECT_EQ(reference("actionId"), "z");
  json["nodes"][1]["actions"].clear();
  json["edges"][0]["actions"] = Json::array({action("b", "beep", "SOFT")});
  refuses(json, "orderError", "blockingType can only be NONE");
  json["edges"][0]["actions"].clear();
  json["edges"][0]["trajectory"] = {{"degree", 1}};
  refuses(json, "orderError", "follows its own lines");
  EXPECT_EQ(reference("edgeId"), "e12");
}

TEST_F(Orders, WhatTheVehicleDoesNotHeedIsTold) {
  Json json = order("A", 0, {"n1", "n2"});
  json["edges"][0]["maxHeight"] = 2.0;
  json["nodes"][1]["nodePosition"] = {{"x", 6.0}, {"y", 0.0}, {"theta", 1.5}, {"mapId", "yard"}, {"allowedDeviationTheta", 0.1}};
  json["edges"][0]["trajectory"] = nullptr;   // as masters of version 2.0 say that there is none
  say("order", json);
  EXPECT_EQ(errors(), "");
  for (const char* field : {"edges.maxHeight", "nodes.nodePosition.theta", "nodes.nodePosition.allowedDeviationTheta"}) {
    EXPECT_NE(state["information"].dump().find(std::string(field) + " of the order is not heeded"), std::string::npos) << field;
  }
}

TEST_F(Orders, AnEdgeSaysHowFastItsRoadsMayBeDriven) {
  Json json = order("A", 0, {"n1", "n2", "n3"});
  json["edges"][0]["maxSpeed"] = 0.0;
  refuses(json, "validationError", "edges[0].maxSpeed is 0.0, and this vehicle drives no slower than 0.02 m/s");
  json["edges"][0]["maxSpeed"] = "slow";
  refuses(json, "validationError", "edges[0].maxSpeed is a string, not a number");
  json["edges"][0]["maxSpeed"] = 0.3;
  json["edges"][1]["maxSpeed"] = nullptr;
  say("order", json);
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(state["information"].dump().find("not heeded"), std::string::npos);
  const std::vector<Visit>& way = vehicle.task().way;
  ASSERT_GE(way.size(), 3u);
  EXPECT_EQ(way[0].limit_m_s, 0.3);
  EXPECT_EQ(way[1].limit_m_s, 0.0);
}

TEST_F(Orders, NodesAndEdgesHaveToBeKnown) {
  for (int i = 0; i < 2; ++i) refuses(order("A", 0, {"n1", "x9"}), "noRouteError", "no node `x9`");
  EXPECT_EQ(errors(), "noRouteError") << "a mistake that is made again is told once";
  EXPECT_EQ(reference("nodeId"), "x9");
  refuses(order("A", 0, {"n1", "n3"}), "noRouteError", "no edge `e13` from `n1` to `n3`");
  refuses(order("A", 0, {"n1", "n2", "n4"}, 2), "noRouteError", "no edge");
}

TEST_F(Orders, AnOrderBeginsWhereTheVehicleIs) {
  refuses(order("A", 0, {"n4", "n5"}), "noRouteError", "the vehicle is at `L1`");
  progress.here.clear();
  look();
  refuses(order("A", 0, {"n4", "n5"}), "noRouteError", "the vehicle is at `L1`");
  progress.here = "L4";   // somebody has carried it
  look();
  EXPECT_EQ(state["lastNodeId"], "n4");
  say("order", order("A", 0, {"n4", "n5"}));
  EXPECT_EQ(state["orderId"], "A");
}

TEST_F(Orders, AnotherOrderHasToWait) {
  say("order", order("A", 0, {"n1", "n2"}));
  refuses(order("B", 0, {"n1", "n2"}), "orderError", "`A` is not over");
  EXPECT_EQ(reference("orderId"), "B");
  drive();
  say("order", order("B", 0, {"n2", "n3"}));
  EXPECT_EQ(state["orderId"], "B");
  EXPECT_EQ(errors(), "") << "an order that is taken ends all complaints";
}

TEST_F(Orders, AHorizonKeepsTheOrderOpen) {
  say("order", order("A", 0, {"n1", "n2", "n3"}, 2));
  drive();
  EXPECT_EQ(left(), "(n3)");
  refuses(order("B", 0, {"n2", "n3"}), "orderError", "`A` is not over");
  say("order", order("A", 1, {"n2"}, 1, 2));
  EXPECT_EQ(left(), "") << "an update without horizon takes it away";
  say("order", order("B", 0, {"n2", "n3"}));
  EXPECT_EQ(state["orderId"], "B");
}

TEST_F(Orders, AMessageThatComesTwiceIsNoMistake) {
  say("order", order("A", 0, {"n1", "n2"}));
  const std::uint64_t task = vehicle.task().number;
  const int before = states;
  Json again = order("A", 0, {"n1", "n2"});
  again["headerId"] = 77;
  say("order", again);
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(states, before + 1) << "the master learns that it has come";
  EXPECT_EQ(vehicle.task().number, task);
  refuses(order("A", 0, {"n1", "n2", "n3"}), "orderUpdateError", "something else");
}

TEST_F(Orders, AnUpdateGoesOnAtTheEndOfTheBase) {
  say("order", order("A", 4, {"n1", "n2", "n3"}, 2));
  refuses(order("A", 3, {"n2", "n3"}, 2, 2), "orderUpdateError", "update 4 of this order was taken");
  refuses(order("A", 5, {"n3", "n4"}, 2, 4), "orderUpdateError", "not at the end of the base, `n2` (2)");
  refuses(order("A", 5, {"n2", "n3"}, 2, 0), "orderUpdateError", "not at the end of the base, `n2` (2)");
  say("order", order("A", 5, {"n2", "n1", "n2"}, 2, 2));
  EXPECT_EQ(state["orderUpdateId"], 5);
  EXPECT_EQ(left(), "n2 n1 (n2)");
  EXPECT_EQ(errors(), "");
}

TEST_F(Orders, AnActionThatAnUpdateAddsAtTheEndOfTheBaseComesTooLate) {
  Json json = order("A", 0, {"n1", "n2"});
  json["nodes"][1]["actions"] = Json::array({action("p", "pick")});
  say("order", json);
  json = order("A", 1, {"n2", "n3"}, 2, 2);
  json["nodes"][0]["actions"] = Json::array({action("p", "pick"), action("q", "pick")});
  say("order", json);
  EXPECT_EQ(left(), "n2 n3");
  EXPECT_EQ(errors(), "orderUpdateError");
  EXPECT_EQ(reference("actionId"), "q");
  EXPECT_EQ(status("q"), "none");
}

TEST_F(Orders, AFinishedOrderCanBeTakenUpAgain) {
  say("order", order("A", 0, {"n1", "n2"}));
  drive();
  refuses(order("A", 1, {"n1", "n2"}, 2, 0), "orderUpdateError", "`n2` (2)");
  say("order", order("A", 1, {"n2", "n3"}, 2, 2));
  EXPECT_EQ(left(), "n3");
  drive();
  EXPECT_EQ(state["lastNodeSequenceId"], 4);
  progress.here = "L5";   // somebody has carried it away
  look();
  refuses(order("A", 2, {"n3", "n4"}, 2, 4), "orderUpdateError", "`n5` (0)");
}

TEST_F(Orders, ActionsOfTheHorizonWaitAndGoWithIt) {
  Json json = order("A", 0, {"n1", "n2", "n3"}, 2);
  json["nodes"][1]["actions"] = Json::array({action("p", "pick")});
  json["nodes"][2]["actions"] = Json::array({action("d", "drop")});
  say("order", json);
  EXPECT_EQ(status("p"), "WAITING");
  EXPECT_EQ(status("d"), "WAITING");
  json = order("A", 1, {"n2", "n1"}, 2, 2);
  json["nodes"][0]["actions"] = Json::array({action("p", "pick")});   // the node where it goes on comes with what it had
  json["nodes"][1]["actions"] = Json::array({action("q", "pick")});
  say("order", json);
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(status("d"), "none");
  EXPECT_EQ(status("q"), "WAITING");
  EXPECT_EQ(state["actionStates"].size(), 2u);
  json = order("A", 2, {"n1", "n2"}, 2, 4);
  json["nodes"][1]["actions"] = Json::array({action("p", "pick")});
  refuses(json, "validationError", "actionId `p` already");
}

TEST_F(Orders, NodesLieWhereTheOrderSays) {
  Json json = order("A", 0, {"n1", "n2"});
  const auto lies = [&json](double x_m, double y_m, const std::string& map) -> Json& {
    return json["nodes"][1]["nodePosition"] = {{"x", x_m}, {"y", y_m}, {"mapId", map}};
  };
  lies(6, 0, "cellar");
  refuses(json, "noRouteError", "node `n2` is on map `cellar`; the positions of this vehicle are on map `yard`");
  lies(6, 0.6, "yard");
  refuses(json, "noRouteError", "node `n2` lies at (6.00, 0.00), 0.60 m from where the order says");
  json["nodes"][1]["nodePosition"]["allowedDeviationXY"] = "wide";
  refuses(json, "validationError", "nodes[1].nodePosition.allowedDeviationXY is a string, not a number");
  json["nodes"][1]["nodePosition"].erase("x");
  refuses(json, "validationError", "nodes[1].nodePosition.x is missing");
  json["nodes"][1]["nodePosition"] = Json::array();
  refuses(json, "validationError", "nodes[1].nodePosition is a list, not an object");
  lies(6, 0.6, "yard")["allowedDeviationXY"] = 1;
  say("order", json);
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(state["orderId"], "A");
}

TEST_F(Orders, AKeyIsThereOnce) {
  const auto twice = [](std::string text, const std::string& key) {
    const std::size_t at = text.find("\"" + key + "\":");
    return text.insert(at, "\"" + key + "\":null,");
  };
  const std::string good = order("A", 0, {"n1", "n2"}).dump();
  for (const char* key : {"orderId", "nodeId", "endNodeId"}) {
    hear("order", twice(good, key));
    EXPECT_EQ(state["errors"].back()["errorType"], "validationError");
    EXPECT_EQ(last_error(), fmt::format("`{}` is there twice in one object", key));
  }
  refuses(order(std::string("A\0", 2), 0, {"n1", "n2"}), "validationError", "orderId has a NUL");
  hear("order", good);
  EXPECT_EQ(state["orderId"], "A");
}

TEST_F(Orders, AMessageThatTheLinkDroppedIsComplainedOf) {
  hear("order", kDropped);
  EXPECT_EQ(errors(), "validationError");
  EXPECT_EQ(reference("topic"), "order");
  EXPECT_NE(last_error().find("dropped"), std::string::npos);
  hear("instantActions", kDropped);
  EXPECT_EQ(reference("topic"), "instantActions");
}

TEST_F(Orders, MessagesForOthersAndOfOtherVersionsAreRefused) {
  Json json = order("A", 0, {"n1", "n2"});
  refuses(with_header(json, "8"), "validationError", "another vehicle");
  for (const char* other : {"3.0.0", "1.1.0", "2", "2.", "2.banana", "2.-1", "2.1.0.", "2.1.0.4", "2..1", "", "22.1"}) {
    json["version"] = other;
    refuses(json, "validationError", "version `" + std::string(other) + "` is not spoken here");
  }
}

TEST_F(Orders, TheHeaderOfAMessageIsComplete) {
  Json json = order("A", 0, {"n1", "n2"});
  json.erase("headerId");
  refuses(json, "validationError", "headerId is missing");
  json["headerId"] = "first";
  refuses(json, "validationError", "headerId is a string, not a number");
  json["headerId"] = 0;
  json.erase("timestamp");
  refuses(json, "validationError", "timestamp is missing");
  for (const char* no : {"gestern", "", "2026-03-02", "2026-03-02T07:45:00", "2026-02-30T07:45:00Z", "2026-03-02T24:00:00Z", "2026-03-02T07:45:00.Z", "2026-03-02T07:45:00ZZ", "2026-03-02T07:45:00+1"}) {
    json["timestamp"] = no;
    refuses(json, "validationError", "timestamp is `" + std::string(no) + "`");
  }
  int update = 0;
  for (const char* yes : {"2026-03-02T07:45:00Z", "2024-02-29T23:59:60.123456Z", "2026-03-02T07:45:00+01:00"}) {
    json["timestamp"] = yes;
    json["orderId"] = fmt::format("A{}", ++update);
    json["nodes"].erase(json["nodes"].size() - 1), json["edges"].clear();
    say("order", json);
    EXPECT_EQ(state["orderId"], json["orderId"]) << yes << last_error();
    json = order("A", 0, {"n1", "n2"});
  }
}

}  // namespace
}  // namespace kb::vda5050
