// Fuzzy blocks: names looked up, units brought to SI, groups of inputs written out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "compiler/model/draft.h"
#include "compiler/model/shapes.h"

namespace kb::model {
namespace {

using diagnostics::Kind;
using fuzzy::Controller;

constexpr std::size_t kMaxSlots = 4'096;      // numbers that one block takes
constexpr std::size_t kMaxDegrees = 16'384;   // degrees of one block: its tables count them in 15 bits
constexpr std::size_t kMaxRulesOfBlock = 30'000;
constexpr std::size_t kMaxGivens = 16;        // in each other

class FuzzyReader {
 public:
  FuzzyReader(Draft& draft, const syntax::Tree& tree, const syntax::Fuzzy& from) : draft_(draft), tree_(tree), from_(from) {}

  /// Nothing if anything was reported.
  std::optional<Controller> run() {
    to_.name = std::string(from_.name.text);
    to_.declared = from_.name.span;
    to_.standard = draft_.standard(from_.name.span);
    read_methods();
    for (const syntax::Fuzzy::Input& input : from_.inputs) read_input(input);
    for (const syntax::Fuzzy::Output& output : from_.outputs) read_output(output);
    if (from_.inputs.empty() || from_.outputs.empty()) {
      fail(Kind::kFuzzyWithout, from_.name.span, {from_.name.text, from_.inputs.empty() ? "input" : "output"});
    } else if (from_.rules.empty()) {
      fail(Kind::kFuzzyWithout, from_.name.span, {from_.name.text, "rule"});
    }
    if (from_.rules.size() > kMaxRulesOfBlock) fail(Kind::kFuzzyTooLarge, from_.name.span, {from_.name.text, "rules", std::to_string(kMaxRulesOfBlock)});
    // A variable that could not be read is known by name, so rules are still looked at.
    conditions_.assign(from_.conds.size(), fuzzy::kNone);
    for (std::size_t i = 0; i < from_.conds.size(); ++i) conditions_[i] = read_condition(from_.conds[i]);
    for (const syntax::Fuzzy::Given& given : from_.givens) read_given(given);
    for (const syntax::Fuzzy::Rule& rule : from_.rules) read_rule(rule);
    check_size();
    if (!good_) return std::nullopt;
    return std::move(to_);
  }

 private:
  struct Variable {
    bool output = false;
    bool broken = false;
    std::uint32_t id = 0;
    source::Span declared;
  };

  diagnostics::Diagnostics& diagnostics() { return draft_.diagnostics; }

  void fail(Kind kind, source::Span at, std::initializer_list<std::string_view> arguments) {
    diagnostics().report(kind, at, arguments);
    good_ = false;
  }

  /// The tables count with 16 bits.
  void check_size() {
    std::size_t parts = to_.nodes.size();
    for (const fuzzy::Rule& rule : to_.rules) {
      for (const fuzzy::Consequent& consequent : rule.consequents) parts += 1 + consequent.linear.size();
    }
    constexpr std::size_t kMost = 60'000;
    if (parts > kMost) fail(Kind::kFuzzyTooLarge, from_.name.span, {from_.name.text, "parts of conditions and values", std::to_string(kMost)});
  }

  // ---- head

  void read_methods() {
    if (const auto& word = from_.conjunction) {
      if (word->text == "product") to_.conjunction = fuzzy::And::kProduct;
      else if (word->text != "min") fail_method(*word, "and", {"min", "product"});
    }
    if (const auto& word = from_.disjunction) {
      if (word->text == "sum") to_.disjunction = fuzzy::Or::kSum;
      else if (word->text != "max") fail_method(*word, "or", {"max", "sum"});
    }
  }

  void fail_method(const syntax::Name& word, std::string_view what, std::initializer_list<std::string_view> known) {
    std::string list;
    for (const std::string_view one : known) list += fmt::format("{}`{}`", list.empty() ? "" : one == *(known.end() - 1) ? " or " : ", ", one);
    const std::vector<std::string_view> candidates(known);
    diagnostics().report(Kind::kFuzzyMethod, word.span, {word.text, what, list}).suggest(diagnostics::closest(word.text, candidates));
    good_ = false;
  }

  void declare(const syntax::Name& name, Variable variable) {
    variable.declared = name.span;
    const auto [known, fresh] = variables_.emplace(name.text, variable);
    if (fresh) return;
    diagnostics().report(Kind::kFuzzyVariableTwice, name.span, {name.text}).note(Kind::kFirstDeclaredHere, known->second.declared);
    good_ = false;
  }

