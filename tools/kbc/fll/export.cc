// A fuzzy controller as FLL.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>

#include "tools/kbc/fll/fll.h"

namespace kb::fll {
namespace {

using diagnostics::Kind;
using fuzzy::Node;
using Out = std::back_insert_iterator<std::string>;

/// Whether fuzzylite takes the word in a rule for something other than the name of a variable or a term. Includes its hedges and functions.
bool is_fll_word(std::string_view name) {
  constexpr std::string_view kWords[] = {"abs", "acos", "acosh", "and", "any", "asin", "asinh", "atan", "atan2", "atanh", "ceil", "cos", "cosh",
                                         "eq", "exp", "extremely", "fabs", "floor", "fmod", "ge", "gt", "if", "is", "le", "log", "log10", "log1p",
                                         "lt", "max", "min", "neq", "not", "or", "pow", "round", "seldom", "sin", "sinh", "somewhat", "sqrt",
                                         "tan", "tanh", "then", "very", "with"};
  return std::binary_search(std::begin(kWords), std::end(kWords), name);
}

/// The name in ASCII. fuzzylite drops other letters from a declaration, and then does not find the name that the rules use.
std::string ascii(std::string_view name) {
  std::string out;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) out += c;
    else if (byte >= 0xC0) out += '_';   // the first byte of a letter; its others are dropped
  }
  return out;
}

class Exporter {
 public:
  Exporter(const fuzzy::Controller& c, diagnostics::Diagnostics& diagnostics) : c_(c), diagnostics_(diagnostics) {}

