// Writes the messages of a vehicle: VDA 5050 2.1, 6.10.6 (state), 6.14 (connection), 6.15 (factsheet).
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <utility>

#include "tools/kbc/vda5050/vehicle_state.h"

namespace kb::vda5050 {
namespace {

using Out = nlohmann::ordered_json;

constexpr std::size_t kMostReports = 20;
constexpr std::string_view kWaitsForButton = "Help.power";   // not a report of the knowledge base: while it holds, the robot obeys nobody

Out header(const Identity& identity, std::uint32_t id, std::int64_t utc_us) {
  return {{"headerId", id}, {"timestamp", timestamp(utc_us)}, {"version", "2.1.0"}, {"manufacturer", identity.manufacturer}, {"serialNumber", identity.serial}};
}

/// JSON as text. Bytes that are not UTF-8, which a host may have sent, become U+FFFD.
std::string text_of(const Out& json) { return json.dump(-1, ' ', false, Out::error_handler_t::replace); }

/// Rounded to a tenth of a millimetre; 0 instead of infinities and NaN, which JSON does not have.
double rounded(double value) {
  const double scaled = std::round(value * 1e4);
  return std::isfinite(scaled) ? scaled / 1e4 + 0.0 : 0.0;
}

Out references(const std::vector<std::pair<std::string, std::string>>& all) {
  Out out = Out::array();
  for (const auto& [key, value] : all) out.push_back({{"referenceKey", key}, {"referenceValue", value}});
  return out;
}

Out error(const Complaint& complaint) {
  return {{"errorType", complaint.type}, {"errorReferences", references(complaint.references)}, {"errorDescription", complaint.description},
          {"errorLevel", complaint.fatal ? "FATAL" : "WARNING"}};
}

Out info(const char* type, std::string description, const std::vector<std::pair<std::string, std::string>>& about = {}) {
  return {{"infoType", type}, {"infoReferences", references(about)}, {"infoDescription", std::move(description)}, {"infoLevel", "INFO"}};
}

template <class Part>
Out left_of(std::span<const Part> parts, const char* id) {
  Out out = Out::array();
  for (const Part& part : parts) out.push_back({{id, part.id}, {"sequenceId", part.sequence}, {"released", part.released}});
  return out;
}

Out action_states(const std::vector<ActionState>& all) {
  Out out = Out::array();
  for (const ActionState& state : all) {
    Out one{{"actionId", state.action.id}, {"actionType", state.action.type}, {"actionStatus", status_name(state.status)}};
    if (!state.result.empty()) one["resultDescription"] = state.result;
    out.push_back(std::move(one));
  }
  return out;
}

/// Has no `blockingTypes`, because the schema of 2.1.0 accepts no list there.
Out agv_action(std::string_view type, Out scopes) { return {{"actionType", type}, {"actionScopes", std::move(scopes)}}; }

Out limits(double visualization_s) {
  Out timing{{"minOrderInterval", 0.0}, {"minStateInterval", 0.0}, {"defaultStateInterval", 30.0}};
  if (visualization_s > 0.0) timing["visualizationInterval"] = visualization_s;
  return {{"maxStringLens", {{"msgLen", kMostBytes}, {"idLen", kLongestId}, {"idNumericalOnly", false}}},
          {"maxArrayLens", {{"order.nodes", kMostNodes}, {"order.edges", kMostNodes - 1}, {"node.actions", kMostActions}, {"edge.actions", kMostActions},
                            {"actions.actionsParameters", kMostActions}, {"instantActions", kMostInstants}, {"state.nodeStates", kMostNodes}}},
          {"timing", std::move(timing)}};
}

}  // namespace

std::string timestamp(std::int64_t utc_us) {
  using namespace std::chrono;
  constexpr std::int64_t kLastMs = 253'402'300'799'999;   // the last millisecond of the year 9999
  const sys_time<milliseconds> at{milliseconds(std::clamp<std::int64_t>(utc_us / 1000, 0, kLastMs))};
  const sys_days day = floor<days>(at);
  const year_month_day date(day);
  const hh_mm_ss<milliseconds> time(at - day);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}.{:03}Z", static_cast<int>(date.year()), static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                     time.hours().count(), time.minutes().count(), time.seconds().count(), time.subseconds().count());
}

Message connection_message(const Identity& identity, std::string_view word, std::uint32_t header_id, std::int64_t utc_us) {
  Out out = header(identity, header_id, utc_us);
  out["connectionState"] = word;
  return {"connection", text_of(out), true};
}

Shown Vehicle::State::shown() const {
  return {driving, condition.charging, condition.field_violation, base_request(), paused || held, waits, stopped, silent, condition.e_stop, condition.mode, book.last_node(), reports};
}

