// Finite sets: `names D { ... }`, the members of groups, and what `names D more { ... }` adds. All members are known before any
// group gets its cells, so it does not matter which file adds to a set.
#include "compiler/model/draft.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

SetId make_set(Draft& draft, std::string_view name, source::Span at) {
  const SetId id{static_cast<std::uint32_t>(draft.model.sets.size())};
  FiniteSet set;
  set.name = std::string(name);
  set.declared = at;
  draft.model.sets.push_back(std::move(set));
  draft.sets.emplace_back();
  draft.set_of.emplace(name, id);
  return id;
}

void add_members(Draft& draft, SetId id, const std::vector<syntax::Name>& members) {
  FiniteSet& set = draft.model.sets[index(id)];
  SetIndex& known = draft.sets[index(id)];
  for (const syntax::Name& member : members) {
    const auto place = static_cast<std::uint32_t>(set.members.size());
    const auto [first, fresh] = known.members.emplace(member.text, place);
    if (!fresh) {
      draft.diagnostics.report(Kind::kMemberTwice, member.span, {member.text, set.name})
          .note(Kind::kFirstDeclaredHere, set.places[first->second]);
      continue;
    }
    set.members.emplace_back(member.text);
    set.places.push_back(member.span);
  }
}

/// A group that lists its members (`Turn { left, right }`) is also a finite set. Its name is declared together with its cells.
void declare_members_of_groups(Draft& draft, const syntax::Declaration& declaration) {
  for (const syntax::Declaration::Item& item : declaration.items) {
    if (item.shape != syntax::Declaration::Item::Shape::kMembers || draft.set_of.contains(item.name.text)) continue;
    add_members(draft, make_set(draft, item.name.text, item.name.span), item.names);
  }
}

/// A group over one set (`In[Direction]`) may stand for it: `x in In`, `facts Far[In]`. Which is declared first does not matter.
void alias_groups(Draft& draft) {
  std::unordered_map<std::string_view, std::string_view> over;
  draft.each<syntax::Declaration>([&](const auto&, const auto&, const syntax::Declaration& declaration) {
    for (const syntax::Declaration::Item& item : declaration.items) {
      const bool one = item.shape == syntax::Declaration::Item::Shape::kOver && item.names.size() == 1;
      if (one) over.emplace(item.name.text, item.names.front().text);
    }
  });
  while (!over.empty()) {
    std::vector<std::string_view> names{over.begin()->first};   // each is a group over the next one
    for (auto at = over.begin(); at != over.end() && !draft.set_of.contains(names.back()); at = over.find(names.back())) {
      names.push_back(at->second);
      over.erase(at);
    }
    over.erase(names.front());
    const auto set = draft.set_of.find(names.back());
    if (set == draft.set_of.end()) continue;
    const SetId id = set->second;
    for (const std::string_view name : names) draft.set_of.emplace(name, id);
  }
}

void declare_set(Draft& draft, const syntax::NameSet& names) {
  if (names.more) return;
  Entity entity{Entity::Kind::kSet, static_cast<std::uint32_t>(draft.model.sets.size()), names.name.span};
  if (!draft.names.declare(names.name, entity, draft.diagnostics)) return;
  add_members(draft, make_set(draft, names.name.text, names.name.span), names.members);
}

/// Looks in the text, because relations are declared later than sets.
const syntax::Name* relation_called(const Draft& draft, std::string_view name) {
  const syntax::Name* found = nullptr;
  draft.each<syntax::Relation>([&](const auto&, const auto&, const syntax::Relation& relation) {
    if (relation.name.text == name) found = &relation.name;
  });
  return found;
}

void add_more(Draft& draft, const syntax::NameSet& names) {
  if (!names.more) return;
  const auto set = draft.set_of.find(names.name.text);
  if (set == draft.set_of.end()) {
    if (const syntax::Name* relation = relation_called(draft, names.name.text)) {
      draft.diagnostics.report(Kind::kNotASet, names.name.span, {names.name.text, words_for(Entity::Kind::kRelation)})
          .note(Kind::kNameDeclaredHere, relation->span, {names.name.text});
      return;
    }
    report_unknown(draft, Kind::kMoreOfUnknown, names.name, draft.diagnostics.nearest(names.name.text, draft.model.sets, &FiniteSet::name));
    return;
  }
  SetIndex& known = draft.sets[index(set->second)];
  if (!known.more) known.more = static_cast<std::uint32_t>(draft.model.sets[index(set->second)].places.size());
  add_members(draft, set->second, names.members);
}

}  // namespace

std::optional<SetId> need_set(Draft& draft, syntax::Name name, bool or_relation) {
  if (const auto set = draft.set_of.find(name.text); set != draft.set_of.end()) return set->second;
  const Entity* entity = draft.names.find(name.text);
  if (entity != nullptr && entity->kind == Entity::Kind::kBroken) return std::nullopt;
  if (entity != nullptr) {
    draft.diagnostics.report(Kind::kNotASet, name.span, {name.text, words_for(entity->kind)})
        .note(Kind::kNameDeclaredHere, entity->declared, {name.text});
    return std::nullopt;
  }
  report_unknown(draft, Kind::kUnknownSet, name, draft.diagnostics.nearest_of(name.text, [&](auto& candidates) {
    for (const FiniteSet& known : draft.model.sets) candidates.emplace_back(known.name);
    for (const Relation& known : draft.model.relations) {
      if (or_relation) candidates.emplace_back(known.name);
    }
  }));
  return std::nullopt;
}

void declare_sets(Draft& draft) {
  draft.each<syntax::NameSet>([&](const auto&, const auto&, const auto& names) { declare_set(draft, names); });
  draft.each<syntax::Declaration>(
      [&](const auto&, const auto&, const auto& declaration) { declare_members_of_groups(draft, declaration); });
  alias_groups(draft);
  draft.each<syntax::NameSet>([&](const auto&, const auto&, const auto& names) { add_more(draft, names); });
  // Only now: a set may get a member by `more` that a later set had before.
  for (std::uint32_t set = 0; set < draft.sets.size(); ++set) {
    for (const auto& [member, place] : draft.sets[set].members) draft.set_with.emplace(member, SetId{set});
  }
}

}  // namespace kb::model
