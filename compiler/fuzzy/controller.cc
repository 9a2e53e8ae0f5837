#include "compiler/fuzzy/controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "compiler/fuzzy/interpret.h"

namespace kb::fuzzy {
namespace {

std::string degree_text(const Controller& c, std::uint32_t id, std::string_view hedges) {
  const Degree& degree = c.degrees[id];
  return fmt::format("{} is {}{}", slot_name(c, degree.slot), hedges, c.input_of(degree).terms[degree.term].name);
}

// How tightly a node binds: `or` 0, `and` 1, the rest 2.
int tightness(const Node& node) { return node.op == Node::Op::kOr ? 0 : node.op == Node::Op::kAnd ? 1 : 2; }

// Hedges and `not` over a degree are written as in `x is not very low`; over anything else, `not` stands before parentheses.
std::string hedged_text(const Controller& c, std::uint32_t id) {
  std::string hedges;
  const Node* node = &c.nodes[id];
  while (node->op == Node::Op::kNot || node->op == Node::Op::kVery || node->op == Node::Op::kSomewhat) {
    hedges += std::string(kOpWords[static_cast<std::size_t>(node->op)]) + " ";
    node = &c.nodes[node->left];
  }
  if (node->op == Node::Op::kDegree) return degree_text(c, node->degree, hedges);
  return fmt::format("not ({})", text(c, c.nodes[id].left));
}

std::string combine_text(const Output& output) {
  std::string out(kCombineWords[static_cast<std::size_t>(output.combine)]);
  if (output.within < kInfinity) out += fmt::format(" within {}", output.within);
  return out;
}

}  // namespace

std::uint32_t input_of_slot(const Controller& controller, std::uint32_t slot) {
  const auto behind = std::ranges::upper_bound(controller.inputs, slot, {}, &Input::first_slot);
  return static_cast<std::uint32_t>(behind - controller.inputs.begin()) - 1;
}

std::string range_text(double low, double high, std::string_view unit, bool circular) {
  return fmt::format("{}..{}{}{}{}", low, high, unit.empty() ? "" : " ", unit, circular ? " circular" : "");
}

std::string slot_name(const Controller& controller, std::uint32_t slot) {
  const Input& input = controller.inputs[input_of_slot(controller, slot)];
  return input.group ? fmt::format("{}[{}]", input.name, slot - input.first_slot) : input.name;
}

std::string text(const Controller& c, std::uint32_t id) {
  const Node& node = c.nodes[id];
  if (node.op == Node::Op::kDegree) return degree_text(c, node.degree, "");
  if (tightness(node) == 2) return hedged_text(c, id);
  const auto part = [&](std::uint32_t child, bool right) {
    const int inner = tightness(c.nodes[child]), own = tightness(node);
    const bool parentheses = inner < own || (right && inner == own);
    return parentheses ? fmt::format("({})", text(c, child)) : text(c, child);
  };
  return fmt::format("{} {} {}", part(node.left, false), node.op == Node::Op::kAnd ? "and" : "or", part(node.right, true));
}

std::string text(const Controller& c, const Consequent& consequent) {
  const Output& output = c.outputs[consequent.output];
  if (consequent.term != kNone) return fmt::format("{} = {}", output.name, output.terms[consequent.term].name);
  std::string sum;
  for (const auto& [slot, coefficient] : consequent.linear) {
    const std::string name = slot_name(c, slot);
    const double size = sum.empty() ? coefficient : std::fabs(coefficient);
    if (!sum.empty()) sum += coefficient < 0.0 ? " - " : " + ";
    sum += size == 1.0 ? name : size == -1.0 ? "-" + name : fmt::format("{}*{}", size, name);
  }
  if (sum.empty()) return fmt::format("{} = {}", output.name, consequent.constant);
  if (consequent.constant != 0.0) sum += fmt::format(" {} {}", consequent.constant < 0.0 ? "-" : "+", std::fabs(consequent.constant));
  return fmt::format("{} = {}", output.name, sum);
}

std::string text(const Controller& c, const Rule& rule) {
  std::string out = text(c, rule.condition) + " -> ";
  for (std::size_t i = 0; i < rule.consequents.size(); ++i) out += (i == 0 ? "" : ", ") + text(c, rule.consequents[i]);
  if (rule.weight != 1.0) out += fmt::format(" weight {}", rule.weight);
  return out;
}

namespace {

class Printer {
 public:
  Printer(const Controller& controller, const source::Sources* sources) : c_(controller), sources_(sources) {}

