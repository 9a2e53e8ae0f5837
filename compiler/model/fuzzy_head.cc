// The head of a fuzzy block: declares its names, converts units to SI, and writes out groups of inputs.
#include "compiler/model/fuzzy_head.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace kb::model {
namespace {

using diagnostics::Kind;

constexpr std::size_t kMaxSlots = 4'096;      // numbers that one block takes
constexpr std::size_t kMaxDegrees = 16'384;   // degrees of one block: its tables count them in 15 bits

}  // namespace

void FuzzyHead::fail(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
  diagnostics().report(kind, at, arguments);
  good_ = false;
}

void FuzzyHead::read_head() {
  to_.name = std::string(from_.name.text);
  to_.declared = from_.name.span;
  to_.standard = draft_.standard(from_.name.span);
  read_methods();
  for (const syntax::Fuzzy::Input& input : from_.inputs) read_input(input);
  for (const syntax::Fuzzy::Output& output : from_.outputs) read_output(output);
}

void FuzzyHead::read_methods() {
  if (const auto& word = from_.conjunction) {
    if (word->text == "product") to_.conjunction = fuzzy::And::kProduct;
    else if (word->text != "min") fail_method(*word, "and", {"min", "product"});
  }
  if (const auto& word = from_.disjunction) {
    if (word->text == "sum") to_.disjunction = fuzzy::Or::kSum;
    else if (word->text != "max") fail_method(*word, "or", {"max", "sum"});
  }
}

void FuzzyHead::fail_method(const syntax::Name& word, std::string_view what, std::initializer_list<std::string_view> known) {
  std::string list;
  for (const std::string_view one : known) list += fmt::format("{}`{}`", list.empty() ? "" : one == *(known.end() - 1) ? " or " : ", ", one);
  const std::vector<std::string_view> candidates(known);
  diagnostics().report(Kind::kFuzzyMethod, word.span, {word.text, what, list}).suggest(diagnostics::closest(word.text, candidates));
  good_ = false;
}

void FuzzyHead::declare(const syntax::Name& name, Variable variable) {
  variable.declared = name.span;
  const auto [known, fresh] = variables_.emplace(name.text, variable);
  if (fresh) return;
  diagnostics().report(Kind::kFuzzyVariableTwice, name.span, {name.text}).note(Kind::kFirstDeclaredHere, known->second.declared);
  good_ = false;
}

std::uint32_t FuzzyHead::read_count(const syntax::Fuzzy::Input& input) {
  if (!input.count) return 1;
  const double count = input.count->value;
  if (input.count->unit.text.empty() && count >= 1.0 && count <= static_cast<double>(kMaxSlots) && count == std::floor(count)) {
    return static_cast<std::uint32_t>(count);
  }
  fail(Kind::kFuzzyGroupSize, input.count->span, {input.name.text, std::to_string(kMaxSlots)});
  return 0;
}

void FuzzyHead::read_input(const syntax::Fuzzy::Input& from) {
  Variable variable{false, false, static_cast<std::uint32_t>(to_.inputs.size()), {}};
  const auto domain = resolve_range(from.low, from.high, std::string(from.name.text), from.circular, diagnostics());
  const std::uint32_t count = read_count(from);
  if (from.terms.empty()) fail(Kind::kFuzzyNoTerms, from.name.span, {from.name.text});
  variable.broken = !domain || count == 0;
  good_ = good_ && !variable.broken;
  declare(from.name, variable);
  fuzzy::Input input;
  input.name = std::string(from.name.text);
  input.declared = from.name.span;
  input.group = from.count.has_value();
  input.count = std::max(count, 1u);
  input.first_slot = to_.slots;
  input.first_degree = static_cast<std::uint32_t>(to_.degrees.size());
  if (domain) {
    input.low = domain->low;
    input.high = domain->high;
    input.unit = domain->unit;
    input.circular = domain->circular;
    input.written_unit = domain->written_unit;
    read_terms(from, *domain, input);
  }
  add_slots(from.name, input, variable.id);
  to_.inputs.push_back(std::move(input));
}

void FuzzyHead::add_slots(const syntax::Name& name, const fuzzy::Input& input, std::uint32_t id) {
  to_.slots += input.count;
  const bool many_slots = to_.slots > kMaxSlots;
  if (many_slots || to_.degrees.size() + std::size_t{input.count} * input.terms.size() > kMaxDegrees) {
    const std::string_view what = many_slots ? "inputs" : "degrees of inputs in terms";
    if (!too_large_) fail(Kind::kFuzzyTooLarge, name.span, {from_.name.text, what, std::to_string(many_slots ? kMaxSlots : kMaxDegrees)});
    too_large_ = true;
    good_ = false;
  } else {
    for (std::uint32_t e = 0; e < input.count; ++e) {
      for (std::uint32_t t = 0; t < input.terms.size(); ++t) to_.degrees.push_back({input.first_slot + e, id, t});
    }
  }
}

