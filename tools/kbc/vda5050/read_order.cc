#include "tools/kbc/vda5050/read_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <utility>

#include "compiler/model/speed.h"
#include "tools/kbc/json/date_time.h"
#include "tools/kbc/json/json.h"

namespace kb::vda5050 {
namespace {

using json::Json;

/// The beginning of a text, for a message.
std::string clipped(const std::string& text) { return text.substr(0, kLongestId); }

void print(const Json& json, std::string& out) {
  const auto quote = [&out](const std::string& text) { out += nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace); };
  switch (json.kind) {
    case Json::Kind::kNull: out += "null"; return;
    case Json::Kind::kBool:
    case Json::Kind::kNumber: out += json.text; return;
    case Json::Kind::kString: quote(json.text); return;
    case Json::Kind::kList:
    case Json::Kind::kObject: break;
  }
  const bool object = json.kind == Json::Kind::kObject;
  out += object ? '{' : '[';
  for (std::size_t i = 0; i < json.parts.size(); ++i) {   // the recursion is no deeper than the JSON that the reader accepts
    if (i > 0) out += ',';
    if (object) quote(json.keys[i]), out += ':';
    print(json.parts[i], out);
  }
  out += object ? '}' : ']';
}

/// Whether it is 2.N or 2.N.N: a later 2.N only adds to what this reads.
bool is_second_version(std::string_view version) {
  std::size_t numbers = 0;
  for (std::size_t at = 0; at <= version.size(); ++numbers) {
    const std::size_t end = std::min(version.find('.', at), version.size());
    const std::string_view number = version.substr(at, end - at);
    const bool digits = !number.empty() && number.size() <= 9 && number.find_first_not_of("0123456789") == std::string_view::npos;
    if (!digits || (numbers == 0 && number != "2")) return false;
    at = end + 1;
  }
  return numbers == 2 || numbers == 3;
}

/// Reads fields of objects and checks their types. Keeps the first mistake; after it, what it returns has no meaning.
class Reader {
 public:
  explicit Reader(std::string topic) : topic_(std::move(topic)) {}

  [[nodiscard]] std::optional<Json> message(std::string_view payload, const Identity& identity) {
    if (payload == kDropped) return refuse("more messages came at once than this vehicle takes, and at least this one was dropped");
    if (payload.size() > kMostBytes) return refuse(fmt::format("the message is longer than {} bytes", kMostBytes));
    json::Fault fault;
    std::optional<Json> root = json::parse(payload, source::FileId::kNone, fault);
    if (!root) return refuse(fmt::format("this is no JSON: {}, at byte {}", fault.what, fault.span.begin + 1));
    if (root->kind != Json::Kind::kObject) return refuse("the message is no object");
    if (const auto twice = json::repeated_key(*root)) return refuse(fmt::format("`{}` is there twice in one object", clipped(std::string(twice->key))));
    for (const char* key : {"headerId", "orderId", "orderUpdateId"}) {
      const Json* value = root->find(key);
      if (value != nullptr && (value->kind == Json::Kind::kNumber || value->kind == Json::Kind::kString)) references_.emplace_back(key, clipped(value->text));
    }
    static_cast<void>(count(*root, "headerId", ""));
    const std::string sent = text(*root, "timestamp", "");
    if (!failed() && !json::is_date_time(sent)) return refuse(fmt::format("timestamp is `{}`, not like 2026-03-02T07:45:00.00Z", clipped(sent)));
    const std::string version = text(*root, "version", ""), maker = text(*root, "manufacturer", ""), serial = text(*root, "serialNumber", "");
    if (failed()) return std::nullopt;
    if (!is_second_version(version)) return refuse(fmt::format("version `{}` is not spoken here, but 2.0.0 and 2.1.0", clipped(version)), {{"version", clipped(version)}});
    if (maker != identity.manufacturer || serial != identity.serial) {
      return refuse("this is meant for another vehicle", {{"manufacturer", clipped(maker)}, {"serialNumber", clipped(serial)}});
    }
    return root;
  }