  std::string run() {
    line(0, "fuzzy {}: and = {}, or = {}{}", c_.name, c_.conjunction == And::kMin ? "min" : "product",
         c_.disjunction == Or::kMax ? "max" : "sum", at(c_.declared));
    for (const Input& input : c_.inputs) print_input(input);
    for (const Output& output : c_.outputs) print_output(output);
    std::size_t nest = 0;
    for (std::uint32_t r = 0; r < c_.rules.size(); ++r) {
      for (; nest < c_.nests.size() && c_.nests[nest].first_rule == r; ++nest) {
        line(1 + depth(c_.nests[nest].parent), "given {}{}", text(c_, c_.nests[nest].condition), at(c_.nests[nest].span));
      }
      line(1 + depth(c_.rules[r].nest), "rule {}: {}{}", r, text(c_, c_.rules[r]), at(c_.rules[r].span));
    }
    return std::move(out_);
  }

 private:
  template <class... Arguments>
  void line(int indent, fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    out_.append(static_cast<std::size_t>(indent) * 2, ' ');
    fmt::format_to(std::back_inserter(out_), format, std::forward<Arguments>(arguments)...);
    out_ += '\n';
  }
  [[nodiscard]] std::string at(source::Span span) const { return sources_ == nullptr ? "" : "  # " + sources_->describe(span); }
  [[nodiscard]] int depth(std::uint32_t nest) const {
    int depth = 0;
    for (; nest != kNone; nest = c_.nests[nest].parent) ++depth;
    return depth;
  }

  void print_input(const Input& input) {
    line(1, "input {}{} {}{}", input.name, input.group ? fmt::format("[{}]", input.count) : "",
         range_text(input.low, input.high, input.unit, input.circular), at(input.declared));
    for (const Term& term : input.terms) line(2, "{} = {}", term.name, text(term.shape));
  }
  void print_output(const Output& output) {
    line(1, "output {} {} by {} default {}{}", output.name, range_text(output.low, output.high, output.unit, output.circular),
         combine_text(output), output.default_value(), at(output.declared));
    for (const Value& term : output.terms) line(2, "{} = {}", term.name, term.number);
  }

  const Controller& c_;
  const source::Sources* sources_;
  std::string out_;
};

}  // namespace

std::string print(const Controller& controller, const source::Sources* sources) { return Printer(controller, sources).run(); }

std::vector<std::string> verify(const Controller& c) {
  std::vector<std::string> faults;
  const auto demand = [&faults, &c](bool holds, std::string_view what) {
    if (!holds) faults.push_back(fmt::format("fuzzy {}: {}", c.name, what));
  };
  std::uint32_t slots = 0, degrees = 0;
  for (const Input& input : c.inputs) {
    demand(input.first_slot == slots && input.first_degree == degrees, "inputs are numbered in order");
    slots += input.count;
    degrees += input.count * static_cast<std::uint32_t>(input.terms.size());
    demand(input.low < input.high, "a range is not empty");
  }
  demand(slots == c.slots && degrees == c.degrees.size(), "all slots and degrees belong to an input");
  for (std::uint32_t n = 0; n < c.nodes.size(); ++n) {
    const Node& node = c.nodes[n];
    const bool pair = node.op == Node::Op::kAnd || node.op == Node::Op::kOr;
    demand(node.op == Node::Op::kDegree ? node.degree < c.degrees.size() : node.left < n, "a node speaks of what is there");
    demand(!pair || node.right < n, "a node joins what was made before it");
  }
  std::uint32_t first = 0;
  for (std::uint32_t n = 0; n < c.nests.size(); ++n) {
    const Nest& nest = c.nests[n];
    demand(nest.parent == kNone || nest.parent < n, "a nest stands in an earlier one");
    demand(nest.first_rule >= first && nest.first_rule < nest.end_rule && nest.end_rule <= c.rules.size(), "a nest holds rules");
    demand(nest.condition < c.nodes.size(), "a nest has a condition");
    first = nest.first_rule;
  }
  for (std::uint32_t r = 0; r < c.rules.size(); ++r) {
    const Rule& rule = c.rules[r];
    demand(rule.condition < c.nodes.size() && !rule.consequents.empty(), "a rule has two parts");
    demand(rule.weight > 0.0 && rule.weight <= 1.0, "a weight lies in (0, 1]");
    demand(rule.nest == kNone || (c.nests[rule.nest].first_rule <= r && r < c.nests[rule.nest].end_rule), "a rule lies in its nest");
    for (const Consequent& consequent : rule.consequents) {
      demand(consequent.output < c.outputs.size(), "a rule writes an output");
      for (const auto& [slot, coefficient] : consequent.linear) demand(slot < c.slots && std::isfinite(coefficient), "a value reads inputs");
    }
  }
  return faults;
}

Outcome<double> interpret(const Controller& controller, const std::vector<double>& inputs) {
  const auto root = [](double x) { return std::sqrt(x); };
  Interpreter<double, ExactDegrees, double (*)(double, double, double), decltype(root)> run(controller, {controller}, wrapped, root);
  return run(inputs);
}

}  // namespace kb::fuzzy
