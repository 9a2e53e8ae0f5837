// The rules of a fuzzy controller as straight C++: the same operations in the same order as mts::evaluate on the tables, so
// the same bits, but without a loop over rules, with constants in their places, and with what several rules ask computed
// once.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "compiler/emit/cpp.h"
#include "compiler/emit/cpp_fuzzy.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using fuzzy::Node;

/// Beyond this much code the tables are walked: straight code would no longer fit into a cache.
constexpr std::size_t kMostCode = 8'000;

class StraightCode {
 public:
  StraightCode(const fuzzy::Controller& c, const tables::FuzzyForm& form, const FuzzyNames& names, std::string& out)
      : c_(c), form_(form), names_(names), out_(out) {}

  void run() {
    find_scopes();
    fmt::format_to(Out(out_), "{0}::Outputs {0}::evaluate(const Inputs& in) noexcept {{\n  using namespace fuzzy_{0};\n", names_.type);
    out_ += "  Outputs out;\n  bool good = true, outside = false;\n";
    for (std::uint32_t s = 0; s < c_.slots; ++s) {
      const mts::FuzzyInput& input = form_.inputs[s];
      const std::string range = input.period > 0.0f ? fmt::format("take(x{0}, kInputs[{0}]", s)
                                                    : fmt::format("take_on_line(x{}, {}, {}", s, float_constant(input.low), float_constant(input.high));
      fmt::format_to(Out(out_), "  float x{0} = {1};\n  good = mts::{2}, outside) && good;\n", s, slot_expression(c_, names_, s), range);
    }
    out_ += "  if (!good) {\n    Outputs none;\n    none.status = mts::FuzzyStatus::kBadInput;\n    return none;\n  }\n"
        "  if (outside) mts::raise(out.status, mts::FuzzyStatus::kInputClamped);\n";
    for (std::size_t o = 0; o < c_.outputs.size(); ++o) declare_output(o);
    emit_degrees(fuzzy::kNone);
    emit_steps();
    for (std::size_t o = 0; o < c_.outputs.size(); ++o) {
      fmt::format_to(Out(out_), "  out.{} = mts::conclude(to_{}, kOutputs[{}], out.status);\n", names_.outputs[o], o, o);
    }
    out_ += "  return out;\n}\n\n";
  }

 private:
  void declare_output(std::size_t o) {
    switch (form_.outputs[o].combine) {
      case mts::FuzzyCombine::kWinner:
      case mts::FuzzyCombine::kAverageAbout:
        fmt::format_to(Out(out_), "  mts::FuzzyFired fired_{0}[{1}];\n  mts::FuzzyList to_{0}{{fired_{0}}};\n", o, form_.writers[o] + 1u);
        break;
      default: fmt::format_to(Out(out_), "  mts::FuzzySums to_{};\n", o); break;
    }
  }

  // ---- where degrees are computed: in the innermost nest that holds all who ask for them

  [[nodiscard]] std::uint32_t depth(std::uint32_t nest) const {
    std::uint32_t depth = 0;
    for (; nest != fuzzy::kNone; nest = c_.nests[nest].parent) ++depth;
    return depth;
  }
  [[nodiscard]] std::uint32_t common(std::uint32_t a, std::uint32_t b) const {
    while (a != b) {
      if (depth(a) < depth(b)) b = c_.nests[b].parent;
      else a = c_.nests[a].parent;
    }
    return a;
  }
  /// Recursion as deep as conditions nest.
  void ask(std::uint32_t id, std::uint32_t scope) {
    const Node& node = c_.nodes[id];
    if (node.op == Node::Op::kDegree) {
      scope_of_[node.degree] = asked_[node.degree] ? common(scope_of_[node.degree], scope) : scope;
      asked_[node.degree] = true;
      return;
    }
    ask(node.left, scope);
    if (node.op == Node::Op::kAnd || node.op == Node::Op::kOr) ask(node.right, scope);
  }
  void find_scopes() {
    scope_of_.assign(c_.degrees.size(), fuzzy::kNone);
    asked_.assign(c_.degrees.size(), false);
    for (const fuzzy::Nest& nest : c_.nests) ask(nest.condition, nest.parent);
    for (const fuzzy::Rule& rule : c_.rules) ask(rule.condition, rule.nest);
  }
  void emit_degrees(std::uint32_t scope) {
    const std::string indent(2 + 2 * depth(scope), ' ');
    for (std::size_t d = 0; d < c_.degrees.size(); ++d) {
      if (!asked_[d] || scope_of_[d] != scope) continue;
      fmt::format_to(Out(out_), "{}const float d{} = {};  // {} is {}\n", indent, d, degree(d), fuzzy::slot_name(c_, c_.degrees[d].slot),
                     c_.input_of(c_.degrees[d]).terms[c_.degrees[d].term].name);
    }
  }

  [[nodiscard]] std::string degree(std::size_t d) const {
    const std::uint16_t term = form_.term_of_degree[d], slot = form_.slot_of_degree[d];
    const mts::Membership& row = form_.terms[term];
    if (row.profile != mts::Profile::kLinear) return fmt::format("mts::mu(kTerms[{}], x{})", term, slot);
    if (row.high == mts::kInfinity) return fmt::format("mts::rising_mu(x{}, {}, {})", slot, float_constant(row.low), float_constant(row.rise));
    if (row.low == -mts::kInfinity) return fmt::format("mts::falling_mu(x{}, {}, {})", slot, float_constant(row.high), float_constant(row.fall));
    if (!(row.period > 0.0f)) return fmt::format("mts::linear_mu(kTerms[{}], x{})", term, slot);
    return fmt::format("mts::linear_mu(kTerms[{}], mts::shortest_difference(x{}, {}, {}))", term, slot, float_constant(row.centre),
                       float_constant(row.period));
  }