  [[nodiscard]] std::string text(const Json& object, const char* key, std::string_view where) {
    const Json* value = need(object, key, where, Json::Kind::kString);
    return value != nullptr ? value->text : "";
  }
  [[nodiscard]] std::string name(const Json& object, const char* key, std::string_view where) {
    std::string value = text(object, key, where);
    if (!failed() && value.empty()) wrong(fmt::format("{}{} is empty", where, key));
    if (!failed() && value.find('\0') != std::string::npos) wrong(fmt::format("{}{} has a NUL", where, key));
    if (!failed() && value.size() > kLongestId) wrong(fmt::format("{}{} is longer than {} bytes", where, key, kLongestId));
    return failed() ? "" : value;
  }
  [[nodiscard]] std::uint32_t count(const Json& object, const char* key, std::string_view where) {
    const Json* value = need(object, key, where, Json::Kind::kNumber);
    if (value == nullptr) return 0;
    if (value->number >= 0.0 && value->number <= 4294967295.0 && value->number == std::floor(value->number)) return static_cast<std::uint32_t>(value->number);
    wrong(fmt::format("{}{} is {}, not a whole number from 0 to 4294967295", where, key, clipped(value->text)));
    return 0;
  }
  [[nodiscard]] double number(const Json& object, const char* key, const std::string& where) {
    const Json* value = need(object, key, where, Json::Kind::kNumber);
    return value != nullptr ? value->number : 0.0;
  }
  /// The object of that name; null if it is not there.
  [[nodiscard]] const Json* part(const Json& object, const char* key, std::string_view where) {
    return object.find(key) != nullptr ? need(object, key, where, Json::Kind::kObject) : nullptr;
  }
  /// 0 if it is not there.
  [[nodiscard]] double speed(const Json& object, const char* key, std::string_view where) {
    if (object.find(key) == nullptr) return 0.0;
    const Json* value = need(object, key, where, Json::Kind::kNumber);
    if (value == nullptr || value->number >= model::kSlowest_m_per_s) return value != nullptr ? value->number : 0.0;
    wrong(fmt::format("{}{} is {}, and this vehicle drives no slower than {} m/s", where, key, clipped(value->text), model::kSlowest_m_per_s));
    return 0.0;
  }
  [[nodiscard]] bool truth(const Json& object, const char* key, std::string_view where) {
    const Json* value = need(object, key, where, Json::Kind::kBool);
    return value != nullptr && value->text == "true";
  }
  [[nodiscard]] const std::vector<Json>& objects(const Json& object, const char* key, std::string_view where, std::size_t most, bool must = true) {
    static const std::vector<Json> kNothing;
    if (!must && object.find(key) == nullptr) return kNothing;
    const Json* value = need(object, key, where, Json::Kind::kList);
    if (value == nullptr) return kNothing;
    if (value->parts.size() > most) {
      wrong(fmt::format("{}{} has {} parts; {} are the most", where, key, value->parts.size(), most));
      return kNothing;
    }
    for (std::size_t i = 0; i < value->parts.size() && !failed(); ++i) {
      if (value->parts[i].kind != Json::Kind::kObject) wrong(fmt::format("{}{}[{}] is no object", where, key, i));
    }
    return value->parts;
  }

  void wrong(std::string description, std::vector<std::pair<std::string, std::string>> references = {}, std::string type = "validationError") {
    if (failed()) return;
    references.insert(references.begin(), references_.begin(), references_.end());
    references.insert(references.begin(), {"topic", topic_});
    complaint_ = Complaint{std::move(type), std::move(description), std::move(references)};
  }
  [[nodiscard]] bool failed() const { return complaint_.has_value(); }
  [[nodiscard]] Complaint complaint() { return std::move(*complaint_); }

 private:
  std::nullopt_t refuse(std::string description, std::vector<std::pair<std::string, std::string>> references = {}) {
    wrong(std::move(description), std::move(references));
    return std::nullopt;
  }
  [[nodiscard]] const Json* need(const Json& object, const char* key, std::string_view where, Json::Kind kind) {
    const Json* value = object.find(key);
    const bool null = value == nullptr && std::find(object.keys.begin(), object.keys.end(), key) != object.keys.end();
    if (value == nullptr) wrong(fmt::format("{}{} is {}", where, key, null ? "null" : "missing"));
    else if (value->kind != kind) wrong(fmt::format("{}{} is {}, not {}", where, key, json::kind_name(value->kind), json::kind_name(kind)));
    return value != nullptr && value->kind == kind ? value : nullptr;
  }

