// Prototypes: fuzzy numbers with a name.
#include "compiler/model/draft.h"
#include "compiler/model/shapes.h"

namespace kb::model {

void declare_prototypes(Draft& draft) {
  draft.each<syntax::Prototype>([&](const syntax::Tree& tree, const auto&, const syntax::Prototype& from) {
    const bool sound = check_shape(tree[from.shape], draft.diagnostics);
    const auto id = static_cast<std::uint32_t>(draft.model.prototypes.size());
    const Entity entity{sound ? Entity::Kind::kPrototype : Entity::Kind::kBroken, id, {}};
    if (!draft.names.declare(from.name, entity, draft.diagnostics) || !sound) return;
    draft.model.prototypes.push_back({std::string(from.name.text), &tree, from.shape, from.name.span});
  });
}

}  // namespace kb::model
