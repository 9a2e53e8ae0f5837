#include "compiler/model/percepts.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/syntax/tree_text.h"

namespace kb::model {

using diagnostics::Kind;

Outcome Percepts::read(syntax::PerceptId id, Environment values, const std::vector<std::string_view>& names, PerceptId& made) {
  values_ = values;
  names_ = names;
  return read(id, made);
}

Outcome Percepts::put(Percept percept, PerceptId& made) {
  made = PerceptId{static_cast<std::uint32_t>(draft_.model.percepts.size())};
  draft_.model.percepts.push_back(std::move(percept));
  return Outcome::kMade;
}

Outcome Percepts::read(syntax::PerceptId id, PerceptId& made) {
  const syntax::Percept& from = tree_[id];
  switch (from.kind) {
    case syntax::Percept::Kind::kAnd: return read_several(from, Percept::Op::kAnd, made);
    case syntax::Percept::Kind::kOr: return read_several(from, Percept::Op::kOr, made);
    case syntax::Percept::Kind::kNot: return read_several(from, Percept::Op::kNot, made);
    case syntax::Percept::Kind::kFact: return read_fact(from, made);
    case syntax::Percept::Kind::kFits: return read_fits(from, tree_[from.shape], syntax::shape_text(tree_[from.shape]), made);
    case syntax::Percept::Kind::kFitsNamed: return read_named(from, made);
    case syntax::Percept::Kind::kReads: return read_text(from, from.word.text, made);
    case syntax::Percept::Kind::kError: break;
  }
  return Outcome::kBroken;
}

Outcome Percepts::read_several(const syntax::Percept& from, Percept::Op op, PerceptId& made) {
  Percept percept;
  percept.op = op;
  Outcome worst = Outcome::kMade;
  for (const syntax::PerceptId child : from.children) {
    PerceptId part{};
    worst = std::max(worst, read(child, part));
    percept.children.push_back(part);
  }
  return worst == Outcome::kMade ? put(std::move(percept), made) : worst;
}

Outcome Percepts::read_fact(const syntax::Percept& from, PerceptId& made) {
  const syntax::Ref& ref = tree_[from.ref];
  const Entity* entity = draft_.names.find(ref.base.text);
  if (entity != nullptr && entity->kind == Entity::Kind::kSensor && !variable(ref.base.text)) {
    draft_.sensors[entity->id].used = true;
    draft_.diagnostics.report(Kind::kSensorAsFact, ref.span, {text(ref.span)});
    return Outcome::kBroken;
  }
  const Operand operand = references_.evaluate(references_.compile(from.ref), values_);
  if (operand.kind == Operand::Kind::kBroken) return Outcome::kBroken;
  if (operand.kind == Operand::Kind::kMissing) return Outcome::kMissing;
  const auto cell = references_.cell_of(operand);
  if (!cell || draft_.model[*cell].kind != CellKind::kFact) {
    draft_.diagnostics.report(Kind::kDefinedByNoFact, ref.span, {text(ref.span), references_.describe(operand)});
    return Outcome::kBroken;
  }
  Percept percept;
  percept.op = Percept::Op::kFact;
  percept.cell = *cell;
  return put(std::move(percept), made);
}

// ---- sensors

std::optional<std::size_t> Percepts::variable(std::string_view name) const {
  for (std::size_t b = 0; b < binders_.size(); ++b) {
    if (binders_[b].name.text == name) return b;
  }
  return std::nullopt;
}

std::optional<Percepts::Element> Percepts::element(syntax::RefId id) {
  const syntax::Ref& ref = tree_[id];
  if (variable(ref.base.text)) {
    draft_.diagnostics.report(Kind::kNotASensor, ref.base.span, {ref.base.text, "a variable"});
    return std::nullopt;
  }
  const Entity* entity = need_entity(draft_, ref.base, Entity::Kind::kSensor, Kind::kUnknownSensor, Kind::kNotASensor);
  if (entity == nullptr) return std::nullopt;
  const Sensor& sensor = draft_.model.sensors[entity->id];
  draft_.sensors[entity->id].used = true;
  const auto offset = index_of(ref, sensor);
  if (!offset) return std::nullopt;
  return Element{entity->id, sensor.first + *offset};
}

std::optional<std::uint32_t> Percepts::index_of(const syntax::Ref& ref, const Sensor& sensor) {
  if (ref.postfixes.empty() && !sensor.array) return 0;
  const auto refuse = [&](Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
    draft_.diagnostics.report(kind, at, arguments).note(Kind::kNameDeclaredHere, sensor.declared, {sensor.name});
    return std::nullopt;
  };
  if (!sensor.array) return refuse(Kind::kSensorIsNoArray, ref.postfixes.front().span, {sensor.name});
  const bool indexed = ref.postfixes.size() == 1 && ref.postfixes.front().kind == syntax::Postfix::Kind::kIndex &&
                       ref.postfixes.front().arguments.size() == 1 && ref.postfixes.front().arguments.front().number;
  if (!indexed) return refuse(Kind::kSensorWithoutIndex, ref.span, {sensor.name, fmt::format("{}", sensor.count)});
  const syntax::Index& at = ref.postfixes.front().arguments.front();
  if (*at.number < sensor.count && *at.number == static_cast<double>(static_cast<std::uint32_t>(*at.number))) {
    return static_cast<std::uint32_t>(*at.number);
  }
  return refuse(Kind::kSensorIndexRange, at.span,
                {sensor.name, fmt::format("{}", sensor.count - 1), fmt::format("{}[{}]", sensor.name, text(at.span))});
}

// ---- what they are like

Outcome Percepts::read_named(const syntax::Percept& from, PerceptId& made) {
  if (const auto b = variable(from.word.text)) {
    binders_[*b].used = true;
    return read_text(from, names_[*b], made);
  }
  const Entity* entity = need_entity(draft_, from.word, Entity::Kind::kPrototype, Kind::kUnknownPrototype, Kind::kNotAPrototype);
  if (entity == nullptr) return Outcome::kBroken;
  const Prototype& prototype = draft_.model.prototypes[entity->id];
  return read_fits(from, (*prototype.tree)[prototype.shape], prototype.name, made);
}

Outcome Percepts::read_fits(const syntax::Percept& from, const syntax::Shape& shape, std::string shown, PerceptId& made) {
  const auto at = element(from.ref);
  if (!at) return Outcome::kBroken;
  const Sensor& sensor = draft_.model.sensors[at->sensor];
  if (sensor.text) {
    draft_.diagnostics.report(Kind::kTextAgainstShape, from.span, {sensor.name})
        .note(Kind::kNameDeclaredHere, sensor.declared, {sensor.name});
    return Outcome::kBroken;
  }
  const auto placed = resolve_shape(shape, draft_.sensors[at->sensor].domain, draft_.diagnostics);
  if (!placed) return Outcome::kBroken;
  if (placed->kind == fuzzy::ShapeKind::kBell || placed->kind == fuzzy::ShapeKind::kSigmoid) {
    draft_.diagnostics.report(Kind::kShapeIsNoPrototype, from.span, {fuzzy::word(placed->kind)});
    return Outcome::kBroken;
  }
  Percept percept;
  percept.op = Percept::Op::kFits;
  percept.reading = at->reading;
  percept.shape = place(*placed, std::move(shown));
  return put(std::move(percept), made);
}

std::uint32_t Percepts::place(const fuzzy::Shape& shape, std::string shown) {
  const auto number = static_cast<std::uint32_t>(draft_.model.placed_shapes.size());
  const std::string key = fmt::format("{} {} {} {}", shown, fuzzy::text(shape), shape.period, shape.range_low);
  const auto [known, fresh] = draft_.placed_shape_of.emplace(key, number);
  if (fresh) draft_.model.placed_shapes.push_back({shape, std::move(shown)});
  return known->second;
}

Outcome Percepts::read_text(const syntax::Percept& from, std::string_view wanted, PerceptId& made) {
  const auto at = element(from.ref);
  if (!at) return Outcome::kBroken;
  const Sensor& sensor = draft_.model.sensors[at->sensor];
  if (!sensor.text) {
    draft_.diagnostics.report(Kind::kNumberAgainstText, from.span, {sensor.name})
        .note(Kind::kNameDeclaredHere, sensor.declared, {sensor.name});
    return Outcome::kBroken;
  }
  Percept percept;
  percept.op = Percept::Op::kReads;
  percept.reading = at->reading;
  percept.text = std::string(wanted);
  return put(std::move(percept), made);
}

}  // namespace kb::model
