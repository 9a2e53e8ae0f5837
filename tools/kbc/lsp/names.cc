#include "tools/kbc/lsp/names.h"

#include <algorithm>

namespace kb::lsp {
namespace {

using Space = Meaning::Space;

std::optional<Symbol> named(const Knowledge& knowledge, std::string_view name, Space space) {
  for (auto at = std::ranges::lower_bound(knowledge.names, name, {}, &model::KnownName::name); at != knowledge.names.end() && at->name == name; ++at) {
    // A control line is about a strategy, which has a symbol of its own.
    if (at->kind != "control" && space_of(at->kind) == space) return Symbol{at->kind, at->more};
  }
  return std::nullopt;
}

}  // namespace

std::optional<Symbol> symbol(const Knowledge& knowledge, const Use& use) {
  const model::Model& model = knowledge.compiled->model;
  switch (use.meaning.space) {
    case Space::kName:
    case Space::kLevel:
    case Space::kRule: return named(knowledge, knowledge.compiled->sources.text(use.span), use.meaning.space);
    case Space::kMember: return Symbol{"member", "of " + model.sets[use.meaning.owner].name};
    case Space::kField: return Symbol{"field", "of " + model.relations[use.meaning.owner].name};
    case Space::kVariable: return Symbol{"variable", {}};
    case Space::kInput: return Symbol{"input", {}};
    case Space::kOutput: return Symbol{"output", {}};
    case Space::kTerm: return Symbol{"term", {}};
    case Space::kController: return Symbol{"controller", {}};
    case Space::kArgument: return Symbol{"argument", {}};
  }
  return std::nullopt;
}

}  // namespace kb::lsp
