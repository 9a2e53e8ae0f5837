// The messages of a vehicle and when they are sent (VDA 5050 2.1, 6.10 and 6.14), its modes, and what it makes of anything that comes.
#include "tests/unit/vda5050/yard.h"

#include <limits>

#include "tests/unit/stride.h"

namespace kb::vda5050 {
namespace {

TEST_F(Yard, TheFirstWordIsOnlineAndTheLastIsOffline) {
  us = 1'764'035'096'123'456;
  look();
  ASSERT_EQ(sent.size(), 2u);
  EXPECT_EQ(sent[0].first.topic, "connection");
  EXPECT_TRUE(sent[0].first.retained);
  EXPECT_EQ(sent[0].second["connectionState"], "ONLINE");
  EXPECT_EQ(sent[0].second["headerId"], 0);
  EXPECT_EQ(sent[0].second["timestamp"], "2025-11-25T01:44:56.223Z");
  EXPECT_EQ(sent[0].second["version"], "2.1.0");
  EXPECT_EQ(sent[0].second["manufacturer"], "Acme");
  EXPECT_EQ(sent[0].second["serialNumber"], "7");
  EXPECT_EQ(sent[1].first.topic, "state");
  EXPECT_FALSE(sent[1].first.retained);
  const Message will = will_of({"Acme", "7"}, 1, us), farewell = vehicle.farewell(us);
  EXPECT_EQ(Json::parse(will.payload)["connectionState"], "CONNECTIONBROKEN");
  EXPECT_EQ(Json::parse(will.payload)["timestamp"], sent[0].second["timestamp"]);
  EXPECT_EQ(Json::parse(farewell.payload)["connectionState"], "OFFLINE");
  EXPECT_EQ(Json::parse(farewell.payload)["headerId"], 1);
}

TEST_F(Yard, OverANewConnectionAllIsToldAgainWithHeadersOfNow) {
  vehicle.tell_again(us);
  EXPECT_TRUE(vehicle.take_messages().empty()) << "it has not told anything yet";
  look();
  instruct("f", "factsheetRequest");
  sent.clear();
  us += 60'000'000;
  vehicle.tell_again(us);
  look();
  ASSERT_EQ(sent.size(), 3u);
  EXPECT_EQ(sent[0].second["connectionState"], "ONLINE") << "the broker may have said that the vehicle is gone";
  EXPECT_EQ(sent[0].second["headerId"], 1);
  EXPECT_EQ(sent[0].second["timestamp"], "1970-01-01T00:01:00.100Z");
  EXPECT_EQ(sent[1].first.topic, "factsheet");
  EXPECT_EQ(sent[1].second["headerId"], 1);
  EXPECT_EQ(sent[2].first.topic, "state");
}

TEST_F(Yard, AStateIsSentWhenSomethingChangesAndEveryThirtySeconds) {
  look();
  EXPECT_EQ(states, 1);
  look(29.9);
  EXPECT_EQ(states, 1);
  look(0.1);
  EXPECT_EQ(states, 2);
  EXPECT_EQ(state["headerId"], 1);
  const auto sends = [this](auto change) {
    change();
    const int before = states;
    look();
    EXPECT_EQ(states, before + 1);
    look(3);
    EXPECT_EQ(states, before + 1);
  };
  sends([this] { progress.speed_m_s = 0.3; });
  EXPECT_EQ(state["driving"], true);
  sends([this] { progress.speed_m_s = 0.0; });
  sends([this] { progress.turn_rad_s = -0.3; });
  EXPECT_EQ(state["driving"], true) << "so it does when it turns";
  sends([this] { progress.turn_rad_s = 0.0; });
  sends([this] { condition.e_stop = "AUTOACK"; });
  EXPECT_EQ(state["safetyState"]["eStop"], "AUTOACK");
  sends([this] { condition.field_violation = true; });
  sends([this] { condition.charging = true; });
  sends([this] { condition.mode = "SEMIAUTOMATIC"; });
  sends([this] { progress.held = true; });
  EXPECT_EQ(state["paused"], true) << "by its own switch";
  sends([this] { progress.held = false; });
  sends([this] { progress.silent = true; });
  EXPECT_EQ(errors(), "robotSilent");
  sends([this] { progress.silent = false; });
  EXPECT_EQ(errors(), "");
  sends([this] { progress.waits = true; });
  EXPECT_EQ(state["paused"], false);
  EXPECT_EQ(state["information"].back()["infoType"], "waits");
  sends([this] { progress.stopped = true; });
  EXPECT_EQ(state["information"].back()["infoType"], "standsAtStopLine");
  sends([this] { progress.reports = {"Help.lost"}; });
  sends([this] { progress.own_mission = "ToPlug"; });
  EXPECT_EQ(errors(), "ownMission Help.lost");
  EXPECT_EQ(state["errors"].front()["errorReferences"].size(), 0u) << "it has no order";
  sends([this] { progress.here = "L3"; });
  EXPECT_EQ(state["lastNodeId"], "n3");
}

TEST_F(AtTheFirst, AClockThatIsSetByAnHourPassesNoTime) {
  instruct("b", "beep");
  look();
  EXPECT_EQ(status("b"), "RUNNING") << "it takes two seconds";
  for (const std::int64_t set_us : {3'600'000'000, -3'600'000'000}) {
    vehicle.observe(progress, condition, {}, {us + set_us, us + 100'000});
    collect();
    EXPECT_EQ(status("b"), "RUNNING");
  }
  look(2.0);
  EXPECT_EQ(status("b"), "FINISHED");
}

TEST_F(Yard, AnOrderIsCancelledThoughTheRobotHasFallenSilent) {
  progress.here = "L1";
  look();
  say("order", order("A", 0, {"n1", "n2"}));
  set_off();
  instruct("c", "cancelOrder");
  progress.speed_m_s = 0.0;
  progress.silent = true;
  look(2.9);
  EXPECT_EQ(status("c"), "RUNNING");
  look(0.3);
  EXPECT_EQ(status("c"), "FINISHED");
}

TEST_F(Yard, WhereItIsIsToldAsOftenAsIsWished) {
  Sheet sheet;
  sheet.visualization_s = 0.5;
  Vehicle one({"Acme", "7"}, {}, row, sheet);
  progress.at = Whereabouts{{"L2", "E"}, 1.0, false};
  std::vector<Json> told;
  for (int i = 0; i <= 20; ++i) {
    progress.at->along_m = 0.1 * i;
    progress.speed_m_s = 0.4;
    one.observe(progress, condition, {}, {1'000'000'000 + 100'000 * i, 100'000 * i});
    for (const Message& message : one.take_messages()) {
      if (message.topic == "visualization") told.push_back(Json::parse(message.payload));
    }
  }
  ASSERT_EQ(told.size(), 5u) << "at once, and then every half second";
  EXPECT_EQ(told[2]["headerId"], 2);
  EXPECT_NEAR(told[2]["agvPosition"]["x"], 7.0, 1e-9);
  EXPECT_NEAR(told[2]["velocity"]["vx"], 0.4, 1e-9);
  one.hear({"instantActions", with_header({{"actions", Json::array({action("f", "factsheetRequest", "NONE")})}}).dump()}, 1'002'100'000);
  EXPECT_EQ(Json::parse(one.take_messages().front().payload)["protocolLimits"]["timing"]["visualizationInterval"], 0.5);
}

TEST_F(Yard, ASpeedThatTremblesIsNoChange) {
  look();
  for (int i = 0; i < 50; ++i) {
    progress.speed_m_s = i % 2 == 0 ? 0.015 : -0.002;
    look();
  }
  EXPECT_EQ(states, 1);
}

TEST_F(Yard, ABatteryThatNobodyKnowsCountsAsFull) {
  look();
  EXPECT_EQ(state["batteryState"]["batteryCharge"], 100.0);
  EXPECT_EQ(state["information"][0]["infoType"], "batteryUnknown");
  condition.battery_percent = 42.5;
  look(30);
  EXPECT_EQ(state["batteryState"]["batteryCharge"], 42.5);
  condition.battery_percent = 104.0;
  look(30);
  EXPECT_EQ(state["batteryState"]["batteryCharge"], 100.0) << "more than full is full";
  EXPECT_TRUE(state["information"].empty());
}

TEST_F(Yard, WhoTakesTheVehicleInHandEndsItsOrder) {
  for (const char* mode : {"MANUAL", "SERVICE", "TEACHIN", "strange"}) {
    Json json = order(mode, 0, {"n1", "n2"});
    json["nodes"][0]["actions"] = Json::array({action(std::string("p") + mode, "pick", "NONE")});
    progress.here = "L1";
    condition.mode = "AUTOMATIC";
    look();
    say("order", json);
    set_off();
    condition.mode = mode;
    look();
    EXPECT_EQ(left(), "") << mode;
    EXPECT_EQ(way(), "");
    EXPECT_EQ(status(std::string("p") + mode), "FAILED");
    EXPECT_EQ(host_actions(), "");
    say("order", order("B", 0, {"n1", "n2"}));
    EXPECT_EQ(state["orderId"], mode);
    EXPECT_EQ(errors(), "orderError") << "the master is not in control";
    instruct(std::string("i") + mode, "pick");
    EXPECT_EQ(status(std::string("i") + mode), "FAILED");
    stop();
  }
  EXPECT_EQ(state["operatingMode"], "MANUAL") << "a word that nobody knows is no reason to drive";
}

TEST_F(Yard, InSomebodysHandsItForgetsWhereItIsAfterTwoSeconds) {
  progress.here = "L1";
  look();
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  pass();
  condition.mode = "MANUAL";
  progress.held = true;   // by a switch of its own, which changes nothing
  stop();
  look(1.8);
  EXPECT_FALSE(vehicle.in_hand());
  EXPECT_EQ(state["lastNodeId"], "n2") << "somebody has only looked after it";
  look(0.2);
  EXPECT_TRUE(vehicle.in_hand());
  EXPECT_EQ(state["lastNodeId"], "");
  condition.mode = "AUTOMATIC";
  look();
  EXPECT_FALSE(vehicle.in_hand());
  say("order", order("B", 0, {"n6", "n7"}));
  EXPECT_EQ(errors(), "") << "where it was counts no more";
  begin();
  look();
  progress.here = "L2";
  look();
  EXPECT_EQ(errors(), "orderError cannotGoOn") << "nor does the crossing that it entered before";
}

TEST_F(Yard, TheModeIsTheFirstReasonToRefuseAnOrder) {
  condition.mode = "MANUAL";
  look();
  say("order", order("A", 0, {"x1"}));
  EXPECT_EQ(errors(), "orderError");
  EXPECT_EQ(last_error(), "the vehicle is in mode MANUAL");
}

TEST_F(Yard, WhatNeedsAPersonIsFatal) {
  progress.reports = {"Help.power", "Help.lost"};
  progress.silent = true;
  look();
  EXPECT_EQ(errors(), "Help.power Help.lost robotSilent");
  EXPECT_EQ(state["errors"][0]["errorLevel"], "FATAL");
  EXPECT_EQ(state["errors"][1]["errorLevel"], "WARNING") << "it can be cancelled and sent elsewhere";
  EXPECT_EQ(state["errors"][2]["errorLevel"], "FATAL");
}

TEST_F(Yard, ACancelThatIsUnderWayEndsWithTheOrder) {
  progress.here = "L1";
  look();
  say("order", order("A", 0, {"n1", "n2", "n3"}));
  set_off();
  instruct("c", "cancelOrder");
  condition.mode = "MANUAL";
  look();
  EXPECT_EQ(status("c"), "FINISHED");
}

TEST_F(Yard, AnythingThatComesIsAnsweredWithAStateAndChangesNothing) {
  progress.here = "L1";
  look();
  const std::string deep = std::string(100'000, '[');
  std::string many = R"({"version":"2.1.0","manufacturer":"Acme","serialNumber":"7","orderId":"A","orderUpdateId":0,"edges":[],"nodes":[0)";
  for (int i = 0; i < 10'000; ++i) many += ",0";
  const std::string good = order("A", 0, {"n1", "n2"}).dump();
  std::vector<std::string> bad{"", "null", "[]", "{}", "\xff\xfe", std::string(3, '\0'), deep, many + "]}", good + '\0', good + std::string(5'000'000, ' '),
                               R"({"version":"2.1.0","manufacturer":"Acme","serialNumber":"7","orderId":"A","orderUpdateId":1e999})",
                               R"({"version":"2.1.0","manufacturer":"Acme","serialNumber":"7","orderId":")" + std::string(1'000'000, 'x') + "\"}"};
  for (std::size_t i = 0; i < good.size(); i += kb::testing::stride()) bad.push_back(good.substr(0, i));
  for (const std::string& payload : bad) {
    for (const char* topic : {"order", "instantActions"}) {
      const int before = states;
      hear(topic, payload);
      EXPECT_EQ(states, before + 1);
      EXPECT_EQ(state["orderId"], "") << payload.substr(0, 200);
      EXPECT_GE(state["errors"].size(), 1u);
      EXPECT_LE(state["errors"].size(), 20u) << "no more than fit";
      EXPECT_LE(sent.back().first.payload.size(), 50'000u);
    }
  }
  hear("weather", good);
  EXPECT_EQ(state["orderId"], "");
  hear("order", good);
  EXPECT_EQ(state["orderId"], "A");
}

TEST_F(Yard, AbsurdNumbersOfTheRobotAreStillJson) {
  const double inf = std::numeric_limits<double>::infinity();
  condition.battery_percent = std::nan("");
  progress = {7, ~std::size_t{0}, true, -inf, std::nan(""), inf, "L1", {"Help.\xff"}};
  us = std::numeric_limits<std::int64_t>::max() - 1'000'000;
  look();
  words = {{"\xff", "finished", "\xff"}};
  look();
  EXPECT_EQ(sent.front().second["timestamp"], "9999-12-31T23:59:59.999Z");
  EXPECT_EQ(state["velocity"]["vx"], 0.0);
  EXPECT_EQ(errors(), "Help.\xEF\xBF\xBD") << "bytes that are no text";
  EXPECT_EQ(state["driving"], false);
  say("order", order("A", 0, {"n1", "n2"}));
  progress.task = vehicle.task().number;
  look();
  EXPECT_EQ(state["lastNodeId"], "n2");
  progress.reports.assign(1'000, "Help.lost");
  look();
  EXPECT_EQ(state["errors"].size(), 20u);
}

TEST_F(Yard, ALongOrderIsTaken) {
  std::vector<std::string> nodes;
  for (int i = 0; i < 10'000; ++i) nodes.push_back(i % 2 == 0 ? "n1" : "n2");
  say("order", order("A", 0, nodes));
  EXPECT_EQ(errors(), "");
  EXPECT_EQ(vehicle.task().way.size(), 10'000u);
  nodes.resize(2);
  say("order", order("A", 1, {"n2", "n1", "n2"}, 3, 19'998));
  EXPECT_EQ(errors(), "orderUpdateError") << "there is enough to drive";
}

TEST_F(Yard, TheSameComesOutForTheSame) {
  const auto run = [this] {
    Vehicle one({"Acme", "7"}, {{"beep", 2.0}}, row);
    std::string out;
    Json json = order("A", 0, {"n1", "n2"});
    json["nodes"][0]["actions"] = Json::array({action("b", "beep")});
    one.hear({"order", json.dump()}, 5);
    for (int i = 0; i < 40; ++i) one.observe({one.task().number, 1, true, 0.1, 0.0, 0.1 * i, "", {}}, {}, {}, {100'000 * i, 100'000 * i});
    for (const Message& message : one.take_messages()) out += message.topic + message.payload;
    return out;
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
}  // namespace kb::vda5050
