#include "tools/kbc/wire/answer.h"

#include <array>
#include <cmath>
#include <utility>

#include "compiler/program/text.h"
#include "tools/kbc/wire/fields.h"

namespace kb::wire {
namespace {

using program::append_json;
using program::append_key;

constexpr std::array<std::string_view, 3> kPlights{"none", "trapped", "no_way"};
constexpr Range kWheels{-1e6, 1e6};   // the robot limits it further

void append_motion(std::string& out, std::string_view key, float value) {
  append_key(out, key);
  if (value == 0.0f && std::signbit(value)) out += "-0.0";
  else program::append_number(out, std::isfinite(value) ? value : 0.0f);
}

void append_text(std::string& out, std::string_view key, std::string_view text) {
  append_key(out, key);
  if (text.empty()) out += "null";
  else append_json(out, text);
}

void append_texts(std::string& out, std::string_view key, const std::vector<std::string>& texts) {
  append_key(out, key);
  program::append_items(out, texts, [&](const std::string& text) { append_json(out, text); });
}

void append_truth(std::string& out, std::string_view key, bool value) {
  append_key(out, key);
  out += value ? "true" : "false";
}

void append_actions(std::string& out, const std::vector<vda5050::HostAction>& actions) {
  append_key(out, "actions");
  program::append_items(out, actions, [&](const vda5050::HostAction& action) {
    out += "{\"id\":";
    append_json(out, action.id);
    append_key(out, "type");
    append_json(out, action.type);
    append_key(out, "parameters");
    out += action.parameters.empty() ? "{}" : action.parameters;
    if (action.pause) append_truth(out, "pause", true);
    if (action.cancel) append_truth(out, "cancel", true);
    out += '}';
  });
}

}  // namespace

std::string print_answer(const Answer& answer) {
  std::string out = "{\"t\":";
  if (answer.t_us) program::append_seconds(out, *answer.t_us);
  else out += "null";
  append_motion(out, "speed", answer.wheels.speed_m_s);
  append_motion(out, "turn", answer.wheels.turn_rad_s);
  append_text(out, "strategy", answer.strategy);
  append_text(out, "controller", answer.controller);
  append_truth(out, "mission", answer.mission.value_or(false));
  append_text(out, "leg", answer.leg);
  append_text(out, "goal", answer.goal);
  append_texts(out, "reports", answer.reports);
  if (answer.outputs) append_texts(out, "outputs", *answer.outputs);
  append_text(out, "plight", kPlights[static_cast<std::size_t>(answer.plight)]);
  append_truth(out, "lost", answer.lost);
  if (answer.waits) append_truth(out, "waits", true);
  if (!answer.actions.empty()) append_actions(out, answer.actions);
  if (!answer.mind.empty()) append_key(out, "mind"), out += answer.mind;
  if (answer.seen) append_texts(out, "seen", *answer.seen);
  return out + "}";
}

std::string print_answer(const Mistake& mistake, std::uint64_t line, const std::vector<vda5050::HostAction>& actions) {
  std::string out = "{\"t\":null,\"speed\":0,\"turn\":0,\"error\":{\"code\":\"" + diagnostics::code_text(mistake.kind) + "\",\"line\":" + std::to_string(line) +
                    ",\"column\":" + std::to_string(mistake.span.begin + 1);
  append_text(out, "field", mistake.field);
  append_text(out, "message", message_of(mistake));
  out += '}';
  if (!actions.empty()) append_actions(out, actions);
  return out + "}";
}

std::string print_end(std::string_view why) {
  std::string out = "{\"t\":null,\"speed\":0,\"turn\":0";
  append_text(out, "end", why);
  return out + "}";
}

std::variant<Answer, Mistake> read_answer(std::string_view text) {
  Reading reading;
  const auto object = reading.object(text);
  if (!object) return *reading.mistake();
  Answer answer;
  reading.once("", *object);
  const auto with = [&](std::string_view key, auto use) {
    if (const Json* part = object->find(key)) use(*part);
  };
  for (const auto& [key, value] : {std::pair("speed", &answer.wheels.speed_m_s), std::pair("turn", &answer.wheels.turn_rad_s)}) {
    const Json* part = object->find(key);
    if (part != nullptr) reading.number(key, *part, kWheels, *value);
    else reading.missing(key, "an answer says `speed` in m/s and `turn` in rad/s", object->span);
  }
  with("strategy", [&](const Json& json) { reading.text("strategy", json, answer.strategy); });
  with("mission", [&](const Json& json) { reading.truth("mission", json, answer.mission.emplace()); });
  with("leg", [&](const Json& json) { reading.text("leg", json, answer.leg); });
  with("goal", [&](const Json& json) { reading.text("goal", json, answer.goal); });
  with("reports", [&](const Json& json) { reading.texts("reports", json, answer.reports); });
  with("mind", [&](const Json& json) {
    if (reading.is("mind", json, Json::Kind::kObject)) answer.mind = part_at(text, json.span.begin);
  });
  with("seen", [&](const Json& json) { reading.texts("seen", json, answer.seen.emplace()); });
  if (reading.mistake()) return *reading.mistake();
  return answer;
}

}  // namespace kb::wire
