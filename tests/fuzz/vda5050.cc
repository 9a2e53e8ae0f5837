// Any bytes as what a master says and a robot does. A line is one event; its first byte says which:
//   o JSON      an order                       i JSON      instant actions
//   u BYTES     an order made of them, so that many are good ones
//   a BYTES     an instant action made of them
//   others      the robot has gone on; each byte says something of it
// After each, what the vehicle tells has to hold together.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "tests/fuzz/reading.h"
#include "tools/kbc/vda5050/vehicle.h"

namespace {

using Json = nlohmann::ordered_json;
using namespace kb::vda5050;

/// Nodes a to h in a row; capital letters are the same places, and an edge to the same place has no way.
class Row final : public Plant {
 public:
  std::optional<std::string> landmark_of(std::string_view node) const override {
    if (node.size() != 1 || (node[0] | 32) < 'a' || (node[0] | 32) > 'h') return std::nullopt;
    return std::string(1, static_cast<char>(node[0] | 32));
  }
  std::optional<std::string> node_at(std::string_view landmark) const override { return std::string(landmark); }
  std::optional<std::vector<Visit>> way(std::string_view, std::string_view from, std::string_view to) const override {
    const int a = from[0] | 32, b = to[0] | 32;
    if (a == b) return std::vector<Visit>{};
    if (std::abs(a - b) > 3) return std::nullopt;
    std::vector<Visit> way;
    for (int at = a; at != b; at += a < b ? 1 : -1) way.push_back({std::string(1, static_cast<char>(at)), a < b ? "E" : "W"});
    return way;
  }
  std::optional<Pose> pose(const Whereabouts& where) const override { return Pose{static_cast<double>(where.road.landmark[0]), where.along_m, 0.0}; }
  std::optional<Pose> place_of(std::string_view node) const override { return pose({{std::string(node)}}); }
  std::optional<Standing> standing_at(const Pose& pose) const override {
    return pose.x_m < 0.0 ? std::nullopt : std::optional(Standing{{{"b", "E"}, pose.x_m}, "c"});
  }
  bool leads_back(const Visit& road) const override { return road.landmark != "d"; }
  std::string map_id() const override { return "row"; }
};

void require(bool good) {
  if (!good) std::abort();
}

Json with_header(Json message) {
  message.update({{"headerId", 0}, {"timestamp", "2026-11-21T03:21:44.736Z"}, {"version", "2.1.0"}, {"manufacturer", "m"}, {"serialNumber", "s"}});
  return message;
}

Json action(std::uint8_t byte, const std::string& id) {
  constexpr const char* kTypes[] = {"pick", "beep", "waitForTrigger", "dance", "cancelOrder", "startPause", "stopPause", "stateRequest"};
  constexpr const char* kBlocking[] = {"NONE", "SOFT", "HARD", "NONE"};
  return {{"actionId", id}, {"actionType", kTypes[byte & 7]}, {"blockingType", kBlocking[(byte >> 3) & 3]}};
}

/// Its name, its update, its first sequence id, how much is released; then nodes, and digits for actions at the last one.
std::string make_order(std::string_view bytes, int number) {
  const auto byte = [&](std::size_t i) -> std::uint8_t { return i < bytes.size() ? static_cast<std::uint8_t>(bytes[i]) : std::uint8_t{0}; };
  const int first = (byte(2) & 15) * 2;
  Json order = with_header({{"orderId", std::string(1, static_cast<char>('A' + (byte(0) & 3)))}, {"orderUpdateId", byte(1) & 15}, {"nodes", Json::array()}, {"edges", Json::array()}});
  for (std::size_t i = 4; i < bytes.size(); ++i) {
    const std::size_t count = order["nodes"].size();
    if (byte(i) >= 0x80) {
      if (count == 0) continue;
      Json& at = (byte(i) & 0x40) != 0 && count > 1 ? order["edges"].back() : order["nodes"].back();
      at["actions"].push_back(action(byte(i), std::to_string(number) + "." + std::to_string(i)));
      continue;
    }
    const std::string node(1, static_cast<char>(((byte(i) & 8) != 0 ? 'A' : 'a') + (byte(i) & 7)));
    const int sequence = first + 2 * static_cast<int>(count);
    const bool released = count <= (byte(3) & 15u);
    if (count > 0) {
      order["edges"].push_back({{"edgeId", "e"}, {"sequenceId", sequence - 1}, {"released", released}, {"startNodeId", order["nodes"].back()["nodeId"]}, {"endNodeId", node}, {"actions", Json::array()}});
    }
    order["nodes"].push_back({{"nodeId", node}, {"sequenceId", sequence}, {"released", released}, {"actions", Json::array()}});
  }
  return order.dump();
}

class Yard {
 public:
  void event(std::string_view line) {
    const char what = line.empty() ? ' ' : line[0];
    const std::string_view rest = line.substr(line.empty() ? 0 : 1);
    const auto byte = [&](std::size_t i) -> std::uint8_t { return i < rest.size() ? static_cast<std::uint8_t>(rest[i]) : std::uint8_t{0}; };
    ++number_;
    if (what == 'o') vehicle_.hear({"order", std::string(rest)}, us_);
    else if (what == 'i') vehicle_.hear({"instantActions", std::string(rest)}, us_);
    else if (what == 'u') vehicle_.hear({"order", make_order(rest, number_)}, us_);
    else if (what == 'a') vehicle_.hear({"instantActions", with_header({{"actions", Json::array({action(byte(0), std::to_string(number_))})}}).dump()}, us_);
    else observe(line);
    check();
  }