  std::uint32_t read_count(const syntax::Fuzzy::Input& input) {
    if (!input.count) return 1;
    const double count = input.count->value;
    if (input.count->unit.text.empty() && count >= 1.0 && count <= static_cast<double>(kMaxSlots) && count == std::floor(count)) {
      return static_cast<std::uint32_t>(count);
    }
    fail(Kind::kFuzzyGroupSize, input.count->span, {input.name.text, std::to_string(kMaxSlots)});
    return 0;
  }

  void read_input(const syntax::Fuzzy::Input& from) {
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
    to_.slots += input.count;
    if (to_.slots > kMaxSlots || to_.degrees.size() + std::size_t{input.count} * input.terms.size() > kMaxDegrees) {
      if (!too_large_) fail(Kind::kFuzzyTooLarge, from.name.span, {from_.name.text, "degrees of inputs in terms", std::to_string(kMaxDegrees)});
      too_large_ = true;
      good_ = false;
    } else {
      for (std::uint32_t e = 0; e < input.count; ++e) {
        for (std::uint32_t t = 0; t < input.terms.size(); ++t) to_.degrees.push_back({input.first_slot + e, variable.id, t});
      }
    }
    to_.inputs.push_back(std::move(input));
  }

  void read_terms(const syntax::Fuzzy::Input& from, const Domain& domain, fuzzy::Input& input) {
    for (const auto& term : from.terms) {
      check_new(input.name, input.terms, term.name);
      const auto shape = resolve_shape(tree_[term.shape], domain, diagnostics());
      good_ = good_ && shape.has_value();
      input.terms.push_back({std::string(term.name.text), shape.value_or(fuzzy::Shape{})});
      input.terms.back().shape.span = term.name.span;
    }
  }

  template <class Terms>
  void check_new(std::string_view variable, const Terms& terms, const syntax::Name& name) {
    const bool twice = std::any_of(terms.begin(), terms.end(), [&](const auto& term) { return term.name == name.text; });
    if (twice) fail(Kind::kFuzzyTermTwice, name.span, {name.text, variable});
    const bool word = name.text == "not" || name.text == "very" || name.text == "somewhat";
    if (word) fail(Kind::kFuzzyTermName, name.span, {name.text});
  }

  void read_output(const syntax::Fuzzy::Output& from) {
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

  double number(const syntax::Number& from, const Domain& domain) {
    const auto value = resolve_number(from, domain, diagnostics());
    good_ = good_ && value.has_value();
    return value.value_or(0.0);
  }

  void read_options(const syntax::Fuzzy::Output& from, const Domain& domain, fuzzy::Output& output) {
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
      if (const fuzzy::Value* term = find_value(output, *from.default_term)) output.fallback = term->number;
    }
    if (output.fallback && good_ && (*output.fallback < output.low || *output.fallback > output.high)) {
      const source::Span at = from.default_number ? from.default_number->span : from.default_term->span;
      fail(Kind::kFuzzyDefaultRange, at, {output.name, fmt::format("{}", output.low), fmt::format("{}", output.high)});
    }
  }

  const fuzzy::Value* find_value(const fuzzy::Output& output, const syntax::Name& name) {
    for (const fuzzy::Value& value : output.terms) {
      if (value.name == name.text) return &value;
    }
    std::vector<std::string_view> candidates;
    for (const fuzzy::Value& value : output.terms) candidates.push_back(value.name);
    diagnostics().report(Kind::kFuzzyUnknownTerm, name.span, {output.name, name.text}).suggest(diagnostics::closest(name.text, candidates));
    good_ = false;
    return nullptr;
  }

  // ---- rules

  const Variable* find(const syntax::Name& name, bool output, std::string_view wanted) {
    const auto found = variables_.find(name.text);
    if (found != variables_.end() && found->second.output == output) return found->second.broken ? nullptr : &found->second;
    good_ = false;
    if (found != variables_.end()) {
      diagnostics().report(Kind::kFuzzyWrongSide, name.span, {name.text, output ? "an input" : "an output", wanted})
          .note(Kind::kNameDeclaredHere, found->second.declared, {name.text});
      return nullptr;
    }
    std::vector<std::string_view> candidates;
    if (output) for (const auto& one : to_.outputs) candidates.push_back(one.name);
    else for (const auto& one : to_.inputs) candidates.push_back(one.name);
    diagnostics().report(Kind::kFuzzyUnknownVariable, name.span, {from_.name.text, output ? "output" : "input", name.text})
        .suggest(diagnostics::closest(name.text, candidates));
    return nullptr;
  }

