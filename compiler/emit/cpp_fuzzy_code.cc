// The rules of a fuzzy controller as straight C++. It has the same operations in the same order as mts::evaluate on the tables, and so the
// same bits, but no loop over rules; constants are written in place, and what several rules ask is computed once. See
// note [why straight code is quick].
#include <fmt/format.h>

#include <iterator>
#include <vector>

#include "compiler/emit/cpp.h"
#include "compiler/emit/cpp_fuzzy.h"
#include "compiler/emit/cpp_fuzzy_rules.h"
#include "compiler/tables/fuzzy_fold.h"

namespace kb::emit {
namespace {

using Out = std::back_insert_iterator<std::string>;
using fuzzy::Node;

/// With more code than this the tables are walked instead, because straight code would no longer fit into a cache.
constexpr std::size_t kMostCode = 8'000;

class StraightCode {
 public:
  StraightCode(const fuzzy::Controller& c, const tables::FuzzyForm& form, const tables::FuzzyLayout& layout, const FuzzyNames& names, std::string& out)
      : c_(c), form_(form), layout_(layout), fold_(layout.fold), names_(names), joint_{form.product}, out_(out) {}

  void run() {
    find_scopes();
    fmt::format_to(Out(out_), "{0}::Outputs {0}::evaluate(const Inputs& in) noexcept {{\n  using namespace fuzzy_{0};\n  Outputs out;\n", names_.type);
    emit_inputs();
    declare_outputs();
    emit_groups();
    emit_degrees(fuzzy::kNone);
    emit_steps();
    std::size_t voice = 0;
    for (std::size_t o = 0; o < c_.outputs.size(); ++o) {
      const std::string from = layout_.listed[o] ? fmt::format("mts::FuzzyVoices<{}>{{firings, kSaid + {}}}", layout_.voices(), voice++) : fmt::format("to_{}", o);
      fmt::format_to(Out(out_), "  out.{} = mts::conclude({}, kOutputs[{}], out.status);\n", names_.outputs[o], from, o);
    }
    out_ += "  return out;\n}\n\n";
  }

 private:
  // ---- inputs

  [[nodiscard]] bool in_lanes(const fuzzy::Input& input) const { return layout_.place_of_degree[input.first_degree] != fuzzy::kNone; }
  [[nodiscard]] std::string x(std::uint32_t slot) const {
    const fuzzy::Input& input = c_.inputs[fuzzy::input_of_slot(c_, slot)];
    return in_lanes(input) ? fmt::format("x{}[{}]", input.first_slot, slot - input.first_slot) : fmt::format("x{}", slot);
  }
  [[nodiscard]] std::string range(const mts::FuzzyInput& input) const {
    return fmt::format("{}, {}", float_constant(input.low), float_constant(input.period > 0.0f ? input.period : input.high));
  }
  void emit_inputs() {
    for (const fuzzy::Input& input : c_.inputs) {
      std::string values;
      for (std::uint32_t e = 0; e < input.count; ++e) {
        const std::string value = slot_expression(c_, names_, input.first_slot + e);
        if (!in_lanes(input)) fmt::format_to(Out(out_), "  float x{} = {};\n", input.first_slot + e, value);
        else values += (e == 0 ? "" : ", ") + value;
      }
      if (in_lanes(input)) fmt::format_to(Out(out_), "  float x{}[{}] = {{{}}};\n", input.first_slot, input.count, values);
    }
    out_ += "  bool inside = true;\n";
    std::string take;
    for (std::uint32_t s = 0; s < c_.slots; ++s) {
      const mts::FuzzyInput& input = form_.inputs[s];
      const fuzzy::Input& of = c_.inputs[fuzzy::input_of_slot(c_, s)];
      fmt::format_to(Out(take), "    good = mts::take({}, kInputs[{}], outside) && good;\n", x(s), s);
      if (in_lanes(of) && input.period == 0.0f) {
        if (s == of.first_slot) fmt::format_to(Out(out_), "  inside &= mts::all_lie_on_line<{}>(x{}, {});\n", of.count, s, range(input));
      } else {
        fmt::format_to(Out(out_), "  inside &= mts::lies_on_{}({}, {});\n", input.period > 0.0f ? "circle" : "line", x(s), range(input));
      }
    }
    fmt::format_to(Out(out_),
                   "  if (!inside) [[unlikely]] {{\n    bool good = true, outside = false;\n{}    if (!good) {{\n      Outputs none;\n"
                   "      none.status = mts::FuzzyStatus::kBadInput;\n      return none;\n    }}\n"
                   "    if (outside) mts::raise(out.status, mts::FuzzyStatus::kInputClamped);\n  }}\n",
                   take);
  }

