// Fuzzy blocks: a head, and rules whose conditions and values are looked up in it.
#include <algorithm>
#include <cmath>

#include "compiler/model/fuzzy_head.h"

namespace kb::model {
namespace {

using diagnostics::Kind;
using fuzzy::Controller;

constexpr std::size_t kMaxRulesOfBlock = 30'000;
constexpr std::size_t kMaxGivens = 16;        // nested in each other

class FuzzyReader : FuzzyHead {
 public:
  FuzzyReader(Draft& draft, const syntax::Tree& tree, const syntax::Fuzzy& from) : FuzzyHead(draft, tree, from) {}

  /// Nothing if anything was reported.
  std::optional<Controller> run() {
    read_head();
    if (from_.inputs.empty() || from_.outputs.empty()) {
      fail(Kind::kFuzzyWithout, from_.name.span, {from_.name.text, from_.inputs.empty() ? "input" : "output"});
    } else if (from_.rules.empty()) {
      fail(Kind::kFuzzyWithout, from_.name.span, {from_.name.text, "rule"});
    }
    if (from_.rules.size() > kMaxRulesOfBlock) fail(Kind::kFuzzyTooLarge, from_.name.span, {from_.name.text, "rules", std::to_string(kMaxRulesOfBlock)});
    conditions_.assign(from_.conds.size(), fuzzy::kNone);
    for (std::size_t i = 0; i < from_.conds.size(); ++i) conditions_[i] = read_condition(from_.conds[i]);
    for (const syntax::Fuzzy::Given& given : from_.givens) read_given(given);
    for (const syntax::Fuzzy::Rule& rule : from_.rules) read_rule(rule);
    check_size();
    if (!good_) return std::nullopt;
    return std::move(to_);
  }

 private:
  /// Refuses a block that is too large for tables with indexes of 16 bits.
  void check_size() {
    std::size_t parts = to_.nodes.size();
    for (const fuzzy::Rule& rule : to_.rules) {
      for (const fuzzy::Consequent& consequent : rule.consequents) parts += 1 + consequent.linear.size();
    }
    constexpr std::size_t kMost = 60'000;
    if (parts > kMost) fail(Kind::kFuzzyTooLarge, from_.name.span, {from_.name.text, "parts of conditions and values", std::to_string(kMost)});
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
    const auto of = slot(from.ref, "a condition asks inputs");
    if (!of) return fuzzy::kNone;
    const std::uint32_t input_id = fuzzy::input_of_slot(to_, *of);
    const fuzzy::Input& input = to_.inputs[input_id];
    const fuzzy::Term* term = find_term(input, from.words.back());
    if (term == nullptr) return fuzzy::kNone;
    const auto offset = (*of - input.first_slot) * input.terms.size() + static_cast<std::size_t>(term - input.terms.data());
    fuzzy::Node node;
    node.degree = input.first_degree + static_cast<std::uint32_t>(offset);
    std::uint32_t id = add(node);
    for (std::size_t i = from.words.size() - 1; i-- > 0;) {
      const syntax::Name& word = from.words[i];
      const auto op = fuzzy::hedge_of(word.text);
      if (!op) {
        diagnostics().report(Kind::kFuzzyHedge, word.span, {word.text}).suggest(diagnostics::closest(word.text, fuzzy::kHedges));
        good_ = false;
        return fuzzy::kNone;
      }
      fuzzy::Node hedge;
      hedge.op = *op;
      hedge.left = id;
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
      find_term(output, part.ref->name);   // reports that there is no such term
      return;
    }
    const auto of = slot(*part.ref, "a value is made of inputs");
    if (!of) return;
    double coefficient = sign;
    if (part.number) {
      // A coefficient's unit would be whatever makes the product fit the output, so it is written as a plain number.
      if (!part.number->unit.text.empty()) return fail(Kind::kFuzzyCoefficientUnit, part.number->unit.span, {part.number->unit.text});
      coefficient *= part.number->value;
      if (coefficient != 0.0 && !(std::fabs(coefficient) >= 1e-18 && std::fabs(coefficient) <= 1e18)) {
        return fail(Kind::kNumberOutOfReach, part.number->span, {diagnostics().sources().text(part.number->span)});
      }
    }
    to.linear.emplace_back(*of, coefficient);
  }

  std::vector<std::uint32_t> conditions_;        // nodes, by condition of the tree; kNone where it could not be read
};

}  // namespace

void declare_fuzzy(Draft& draft) {
  draft.each<syntax::Fuzzy>([&](const syntax::Tree& tree, const auto&, const syntax::Fuzzy& from) {
    std::optional<Controller> controller = FuzzyReader(draft, tree, from).run();
    if (draft.declare(from.name, Entity::Kind::kFuzzy, draft.model.fuzzy.size(), controller.has_value())) draft.model.fuzzy.push_back(std::move(*controller));
  });
}

}  // namespace kb::model
