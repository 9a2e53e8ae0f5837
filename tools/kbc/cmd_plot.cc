// kbc plot: pictures of fuzzy controllers, and of how well readings fit prototypes.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "compiler/emit/fuzzy_svg.h"
#include "compiler/emit/prototype_svg.h"
#include "compiler/source/numbers.h"
#include "tools/kbc/checks.h"
#include "tools/kbc/find_named.h"

namespace kb::cli {
namespace {

using diagnostics::Kind;

struct PlotOptions {
  std::string what, file, controller, x, y, output, of;
  std::vector<std::string> at;
};

// The slot of an input: `bearing`, `free[3]`.
std::optional<std::uint32_t> find_slot(const fuzzy::Controller& c, const std::string& name, diagnostics::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (std::uint32_t slot = 0; slot < c.slots; ++slot) {
    names.push_back(fuzzy::slot_name(c, slot));
    if (names.back() == name) return slot;
  }
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  diagnostics.report(Kind::kPlotNothing, {}, {c.name, "input", name}).suggest(diagnostics::closest(name, candidates));
  return std::nullopt;
}

// `free[3]=0.5`, in SI units or degrees, within the range of the input.
bool set_place(const fuzzy::Controller& c, const std::string& text, emit::FuzzyPicture& picture, diagnostics::Diagnostics& diagnostics) {
  const std::size_t equal = text.find('=');
  const auto slot = find_slot(c, text.substr(0, equal), diagnostics);
  if (!slot) return false;
  double value = 0.0;
  const fuzzy::Input& input = c.inputs[fuzzy::input_of_slot(c, *slot)];
  if (source::read_number(std::string_view(text).substr(equal + 1), value) && value >= input.low && value <= input.high) {
    picture.at[*slot] = value;
    const bool axis = *slot == picture.x || *slot == picture.y;
    if (axis) diagnostics.report(Kind::kPlotAxis, {}, {fuzzy::slot_name(c, *slot)});
    return !axis;
  }
  diagnostics.report(Kind::kPlotOutside, {}, {fuzzy::slot_name(c, *slot), fmt::format("{:g}", input.low), fmt::format("{:g}", input.high), text.substr(equal + 1)});
  return false;
}

bool choose(const PlotOptions& options, const fuzzy::Controller& c, emit::FuzzyPicture& picture, diagnostics::Diagnostics& diagnostics) {
  for (std::uint32_t slot = 0; slot < c.slots; ++slot) {
    const fuzzy::Input& input = c.inputs[fuzzy::input_of_slot(c, slot)];
    picture.at.push_back(0.5 * (input.low + input.high));
  }
  if (c.slots > 1) picture.y = 1;
  if (!options.x.empty()) {
    const auto slot = find_slot(c, options.x, diagnostics);
    if (!slot) return false;
    picture.x = *slot;
    if (options.y.empty()) picture.y = fuzzy::kNone;
  }
  if (!options.y.empty()) {
    const auto slot = find_slot(c, options.y, diagnostics);
    if (!slot) return false;
    picture.y = *slot;
    if (options.x.empty() && picture.y == picture.x) picture.x = 1 % c.slots;
  }
  if (picture.y == picture.x) {
    diagnostics.report(Kind::kPlotNothing, {}, {c.name, "second input", options.y});
    return false;
  }
  for (const std::string& place : options.at) {
    if (!set_place(c, place, picture, diagnostics)) return false;
  }
  if (options.of.empty()) return true;
  std::vector<std::string_view> candidates;
  for (std::uint32_t o = 0; o < c.outputs.size(); ++o) {
    candidates.push_back(c.outputs[o].name);
    if (c.outputs[o].name != options.of) continue;
    picture.output = o;
    return true;
  }
  diagnostics.report(Kind::kPlotNothing, {}, {c.name, "output", options.of}).suggest(diagnostics::closest(options.of, candidates));
  return false;
}

// Draws a prototype with which a fact compares a sensor of numbers, found by the prototype's text and, if `--of` names one, the sensor or its reading.
int plot_prototype(const PlotOptions& options, const program::Perception& perception, Session& session, diagnostics::Diagnostics& diagnostics) {
  std::vector<std::string_view> candidates;
  for (const program::Percept& percept : perception.percepts) {
    if (percept.op != program::Percept::Op::kFits) continue;
    const program::Sensor& sensor = perception.sensor_of(percept.reading);
    const program::Prototype& prototype = perception.prototypes[percept.prototype];
    candidates.push_back(prototype.text);
    const bool meant = options.of.empty() || options.of == sensor.name || options.of == perception.reading_name(percept.reading);
    if (!meant || (!options.controller.empty() && prototype.text != options.controller)) continue;
    return session.deliver(options.output,
                   emit::print_prototype_svg(prototype.shape, {sensor.name, prototype.text, sensor.unit, sensor.low, sensor.high, sensor.noise,
                                                               sensor.stale_s.value_or(0.0), sensor.growth}));
  }
  const std::string sensor = options.of.empty() ? "a sensor of numbers" : "`" + options.of + "`", prototype = options.controller.empty() ? "a prototype" : "`" + options.controller + "`";
  auto message = diagnostics.report(Kind::kPlotNoPrototype, {}, {options.file, sensor, prototype});
  if (std::find(candidates.begin(), candidates.end(), options.controller) == candidates.end()) message.suggest(diagnostics::closest(options.controller, candidates));
  return kErrors;
}

int plot(const PlotOptions& options, Session& session) {
  const auto compiled = session.compile(options.file, driver::Stage::kProgram);
  if (!compiled->ok()) return kErrors;
  auto diagnostics = session.diagnostics(compiled->sources);
  if (options.what == "prototype") return plot_prototype(options, compiled->program.perception, session, diagnostics);
  const fuzzy::Controller* controller = find_fuzzy(compiled->program.fuzzy, options.file, options.controller, diagnostics);
  if (controller == nullptr) return kErrors;
  emit::FuzzyPicture picture;
  if (!choose(options, *controller, picture, diagnostics)) return kErrors;
  return session.deliver(options.output, emit::print_fuzzy_svg(*controller, picture));
}

}  // namespace

Run setup_plot(CLI::App& app) {
  auto options = std::make_shared<PlotOptions>();
  app.add_option("WHAT", options->what, "What to draw: a fuzzy controller, or a prototype")->required()->check(CLI::IsMember({"fuzzy", "prototype"}));
  app.add_option("FILE", options->file, "The knowledge base")->required();
  app.add_option("NAME", options->controller, "The name of the controller, needed if there are several, or of the prototype (the first)");
  auto* x = app.add_option("--x", options->x, "The input along the horizontal axis (the first); without --y the output is drawn as a curve")->type_name("INPUT");
  auto* y = app.add_option("--y", options->y, "The input along the vertical axis (the second)")->type_name("INPUT");
  app.add_option("--of", options->of, "The output to draw (the first); for a prototype, the sensor or its reading")->type_name("OUTPUT");
  auto* at = app.add_option("--at", options->at, "The value of an input that is not drawn, in SI units, angles in degrees (the middle of its range); may be given often")->type_name("INPUT=NUMBER");
  app.add_option("-o,--output", options->output, "Write to this file, as SVG")->type_name("FILE")->check(is_svg());
  app.callback([options, x, y, at] {
    for (const CLI::Option* axis : {x, y, at}) {
      if (options->what == "prototype" && axis->count() > 0) throw CLI::ValidationError(axis->get_name(), "is only for `fuzzy`");
    }
    std::set<std::string> inputs;
    for (const std::string& place : options->at) {
      const std::string input = place.substr(0, place.find('='));
      if (!inputs.insert(input).second) throw CLI::ValidationError("--at", "`" + input + "` stays at one number");
    }
  });
  return [options](Session& session) { return plot(*options, session); };
}

}  // namespace kb::cli