  void declare_outputs() {
    if (layout_.voices() != 0) {
      fmt::format_to(Out(out_), "  mts::FuzzyFiring fired[{}];\n  mts::FuzzyFirings firings{{fired}};\n", c_.rules.size() + 1);
    }
    for (std::size_t o = 0; o < c_.outputs.size(); ++o) {
      if (layout_.listed[o]) continue;
      switch (form_.outputs[o].combine) {
        case mts::FuzzyCombine::kWinner:
        case mts::FuzzyCombine::kAverageAbout:
          fmt::format_to(Out(out_), "  mts::FuzzyFired fired_{0}[{1}];\n  mts::FuzzyList to_{0}{{fired_{0}}};\n", o, form_.writers[o] + 1u);
          break;
        default: fmt::format_to(Out(out_), "  mts::FuzzySums to_{};\n", o); break;
      }
    }
  }

  // ---- where degrees are computed: those of groups at once, others in the innermost nest that holds all who ask for them

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
  [[nodiscard]] bool folded(std::uint32_t nest) const { return nest != fuzzy::kNone && nest >= fold_.first_nest && nest < fold_.end_nest; }
  void find_scopes() {
    scope_of_.assign(c_.degrees.size(), fuzzy::kNone);
    asked_.assign(c_.degrees.size(), false);
    for (std::uint32_t n = 0; n < c_.nests.size(); ++n) {
      if (!folded(n)) ask(c_.nests[n].condition, c_.nests[n].parent);
    }
    for (const fuzzy::Rule& rule : c_.rules) {
      if (!folded(rule.nest)) ask(rule.condition, rule.nest);
    }
  }
  void emit_groups() {
    if (layout_.places == 0) return;
    fmt::format_to(Out(out_), "  float group[{}];\n", layout_.places);
    for (const fuzzy::Input& input : c_.inputs) {
      for (std::uint32_t t = 0; in_lanes(input) && t < input.terms.size(); ++t) {
        const std::uint32_t degree = input.first_degree + t;
        const mts::Membership& row = form_.terms[form_.term_of_degree[degree]];
        const bool line = row.profile == mts::Profile::kLinear && !(row.period > 0.0f);
        std::string call = fmt::format("group_mu<{}>(x{}, kTerms[{}]", input.count, input.first_slot, form_.term_of_degree[degree]);
        if (line && row.high == mts::kInfinity) {
          call = fmt::format("rising_group<{}>(x{}, {}, {}", input.count, input.first_slot, float_constant(row.low), float_constant(row.rise));
        } else if (line && row.low == -mts::kInfinity) {
          call = fmt::format("falling_group<{}>(x{}, {}, {}", input.count, input.first_slot, float_constant(row.high), float_constant(row.fall));
        }
        fmt::format_to(Out(out_), "  mts::{}, group + {});  // {} is {}\n", call, layout_.place_of_degree[degree], input.name, input.terms[t].name);
      }
    }
  }
  void emit_degrees(std::uint32_t scope) {
    const std::string indent(2 + 2 * depth(scope), ' ');
    for (std::size_t d = 0; d < c_.degrees.size(); ++d) {
      if (!asked_[d] || scope_of_[d] != scope || layout_.place_of_degree[d] != fuzzy::kNone) continue;
      fmt::format_to(Out(out_), "{}const float d{} = {};  // {} is {}\n", indent, d, degree(d), fuzzy::slot_name(c_, c_.degrees[d].slot),
                     c_.input_of(c_.degrees[d]).terms[c_.degrees[d].term].name);
    }
  }
  [[nodiscard]] std::string degree(std::size_t d) const {
    const std::uint16_t term = form_.term_of_degree[d];
    const std::string value = x(form_.slot_of_degree[d]);
    const mts::Membership& row = form_.terms[term];
    if (row.profile != mts::Profile::kLinear) return fmt::format("mts::mu(kTerms[{}], {})", term, value);
    if (row.high == mts::kInfinity) return fmt::format("mts::rising_mu({}, {}, {})", value, float_constant(row.low), float_constant(row.rise));
    if (row.low == -mts::kInfinity) return fmt::format("mts::falling_mu({}, {}, {})", value, float_constant(row.high), float_constant(row.fall));
    if (!(row.period > 0.0f)) return fmt::format("mts::linear_mu(kTerms[{}], {})", term, value);
    return fmt::format("mts::linear_mu(kTerms[{}], mts::shortest_difference({}, {}, {}))", term, value, float_constant(row.centre),
                       float_constant(row.period));
  }

