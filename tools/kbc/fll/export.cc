// A fuzzy controller as FLL.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "tools/kbc/fll/fll.h"

namespace kb::fll {
namespace {

using diagnostics::Kind;
using fuzzy::Node;
using Out = std::back_insert_iterator<std::string>;

class Exporter {
 public:
  Exporter(const fuzzy::Controller& c, diagnostics::Diagnostics& diagnostics) : c_(c), diagnostics_(diagnostics) {}

  std::optional<std::string> run() {
    fmt::format_to(Out(out_), "Engine: {}\n", c_.name);
    for (const fuzzy::Input& input : c_.inputs) write_input(input);
    for (const fuzzy::Rule& rule : c_.rules) name_values(rule);
    for (std::uint32_t o = 0; o < c_.outputs.size(); ++o) write_output(o);
    fmt::format_to(Out(out_), "RuleBlock: rules\n  enabled: true\n  conjunction: {}\n  disjunction: {}\n  implication: none\n  activation: General\n",
                   c_.conjunction == fuzzy::And::kMin ? "Minimum" : "AlgebraicProduct", c_.disjunction == fuzzy::Or::kMax ? "Maximum" : "AlgebraicSum");
    for (std::size_t r = 0; r < c_.rules.size(); ++r) write_rule(r);
    if (!good_) return std::nullopt;
    return std::move(out_);
  }

 private:
  void refuse(source::Span at, std::string_view what) {
    diagnostics_.report(Kind::kFllCannotSay, at, {what});
    good_ = false;
  }

  /// FLL has no groups: `free[3]` is `free_3`.
  [[nodiscard]] std::string name(std::uint32_t slot) const {
    const fuzzy::Input& input = c_.inputs[input_of_slot(c_, slot)];
    return input.group ? fmt::format("{}_{}", input.name, slot - input.first_slot) : input.name;
  }

  std::string shape(const fuzzy::Shape& s) {
    using fuzzy::ShapeKind;
    const auto& p = s.p;
    switch (s.kind) {
      case ShapeKind::kTriangle: return fmt::format("Triangle {} {} {}", p[0], p[1], p[2]);
      case ShapeKind::kTrapezoid: return fmt::format("Trapezoid {} {} {} {}", p[0], p[1], p[2], p[3]);
      case ShapeKind::kRamp: return fmt::format("Ramp {} {}", p[0], p[1]);
      case ShapeKind::kBell: return fmt::format("Bell {} {} {}", p[0], p[1], p[2]);
      case ShapeKind::kSigmoid: return fmt::format("Sigmoid {} {}", p[0], p[1]);
      case ShapeKind::kGaussian:
        if (std::isinf(p[2]) || std::isinf(p[3])) refuse(s.span, "a Gaussian with one side only");
        if (p[0] == p[1] && p[2] == p[3]) return fmt::format("Gaussian {} {}", p[0], p[2]);
        return fmt::format("GaussianProduct {} {} {} {}", p[0], p[2], p[1], p[3]);
      case ShapeKind::kSingleton: refuse(s.span, "a singleton as a term of an input"); return {};
    }
    return {};
  }

  void write_input(const fuzzy::Input& input) {
    if (input.circular) refuse(input.declared, fmt::format("that `{}` is circular", input.name));
    std::vector<std::string> shapes;
    for (const fuzzy::Term& term : input.terms) shapes.push_back(shape(term.shape));
    for (std::uint32_t e = 0; e < input.count; ++e) {
      fmt::format_to(Out(out_), "InputVariable: {}\n  enabled: true\n  range: {} {}\n  lock-range: true\n", name(input.first_slot + e), input.low, input.high);
      for (std::size_t t = 0; t < input.terms.size(); ++t) fmt::format_to(Out(out_), "  term: {} {}\n", input.terms[t].name, shapes[t]);
    }
  }

