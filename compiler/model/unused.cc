// Declarations besides cells that nothing names: tables, finite sets, relations with their rows, prototypes, fuzzy controllers.
//
// A map is not among them: its landmarks are facts that programs and the simulator know, whether a route goes there or not.
#include <algorithm>
#include <array>
#include <string_view>
#include <unordered_set>
#include <vector>

#include "compiler/model/draft.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

/// The compiler writes rows of these and looks at them, whoever else does.
constexpr std::array<std::string_view, 9> kRelationsOfRoutes{"Command", "Landmark", "Road", "Route", "Leg", "Detour", "Retreat", "Rejoin", "Recheck"};

/// The names that a knowledge base uses. A variable that is called as a declaration counts as a use of that.
class Uses {
 public:
  explicit Uses(const Draft& draft) : draft_(draft) {
    for (const syntax::Tree& tree : draft.forest.trees) read(tree);
    for (const SetId set : {draft.exits, draft.methods}) {
      if (set != SetId::kNone) names_.insert(draft.model.sets[index(set)].name);
    }
  }

  [[nodiscard]] bool contain(std::string_view name) const { return names_.contains(name); }
  /// Whether a `control` line hands a member of the set to its controller.
  [[nodiscard]] bool contain_word_of(const SetIndex& set) const {
    return std::ranges::any_of(words_, [&](std::string_view word) { return set.members.contains(word); });
  }

 private:
  struct RowText { source::Span span; std::string_view relation; };

  void read(const syntax::Tree& tree) {
    std::vector<RowText> rows;
    for (const syntax::Statement& statement : tree.statements) {
      std::visit([&](const auto& node) { read_names(node); }, statement.node);
      if (const auto* row = std::get_if<syntax::Row>(&statement.node)) rows.push_back({statement.span, row->relation.text});
    }
    for (const syntax::Percept& percept : tree.percepts) {
      if (percept.kind == syntax::Percept::Kind::kFitsNamed) names_.insert(percept.word.text);
    }
    for (const syntax::Ref& ref : tree.refs) read_reference(ref, rows);
  }

  void read_names(const auto&) {}
  void read_names(const syntax::Rule& rule) { read_ranges(rule.binders); }
  void read_names(const syntax::Perceive& perceive) { read_ranges(perceive.binders); }
  void read_names(const syntax::Declaration& declaration) {
    for (const syntax::Declaration::Item& item : declaration.items) {
      if (item.shape != syntax::Declaration::Item::Shape::kOver) continue;
      for (const syntax::Name& set : item.names) names_.insert(set.text);
    }
  }
  void read_names(const syntax::Table& table) {
    for (const syntax::Name& parameter : table.parameters) names_.insert(parameter.text);
    names_.insert(table.result.text);
  }
  void read_names(const syntax::Control& control) {
    names_.insert(control.controller.text);
    for (const syntax::Control::Argument& argument : control.arguments) {
      if (!argument.number) words_.insert(argument.word.text);
    }
  }
  void read_ranges(const std::vector<syntax::Rule::Binder>& binders) {
    for (const syntax::Rule::Binder& binder : binders) names_.insert(binder.set.text);
  }

  void read_reference(const syntax::Ref& ref, const std::vector<RowText>& rows) {
    const std::string_view name = ref.base.text;
    const Entity* entity = draft_.names.find(name);
    if (entity == nullptr) {   // a member, as the value of a field
      const auto set = draft_.set_with.find(name);
      if (set != draft_.set_with.end()) names_.insert(draft_.model.sets[index(set->second)].name);
    } else if (entity->kind == Entity::Kind::kRow) {
      const std::string_view relation = draft_.model[draft_.model[RowId{entity->id}].relation].name;
      if (relation != row_around(ref.span, rows)) names_.insert(relation);   // rows that only name one another are used by nobody
    } else {
      names_.insert(name);
    }
  }
  /// The relation of the row in whose text the place is.
  [[nodiscard]] static std::string_view row_around(source::Span place, const std::vector<RowText>& rows) {
    const auto after = std::ranges::upper_bound(rows, place.begin, {}, [](const RowText& row) { return row.span.begin; });
    return after == rows.begin() || std::prev(after)->span.end < place.end ? std::string_view() : std::prev(after)->relation;
  }

  const Draft& draft_;
  std::unordered_set<std::string_view> names_, words_;   // looked up, never told in their order
};

/// What the declaration is called in messages; empty if it may be used where no text names it, or has cells, which are reported.
std::string_view word_for(const Draft& draft, const Entity& entity) {
  switch (entity.kind) {
    case Entity::Kind::kSet: return "set";
    case Entity::Kind::kTable: return "table";
    case Entity::Kind::kPrototype: return "prototype";
    case Entity::Kind::kRelation: {
      const Relation& relation = draft.model.relations[entity.id];
      const bool known = std::ranges::find(kRelationsOfRoutes, relation.name) != kRelationsOfRoutes.end();
      return known || (relation.satellites && !relation.rows.empty()) ? "" : "relation";
    }
    // Without strategies a program takes the controller alone.
    case Entity::Kind::kFuzzy: return draft.model.priority.empty() ? "" : "fuzzy controller";
    default: return "";
  }
}

}  // namespace

void report_unused(Draft& draft) {
  if (draft.diagnostics.errors() > 0) return;   // what could not be read may use it
  if (draft.model.templates.empty()) return;    // a module of words for others
  const Uses uses(draft);
  for (const Names::Named& named : draft.names.all()) {
    const Entity& entity = named.entity;
    const std::string_view word = word_for(draft, entity);
    if (word.empty() || uses.contain(named.text)) continue;
    if (entity.kind == Entity::Kind::kSet && uses.contain_word_of(draft.sets[entity.id])) continue;
    draft.diagnostics.report(Kind::kUnusedDeclaration, entity.declared, {word, named.text, entity.kind == Entity::Kind::kFuzzy ? "; a `control` line would say which strategy it drives" : ""});
  }
}

}  // namespace kb::model
