#include "compiler/model/effects.h"

#include <fmt/format.h>

namespace kb::model {

using diagnostics::Kind;

namespace {

/// The sign that an effect was written with.
std::string_view sign_of(float value) { return value == 1.0f ? "+" : value == -1.0f ? "-" : ""; }

/// What to write where a robot was to be sent, or called off, by writing a landmark or a command: the route that ends there, or that it starts.
std::string advice(const Draft& draft, const Cell& cell, float value) {
  const bool raises = value > 0.0f;
  const std::string_view verb = raises ? "raise" : "lower", sign = raises ? "+" : "-";
  for (const RouteInfo& route : draft.routes) {
    const Row& row = draft.model[route.row];
    if (row.cell == CellId::kNone || route.legs.empty()) continue;   // it cannot be raised
    const Row* command = draft.model.row_in(row, "command");
    const Row& goal = draft.model[draft.legs[route.legs.back()].row];
    const Row* end = draft.model.row_in(goal, "to");
    if (cell.command && command != nullptr && command->name == cell.name) return fmt::format("{} the route that it starts: `{}{}`", verb, sign, route.name);
    if (end != nullptr && end->name == cell.name) return fmt::format("{} the route that ends there: `{}{}`", verb, sign, route.name);
  }
  if (cell.command) return "for a flag of the rules declare a satellite";
  if (!raises) return fmt::format("what rules can lower is its satellite: `-sat {}`", cell.name);
  return fmt::format("a route that ends there sends it, raised by its name, as in `+To{}`", cell.name);
}

}  // namespace

bool Effects::compile(const std::vector<syntax::Effect>& effects) {
  bool good = true;
  for (const syntax::Effect& effect : effects) {
    Pattern pattern;
    pattern.span = effect.span;
    pattern.sat = effect.sat;
    pattern.reset = effect.kind == syntax::Effect::Kind::kReset;
    pattern.value = effect.kind == syntax::Effect::Kind::kRaise ? 1.0f : -1.0f;
    if (effect.kind == syntax::Effect::Kind::kAssign) {
      pattern.value = static_cast<float>(effect.value.value);
      if (!effect.value.unit.text.empty()) {
        draft_.diagnostics.report(Kind::kValueWithUnit, effect.value.unit.span, {effect.value.unit.text});
        good = false;
      } else if (!(effect.value.value >= -1.0 && effect.value.value <= 1.0)) {
        draft_.diagnostics.report(Kind::kValueOutOfRange, effect.value.span, {fmt::format("{}", effect.value.value)});
        good = false;
      }
    }
    if (!pattern.reset) {
      pattern.ref = references_.compile(effect.ref);
      pattern.span = source::join(pattern.span, references_.span(pattern.ref));
    }
    patterns_.push_back(pattern);
    if (!pattern.reset) good = check_row(pattern) && good;
    // What is the same in all instances is checked once, even if there will be no instance.
    Writes trial;
    if (!pattern.reset && references_.constant(pattern.ref)) good = evaluate_one(pattern, {}, trial) != Outcome::kBroken && good;
  }
  return good;
}

/// Reports what is wrong with a pattern over rows, even if the relation has no rows.
bool Effects::check_row(const Pattern& pattern) {
  const References::RowState state = references_.row_state(pattern.ref);
  const bool good = state == References::RowState::kUnknown || (state == References::RowState::kFact && pattern.sat) ||
                    (state == References::RowState::kSatellite && !pattern.sat);
  if (good) return true;
  const source::Span at = references_.span(pattern.ref);
  const std::string_view text = references_.text(pattern.ref);
  switch (state) {
    case References::RowState::kFact: draft_.diagnostics.report(Kind::kWriteToFact, at, {text, "", sign_of(pattern.value)}); break;
    case References::RowState::kSatellite: draft_.diagnostics.report(Kind::kSatOfSatellite, at, {text}); break;
    default:
      if (!draft_.library_missing) draft_.diagnostics.report(Kind::kNoState, at, {text, references_.describe_row(pattern.ref)});
  }
  return false;
}

Outcome Effects::evaluate(Environment values, Writes& writes) {
  Outcome worst = Outcome::kMade;
  for (const Pattern& pattern : patterns_) worst = std::max(worst, evaluate_one(pattern, values, writes));
  return worst;
}

Outcome Effects::evaluate_one(const Pattern& pattern, Environment values, Writes& writes) {
  if (pattern.reset) {
    writes.push_back({CellId::kNone, 0.0f, pattern.span, true});
    return Outcome::kMade;
  }
  const Operand operand = references_.evaluate(pattern.ref, values);
  if (operand.kind == Operand::Kind::kBroken) return Outcome::kBroken;
  if (operand.kind == Operand::Kind::kMissing) return Outcome::kMissing;
  if (const auto cell = references_.cell_of(operand)) return write(pattern, *cell, writes);
  const auto cells = references_.cells_of(operand);
  const std::string_view text = references_.text(pattern.ref);
  if (!cells) return references_.report_no_cell(pattern.ref, operand);
  if (operand.kind != Operand::Kind::kCells && text.find('[') == std::string_view::npos) {
    const std::string all = fmt::format("{}[*]", text);
    if (!cells->empty() && !may_write(pattern, cells->front(), all)) return Outcome::kBroken;
    draft_.diagnostics.report(Kind::kWriteWholeGroup, references_.span(pattern.ref), {text, references_.describe(operand), pattern.sat ? "sat " + all : all});
    return Outcome::kBroken;
  }
  for (const CellId cell : *cells) {
    if (write(pattern, cell, writes) == Outcome::kBroken) return Outcome::kBroken;
  }
  return Outcome::kMade;
}

bool Effects::may_write(const Pattern& pattern, CellId cell, std::string_view text) {
  const Cell& known = draft_.model[cell];
  const bool satellite = known.kind == CellKind::kSatellite;
  if (pattern.sat && satellite) {
    draft_.diagnostics.report(Kind::kSatOfSatellite, references_.span(pattern.ref), {text})
        .note(Kind::kNameDeclaredHere, known.declared, {known.name});
  } else if (!pattern.sat && !satellite) {
    report_unwritable(pattern, known, text);
  }
  return pattern.sat != satellite;
}

void Effects::report_unwritable(const Pattern& pattern, const Cell& cell, std::string_view text) {
  const source::Span at = references_.span(pattern.ref);
  const std::string_view sign = sign_of(pattern.value);
  const auto say = [&](Kind kind, std::initializer_list<std::string_view> arguments) {
    draft_.diagnostics.report(kind, at, arguments).note(Kind::kNameDeclaredHere, cell.declared, {cell.name});
  };
  if (cell.kind == CellKind::kStrategy) return say(Kind::kWriteToStrategy, {text, sign});
  const Entity* declared = draft_.names.find(cell.name);
  if (declared != nullptr && declared->kind == Entity::Kind::kLandmark) return say(Kind::kWriteToLandmark, {text, advice(draft_, cell, pattern.value)});
  if (cell.command) return say(Kind::kWriteToCommand, {text, advice(draft_, cell, pattern.value)});
  const Entity* named = draft_.names.find(text);
  const bool plain = named != nullptr && named->kind == Entity::Kind::kFact && !draft_.standard(cell.declared);
  say(Kind::kWriteToFact, {text, plain ? fmt::format("if rules are to write it, declare `satellite {}` instead; ", text) : std::string(), sign});
}

Outcome Effects::write(const Pattern& pattern, CellId cell, Writes& writes) {
  if (!may_write(pattern, cell, references_.text(pattern.ref))) return Outcome::kBroken;
  const bool satellite = draft_.model[cell].kind == CellKind::kSatellite;
  writes.push_back({satellite ? cell : own_satellite(draft_.model, cell), pattern.value, pattern.span, false});
  return Outcome::kMade;
}

}  // namespace kb::model