 private:
  void observe(std::string_view line) {
    const auto byte = [&](std::size_t i) -> std::uint8_t { return i < line.size() ? static_cast<std::uint8_t>(line[i]) : std::uint8_t{0}; };
    us_ += 100'000 * (byte(0) & 63);
    Progress progress;
    progress.task = vehicle_.task().number - (byte(1) & 1u);
    if ((byte(1) & 2) != 0 || progress.task != task_) reached_ = std::exchange(task_, progress.task) == progress.task ? reached_ + 1 : 0;
    progress.reached = reached_;
    progress.on_mission = (byte(1) & 4) == 0 && !vehicle_.task().way.empty();
    progress.speed_m_s = (byte(1) & 8) != 0 ? 0.5 : 0.0;
    if ((byte(1) & 16) != 0) progress.here = std::string(1, static_cast<char>('a' + (byte(2) & 7)));
    if ((byte(1) & 32) != 0) progress.reports = {"Help.lost"};
    if ((byte(2) & 64) != 0) progress.at = Whereabouts{{std::string(1, static_cast<char>('a' + ((byte(2) >> 3) & 7))), (byte(3) & 8) != 0 ? "E" : "W"}, 1.0, (byte(3) & 16) != 0};
    Condition condition;
    if ((byte(1) & 192) == 192) condition.mode = "MANUAL";
    std::vector<HostActionState> words;
    constexpr const char* kWords[] = {"running", "paused", "finished", "failed"};
    for (const HostAction& action : vehicle_.host_actions()) {
      if ((byte(3) & 1) != 0) words.push_back({action.id, kWords[(byte(3) >> 1) & 3], ""});
    }
    vehicle_.observe(progress, condition, words, {us_, us_});
  }

  void check() {
    std::size_t told = 0;
    for (const Message& message : vehicle_.take_messages()) {
      const Json json = Json::parse(message.payload);
      if (message.topic != "state") continue;
      ++told;
      require(json["headerId"] == states_++);
      const Json &nodes = json["nodeStates"], &edges = json["edgeStates"];
      const std::size_t back = nodes.size() - edges.size();   // 1: it comes to its last node once more
      require(back == 0 || (back == 1 && nodes[0]["sequenceId"] == json["lastNodeSequenceId"] && nodes[0]["released"] == true));
      for (std::size_t i = 0; i < edges.size(); ++i) {
        const Json& node = nodes[i + back];
        require(node["sequenceId"] == edges[i]["sequenceId"].get<int>() + 1 && node["released"] == edges[i]["released"]);
        require(i + back == 0 || nodes[i + back - 1]["released"] == true || node["released"] == false);
        require(i > 0 || edges[i]["sequenceId"] == json["lastNodeSequenceId"].get<int>() + 1);
      }
      require(json["errors"].size() <= 41 && json["actionStates"].size() <= 12'000);
    }
    require(told <= 1);
    const std::vector<Visit>& way = vehicle_.task().way;
    require(way.empty() || way.back().exit.empty());
    for (std::size_t i = 1; i < way.size(); ++i) require(std::abs(way[i].landmark[0] - way[i - 1].landmark[0]) == 1 && !way[i - 1].exit.empty());
  }

  Row row_;
  Vehicle vehicle_{{"m", "s"}, {{"pick", {}}, {"beep", 1.0}, {"waitForTrigger", {}}}, row_};
  std::int64_t us_ = 0;
  std::uint64_t task_ = 0;
  std::size_t reached_ = 0;
  int number_ = 0, states_ = 0;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  Yard yard;
  while (!rest.empty()) yard.event(kb::take_line(rest));
  return 0;
}