  std::string topic_;
  std::vector<std::pair<std::string, std::string>> references_;
  std::optional<Complaint> complaint_;
};

std::string read_parameters(Reader& reader, const Json& json, const std::string& where) {
  std::string out = "{";
  std::set<std::string_view> seen;
  for (const Json& parameter : reader.objects(json, "actionParameters", where, kMostActions, false)) {
    if (reader.failed()) break;
    const std::string key = reader.text(parameter, "key", where + "actionParameters.");
    const Json* value = parameter.find("value");
    if (value == nullptr) reader.wrong(fmt::format("{}actionParameters: `{}` has no value", where, clipped(key)));
    if (reader.failed()) break;
    if (!seen.insert(parameter.find("key")->text).second) reader.wrong(fmt::format("{}actionParameters: `{}` is there twice", where, clipped(key)));
    if (out.size() > 1) out += ',';
    out += nlohmann::json(key).dump();
    out += ':';
    print(*value, out);
    if (out.size() >= kLongestParameters) reader.wrong(fmt::format("{}actionParameters are longer than {} bytes", where, kLongestParameters));
    if (reader.failed()) break;
  }
  return out + '}';
}

Action read_action(Reader& reader, const Json& json, const std::string& where) {
  Action action{reader.name(json, "actionId", where), reader.name(json, "actionType", where), Blocking::kNone, "{}"};
  const std::string blocking = reader.text(json, "blockingType", where);
  if (blocking == "SOFT") action.blocking = Blocking::kSoft;
  else if (blocking == "HARD") action.blocking = Blocking::kHard;
  else if (blocking != "NONE") reader.wrong(fmt::format("{}blockingType is {}, not NONE, SOFT or HARD", where, clipped(blocking)), {{"actionId", action.id}});
  if (!reader.failed()) action.parameters = read_parameters(reader, json, where);
  return action;
}

std::vector<Action> read_actions(Reader& reader, const Json& json, const char* key, const std::string& where, std::size_t most) {
  std::vector<Action> actions;
  for (const Json& part : reader.objects(json, key, where, most)) {
    if (reader.failed()) break;
    actions.push_back(read_action(reader, part, fmt::format("{}{}[{}].", where, key, actions.size())));
  }
  return actions;
}

std::optional<NodePosition> read_node_position(Reader& reader, const Json& node, const std::string& where) {
  const Json* json = reader.part(node, "nodePosition", where);
  if (json == nullptr) return std::nullopt;
  const std::string within = where + "nodePosition.";
  NodePosition position;
  position.x_m = reader.number(*json, "x", within);
  position.y_m = reader.number(*json, "y", within);
  if (json->find("mapId") != nullptr) position.map = reader.text(*json, "mapId", within);
  if (json->find("allowedDeviationXY") != nullptr) position.deviation_m = reader.number(*json, "allowedDeviationXY", within);
  return position;
}

Node read_node(Reader& reader, const Json& json, const std::string& where) {
  return {reader.name(json, "nodeId", where), reader.count(json, "sequenceId", where), reader.truth(json, "released", where),
          read_actions(reader, json, "actions", where, kMostActions), {}, read_node_position(reader, json, where)};
}

Edge read_edge(Reader& reader, const Json& json, const std::string& where) {
  Edge edge{reader.name(json, "edgeId", where), reader.count(json, "sequenceId", where), reader.truth(json, "released", where),
            reader.name(json, "startNodeId", where), reader.name(json, "endNodeId", where), read_actions(reader, json, "actions", where, kMostActions),
            reader.speed(json, "maxSpeed", where)};
  // 6.6.4.2: a vehicle that follows lines refuses trajectories.
  if (json.find("trajectory") != nullptr) reader.wrong(where + "trajectory: this vehicle follows its own lines", {{"edgeId", edge.id}}, "orderError");
  for (const Action& action : edge.actions) {
    if (action.blocking == Blocking::kNone) continue;
    reader.wrong(fmt::format("action `{}` is to be done on edge `{}`, where this vehicle does not stand; its blockingType can only be NONE", action.id, edge.id),
                 {{"edgeId", edge.id}, {"actionId", action.id}}, "orderError");
  }
  return edge;
}

/// Notes fields about how to drive that this vehicle ignores.
void note_unused(const std::vector<const Json*>& objects, const char* prefix, std::initializer_list<const char*> keys, std::vector<std::string>& unused) {
  for (const char* key : keys) {
    if (std::any_of(objects.begin(), objects.end(), [key](const Json* part) { return part->find(key) != nullptr; })) unused.push_back(fmt::format("{}.{}", prefix, key));
  }
}

/// 6.6.1: checks that nodes and edges alternate, and that the base comes before the horizon.
void check_chain(Reader& reader, const Order& order) {
  if (order.nodes.empty()) return reader.wrong("nodes is empty");
  if (order.edges.size() + 1 != order.nodes.size()) return reader.wrong(fmt::format("{} nodes need {} edges, not {}", order.nodes.size(), order.nodes.size() - 1, order.edges.size()));
  const Node& first = order.nodes.front();
  if (first.sequence % 2 != 0) return reader.wrong(fmt::format("node `{}` has the odd sequenceId {}", first.id, first.sequence), {{"nodeId", first.id}});
  if (!first.released) return reader.wrong(fmt::format("node `{}`, the first, is not released", first.id), {{"nodeId", first.id}});
  for (std::size_t i = 0; i < order.edges.size() && !reader.failed(); ++i) {
    const Node &from = order.nodes[i], &to = order.nodes[i + 1];
    const Edge& edge = order.edges[i];
    const auto bad = [&](std::string what) { reader.wrong(fmt::format("edge `{}` {}", edge.id, what), {{"edgeId", edge.id}}); };
    const std::uint64_t next = std::uint64_t{from.sequence} + 1;
    if (edge.sequence != next) bad(fmt::format("has sequenceId {}, not {}", edge.sequence, next));
    if (to.sequence != next + 1) reader.wrong(fmt::format("node `{}` has sequenceId {}, not {}", to.id, to.sequence, next + 1), {{"nodeId", to.id}});
    if (edge.from != from.id || edge.to != to.id) bad(fmt::format("leads from `{}` to `{}`, not from `{}` to `{}`", edge.from, edge.to, from.id, to.id));
    if (edge.released && !(from.released && to.released)) bad("is released, but not both its nodes");
    if (!edge.released && to.released) reader.wrong(fmt::format("node `{}` is released, but not the edge that leads to it", to.id), {{"nodeId", to.id}});
  }
}

void check_actions(Reader& reader, const Order& order) {
  std::set<std::string_view> ids;
  const auto check = [&](const std::vector<Action>& actions) {
    for (const Action& action : actions) {
      if (!ids.insert(action.id).second) reader.wrong(fmt::format("two actions have the actionId `{}`", action.id), {{"actionId", action.id}});
    }
  };
  for (const Node& node : order.nodes) check(node.actions);
  for (const Edge& edge : order.edges) check(edge.actions);
  if (ids.size() > kMostActions) reader.wrong(fmt::format("there are {} actions; {} are the most", ids.size(), kMostActions));
}

std::variant<Order, Complaint> read_order(std::string_view payload, const Identity& identity) {
  Reader reader("order");
  const std::optional<Json> root = reader.message(payload, identity);
  if (!root) return reader.complaint();
  Order order{reader.name(*root, "orderId", ""), reader.count(*root, "orderUpdateId", ""), {}, {}};
  for (const Json& node : reader.objects(*root, "nodes", "", kMostNodes)) {
    if (reader.failed()) break;
    order.nodes.push_back(read_node(reader, node, fmt::format("nodes[{}].", order.nodes.size())));
  }
  for (const Json& edge : reader.objects(*root, "edges", "", kMostNodes)) {
    if (reader.failed()) break;
    order.edges.push_back(read_edge(reader, edge, fmt::format("edges[{}].", order.edges.size())));
  }
  if (!reader.failed()) check_chain(reader, order);
  if (!reader.failed()) check_actions(reader, order);
  if (reader.failed()) return reader.complaint();
  if (root->find("zoneSetId") != nullptr) order.unused.emplace_back("zoneSetId");
  std::vector<const Json*> positions, edges;
  for (const Json& edge : root->find("edges")->parts) edges.push_back(&edge);
  for (const Json& node : root->find("nodes")->parts) {
    if (const Json* position = node.find("nodePosition")) positions.push_back(position);
  }
  note_unused(positions, "nodes.nodePosition", {"theta", "allowedDeviationTheta"}, order.unused);
  note_unused(edges, "edges", {"maxHeight", "minHeight", "orientation", "direction", "rotationAllowed", "maxRotationSpeed", "corridor"}, order.unused);
  return order;
}

std::variant<std::vector<Action>, Complaint> read_instant_actions(std::string_view payload, const Identity& identity) {
  Reader reader("instantActions");
  const std::optional<Json> root = reader.message(payload, identity);
  if (!root) return reader.complaint();
  const char* key = root->find("actions") == nullptr && root->find("instantActions") != nullptr ? "instantActions" : "actions";
  std::vector<Action> actions = read_actions(reader, *root, key, "", kMostInstants);
  if (reader.failed()) return reader.complaint();
  return actions;
}

}  // namespace