  /// The slot of an input, or of one of a group.
  std::optional<std::uint32_t> slot(const syntax::FuzzyRef& ref, std::string_view wanted) {
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

  std::uint32_t add(fuzzy::Node node) {
    to_.nodes.push_back(node);
    return static_cast<std::uint32_t>(to_.nodes.size() - 1);
  }

  std::uint32_t read_condition(const syntax::FuzzyCond& from) {
    using Op = fuzzy::Node::Op;
    if (from.kind == syntax::FuzzyCond::Kind::kIs) return read_is(from);
    fuzzy::Node node;
    node.left = conditions_[from.left];
    if (node.left == fuzzy::kNone) return fuzzy::kNone;
    if (from.kind == syntax::FuzzyCond::Kind::kNot) {
      node.op = Op::kNot;
      return add(node);
    }
    node.right = conditions_[from.right];
    if (node.right == fuzzy::kNone) return fuzzy::kNone;
    node.op = from.kind == syntax::FuzzyCond::Kind::kAnd ? Op::kAnd : Op::kOr;
    return add(node);
  }

  std::uint32_t read_is(const syntax::FuzzyCond& from) {
    using Op = fuzzy::Node::Op;
    const auto of = slot(from.ref, "a condition asks inputs");
    if (!of) return fuzzy::kNone;
    const std::uint32_t input_id = fuzzy::input_of_slot(to_, *of);
    const fuzzy::Input& input = to_.inputs[input_id];
    const syntax::Name& name = from.words.back();
    const auto term = std::find_if(input.terms.begin(), input.terms.end(), [&](const auto& one) { return one.name == name.text; });
    if (term == input.terms.end()) {
      std::vector<std::string_view> candidates;
      for (const auto& one : input.terms) candidates.push_back(one.name);
      diagnostics().report(Kind::kFuzzyUnknownTerm, name.span, {input.name, name.text}).suggest(diagnostics::closest(name.text, candidates));
      good_ = false;
      return fuzzy::kNone;
    }
    const auto offset = (*of - input.first_slot) * input.terms.size() + static_cast<std::size_t>(term - input.terms.begin());
    fuzzy::Node node;
    node.degree = input.first_degree + static_cast<std::uint32_t>(offset);
    std::uint32_t id = add(node);
    for (std::size_t i = from.words.size() - 1; i-- > 0;) {
      const syntax::Name& word = from.words[i];
      fuzzy::Node hedge;
      hedge.left = id;
      if (word.text == "not") hedge.op = Op::kNot;
      else if (word.text == "very") hedge.op = Op::kVery;
      else if (word.text == "somewhat") hedge.op = Op::kSomewhat;
      else {
        constexpr std::string_view kHedges[] = {"not", "very", "somewhat"};
        diagnostics().report(Kind::kFuzzyHedge, word.span, {word.text}).suggest(diagnostics::closest(word.text, kHedges));
        good_ = false;
        return fuzzy::kNone;
      }
      id = add(hedge);
    }
    return id;
  }

  void read_given(const syntax::Fuzzy::Given& from) {
    if (from.first_rule == from.end_rule) fail(Kind::kFuzzyEmptyGiven, from.span, {});
    std::size_t depth = 1;
    for (std::uint32_t up = from.parent; up != syntax::Fuzzy::kNoGiven; up = from_.givens[up].parent) ++depth;
    if (depth > kMaxGivens) fail(Kind::kFuzzyGivenDepth, from.span, {std::to_string(kMaxGivens)});
    to_.nests.push_back({from.parent, conditions_[from.condition], from.first_rule, from.end_rule, from.span});
  }

  void read_rule(const syntax::Fuzzy::Rule& from) {
    fuzzy::Rule rule;
    rule.nest = from.given;
    rule.condition = conditions_[from.condition];
    rule.span = from.span;
    if (from.weight) {
      rule.weight = from.weight->unit.text == "%" ? from.weight->value / 100.0 : from.weight->value;
      const bool plain = from.weight->unit.text.empty() || from.weight->unit.text == "%";
      if (!plain || !(rule.weight >= 1e-6 && rule.weight <= 1.0)) fail(Kind::kFuzzyWeight, from.weight->span, {diagnostics().sources().text(from.weight->span)});
    }
    for (const syntax::Fuzzy::Consequent& consequent : from.consequents) read_consequent(consequent, rule);
    to_.rules.push_back(std::move(rule));
  }

  void read_consequent(const syntax::Fuzzy::Consequent& from, fuzzy::Rule& rule) {
    const Variable* variable = find(from.output, true, "a rule concludes outputs");
    if (variable == nullptr) return;
    for (const fuzzy::Consequent& before : rule.consequents) {
      if (before.output == variable->id) return fail(Kind::kFuzzyConsequentTwice, from.output.span, {from.output.text});
    }
    fuzzy::Consequent consequent;
    consequent.output = variable->id;
    consequent.span = from.span;
    const bool alone = from.sum.size() == 1 && !from.sum.front().negative;
    for (const syntax::Fuzzy::Part& part : from.sum) read_part(part, alone, consequent);
    std::sort(consequent.linear.begin(), consequent.linear.end());
    for (std::size_t i = 1; i < consequent.linear.size(); ++i) {
      if (consequent.linear[i].first == consequent.linear[i - 1].first) {
        fail(Kind::kFuzzyInputTwice, from.span, {fuzzy::slot_name(to_, consequent.linear[i].first)});
      }
    }
    rule.consequents.push_back(std::move(consequent));
  }

  void read_part(const syntax::Fuzzy::Part& part, bool alone, fuzzy::Consequent& to) {
    const fuzzy::Output& output = to_.outputs[to.output];
    const double sign = part.negative ? -1.0 : 1.0;
    if (!part.ref) {
      to.constant += sign * number(*part.number, *domains_[to.output]);
      return;
    }
    const auto term = std::find_if(output.terms.begin(), output.terms.end(), [&](const auto& one) { return one.name == part.ref->name.text; });
    if (!part.number && !part.ref->element && term != output.terms.end()) {
      if (!alone) return fail(Kind::kFuzzyTermInSum, part.span, {term->name, output.name});
      to.term = static_cast<std::uint32_t>(term - output.terms.begin());
      to.constant = term->number;
      return;
    }
    if (!part.number && !part.ref->element && variables_.find(part.ref->name.text) == variables_.end()) {
      find_value(output, part.ref->name);   // says that there is no such term
      return;
    }
    const auto of = slot(*part.ref, "a value is made of inputs");
    if (!of) return;
    double coefficient = sign;
    if (part.number) {
      // A coefficient has the unit that makes the product one of the output's, whatever that is: it is a plain number.
      if (!part.number->unit.text.empty()) return fail(Kind::kFuzzyCoefficientUnit, part.number->unit.span, {part.number->unit.text});
      coefficient *= part.number->value;
      if (coefficient != 0.0 && !(std::fabs(coefficient) >= 1e-18 && std::fabs(coefficient) <= 1e18)) {
        return fail(Kind::kNumberOutOfReach, part.number->span, {diagnostics().sources().text(part.number->span)});
      }
    }
    to.linear.emplace_back(*of, coefficient);
  }

  Draft& draft_;
  const syntax::Tree& tree_;
  const syntax::Fuzzy& from_;
  Controller to_;
  std::unordered_map<std::string_view, Variable> variables_;
  std::vector<std::optional<Domain>> domains_;   // of the outputs
  std::vector<std::uint32_t> conditions_;        // nodes, by condition of the tree; kNone where it could not be read
  bool good_ = true;
  bool too_large_ = false;
};

}  // namespace

void declare_fuzzy(Draft& draft) {
  draft.each<syntax::Fuzzy>([&](const syntax::Tree& tree, const auto&, const syntax::Fuzzy& from) {
    std::optional<Controller> controller = FuzzyReader(draft, tree, from).run();
    const auto id = static_cast<std::uint32_t>(draft.model.fuzzy.size());
    const Entity entity{controller ? Entity::Kind::kFuzzy : Entity::Kind::kBroken, id, {}};
    if (!draft.names.declare(from.name, entity, draft.diagnostics) || !controller) return;
    draft.model.fuzzy.push_back(std::move(*controller));
  });
}

}  // namespace kb::model
