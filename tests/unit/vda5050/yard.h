// A yard with nine nodes in a row, a vehicle in it, its master and its robot.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "tools/kbc/vda5050/vehicle.h"

namespace kb::vda5050 {

using Json = nlohmann::ordered_json;

/// Nodes n1 to n9 at landmarks L1 to L9, 6 m apart; edges e12, e21, e23 ...; `long` leads from n3 to n5 over L4. n2b is at L2 as well,
/// and `turn` leads there from n2.
class Row final : public Plant {
 public:
  std::optional<std::string> landmark_of(std::string_view node) const override {
    if (node == "n2b") return "L2";
    return node.size() == 2 && node[0] == 'n' && node[1] >= '1' && node[1] <= '9' ? std::optional("L" + std::string(1, node[1])) : std::nullopt;
  }
  std::optional<std::string> node_at(std::string_view landmark) const override {
    return landmark.size() == 2 && landmark[0] == 'L' ? std::optional("n" + std::string(1, landmark[1])) : std::nullopt;
  }
  std::optional<std::vector<Visit>> way(std::string_view edge, std::string_view from, std::string_view to) const override {
    if (edge == "turn" && from == "n2" && to == "n2b") return std::vector<Visit>{};
    if (edge == "e2b3" && from == "n2b" && to == "n3") return std::vector<Visit>{{"L2", "E"}};
    if (edge == "long" && from == "n3" && to == "n5") return std::vector<Visit>{{"L3", "E"}, {"L4", "E"}};
    if (from.size() != 2 || to.size() != 2 || edge != fmt::format("e{}{}", from[1], to[1]) || std::abs(from[1] - to[1]) != 1) return std::nullopt;
    return std::vector<Visit>{{*landmark_of(from), from[1] < to[1] ? "E" : "W"}};
  }
  std::optional<Pose> pose(const Whereabouts& where) const override {
    const double from_m = 6.0 * (where.road.landmark[1] - '1'), along_m = std::min(where.along_m, 6.0);
    const bool west = where.road.exit == "W";
    return Pose{from_m + (where.road.exit.empty() ? 0.0 : west ? -along_m : along_m), 0.0, west != where.outwards ? 0.0 : 3.1416};
  }
  std::optional<Standing> standing_at(const Pose& pose) const override {
    const int behind = static_cast<int>(pose.x_m / 6.0) + 1;
    if (std::abs(pose.y_m) > 0.3 || std::abs(pose.theta_rad) > 0.5) return std::nullopt;   // roads lead east
    return Standing{{{fmt::format("L{}", behind), "E"}, pose.x_m - 6.0 * (behind - 1)}, fmt::format("L{}", behind + 1)};
  }
  bool leads_back(const Visit& road) const override { return road.landmark != "L8"; }
  std::optional<Pose> place_of(std::string_view node) const override {
    const auto landmark = knows_places ? landmark_of(node) : std::nullopt;
    return landmark ? pose({{*landmark}}) : std::nullopt;
  }
  std::string map_id() const override { return map; }

  std::string map = "yard";
  bool knows_places = true;
};

inline std::string edge_name(std::string_view from, std::string_view to) {
  if (from == "n2" && to == "n2b") return "turn";
  if (from == "n3" && to == "n5") return "long";
  return fmt::format("e{}{}", from.substr(1), to.substr(1));
}

inline Json with_header(Json message, const std::string& serial = "7") {
  message.update({{"headerId", 1}, {"timestamp", "2026-11-25T00:00:00.00Z"}, {"version", "2.0.0"}, {"manufacturer", "Acme"}, {"serialNumber", serial}});
  return message;
}

/// The first `released` nodes are the base.
inline Json order(const std::string& id, int update, const std::vector<std::string>& nodes, std::size_t released = 1'000'000, int sequence = 0) {
  Json out{{"orderId", id}, {"orderUpdateId", update}, {"nodes", Json::array()}, {"edges", Json::array()}};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const int at = sequence + 2 * static_cast<int>(i);
    if (i > 0) {
      out["edges"].push_back({{"edgeId", edge_name(nodes[i - 1], nodes[i])}, {"sequenceId", at - 1}, {"released", i < released}, {"startNodeId", nodes[i - 1]}, {"endNodeId", nodes[i]},
                              {"actions", Json::array()}});
    }
    out["nodes"].push_back({{"nodeId", nodes[i]}, {"sequenceId", at}, {"released", i < released}, {"actions", Json::array()}});
  }
  return with_header(out);
}

