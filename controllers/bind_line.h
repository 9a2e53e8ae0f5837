// Chooses and sets up the controller that a control line names.
#pragma once

#include "../runtime/control_line.h"
#include "any_controller.h"
#include "similarity.h"

namespace mts {

/// What a line calls the controller of halls that decides by the rules of the host (Host::decide). No knowledge base has such a name: there it is
/// that of a fuzzy controller.
inline constexpr const char* kRulesOfHost = "follow_rules";

/// What the line says of a parameter; null: nothing.
[[nodiscard]] constexpr const ControlArgument* find_argument(const ControlLine& line, const char* name) noexcept {
  for (std::uint32_t i = 0; i < line.count; ++i) {
    if (same_text(line.arguments[i].name, name)) return &line.arguments[i];
  }
  return nullptr;
}

/// Of the turns of `std.compass8`, the one that controllers know; how far it goes is the map's business.
[[nodiscard]] constexpr const char* main_turn(const char* word) noexcept {
  if (same_text(word, "half_left") || same_text(word, "sharp_left")) return "left";
  return same_text(word, "half_right") || same_text(word, "sharp_right") ? "right" : word;
}

/// What a value of the robot is in the scale of the small one. A line is written for a quick robot. One that is slow (see note [slow wheels take longer] in
/// similarity.h) takes its times, and what hangs on them, as long again; but where a line asks for less speed than the preset, it means that speed.
[[nodiscard]] inline float small_value(float number, const Parameter& parameter, const Similarity& as) noexcept {
  const float quick = as.of_size().in(number, parameter.unit);
  const bool speed = same_text(parameter.unit, "m/s") || same_text(parameter.unit, "deg/s");
  return speed ? greatest(quick, least(as.in(number, parameter.unit), parameter.preset)) : quick;
}

/// Sets a parameter of a chosen controller to what a line says, in units of the robot. `as`: the robot's; `body`: as in its scale. A value that
/// bodies of this size may have, but not this one, as it is slower or broader, becomes the nearest that it can.
[[nodiscard]] inline Setting set_argument(AnyController& controller, const ControlArgument& argument, const Similarity& as, const Body& body) noexcept {
  if (argument.word[0] != '\0') return controller.set_word(argument.name, main_turn(argument.word));
  const Parameter* parameter = find_parameter(controller.id(), argument.name);
  if (parameter == nullptr) return Setting::kUnknown;
  const float value = small_value(argument.number, *parameter, as);
  const float rounded = 1e-6f * greatest(magnitude(parameter->low), magnitude(parameter->high));   // by the conversion of sizes
  const bool possible = value >= parameter->low - rounded && value <= greatest(parameter->high, highest(*parameter, body)) + rounded;
  if (!possible || (argument.unit[0] != '\0' && !same_text(argument.unit, parameter->unit)) || words_of(parameter->values).count > 0) return Setting::kOutside;
  return controller.set(argument.name, clamped(value, lowest(*parameter, body), highest(*parameter, body)));
}

/// The same for a whole line, after choosing its controller. The first argument that does not fit tells the result; those after it are not set.
[[nodiscard]] inline Setting bind_line(AnyController& controller, const ControlLine& line, const Similarity& as, const Body& body, const Host& host) noexcept {
  const ControllerEntry* entry = find_controller(line.controller);
  const bool by_rules = host.decide != nullptr && same_text(line.controller, kRulesOfHost);
  if (entry == nullptr && !by_rules) return Setting::kUnknown;
  controller.choose(by_rules ? ControllerId::kFollowRules : entry->id, body, host);
  for (std::uint32_t i = 0; i < line.count; ++i) {
    const Setting set = set_argument(controller, line.arguments[i], as, body);
    if (set != Setting::kSet) return set;
  }
  return Setting::kSet;
}

}  // namespace mts