  /// FLL names every value: those that are no term get a name here.
  void name_values(const fuzzy::Rule& rule) {
    std::vector<std::string> of;
    for (const fuzzy::Consequent& one : rule.consequents) {
      const fuzzy::Output& output = c_.outputs[one.output];
      if (one.term != fuzzy::kNone) {
        of.push_back(output.terms[one.term].name);
        continue;
      }
      of.push_back(fmt::format("rule{}_{}", values_.size(), output.name));
      std::vector<double> numbers(c_.slots, 0.0);
      for (const auto& [slot, coefficient] : one.linear) numbers[slot] = coefficient;
      numbers.push_back(one.constant);
      extra_.push_back({one.output, one.linear.empty() ? fmt::format("{} Constant {}", of.back(), one.constant)
                                                       : fmt::format("{} Linear {}", of.back(), fmt::join(numbers, " "))});
    }
    values_.push_back(std::move(of));
  }

  void write_output(std::uint32_t o) {
    const fuzzy::Output& output = c_.outputs[o];
    if (output.circular) refuse(output.declared, fmt::format("that `{}` is circular", output.name));
    if (output.combine == fuzzy::Combine::kWinner) refuse(output.declared, fmt::format("that the strongest rule alone says what `{}` is", output.name));
    if (output.within < fuzzy::kInfinity) refuse(output.declared, fmt::format("`within`, how far from the strongest a value of `{}` may lie", output.name));
    fmt::format_to(Out(out_), "OutputVariable: {}\n  enabled: true\n  range: {} {}\n  lock-range: true\n  aggregation: none\n  defuzzifier: {} TakagiSugeno\n  default: {}\n  lock-previous: false\n",
                   output.name, output.low, output.high, output.combine == fuzzy::Combine::kSum ? "WeightedSum" : "WeightedAverage", output.default_value());
    for (const fuzzy::Value& term : output.terms) fmt::format_to(Out(out_), "  term: {} Constant {}\n", term.name, term.number);
    for (const auto& [of, text] : extra_) {
      if (of == o) fmt::format_to(Out(out_), "  term: {}\n", text);
    }
  }

  /// A condition with parentheses round every pair; recursion as deep as conditions nest.
  std::string condition(std::uint32_t id, source::Span at) {
    const Node& node = c_.nodes[id];
    if (node.op == Node::Op::kAnd || node.op == Node::Op::kOr) {
      return fmt::format("( {} {} {} )", condition(node.left, at), node.op == Node::Op::kAnd ? "and" : "or", condition(node.right, at));
    }
    std::string hedges;
    const Node* inner = &node;
    while (inner->op == Node::Op::kNot || inner->op == Node::Op::kVery || inner->op == Node::Op::kSomewhat) {
      hedges += inner->op == Node::Op::kNot ? "not " : inner->op == Node::Op::kVery ? "very " : "somewhat ";
      inner = &c_.nodes[inner->left];
    }
    if (inner->op != Node::Op::kDegree) {
      refuse(at, "`not` of more than one part");
      return {};
    }
    const fuzzy::Degree& degree = c_.degrees[inner->degree];
    return fmt::format("{} is {}{}", name(degree.slot), hedges, c_.input_of(degree).terms[degree.term].name);
  }

  void write_rule(std::size_t r) {
    const fuzzy::Rule& rule = c_.rules[r];
    std::string text = condition(rule.condition, rule.span);
    for (std::uint32_t nest = rule.nest; nest != fuzzy::kNone; nest = c_.nests[nest].parent) {
      text = fmt::format("( {} and {} )", condition(c_.nests[nest].condition, c_.nests[nest].span), text);
    }
    fmt::format_to(Out(out_), "  rule: if {} then ", text);
    for (std::size_t i = 0; i < rule.consequents.size(); ++i) {
      fmt::format_to(Out(out_), "{}{} is {}", i == 0 ? "" : " and ", c_.outputs[rule.consequents[i].output].name, values_[r][i]);
    }
    if (rule.weight != 1.0) fmt::format_to(Out(out_), " with {}", rule.weight);
    out_ += '\n';
  }

  const fuzzy::Controller& c_;
  diagnostics::Diagnostics& diagnostics_;
  std::string out_;
  std::vector<std::pair<std::uint32_t, std::string>> extra_;   // output, term
  std::vector<std::vector<std::string>> values_;               // by rule, by consequent
  bool good_ = true;
};

}  // namespace

std::optional<std::string> export_engine(const fuzzy::Controller& controller, diagnostics::Diagnostics& diagnostics) {
  return Exporter(controller, diagnostics).run();
}

}  // namespace kb::fll