  std::optional<std::string> run() {
    name_variables();
    name_terms();
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

  /// `wanted` in ASCII, with as many `_` behind it as it takes to be no word of FLL and not among `taken`, to which it is added. Reports a
  /// change; `written` is the name as it stands in the knowledge base.
  std::string free_name(const std::string& wanted, const std::string& written, source::Span at, std::set<std::string>& taken) {
    std::string name = ascii(wanted);
    const std::string why = name != wanted      ? "a name of FLL is ASCII"
                            : is_fll_word(name) ? fmt::format("`{}` is a word of FLL", name)
                                                : fmt::format("another is called `{}`", name);
    while (is_fll_word(name) || taken.contains(name)) name += '_';
    if (name != wanted) diagnostics_.report(Kind::kFllAdapted, at, {fmt::format("`{}` becomes `{}`, since {}", written, name, why)});
    taken.insert(name);
    return name;
  }

  /// FLL has no groups: `free[3]` becomes `free_3`. Names that need not change are given first, so that they stay free.
  void name_variables() {
    std::set<std::string> taken;
    names_.resize(c_.slots);
    for (const fuzzy::Input& input : c_.inputs) {
      if (!input.group) names_[input.first_slot] = free_name(input.name, input.name, input.declared, taken);
    }
    for (const fuzzy::Output& output : c_.outputs) output_names_.push_back(free_name(output.name, output.name, output.declared, taken));
    for (const fuzzy::Input& input : c_.inputs) {
      for (std::uint32_t e = 0; input.group && e < input.count; ++e) {
        const std::uint32_t slot = input.first_slot + e;
        names_[slot] = free_name(fmt::format("{}_{}", input.name, e), fuzzy::slot_name(c_, slot), input.declared, taken);
      }
    }
  }

  void name_terms() {
    for (const fuzzy::Input& input : c_.inputs) {
      std::set<std::string> taken;
      std::vector<std::string>& names = input_terms_.emplace_back();
      for (const fuzzy::Term& term : input.terms) names.push_back(free_name(term.name, term.name, term.shape.span, taken));
    }
    for (const fuzzy::Output& output : c_.outputs) {
      std::set<std::string>& taken = output_taken_.emplace_back();
      std::vector<std::string>& names = output_terms_.emplace_back();
      for (const fuzzy::Value& term : output.terms) names.push_back(free_name(term.name, term.name, term.span, taken));
    }
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

  /// A comment with the unit: numbers are written in SI units, whatever units the knowledge base uses.
  static std::string in_unit(std::string_view unit) { return unit.empty() ? "" : fmt::format("  description: in {}\n", unit); }

  void write_input(const fuzzy::Input& input) {
    if (input.circular) refuse(input.declared, fmt::format("that `{}` is circular", input.name));
    std::vector<std::string> shapes;
    const std::vector<std::string>& terms = input_terms_[input_of_slot(c_, input.first_slot)];
    for (const fuzzy::Term& term : input.terms) shapes.push_back(shape(term.shape));
    for (std::uint32_t e = 0; e < input.count; ++e) {
      fmt::format_to(Out(out_), "InputVariable: {}\n{}  enabled: true\n  range: {} {}\n  lock-range: true\n", names_[input.first_slot + e], in_unit(input.unit), input.low, input.high);
      for (std::size_t t = 0; t < input.terms.size(); ++t) fmt::format_to(Out(out_), "  term: {} {}\n", terms[t], shapes[t]);
    }
  }

  /// Gives a name to each value that is not a term: in FLL every value has one.
  void name_values(const fuzzy::Rule& rule) {
    std::vector<std::string> of;
    for (const fuzzy::Consequent& one : rule.consequents) {
      if (one.term != fuzzy::kNone) {
        of.push_back(output_terms_[one.output][one.term]);
        continue;
      }
      of.push_back(fmt::format("rule{}_{}", values_.size(), output_names_[one.output]));
      while (!output_taken_[one.output].insert(of.back()).second) of.back() += '_';
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
    fmt::format_to(Out(out_), "OutputVariable: {}\n{}  enabled: true\n  range: {} {}\n  lock-range: true\n  aggregation: none\n  defuzzifier: {} TakagiSugeno\n  default: {}\n  lock-previous: false\n",
                   output_names_[o], in_unit(output.unit), output.low, output.high, output.combine == fuzzy::Combine::kSum ? "WeightedSum" : "WeightedAverage", output.default_value());
    for (std::size_t t = 0; t < output.terms.size(); ++t) {
      fmt::format_to(Out(out_), "  term: {} Constant {}\n", output_terms_[o][t], output.terms[t].number);
    }
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
    return fmt::format("{} is {}{}", names_[degree.slot], hedges, input_terms_[degree.input][degree.term]);
  }

  void write_rule(std::size_t r) {
    const fuzzy::Rule& rule = c_.rules[r];
    std::string text = condition(rule.condition, rule.span);
    for (std::uint32_t nest = rule.nest; nest != fuzzy::kNone; nest = c_.nests[nest].parent) {
      text = fmt::format("( {} and {} )", condition(c_.nests[nest].condition, c_.nests[nest].span), text);
    }
    fmt::format_to(Out(out_), "  rule: if {} then ", text);
    for (std::size_t i = 0; i < rule.consequents.size(); ++i) {
      fmt::format_to(Out(out_), "{}{} is {}", i == 0 ? "" : " and ", output_names_[rule.consequents[i].output], values_[r][i]);
    }
    if (rule.weight != 1.0) fmt::format_to(Out(out_), " with {}", rule.weight);
    out_ += '\n';
  }

  const fuzzy::Controller& c_;
  diagnostics::Diagnostics& diagnostics_;
  std::string out_;
  std::vector<std::string> names_, output_names_;              // of slots, of outputs, in FLL
  std::vector<std::vector<std::string>> input_terms_, output_terms_;
  std::vector<std::set<std::string>> output_taken_;            // what terms of each output are called
  std::vector<std::pair<std::uint32_t, std::string>> extra_;   // output, term
  std::vector<std::vector<std::string>> values_;               // by rule, by consequent
  bool good_ = true;
};

}  // namespace

std::optional<std::string> export_engine(const fuzzy::Controller& controller, diagnostics::Diagnostics& diagnostics) {
  return Exporter(controller, diagnostics).run();
}

}  // namespace kb::fll
