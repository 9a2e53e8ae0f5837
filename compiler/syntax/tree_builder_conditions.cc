#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "compiler/syntax/syntax.h"
#include "compiler/syntax/tree_builder.h"

namespace kb::syntax {
namespace {

using diagnostics::Kind;

}  // namespace

// ---- conditions

TreeBuilder::Id TreeBuilder::add_condition(Cond condition, std::uint16_t depth) {
  if (depth > kMaxNesting) return too_deep(condition.span);
  tree_.conds.push_back(std::move(condition));
  cond_depths_.push_back(depth);
  return static_cast<Id>(tree_.conds.size() - 1);
}

// An error condition that replaces one that is nested too deeply, so that the conditions around it stay shallow.
TreeBuilder::Id TreeBuilder::too_deep(Span span) {
  report_too_deep(span);
  Cond error;
  error.span = span;
  return add_condition(std::move(error), 0);
}

void TreeBuilder::report_too_deep(Span span) {
  if (!std::exchange(depth_reported_, true)) diagnostics_.report(Kind::kNestingTooDeep, span, {std::to_string(kMaxNesting)});
}

TreeBuilder::Id TreeBuilder::combine(Cond::Kind kind, Span span, Id left, Id right) {
  Cond condition;
  condition.kind = kind;
  condition.span = span;
  condition.children = {CondId{left}, CondId{right}};
  return add_condition(std::move(condition), std::max(cond_depths_[left], cond_depths_[right]));
}

TreeBuilder::Id TreeBuilder::extend(Span span, Id whole, Id part) {
  Cond& condition = tree_.conds[whole];
  if (condition.kind == Cond::Kind::kError) return whole;
  condition.span = span;
  condition.children.push_back(CondId{part});
  cond_depths_[whole] = std::max(cond_depths_[whole], cond_depths_[part]);
  return whole;
}

TreeBuilder::Id TreeBuilder::held_for(Span span, Span word, Id condition, Id duration) {
  Cond held;
  held.kind = Cond::Kind::kFor;
  held.span = span;
  held.children = {CondId{condition}};
  held.duration = numbers_[duration];
  held.time = join(word, held.duration.span);
  return add_condition(std::move(held), static_cast<std::uint16_t>(cond_depths_[condition] + 1));
}

TreeBuilder::Id TreeBuilder::negate(Span span, Id condition) {
  Cond negated;
  negated.kind = Cond::Kind::kNot;
  negated.span = span;
  negated.children = {CondId{condition}};
  return add_condition(std::move(negated), static_cast<std::uint16_t>(cond_depths_[condition] + 1));
}

TreeBuilder::Id TreeBuilder::parenthesised(Span span, Id condition) {
  const auto depth = static_cast<std::uint16_t>(cond_depths_[condition] + 1);
  if (depth > kMaxNesting) return too_deep(span);
  cond_depths_[condition] = depth;
  tree_.conds[condition].parenthesised = true;
  return condition;
}

TreeBuilder::Id TreeBuilder::question(Cond::Kind kind, Span span, Id ref) {
  Cond condition;
  condition.kind = kind;
  condition.span = span;
  condition.ref = RefId{ref};
  return add_condition(std::move(condition), ref_depths_[ref]);
}

TreeBuilder::Id TreeBuilder::any(Span span, bool none, Id asked, Id ref) {
  constexpr std::array kAsked{Cond::Kind::kIs, Cond::Kind::kIs, Cond::Kind::kEvent, Cond::Kind::kLost, Cond::Kind::kSeen};
  const Id id = question(Cond::Kind::kAny, span, ref);
  tree_.conds[id].sat = asked == 1;
  tree_.conds[id].asked = kAsked[asked];
  tree_.conds[id].none = none;
  return id;
}

TreeBuilder::Id TreeBuilder::is_high(Span span, Id sat, Id ref) {
  const Id id = question(Cond::Kind::kIs, span, ref);
  tree_.conds[id].sat = sat != 0;
  return id;
}

TreeBuilder::Id TreeBuilder::is(Span span, Id sat, Id ref, bool negated, Span term) {
  const Id id = is_high(span, sat, ref);
  Cond& condition = tree_.conds[id];
  condition.negated = negated;
  condition.term = name_at(term);
  return id;
}

// ---- references

TreeBuilder::Id TreeBuilder::begin_ref(Span base) {
  tree_.refs.push_back({base, name_at(base), {}});
  ref_depths_.push_back(0);
  return static_cast<Id>(tree_.refs.size() - 1);
}

TreeBuilder::Id TreeBuilder::add_field(Id ref, Span field) {
  Ref& whole = tree_.refs[ref];
  whole.span.end = field.end;
  whole.postfixes.push_back({Postfix::Kind::kField, field, name_at(field), {}});
  return ref;
}

TreeBuilder::Id TreeBuilder::add_postfix(Postfix::Kind kind, Span span, Id ref, Span open, Id first_index) {
  const auto first = indices_.begin() + first_index;
  std::uint16_t depth = ref_depths_[ref];
  for (auto index = first; index != indices_.end(); ++index) {
    if (!index->star && !index->number) {
      const auto inner = static_cast<std::uint16_t>(ref_depths_[static_cast<std::size_t>(index->ref)] + 1);
      depth = std::max(depth, inner);
    }
  }
  if (depth > kMaxNesting) {
    report_too_deep(span);
    indices_.erase(first, indices_.end());
    return ref;
  }
  ref_depths_[ref] = depth;
  Ref& whole = tree_.refs[ref];
  whole.span.end = span.end;
  whole.postfixes.push_back({kind, {span.file, open.begin, span.end}, {}, {first, indices_.end()}});
  indices_.erase(first, indices_.end());
  return ref;
}

TreeBuilder::Id TreeBuilder::add_index(Span span, Id ref) {
  indices_.push_back({span, false, RefId{ref}, {}});
  return static_cast<Id>(indices_.size() - 1);
}

TreeBuilder::Id TreeBuilder::add_star(Span span) {
  indices_.push_back({span, true, RefId{}, {}});
  return static_cast<Id>(indices_.size() - 1);
}

TreeBuilder::Id TreeBuilder::add_number_index(Span number) {
  indices_.push_back({number, false, RefId{}, value_of(number)});
  return static_cast<Id>(indices_.size() - 1);
}

// ---- numbers

TreeBuilder::Id TreeBuilder::number(Span span, Id negative, Span digits, Span unit) {
  const double value = value_of(digits);
  numbers_.push_back({span, negative != 0 ? -value : value, name_at(unit)});
  return static_cast<Id>(numbers_.size() - 1);
}

}  // namespace kb::syntax