void FuzzyHead::read_terms(const syntax::Fuzzy::Input& from, const Domain& domain, fuzzy::Input& input) {
  for (const auto& term : from.terms) {
    check_new(input.name, input.terms, term.name);
    const auto shape = resolve_shape(tree_[term.shape], domain, diagnostics());
    good_ = good_ && shape.has_value();
    input.terms.push_back({std::string(term.name.text), shape.value_or(fuzzy::Shape{})});
    input.terms.back().shape.span = term.name.span;
  }
}

template <class Terms>
void FuzzyHead::check_new(std::string_view variable, const Terms& terms, const syntax::Name& name) {
  const bool twice = std::any_of(terms.begin(), terms.end(), [&](const auto& term) { return term.name == name.text; });
  if (twice) fail(Kind::kFuzzyTermTwice, name.span, {name.text, variable});
  if (fuzzy::hedge_of(name.text)) fail(Kind::kFuzzyTermName, name.span, {name.text});
}

void FuzzyHead::read_output(const syntax::Fuzzy::Output& from) {
  Variable variable{true, false, static_cast<std::uint32_t>(to_.outputs.size()), {}};
  const auto domain = resolve_range(from.low, from.high, std::string(from.name.text), from.circular, diagnostics());
  variable.broken = !domain;
  good_ = good_ && domain.has_value();
  declare(from.name, variable);
  domains_.push_back(domain);
  fuzzy::Output output;
  output.name = std::string(from.name.text);
  output.declared = from.name.span;
  if (domain) {
    output.low = domain->low;
    output.high = domain->high;
    output.unit = domain->unit;
    output.circular = domain->circular;
    for (const auto& term : from.terms) {
      check_new(output.name, output.terms, term.name);
      output.terms.push_back({std::string(term.name.text), number(term.value, *domain), term.name.span});
    }
    read_options(from, *domain, output);
  }
  to_.outputs.push_back(std::move(output));
}

double FuzzyHead::number(const syntax::Number& from, const Domain& domain) {
  const auto value = resolve_number(from, domain, diagnostics());
  good_ = good_ && value.has_value();
  return value.value_or(0.0);
}

void FuzzyHead::read_options(const syntax::Fuzzy::Output& from, const Domain& domain, fuzzy::Output& output) {
  if (from.by) {
    if (from.by->text == "sum") output.combine = fuzzy::Combine::kSum;
    else if (from.by->text == "winner") output.combine = fuzzy::Combine::kWinner;
    else if (from.by->text != "average") fail_method(*from.by, "by", {"average", "sum", "winner"});
  }
  if (output.circular && output.combine == fuzzy::Combine::kSum) fail(Kind::kFuzzySumOnCircle, from.by->span, {output.name});
  if (from.within) {
    output.within = number(*from.within, domain);
    if (output.combine != fuzzy::Combine::kAverage) fail(Kind::kFuzzyWithinNotHere, from.within->span, {output.name});
    else if (good_ && !(output.within > 0.0)) fail(Kind::kSpreadNotPositive, from.within->span, {"reach", "within", diagnostics().sources().text(from.within->span)});
  }
  if (from.default_number) output.fallback = number(*from.default_number, domain);
  if (from.default_term) {
    if (const fuzzy::Value* term = find_term(output, *from.default_term)) output.fallback = term->number;
  }
  if (output.fallback && good_ && (*output.fallback < output.low || *output.fallback > output.high)) {
    const source::Span at = from.default_number ? from.default_number->span : from.default_term->span;
    fail(Kind::kFuzzyDefaultRange, at, {output.name, fmt::format("{}", output.low), fmt::format("{}", output.high)});
  }
}

auto FuzzyHead::find(const syntax::Name& name, bool output, std::string_view wanted) -> const Variable* {
  const auto found = variables_.find(name.text);
  if (found != variables_.end() && found->second.output == output) return found->second.broken ? nullptr : &found->second;
  good_ = false;
  if (found != variables_.end()) {
    diagnostics().report(Kind::kFuzzyWrongSide, name.span, {name.text, output ? "an input" : "an output", wanted})
        .note(Kind::kNameDeclaredHere, found->second.declared, {name.text});
    return nullptr;
  }
  diagnostics().report(Kind::kFuzzyUnknownVariable, name.span, {from_.name.text, output ? "output" : "input", name.text})
      .suggest(output ? diagnostics().nearest(name.text, to_.outputs, &fuzzy::Output::name) : diagnostics().nearest(name.text, to_.inputs, &fuzzy::Input::name));
  return nullptr;
}

std::optional<std::uint32_t> FuzzyHead::slot(const syntax::FuzzyRef& ref, std::string_view wanted) {
  const Variable* variable = find(ref.name, false, wanted);
  if (variable == nullptr) return std::nullopt;
  const fuzzy::Input& input = to_.inputs[variable->id];
  if (!ref.element && !input.group) return input.first_slot;
  const double element = ref.element ? ref.element->value : -1.0;
  const bool inside = ref.element && ref.element->unit.text.empty() && element >= 0.0 && element < input.count && element == std::floor(element);
  if (input.group && inside) return input.first_slot + static_cast<std::uint32_t>(element);
  if (input.group) fail(Kind::kFuzzyElement, ref.span, {input.name, std::to_string(input.count - 1)});
  else fail(Kind::kFuzzyNoGroup, ref.span, {input.name});
  return std::nullopt;
}

}  // namespace kb::model