std::variant<Position, std::string> read_position(const std::string& parameters) {
  json::Fault fault;
  const std::optional<Json> json = json::parse(parameters, source::FileId::kNone, fault);
  Position position;
  struct Number { const char* key; double* value; };
  for (const auto& [key, value] : {Number{"x", &position.pose.x_m}, Number{"y", &position.pose.y_m}, Number{"theta", &position.pose.theta_rad}}) {
    const Json* said = json ? json->find(key) : nullptr;
    if (said == nullptr || said->kind != Json::Kind::kNumber) return fmt::format("parameter `{}` of initPosition is a number", key);
    *value = said->number;
  }
  struct Text { const char* key; std::string* value; };
  for (const auto& [key, value] : {Text{"mapId", &position.map_id}, Text{"lastNodeId", &position.last_node}}) {
    const Json* said = json->find(key);
    if (said == nullptr || said->kind != Json::Kind::kString) return fmt::format("parameter `{}` of initPosition is a text", key);
    *value = said->text;
  }
  return position;
}

ReadMessage read_message(const Message& message, const Identity& identity) {
  if (message.topic == "order") return {read_order(message.payload, identity)};
  if (message.topic == "instantActions") return {read_instant_actions(message.payload, identity)};
  return {};
}

}  // namespace kb::vda5050