/// Adds where the robot is, and how fast it moves.
void Vehicle::State::add_motion(Out& out) {
  const std::optional<Pose> pose = at ? plant.pose(*at) : std::nullopt, faces = on_road ? plant.pose(*on_road) : std::nullopt;
  if (pose && faces) {
    out["agvPosition"] = {{"positionInitialized", true}, {"x", rounded(pose->x_m)}, {"y", rounded(pose->y_m)}, {"theta", rounded(faces->theta_rad)}, {"mapId", plant.map_id()}};
  }
  out["velocity"] = {{"vx", rounded(speed_m_s)}, {"vy", 0.0}, {"omega", rounded(turn_rad_s)}};
}

void Vehicle::State::send_state(std::int64_t utc_us) {
  Out out = header(identity, states++, utc_us);
  out.update({{"orderId", book.id()}, {"orderUpdateId", book.update()}, {"lastNodeId", book.last_node()}, {"lastNodeSequenceId", book.last_sequence()}});
  out["nodeStates"] = left_of(book.nodes_left(), "nodeId");
  out["edgeStates"] = left_of(book.edges_left(), "edgeId");
  add_motion(out);
  out["driving"] = driving;
  out["paused"] = paused || held;
  out["newBaseRequest"] = base_request();
  out["distanceSinceLastNode"] = rounded(passed_m + since_m);
  out["actionStates"] = action_states(actions.all());
  const bool battery_known = condition.battery_percent && std::isfinite(*condition.battery_percent);
  const double battery_percent = battery_known ? std::clamp(*condition.battery_percent, 0.0, 100.0) : 100.0;
  out["batteryState"] = {{"batteryCharge", rounded(battery_percent)}, {"charging", condition.charging}};
  out["operatingMode"] = condition.mode;

  Out errors = Out::array();
  for (const Complaint& complaint : complaints) errors.push_back(error(complaint));
  for (std::size_t i = 0; i < reports.size() && i < kMostReports; ++i) errors.push_back(error({reports[i], "the robot reports " + reports[i], {}, reports[i] == kWaitsForButton}));
  if (silent) errors.push_back(error({"robotSilent", "nothing that can be used is heard from the robot, or it takes no answers; it stands", {}, true}));
  if (gave_up) errors.push_back(error({"cannotGoOn", "the robot has given up its way; cancelOrder frees it", {{"orderId", book.id()}, {"orderUpdateId", std::to_string(book.update())}}, true}));
  out["errors"] = std::move(errors);
  Out infos = Out::array();
  if (!battery_known) infos.push_back(info("batteryUnknown", "nobody tells how full the battery is"));
  if (waits) infos.push_back(info("waits", "a rule of the robot's own holds it until something is done"));
  if (stopped) infos.push_back(info("standsAtStopLine", "the robot stands before a crossing: it is not safe to enter, or no way on is open"));
  for (const std::string& field : book.unused()) infos.push_back(info("fieldPassedOver", field + " of the order is not heeded", {{"orderId", book.id()}}));
  out["information"] = std::move(infos);
  out["safetyState"] = {{"eStop", condition.e_stop}, {"fieldViolation", condition.field_violation}};
  send({"state", text_of(out), false});
}

void Vehicle::State::send_visualization(std::int64_t utc_us) {
  Out out = header(identity, visualizations++, utc_us);
  add_motion(out);
  send({"visualization", text_of(out), false});
}

void Vehicle::State::send_factsheet(std::int64_t utc_us) {
  Out out = header(identity, factsheets++, utc_us);
  out["typeSpecification"] = {{"seriesName", "Waymark"}, {"agvKinematic", "DIFF"}, {"agvClass", "CARRIER"}, {"maxLoadMass", 0.0},
                              {"localizationTypes", Out::array({"RFID"})}, {"navigationTypes", Out::array({"PHYSICAL_LINE_GUIDED"})}};
  out["physicalParameters"] = {{"speedMin", 0.0}, {"speedMax", rounded(sheet.speed_max_m_s)}, {"accelerationMax", rounded(sheet.acceleration_m_s2)},
                               {"decelerationMax", rounded(sheet.deceleration_m_s2)}, {"heightMin", 0.0}, {"heightMax", 0.0},
                               {"width", rounded(sheet.width_m)}, {"length", rounded(sheet.length_m)}};
  out["protocolLimits"] = limits(sheet.visualization_s);
  Out able = Out::array();
  for (const std::string_view type : kOwnActions) able.push_back(agv_action(type, Out::array({"INSTANT"})));
  for (const Skill& skill : actions.skills()) able.push_back(agv_action(skill.type, Out::array({"INSTANT", "NODE", "EDGE"})));
  out["protocolFeatures"] = {{"optionalParameters", Out::array({{{"parameter", "order.edges.maxSpeed"}, {"support", "SUPPORTED"}}})}, {"agvActions", std::move(able)}};
  out["agvGeometry"] = Out::object();
  out["loadSpecification"] = Out::object();
  send({"factsheet", text_of(out), true});
}

}  // namespace kb::vda5050
