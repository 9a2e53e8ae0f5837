// Sensors, and facts that are perceived.
#include <algorithm>
#include <utility>

#include "compiler/syntax/syntax.h"
#include "compiler/syntax/tree_builder.h"

namespace kb::syntax {

using diagnostics::Kind;

// ---- sensors

void TreeBuilder::begin_sensor(Span name) {
  sensor_ = Sensor{};
  sensor_.name = name_at(name);
}

void TreeBuilder::begin_sensor(Span name, Span count) {
  begin_sensor(name);
  sensor_.count = Number{count, value_of(count), {}};
}

void TreeBuilder::sensor_range(Id last) { sensor_.range.emplace(numbers_[last - 1], numbers_[last]); }

void TreeBuilder::sensor_text(Span word) {
  if (text(word) != "text") diagnostics_.report(Kind::kSensorQuantity, word, {text(word)});
}

void TreeBuilder::sensor_noise(Span span, Id number) { set_once(sensor_.noise, numbers_[number], span); }

void TreeBuilder::sensor_stale(Span span, Id number) { set_once(sensor_.stale, numbers_[number], span); }

void TreeBuilder::sensor_circular(Span span) { set_once(sensor_.circular, span, span); }

void TreeBuilder::sensor_strict(Span span) { set_once(sensor_.strict, span, span); }

void TreeBuilder::sensor() { add(std::move(sensor_)); }

// ---- facts that are perceived

void TreeBuilder::add_member(Span name, Id percept) {
  add_name(name);
  definitions_.resize(names_.size());
  values_.resize(names_.size());
  if (percept != kNothing) definitions_.back() = PerceptId{percept};
}

void TreeBuilder::add_member_value(Span name, Id number) {
  add_member(name);
  values_.back() = numbers_[number];
}

void TreeBuilder::definition(Span span, Id percept) {
  set_once(declaration_.definition, PerceptId{percept}, span);
  declaration_.definition_span = span;
}

void TreeBuilder::lazy(Span span) { set_once(declaration_.lazy, span, span); }

void TreeBuilder::perceive(Id target, Id percept) { add(Perceive{std::move(binders_), RefId{target}, PerceptId{percept}}); }

TreeBuilder::Id TreeBuilder::add_percept(Percept percept, std::uint16_t depth) {
  if (depth > kMaxNesting) {
    report_too_deep(percept.span);
    percept = Percept{Percept::Kind::kError, percept.span, {}, {}, {}, {}};
    depth = 0;
  }
  tree_.percepts.push_back(std::move(percept));
  percept_depths_.push_back(depth);
  return static_cast<Id>(tree_.percepts.size() - 1);
}

TreeBuilder::Id TreeBuilder::combine_percepts(Percept::Kind kind, Span span, Id left, Id right) {
  const std::uint16_t depth = std::max(percept_depths_[left], percept_depths_[right]);
  return add_percept({kind, span, {PerceptId{left}, PerceptId{right}}, {}, {}, {}}, depth);
}

TreeBuilder::Id TreeBuilder::extend_percept(Span span, Id whole, Id part) {
  Percept& percept = tree_.percepts[whole];
  if (percept.kind == Percept::Kind::kError) return whole;
  percept.span = span;
  percept.children.push_back(PerceptId{part});
  percept_depths_[whole] = std::max(percept_depths_[whole], percept_depths_[part]);
  return whole;
}

TreeBuilder::Id TreeBuilder::negate_percept(Span span, Id percept) {
  const auto depth = static_cast<std::uint16_t>(percept_depths_[percept] + 1);
  return add_percept({Percept::Kind::kNot, span, {PerceptId{percept}}, {}, {}, {}}, depth);
}

TreeBuilder::Id TreeBuilder::parenthesised_percept(Span span, Id percept) {
  const auto depth = static_cast<std::uint16_t>(percept_depths_[percept] + 1);
  if (depth > kMaxNesting) return add_percept({Percept::Kind::kError, span, {}, {}, {}, {}}, depth);
  percept_depths_[percept] = depth;
  return percept;
}

TreeBuilder::Id TreeBuilder::percept(Span span, Id ref) {
  return add_percept({Percept::Kind::kFact, span, {}, RefId{ref}, {}, {}}, ref_depths_[ref]);
}

TreeBuilder::Id TreeBuilder::fits(Span span, Id sensor, Id shape) {
  return add_percept({Percept::Kind::kFits, span, {}, RefId{sensor}, ShapeId{shape}, {}}, ref_depths_[sensor]);
}

TreeBuilder::Id TreeBuilder::fits_named(Span span, Id sensor, Span name) {
  return add_percept({Percept::Kind::kFitsNamed, span, {}, RefId{sensor}, {}, name_at(name)}, ref_depths_[sensor]);
}

TreeBuilder::Id TreeBuilder::reads(Span span, Id sensor, Span text_span) {
  return add_percept({Percept::Kind::kReads, span, {}, RefId{sensor}, {}, {text_span, unquoted(text_span)}}, ref_depths_[sensor]);
}

}  // namespace kb::syntax
