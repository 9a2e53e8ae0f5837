#include <fmt/format.h>

#include "compiler/syntax/tree_text.h"

namespace kb::syntax {
namespace {

std::string arguments_text(const Tree& tree, const std::vector<Index>& arguments) {
  std::string out;
  for (const Index& index : arguments) {
    if (!out.empty()) out += ", ";
    out += index.star ? "*" : index.number ? fmt::format("{}", *index.number) : ref_text(tree, index.ref);
  }
  return out;
}

}  // namespace

std::string ref_text(const Tree& tree, RefId id) {
  const Ref& ref = tree[id];
  std::string out(ref.base.text);
  for (const Postfix& postfix : ref.postfixes) {
    switch (postfix.kind) {
      case Postfix::Kind::kField: out += fmt::format(".{}", postfix.field.text); break;
      case Postfix::Kind::kIndex: out += fmt::format("[{}]", arguments_text(tree, postfix.arguments)); break;
      case Postfix::Kind::kCall: out += fmt::format("({})", arguments_text(tree, postfix.arguments)); break;
    }
  }
  return out;
}

std::string number_text(const Number& number) {
  return fmt::format("{}{}{}", number.value, number.unit.text.empty() ? "" : " ", number.unit.text);
}

// Recursion is bounded by kMaxNesting.
std::string percept_text(const Tree& tree, PerceptId id, bool inside) {
  const Percept& percept = tree[id];
  std::string out;
  switch (percept.kind) {
    case Percept::Kind::kOr:
    case Percept::Kind::kAnd:
      for (const PerceptId child : percept.children) {
        if (!out.empty()) out += percept.kind == Percept::Kind::kOr ? " or " : " and ";
        out += percept_text(tree, child, true);
      }
      return inside ? "(" + out + ")" : out;
    case Percept::Kind::kNot: return "not " + percept_text(tree, percept.children.front(), true);
    case Percept::Kind::kFact: return ref_text(tree, percept.ref);
    case Percept::Kind::kFits: return fmt::format("{} ~ {}", ref_text(tree, percept.ref), shape_text(tree[percept.shape]));
    case Percept::Kind::kFitsNamed: return fmt::format("{} ~ {}", ref_text(tree, percept.ref), percept.word.text);
    case Percept::Kind::kReads: return fmt::format("{} ~ \"{}\"", ref_text(tree, percept.ref), percept.word.text);
    case Percept::Kind::kError: break;
  }
  return "error";
}

namespace {

std::string fuzzy_ref_text(const FuzzyRef& ref) {
  return ref.element ? fmt::format("{}[{}]", ref.name.text, number_text(*ref.element)) : std::string(ref.name.text);
}

std::string part_text(const Fuzzy::Part& part, bool first) {
  std::string out = part.negative ? (first ? "-" : " - ") : (first ? "" : " + ");
  if (part.number) out += number_text(*part.number);
  if (part.number && part.ref) out += "*";
  if (part.ref) out += fuzzy_ref_text(*part.ref);
  return out;
}

}  // namespace

std::string fuzzy_text(const Fuzzy& fuzzy, std::uint32_t condition) {
  const FuzzyCond& cond = fuzzy.conds[condition];
  switch (cond.kind) {
    case FuzzyCond::Kind::kAnd: return fmt::format("({} and {})", fuzzy_text(fuzzy, cond.left), fuzzy_text(fuzzy, cond.right));
    case FuzzyCond::Kind::kOr: return fmt::format("({} or {})", fuzzy_text(fuzzy, cond.left), fuzzy_text(fuzzy, cond.right));
    case FuzzyCond::Kind::kNot: return fmt::format("not {}", fuzzy_text(fuzzy, cond.left));
    case FuzzyCond::Kind::kIs: break;
  }
  std::string words;
  for (const Name& word : cond.words) words += fmt::format(" {}", word.text);
  return fmt::format("{} is{}", fuzzy_ref_text(cond.ref), words);
}

std::string fuzzy_text(const Fuzzy& fuzzy, const Fuzzy::Rule& rule) {
  std::string out = fuzzy_text(fuzzy, rule.condition) + " ->";
  for (const Fuzzy::Consequent& consequent : rule.consequents) {
    out += fmt::format("{} {} = ", &consequent == &rule.consequents.front() ? "" : ",", consequent.output.text);
    for (const Fuzzy::Part& part : consequent.sum) out += part_text(part, &part == &consequent.sum.front());
  }
  if (rule.weight) out += fmt::format(" weight {}", number_text(*rule.weight));
  return out;
}

std::string shape_text(const Shape& shape) {
  std::string out;
  for (const Shape::Argument& argument : shape.arguments) {
    if (!out.empty()) out += ", ";
    if (argument.label) out += fmt::format("{} ", argument.label->text);
    out += argument.number ? number_text(*argument.number) : std::string(argument.word.text);
    if (argument.to) out += ".." + number_text(*argument.to);
  }
  return fmt::format("{}({})", shape.name.text, out);
}

}  // namespace kb::syntax
