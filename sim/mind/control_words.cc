#include "sim/mind/control_words.h"

#include <fmt/format.h>

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>

#include <waymark/controllers/any_controller.h>

namespace kb::sim {
namespace {

using diagnostics::Kind;

void check_argument(const program::Control& control, const program::Control::Argument& argument, mts::ControllerId id, diagnostics::Diagnostics& diagnostics) {
  const mts::Parameter* parameter = mts::find_parameter(id, argument.name.c_str());
  if (parameter == nullptr) {
    std::optional<std::string> meant;
    mts::for_each_parameter(id, [&](const mts::Parameter& known) {
      if (diagnostics::is_slip_of(argument.name, known.name)) meant = known.name;
    });
    if (meant) diagnostics.report(Kind::kControlArgument, argument.span, {control.controller, argument.name}).suggest(meant);
    return;
  }
  const bool plain = argument.is_number && parameter->values == mts::Values::kNumber;
  const bool same_unit = argument.unit.empty() || argument.unit == parameter->unit;
  if (!plain || !same_unit) return;   // words may be of the user's own tasks; other units are told where they are bound
  const auto value = static_cast<float>(argument.number);
  if (value >= parameter->low && value <= parameter->high) return;
  const std::string unit = *parameter->unit != '\0' ? fmt::format(" {}", parameter->unit) : "";
  diagnostics.report(Kind::kControlRange, argument.span,
                     {argument.name, control.controller, fmt::format("{:g} to {:g}{}", parameter->low, parameter->high, unit), fmt::format("{:g}{}", value, unit)});
}

}  // namespace

void check_controls(const program::Program& program, diagnostics::Diagnostics& diagnostics) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> told;   // one line may be that of many strategies
  for (const program::Control& control : program.controls) {
    const source::Span at = control.controller_span;
    if (control.fuzzy != fuzzy::kNone || !told.insert({static_cast<std::uint32_t>(at.file), at.begin}).second) continue;
    const mts::ControllerEntry* entry = mts::find_controller(control.controller.c_str());
    if (entry != nullptr) {
      for (const auto& argument : control.arguments) check_argument(control, argument, entry->id, diagnostics);
      continue;
    }
    for (const mts::ControllerEntry& known : mts::kControllers) {
      if (diagnostics::is_slip_of(control.controller, known.name)) diagnostics.report(Kind::kControlName, at, {control.controller}).suggest(std::string(known.name));
    }
  }
}

}  // namespace kb::sim
