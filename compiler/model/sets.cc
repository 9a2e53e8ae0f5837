// Finite sets: `names D { ... }`, the members of groups, and what `names D more { ... }` adds. All are known before any
// group is laid out, so it does not matter which file adds to a set.
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
          .note(Kind::kFirstDeclaredHere, known.spans[first->second]);
      continue;
    }
    set.members.emplace_back(member.text);
    known.spans.push_back(member.span);
  }
}

/// A group that lists its members (`Turn { left, right }`) is a finite set as well. Its name is declared with its cells.
void declare_members_of_groups(Draft& draft, const syntax::Declaration& declaration) {
  for (const syntax::Declaration::Item& item : declaration.items) {
    if (item.shape != syntax::Declaration::Item::Shape::kMembers || draft.set_of.contains(item.name.text)) continue;
    add_members(draft, make_set(draft, item.name.text, item.name.span), item.names);
  }
}

/// A group over one set (`In[Direction]`) may stand for it: `x in In`, `facts Far[In]`.
void alias_groups(Draft& draft, const syntax::Declaration& declaration) {
  for (const syntax::Declaration::Item& item : declaration.items) {
    if (item.shape != syntax::Declaration::Item::Shape::kOver || item.names.size() != 1) continue;
    if (const auto set = draft.set_of.find(item.names.front().text); set != draft.set_of.end()) {
      draft.set_of.emplace(item.name.text, set->second);
    }
  }
}

void declare_set(Draft& draft, const syntax::NameSet& names) {
  if (names.more) return;
  Entity entity{Entity::Kind::kSet, static_cast<std::uint32_t>(draft.model.sets.size()), names.name.span};
  if (!draft.names.declare(names.name, entity, draft.diagnostics)) return;
  add_members(draft, make_set(draft, names.name.text, names.name.span), names.members);
}

void add_more(Draft& draft, const syntax::NameSet& names) {
  if (!names.more) return;
  const auto set = draft.set_of.find(names.name.text);
  if (set == draft.set_of.end()) {
    std::vector<std::string_view> candidates;
    for (const FiniteSet& known : draft.model.sets) candidates.emplace_back(known.name);
    report_unknown(draft, Kind::kMoreOfUnknown, names.name, draft.diagnostics.nearest(names.name.text, candidates));
    return;
  }
  std::optional<source::Span>& more = draft.sets[index(set->second)].more;
  if (!more) more = names.name.span;
  add_members(draft, set->second, names.members);
}

}  // namespace

std::optional<SetId> need_set(Draft& draft, syntax::Name name) {
  if (const auto set = draft.set_of.find(name.text); set != draft.set_of.end()) return set->second;
  const Entity* entity = draft.names.find(name.text);
  if (entity != nullptr && entity->kind == Entity::Kind::kBroken) return std::nullopt;
  if (entity != nullptr) {
    draft.diagnostics.report(Kind::kNotASet, name.span, {name.text, words_for(entity->kind)})
        .note(Kind::kNameDeclaredHere, entity->declared, {name.text});
    return std::nullopt;
  }
  std::vector<std::string_view> candidates;
  for (const FiniteSet& known : draft.model.sets) candidates.emplace_back(known.name);
  report_unknown(draft, Kind::kUnknownSet, name, draft.diagnostics.nearest(name.text, candidates));
  return std::nullopt;
}

void declare_sets(Draft& draft) {
  draft.each<syntax::NameSet>([&](const auto&, const auto&, const auto& names) { declare_set(draft, names); });
  draft.each<syntax::Declaration>(
      [&](const auto&, const auto&, const auto& declaration) { declare_members_of_groups(draft, declaration); });
  draft.each<syntax::Declaration>(
      [&](const auto&, const auto&, const auto& declaration) { alias_groups(draft, declaration); });
  draft.each<syntax::NameSet>([&](const auto&, const auto&, const auto& names) { add_more(draft, names); });
}

}  // namespace kb::model