inline Json action(const std::string& id, const std::string& type, const std::string& blocking = "HARD") {
  return {{"actionId", id}, {"actionType", type}, {"blockingType", blocking}};
}

class Yard : public testing::Test {
 protected:
  // ---- the master
  void say(const std::string& topic, const Json& message) { hear(topic, message.dump()); }
  void hear(const std::string& topic, const std::string& payload) {
    vehicle.hear({topic, payload}, us);
    collect();
  }
  void instruct(const std::string& id, const std::string& type, const std::string& blocking = "NONE") {
    say("instantActions", with_header({{"actions", Json::array({action(id, type, blocking)})}}));
  }

  // ---- the robot
  /// Looks around every tenth of a second, for so long.
  void look(double s = 0.1) {
    for (int i = 0; i < static_cast<int>(s * 10 + 0.5); ++i) {
      us += 100'000;
      vehicle.observe(progress, condition, std::exchange(words, {}), {us, us});
      collect();
    }
  }
  /// Sets off with the task, to the sign of its first landmark.
  void begin() {
    progress.task = vehicle.task().number;
    progress.reached = 0;
    progress.on_mission = true;
    progress.speed_m_s = 0.5;
    progress.here.clear();
  }
  /// The same, and on through that crossing.
  void set_off() {
    begin();
    progress.reached = 1;
    progress.in_crossing = true;
    look();
    progress.in_crossing = false;
  }
  /// Reads the sign of the next landmark.
  void pass() {
    ++progress.reached;
    progress.since_m = 0.0;
    look();
  }
  /// Stands, its mission over.
  void stop() {
    progress.on_mission = false;
    progress.speed_m_s = progress.turn_rad_s = 0.0;
    look();
  }
  /// All of the task.
  void drive() {
    set_off();
    while (progress.reached < vehicle.task().visits()) pass();
    stop();
  }

  // ---- what is told
  void collect() {
    int now = 0;
    for (Message& message : vehicle.take_messages()) {
      const Json json = Json::parse(message.payload);
      if (message.topic == "state") state = json, ++states, ++now;
      sent.emplace_back(std::move(message), json);
    }
    EXPECT_LE(now, 1) << "one state for all that happens at once";
  }
  /// The nodes that are left: `n1 n2 (n3)`, horizon in brackets.
  std::string left() const {
    std::string out;
    for (const Json& node : state["nodeStates"]) {
      const std::string id = node["nodeId"];
      out += (out.empty() ? "" : " ") + (node["released"] == true ? id : "(" + id + ")");
    }
    return out;
  }
  std::string way() const {
    std::string out;
    for (const Visit& visit : vehicle.task().way) out += fmt::format("{}{}{}{}", out.empty() ? "" : " ", visit.landmark, visit.exit.empty() ? "" : ".", visit.exit);
    return out;
  }
  std::string status(const std::string& id) const {
    for (const Json& one : state["actionStates"]) {
      if (one["actionId"] == id) return one["actionStatus"];
    }
    return "none";
  }
  /// The types of all errors.
  std::string errors() const {
    std::string out;
    for (const Json& error : state["errors"]) out += (out.empty() ? "" : " ") + error["errorType"].get<std::string>();
    return out;
  }
  std::string last_error() const { return state["errors"].empty() ? "" : state["errors"].back()["errorDescription"].get<std::string>(); }
  std::string reference(const std::string& key) const {
    for (const Json& one : state["errors"].back()["errorReferences"]) {
      if (one["referenceKey"] == key) return one["referenceValue"];
    }
    return "";
  }
  std::string host_actions() const {
    std::string out;
    for (const HostAction& action : vehicle.host_actions()) out += (out.empty() ? "" : " ") + action.id;
    return out;
  }

  Row row;
  Vehicle vehicle{{"Acme", "7"}, {{"pick", {}}, {"drop", {}}, {"beep", 2.0}, {"waitForTrigger", {}}}, row};
  std::int64_t us = 0;
  Progress progress;
  Condition condition;
  std::vector<HostActionState> words;
  std::vector<std::pair<Message, Json>> sent;
  Json state;
  int states = 0;
};

/// The yard with the robot at its first landmark.
class AtTheFirst : public Yard {
 protected:
  void SetUp() override {
    progress.here = "L1";
    look();
  }
};

}  // namespace kb::vda5050
