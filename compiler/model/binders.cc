#include "compiler/model/binders.h"

#include <fmt/format.h>

#include <algorithm>

#include "compiler/diagnostics/look_alike.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

void add_members(Draft& draft, SetId set, const std::vector<CellId>& cells, Range& range) {
  const std::vector<std::string>& members = draft.model.sets[index(set)].members;
  for (std::uint32_t i = 0; i < members.size(); ++i) {
    range.add(Operand::of(Member{set, i}, cells.empty() ? CellId::kNone : cells[i]), members[i]);
  }
}

void add_group(Draft& draft, const Group& group, Range& range) {
  if (group.dimensions.size() == 1) return add_members(draft, group.dimensions.front(), group.cells, range);
  for (const CellId cell : group.cells) range.add(Operand::of(cell), draft.model[cell].name);
}

bool read_range(Draft& draft, syntax::Name name, Binder& binder, Range& range) {
  const Entity* entity = draft.names.find(name.text);
  if (entity != nullptr && entity->kind == Entity::Kind::kRelation) {
    binder.relation = RelationId{entity->id};
    range.add_rows_of(binder.relation);
    return true;
  }
  if (entity != nullptr && entity->kind == Entity::Kind::kGroup) {
    const Group& group = draft.model.groups[entity->id];
    if (group.dimensions.size() == 1) binder.set = group.dimensions.front();
    add_group(draft, group, range);
    return true;
  }
  const auto set = need_set(draft, name, true);
  if (!set) return false;
  binder.set = *set;
  add_members(draft, *set, {}, range);
  return true;
}

}  // namespace

bool read_binders(Draft& draft, const std::vector<syntax::Rule::Binder>& written, std::vector<Binder>& binders,
                  std::vector<Range>& ranges) {
  bool good = true;
  for (const syntax::Rule::Binder& from : written) {
    const bool twice = std::any_of(binders.begin(), binders.end(), [&](const Binder& b) { return b.name.text == from.variable.text; });
    if (twice) {
      draft.diagnostics.report(Kind::kBinderTwice, from.variable.span, {from.variable.text});
      good = false;
      continue;
    }
    const auto twin = std::find_if(binders.begin(), binders.end(), [&](const Binder& b) { return diagnostics::look_alike(b.name.text, from.variable.text); });
    if (twin != binders.end()) {
      draft.diagnostics.report(Kind::kLookAlike, from.variable.span, {from.variable.text, twin->name.text, diagnostics::difference(from.variable.text, twin->name.text)})
          .note(Kind::kNameDeclaredHere, twin->name.span, {twin->name.text});
    }
    Binder binder;
    binder.name = from.variable;
    Range range(draft.model);
    const bool known = read_range(draft, from.set, binder, range);
    binder.used = binder.broken = !known;  // no further message about it
    good = good && known;
    binders.push_back(binder);
    ranges.push_back(std::move(range));
  }
  return good;
}

std::optional<std::size_t> combinations(Draft& draft, const std::vector<Range>& ranges, syntax::Name owner) {
  double exact = 1.0;
  for (const Range& range : ranges) exact *= static_cast<double>(range.size());
  if (exact <= static_cast<double>(kMaxInstances)) return static_cast<std::size_t>(exact);
  draft.diagnostics.report(Kind::kTooManyInstances, owner.span,
                           {owner.text, fmt::format("{:.0f}", exact), fmt::format("{}", kMaxInstances)});
  return std::nullopt;
}

}  // namespace kb::model
