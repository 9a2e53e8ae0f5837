// Fuzzy numbers and fuzzy controllers.
#include <algorithm>
#include <utility>

#include "compiler/syntax/tree_builder.h"

namespace kb::syntax {

using diagnostics::Kind;

void TreeBuilder::begin_shape(Span name) {
  shape_ = Shape{};
  shape_argument_ = Shape::Argument{};
  shape_.name = name_at(name);
}

void TreeBuilder::add_shape_argument(Span span) {
  shape_argument_.span = span;
  shape_.arguments.push_back(std::exchange(shape_argument_, Shape::Argument{}));
}

void TreeBuilder::add_shape_argument(Span span, Span label) {
  shape_argument_.label = name_at(label);
  add_shape_argument(span);
}

void TreeBuilder::add_shape_range(Span span, Id last) {
  shape_argument_.number = numbers_[last - 1];
  shape_argument_.to = numbers_[last];
  add_shape_argument(span);
}

TreeBuilder::Id TreeBuilder::shape(Span span) {
  shape_.span = span;
  tree_.shapes.push_back(std::exchange(shape_, Shape{}));
  return static_cast<Id>(tree_.shapes.size() - 1);
}

void TreeBuilder::prototype(Span name, Id shape) { add(Prototype{name_at(name), ShapeId{shape}}); }

// ---- fuzzy controllers

void TreeBuilder::begin_fuzzy(Span name) {
  fuzzy_ = Fuzzy{};
  fuzzy_.name = name_at(name);
}

void TreeBuilder::fuzzy_and(Span clause, Span word) { set_once(fuzzy_.conjunction, name_at(word), clause); }

void TreeBuilder::fuzzy_or(Span clause, Span word) { set_once(fuzzy_.disjunction, name_at(word), clause); }

void TreeBuilder::add_input(Span name, Id range_end, Id circular) {
  Fuzzy::Input input;
  input.name = name_at(name);
  if (input_size_ != kNothing) input.count = numbers_[input_size_];
  input.low = numbers_[range_end - 1];
  input.high = numbers_[range_end];
  input.circular = circular != 0;
  fuzzy_.inputs.push_back(std::move(input));
}

void TreeBuilder::add_input_term(Span name, Id shape) {
  fuzzy_.inputs.back().terms.push_back({name_at(name), ShapeId{shape}});
}

void TreeBuilder::add_output(Span name, Id range_end, Id circular) {
  Fuzzy::Output output;
  output.name = name_at(name);
  output.low = numbers_[range_end - 1];
  output.high = numbers_[range_end];
  output.circular = circular != 0;
  fuzzy_.outputs.push_back(std::move(output));
}

void TreeBuilder::add_output_term(Span name, Id number) {
  fuzzy_.outputs.back().terms.push_back({name_at(name), numbers_[number]});
}

void TreeBuilder::output_by(Span word, Span method) { set_once(fuzzy_.outputs.back().by, name_at(method), word); }

void TreeBuilder::output_within(Span word, Id number) { set_once(fuzzy_.outputs.back().within, numbers_[number], word); }

void TreeBuilder::output_default(Span word, Id number) {
  Fuzzy::Output& output = fuzzy_.outputs.back();
  once(output.default_number || output.default_term, word);
  output.default_number = numbers_[number];
}

void TreeBuilder::output_default(Span word, Span term) {
  Fuzzy::Output& output = fuzzy_.outputs.back();
  once(output.default_number || output.default_term, word);
  output.default_term = name_at(term);
}

void TreeBuilder::begin_given(Id condition) {
  Fuzzy::Given given;
  given.parent = givens_.empty() ? Fuzzy::kNoGiven : givens_.back();
  given.condition = condition;
  given.first_rule = static_cast<std::uint32_t>(fuzzy_.rules.size());
  given.span = fuzzy_.conds[condition].span;
  givens_.push_back(static_cast<std::uint32_t>(fuzzy_.givens.size()));
  fuzzy_.givens.push_back(given);
}

void TreeBuilder::end_given() {
  fuzzy_.givens[givens_.back()].end_rule = static_cast<std::uint32_t>(fuzzy_.rules.size());
  givens_.pop_back();
}

void TreeBuilder::begin_consequent(Span output) { consequents_.push_back({{}, name_at(output), {}}); }

void TreeBuilder::end_consequent(Span span) { consequents_.back().span = span; }

void TreeBuilder::linear_number(Span span, Span digits, Span unit) {
  part_.number = numbers_[number(span, 0, digits, unit)];
}

void TreeBuilder::add_linear_part(Span span, Id negative) {
  part_.span = span;
  part_.negative = negative != 0;
  consequents_.back().sum.push_back(std::exchange(part_, Fuzzy::Part{}));
}

void TreeBuilder::fuzzy_rule(Span span, Id condition, Id weight) {
  Fuzzy::Rule rule;
  rule.span = span;
  rule.given = givens_.empty() ? Fuzzy::kNoGiven : givens_.back();
  rule.condition = condition;
  rule.consequents = std::exchange(consequents_, {});
  if (weight != kNothing) rule.weight = numbers_[weight];
  fuzzy_.rules.push_back(std::move(rule));
  numbers_.clear();
  fuzzy_refs_.clear();
}

void TreeBuilder::fuzzy() { add(std::move(fuzzy_)); }

// Refuses a condition that nests too deeply, or is so long a chain that walking it would recurse too deeply; it is dropped then.
TreeBuilder::Id TreeBuilder::add_fuzzy(FuzzyCond condition, std::uint32_t depth) {
  constexpr std::uint32_t kDeepest = 1'000;
  if (depth > kDeepest) {
    if (!depth_reported_) diagnostics_.report(Kind::kFuzzyTooLong, condition.span, {std::to_string(kDeepest)});
    depth_reported_ = true;
    return condition.left;
  }
  fuzzy_.conds.push_back(std::move(condition));
  fuzzy_depths_.push_back(static_cast<std::uint16_t>(depth));
  return static_cast<Id>(fuzzy_.conds.size() - 1);
}

TreeBuilder::Id TreeBuilder::fuzzy_join(Span span, FuzzyCond::Kind kind, Id left, Id right) {
  FuzzyCond condition;
  condition.kind = kind;
  condition.span = span;
  condition.left = left;
  condition.right = right;
  return add_fuzzy(std::move(condition), 1u + std::max(fuzzy_depths_[left], fuzzy_depths_[right]));
}

TreeBuilder::Id TreeBuilder::fuzzy_not(Span span, Id inner) {
  FuzzyCond condition;
  condition.kind = FuzzyCond::Kind::kNot;
  condition.span = span;
  condition.left = inner;
  return add_fuzzy(std::move(condition), 1u + fuzzy_depths_[inner]);
}

TreeBuilder::Id TreeBuilder::fuzzy_is(Span span, Id ref) {
  FuzzyCond condition;
  condition.span = span;
  condition.ref = fuzzy_refs_[ref];
  condition.words = std::exchange(is_words_, {});
  return add_fuzzy(std::move(condition), 1);
}

TreeBuilder::Id TreeBuilder::fuzzy_ref(Span span, Span name, Id element) {
  FuzzyRef ref;
  ref.span = span;
  ref.name = name_at(name);
  if (element != kNothing) ref.element = numbers_[element];
  fuzzy_refs_.push_back(std::move(ref));
  return static_cast<Id>(fuzzy_refs_.size() - 1);
}

}  // namespace kb::syntax
