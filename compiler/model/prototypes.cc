// Prototypes: fuzzy numbers with a name.
#include "compiler/model/draft.h"
#include "compiler/model/shapes.h"

namespace kb::model {

void declare_prototypes(Draft& draft) {
  draft.each<syntax::Prototype>([&](const syntax::Tree& tree, const auto&, const syntax::Prototype& from) {
    const bool sound = check_shape(tree[from.shape], draft.diagnostics);
    if (!draft.declare(from.name, Entity::Kind::kPrototype, draft.model.prototypes.size(), sound)) return;
    draft.model.prototypes.push_back({std::string(from.name.text), &tree, from.shape, from.name.span});
  });
}

}  // namespace kb::model