  // ---- conditions, values

  /// How a degree is written: a variable, an element of a group's array, or (in the loop over rows) a word of the row.
  [[nodiscard]] std::string leaf(std::uint32_t degree) {
    if (in_fold_) {
      const std::uint32_t column = fold_.column_of_leaf[next_leaf_++];
      return fold_.columns[column].of_group ? fmt::format("group[row.words[{}]]", column) : fmt::format("w{}", column);
    }
    const std::uint32_t place = layout_.place_of_degree[degree];
    return place != fuzzy::kNone ? fmt::format("group[{}]", place) : fmt::format("d{}", degree);
  }
  /// Recursion as deep as conditions nest.
  [[nodiscard]] std::string condition(std::uint32_t id) {
    const Node& node = c_.nodes[id];
    if (node.op == Node::Op::kDegree) return leaf(node.degree);
    const std::string left = condition(node.left);   // first the left one: words of a row are taken in order
    const bool two = node.op == Node::Op::kAnd || node.op == Node::Op::kOr;
    const std::string right = two ? condition(node.right) : "";
    switch (node.op) {
      case Node::Op::kAnd: return joint_.both(left, right);
      case Node::Op::kOr: return fmt::format("{}({}, {})", form_.sum ? "mts::fuzzy_sum" : "mts::greatest", left, right);
      case Node::Op::kNot: return fmt::format("(1.0f - {})", left);
      case Node::Op::kVery: return fmt::format("mts::very({})", left);
      case Node::Op::kSomewhat: return fmt::format("mts::square_root({})", left);
      case Node::Op::kDegree: break;
    }
    return {};
  }
  void split(std::uint32_t id, std::vector<std::string>& factors) {
    const Node& node = c_.nodes[id];
    if (node.op != Node::Op::kAnd) {
      factors.push_back(condition(id));
      return;
    }
    split(node.left, factors);
    factors.push_back(condition(node.right));
  }
  [[nodiscard]] std::string value(const mts::FuzzyConsequent& consequent) const {
    std::string sum = float_constant(consequent.constant);
    for (std::size_t p = consequent.first_part; p < consequent.end_part; ++p) {
      const std::string part = fmt::format("{} * {}", float_constant(form_.parts[p].coefficient), x(form_.parts[p].slot));
      sum = p == consequent.first_part ? fmt::format("{} + {}", sum, part) : fmt::format("({}) + {}", sum, part);
    }
    const mts::FuzzyOutput& output = form_.outputs[consequent.output];
    if (!(output.period > 0.0f)) return sum;
    return fmt::format("mts::wrapped({}, {}, {})", sum, float_constant(output.low), float_constant(output.period));
  }
  [[nodiscard]] StraightRule rule(const mts::FuzzyStep& step, std::uint32_t id) {
    StraightRule rule;
    split(c_.rules[id].condition, rule.factors);
    if (step.weight != 1.0f) rule.weight = " * " + float_constant(step.weight);
    rule.comment = fuzzy::text(c_, c_.rules[id]);
    for (std::size_t k = step.first_consequent; k < step.end_consequent; ++k) {
      const mts::FuzzyConsequent& consequent = form_.consequents[k];
      if (layout_.listed[consequent.output]) rule.number = std::to_string(id);
      else rule.statements.push_back(fmt::format("to_{}.add(s, {});", consequent.output, value(consequent)));
    }
    return rule;
  }

