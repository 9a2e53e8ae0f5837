#include "sim/mind/hall_rules.h"

#include <algorithm>
#include <limits>

namespace kb::sim {
namespace {

using diagnostics::Kind;

bool fixes(const program::Control& control, const std::string& input) {
  return std::any_of(control.arguments.begin(), control.arguments.end(), [&](const auto& argument) { return argument.name == input; });
}

/// On a circle of 360 degrees it does not matter where the range begins.
bool takes_all_bearings(const fuzzy::Input& input) {
  return input.circular ? input.high - input.low == 360.0 : input.low <= -180.0 && input.high >= 180.0;
}

std::uint32_t place_of(const auto& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const auto& one) { return one.name == name; });
  return static_cast<std::uint32_t>(found - list.begin());
}

}  // namespace

bool check_rules(const fuzzy::Controller& controller, const program::Control& control, diagnostics::Diagnostics& diagnostics) {
  bool good = true;
  const auto want = [&](bool there, const std::string& who, std::string_view what) {
    if (!there) diagnostics.report(Kind::kSimMissing, control.span, {who, what});
    good = good && there;
  };
  const std::string driver = "`" + controller.name + "`, which is to drive,";
  const auto has_input = [&](std::string_view name, std::uint32_t count, std::string_view unit, const auto& takes) {
    return std::any_of(controller.inputs.begin(), controller.inputs.end(), [&](const fuzzy::Input& input) {
      return input.name == name && input.count == count && input.group == (count > 1) && input.unit == unit && takes(input);
    });
  };
  const auto has_output = [&](std::string_view name, std::string_view unit, double low, double high) {
    return std::any_of(controller.outputs.begin(), controller.outputs.end(), [&](const fuzzy::Output& output) {
      return output.name == name && output.unit == unit && output.low >= low && output.high <= high;
    });
  };
  constexpr double kAny = std::numeric_limits<double>::infinity();   // a turn is reduced to half a circle to each side
  const bool fixed = fixes(control, "bearing");
  want(has_input("bearing", 1, "deg", [&](const fuzzy::Input& input) { return fixed || takes_all_bearings(input); }), driver,
       "input bearing -180..180 deg");
  want(has_input("free", mts::kRangeFinders, "", [](const fuzzy::Input& input) { return input.low == 0.0 && input.high == 1.0; }), driver,
       "input free[8] 0..1");
  want(has_output("turn", "deg", -kAny, kAny), driver, "output turn -180..180 deg");
  want(has_output("speed", "", 0.0, 1.0), driver, "output speed 0..1");
  for (const fuzzy::Input& input : controller.inputs) {
    const bool supplied = input.name == "bearing" || input.name == "free";
    want(supplied || fixes(control, input.name), "the control line of `" + controller.name + "`", input.name);
  }
  return good;
}

HallRules::HallRules(const fuzzy::Controller& controller, const program::Control& control)
    : form_(tables::pack(controller)), numbers_(controller.slots, 0.0f) {
  for (const auto& argument : control.arguments) {
    const std::uint32_t input = place_of(controller.inputs, argument.name);
    numbers_[controller.inputs[input].first_slot] = static_cast<float>(argument.number);
  }
  bearing_fixed_ = fixes(control, "bearing");
  bearing_ = controller.inputs[place_of(controller.inputs, "bearing")].first_slot;
  free_ = controller.inputs[place_of(controller.inputs, "free")].first_slot;
  turn_ = place_of(controller.outputs, "turn");
  speed_ = place_of(controller.outputs, "speed");
}

mts::RulesOutput HallRules::decide(const mts::RulesInput& input) {
  if (!bearing_fixed_) numbers_[bearing_] = input.bearing_deg;
  std::copy(std::begin(input.free), std::end(input.free), numbers_.begin() + free_);
  const tables::FuzzyAnswer answer = tables::evaluate(form_, numbers_);
  return {answer.outputs[turn_], answer.outputs[speed_], answer.status < mts::FuzzyStatus::kNoRule};
}

}  // namespace kb::sim