  // ---- conditions, values, steps

  [[nodiscard]] std::string both(const std::string& a, const std::string& b) const {
    return form_.product ? fmt::format("({} * {})", a, b) : fmt::format("mts::least({}, {})", a, b);
  }
  /// Recursion as deep as conditions nest.
  [[nodiscard]] std::string condition(std::uint32_t id) const {
    const Node& node = c_.nodes[id];
    switch (node.op) {
      case Node::Op::kDegree: return fmt::format("d{}", node.degree);
      case Node::Op::kAnd: return both(condition(node.left), condition(node.right));
      case Node::Op::kOr: return fmt::format("{}({}, {})", form_.sum ? "mts::fuzzy_sum" : "mts::greatest", condition(node.left), condition(node.right));
      case Node::Op::kNot: return fmt::format("(1.0f - {})", condition(node.left));
      case Node::Op::kVery: return fmt::format("mts::very({})", condition(node.left));
      case Node::Op::kSomewhat: return fmt::format("mts::square_root({})", condition(node.left));
    }
    return {};
  }
  [[nodiscard]] std::string value(const mts::FuzzyConsequent& consequent) const {
    std::string sum = float_constant(consequent.constant);
    for (std::size_t p = consequent.first_part; p < consequent.end_part; ++p) {
      const std::string part = fmt::format("{} * x{}", float_constant(form_.parts[p].coefficient), form_.parts[p].slot);
      sum = p == consequent.first_part ? fmt::format("{} + {}", sum, part) : fmt::format("({}) + {}", sum, part);
    }
    const mts::FuzzyOutput& output = form_.outputs[consequent.output];
    if (!(output.period > 0.0f)) return sum;
    return fmt::format("mts::wrapped({}, {}, {})", sum, float_constant(output.low), float_constant(output.period));
  }
  void emit_steps() {
    std::vector<std::size_t> ends;   // of the nests that are open
    for (std::size_t i = 0; i < form_.steps.size(); ++i) {
      while (!ends.empty() && ends.back() == i) close(ends);
      const mts::FuzzyStep& step = form_.steps[i];
      const bool given = step.skip != 0;
      const std::string indent(2 + 2 * ends.size(), ' ');
      std::string holds = condition(given ? c_.nests[form_.origins[i]].condition : c_.rules[form_.origins[i]].condition);
      if (step.depth > 0) holds = both(fmt::format("given_{}", step.depth - 1), holds);
      if (given) {
        fmt::format_to(Out(out_), "{}if (const float given_{} = {}; given_{} > 0.0f) {{\n", indent, step.depth, holds, step.depth);
        ends.push_back(step.skip);
        emit_degrees(form_.origins[i]);
        continue;
      }
      emit_rule(step, holds, indent, form_.origins[i]);
    }
    while (!ends.empty()) close(ends);
  }
  void close(std::vector<std::size_t>& ends) {
    ends.pop_back();
    out_ += std::string(2 + 2 * ends.size(), ' ') + "}\n";
  }
  void emit_rule(const mts::FuzzyStep& step, const std::string& holds, const std::string& indent, std::uint32_t rule) {
    const std::string weight = step.weight == 1.0f ? "" : " * " + float_constant(step.weight);
    fmt::format_to(Out(out_), "{0}// {1}\n{0}{{\n{0}  const float s = {2}{3};\n", indent, fuzzy::text(c_, c_.rules[rule]), holds, weight);
    for (std::size_t k = step.first_consequent; k < step.end_consequent; ++k) {
      fmt::format_to(Out(out_), "{}  to_{}.add(s, {});\n", indent, form_.consequents[k].output, value(form_.consequents[k]));
    }
    fmt::format_to(Out(out_), "{}}}\n", indent);
  }

  const fuzzy::Controller& c_;
  const tables::FuzzyForm& form_;
  const FuzzyNames& names_;
  std::string& out_;
  std::vector<std::uint32_t> scope_of_;   // by degree: a nest
  std::vector<bool> asked_;
};

}  // namespace

void emit_table_walk(const fuzzy::Controller& c, const tables::FuzzyForm& form, const FuzzyNames& names, std::string& out) {
  fmt::format_to(Out(out), "{0}::Outputs {0}::evaluate_tables(const Inputs& in) noexcept {{\n", names.type);
  fmt::format_to(Out(out), "  float x[{}] = {{", c.slots);
  for (std::uint32_t s = 0; s < c.slots; ++s) out += (s == 0 ? "" : ", ") + slot_expression(c, names, s);
  fmt::format_to(Out(out), "}};\n  float y[{0}];\n  mts::FuzzyScratch<{1}, {0}, {2}> room;\n", c.outputs.size(), form.slot_of_degree.size(), form.fired);
  fmt::format_to(Out(out), "  Outputs out;\n  out.status = mts::evaluate(fuzzy_{}::kTables, x, y, room);\n", names.type);
  for (std::size_t o = 0; o < c.outputs.size(); ++o) fmt::format_to(Out(out), "  out.{} = y[{}];\n", names.outputs[o], o);
  out += "  return out;\n}\n\n";
}

void emit_straight_code(const fuzzy::Controller& c, const tables::FuzzyForm& form, const FuzzyNames& names, std::string& out) {
  if (form.code.size() + form.parts.size() + form.consequents.size() <= kMostCode) return StraightCode(c, form, names, out).run();
  fmt::format_to(Out(out), "{0}::Outputs {0}::evaluate(const Inputs& in) noexcept {{ return evaluate_tables(in); }}\n\n", names.type);
}

}  // namespace kb::emit