  // ---- steps

  void emit_steps() {
    std::vector<std::size_t> ends;   // the ends of the open nests
    std::vector<StraightRule> rules;
    const auto flush = [&] {
      emit_rules(std::move(rules), ends.empty() ? "" : fmt::format("given_{}", ends.size() - 1), joint_, 1 + ends.size(), out_);
      rules.clear();
    };
    for (std::size_t i = 0; i < form_.steps.size();) {
      while (!ends.empty() && ends.back() == i) {
        flush();
        close(ends);
      }
      const mts::FuzzyStep& step = form_.steps[i];
      if (step.skip == 0) {
        rules.push_back(rule(step, form_.origins[i++]));
        continue;
      }
      flush();
      if (folded(form_.origins[i])) {
        i = emit_fold(i);
        continue;
      }
      std::string holds = condition(c_.nests[form_.origins[i]].condition);
      if (step.depth > 0) holds = joint_.both(fmt::format("given_{}", step.depth - 1), holds);
      fmt::format_to(Out(out_), "{}if (const float given_{} = {}; given_{} > 0.0f) {{\n", std::string(2 + 2 * ends.size(), ' '), step.depth, holds, step.depth);
      ends.push_back(step.skip);
      emit_degrees(form_.origins[i++]);
    }
    flush();
    while (!ends.empty()) close(ends);
  }
  void close(std::vector<std::size_t>& ends) {
    ends.pop_back();
    out_ += std::string(2 + 2 * ends.size(), ' ') + "}\n";
  }

  /// Writes the loop over rows for the folded nests, of which the first begins at step i. Returns the step after the last one.
  std::size_t emit_fold(std::size_t i) {
    const fuzzy::Nest& nest = c_.nests[fold_.first_nest];
    in_fold_ = true;
    next_leaf_ = 0;
    fmt::format_to(Out(out_), "  // {} nests that differ in their words only; written out is the first\n", fold_.rows.size());
    if (fold_.cells != 0) {
      fmt::format_to(Out(out_),
                     "  for (auto rows = kRowsInCell[mts::cell_of({}, {}, {}, {})]; rows != 0; rows &= rows - 1) {{\n"
                     "    const Row& row = kRows[std::countr_zero(rows)];\n",
                     x(fold_.slot), float_constant(form_.inputs[fold_.slot].low), float_constant(fold_.per_cell), fold_.cells);
    } else {
      out_ += "  for (const Row& row : kRows) {\n";
    }
    for (std::size_t column = 0; column < fold_.columns.size(); ++column) emit_word(column);
    fmt::format_to(Out(out_), "    const float given_0 = {};\n", condition(nest.condition));
    if (fold_.cells == 0) out_ += "    if (!(given_0 > 0.0f)) continue;\n";
    std::vector<StraightRule> rules;
    for (std::uint32_t r = nest.first_rule; r < nest.end_rule; ++r) {
      rules.push_back(rule(form_.steps[++i], r));
      rules.back().number = r == nest.first_rule ? "row.rule" : fmt::format("row.rule + {}", r - nest.first_rule);
    }
    emit_rules(std::move(rules), "given_0", joint_, 2, out_);
    out_ += "  }\n";
    in_fold_ = false;
    while (i < form_.steps.size() && !(form_.steps[i].skip == 0 && form_.origins[i] + 1 == c_.nests[fold_.end_nest - 1].end_rule)) ++i;
    return i + 1;
  }
  void emit_word(std::size_t column) {
    if (fold_.columns[column].of_group) return;
    const std::uint32_t slot = fold_.columns[column].slot;
    const std::string term = fmt::format("kTerms[row.words[{}]]", column);
    const float period = form_.inputs[slot].period;
    const std::string d = period > 0.0f ? fmt::format("mts::shortest_difference({}, {}.centre, {})", x(slot), term, float_constant(period)) : x(slot);
    fmt::format_to(Out(out_), "    const float w{} = mts::linear_mu({}, {});\n", column, term, d);
  }

