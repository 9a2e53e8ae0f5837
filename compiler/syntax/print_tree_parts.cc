#include <fmt/format.h>

#include "compiler/syntax/tree_text.h"

namespace kb::syntax {
namespace {

std::string arguments_text(const Tree& tree, const std::vector<Index>& arguments) {
  std::string out;
  for (const Index& index : arguments) {
    if (!out.empty()) out += ", ";
    out += index.star ? "*" : ref_text(tree, index.ref);
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

}  // namespace kb::syntax