  const fuzzy::Controller& c_;
  const tables::FuzzyForm& form_;
  const tables::FuzzyLayout& layout_;
  const tables::FuzzyFold& fold_;
  const FuzzyNames& names_;
  Joint joint_;
  std::string& out_;
  std::vector<std::uint32_t> scope_of_;   // by degree: a nest
  std::vector<bool> asked_;
  bool in_fold_ = false;                  // words are taken from a row
  std::size_t next_leaf_ = 0;
};

// ---- the constants of straight code

void emit_said(const fuzzy::Controller& c, const tables::FuzzyForm& form, const tables::FuzzyLayout& layout, std::string& out) {
  if (layout.voices() == 0) return;
  out += "// What each rule says of each output that is read from the list of rules.\nconstexpr mts::FuzzySaid kSaid[] = {\n";
  for (std::size_t s = 0; s < form.steps.size(); ++s) {
    if (form.steps[s].skip != 0) continue;
    std::string row;
    for (std::size_t o = 0; o < form.outputs.size(); ++o) {
      if (!layout.listed[o]) continue;
      std::string said = "{0.0f, 0u}";
      for (std::size_t k = form.steps[s].first_consequent; k < form.steps[s].end_consequent; ++k) {
        if (form.consequents[k].output != o) continue;
        const mts::FuzzyOutput& output = form.outputs[o];
        const float constant = form.consequents[k].constant;
        said = fmt::format("{{{}, ~0u}}", float_constant(output.period > 0.0f ? mts::wrapped(constant, output.low, output.period) : constant));
      }
      row += said + ", ";
    }
    fmt::format_to(Out(out), "    {}// {}\n", row, fuzzy::text(c, c.rules[form.origins[s]]));
  }
  out += "};\n";
}

void emit_rows(const fuzzy::Controller& c, const tables::FuzzyFold& fold, std::string& out) {
  if (fold.rows.empty()) return;
  fmt::format_to(Out(out), "struct Row {{\n  std::uint16_t rule, words[{}];\n}};\nconstexpr Row kRows[] = {{\n", fold.columns.size());
  for (std::uint32_t r = 0; r < fold.rows.size(); ++r) {
    const fuzzy::Nest& nest = c.nests[fold.first_nest + r];
    fmt::format_to(Out(out), "    {{{}, {{{}}}}},  // given {}\n", nest.first_rule, fmt::join(fold.rows[r], ", "), fuzzy::text(c, nest.condition));
  }
  out += "};\n";
  if (fold.cells == 0) return;
  fmt::format_to(Out(out), "// A bit for each row that can hold in this cell of {}.\nconstexpr std::uint{}_t kRowsInCell[] = {{\n", fuzzy::slot_name(c, fold.slot),
                 fold.rows.size() > 32 ? 64 : 32);
  for (std::size_t cell = 0; cell < fold.rows_in_cell.size(); ++cell) {
    fmt::format_to(Out(out), "{}{:#x},{}", cell % 8 == 0 ? "    " : " ", fold.rows_in_cell[cell], cell % 8 == 7 || cell + 1 == fold.rows_in_cell.size() ? "\n" : "");
  }
  out += "};\n";
}

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
  if (form.code.size() + form.parts.size() + form.consequents.size() > kMostCode) {
    fmt::format_to(Out(out), "{0}::Outputs {0}::evaluate(const Inputs& in) noexcept {{ return evaluate_tables(in); }}\n\n", names.type);
    return;
  }
  const tables::FuzzyLayout layout = tables::lay_out(c, form);
  fmt::format_to(Out(out), "namespace {{\nnamespace fuzzy_{} {{\n\n", names.type);
  emit_said(c, form, layout, out);
  emit_rows(c, layout.fold, out);
  fmt::format_to(Out(out), "\n}}  // namespace fuzzy_{}\n}}  // namespace\n\n", names.type);
  StraightCode(c, form, layout, names, out).run();
}

}  // namespace kb::emit
