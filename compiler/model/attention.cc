// Which satellites draw attention to which facts: `satellites S of X`, and rows of `relation R(...) satellites of f`.
#include "compiler/model/references.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

/// The cells of an item of a declaration that has no mistake.
std::vector<CellId> cells_of_item(const Draft& draft, const syntax::Declaration::Item& item) {
  const Entity* entity = draft.names.find(item.name.text);
  if (entity == nullptr || entity->declared != item.name.span) return {};
  if (entity->kind == Entity::Kind::kSatellite) return {CellId{entity->id}};
  if (entity->kind == Entity::Kind::kGroup) return draft.model.groups[entity->id].cells;
  return {};
}

void attach_item(Draft& draft, const syntax::Tree& tree, const syntax::Declaration::Item& item) {
  std::vector<Binder> binders;
  References references(draft, tree, binders);
  const std::uint32_t ref = references.compile(*item.of);
  const Operand target = references.evaluate(ref, {});
  if (target.kind == Operand::Kind::kBroken || target.kind == Operand::Kind::kMissing) return;
  const auto targets = references.cells_of(target);
  const bool satellite = targets && !targets->empty() && draft.model[targets->front()].kind == CellKind::kSatellite;
  if (!targets || satellite) {
    draft.diagnostics.report(Kind::kOfNothing, references.span(ref), {references.text(ref), references.describe(target)});
    return;
  }
  for (const CellId satellite_cell : cells_of_item(draft, item)) {
    for (const CellId cell : *targets) attach(draft.model, satellite_cell, cell);
  }
}

CellId cell_of(const Model& model, const Value& value) {
  if (const auto* row = std::get_if<RowId>(&value)) return model[*row].cell;
  if (const auto* cell = std::get_if<CellId>(&value)) return *cell;
  return CellId::kNone;
}

void attach_rows(Draft& draft, const syntax::Relation& from) {
  const auto id = find_relation(draft, from.name.text);
  if (!id || draft.model[*id].declared != from.name.span) return;
  for (const syntax::Name& field : from.of) {
    const auto place = find_field(draft.model[*id], field.text);
    if (!place) continue;
    for (const RowId row : draft.model[*id].rows) {
      const Value& value = draft.model.fields(draft.model[row])[*place];
      if (std::holds_alternative<std::monostate>(value)) continue;
      const CellId cell = cell_of(draft.model, value);
      if (cell != CellId::kNone && draft.model[cell].kind != CellKind::kSatellite) {
        attach(draft.model, draft.model[row].cell, cell);
        continue;
      }
      const auto written = draft.field_spans.find(field_key(row, *place));
      const bool known = written != draft.field_spans.end();
      const auto* kept = std::get_if<KeptId>(&value);
      if (kept != nullptr) draft.model.kept[index(*kept)].tree = nullptr;   // its mistakes are reported here
      const source::Span at = known ? written->second : draft.model[row].declared;
      draft.diagnostics.report(Kind::kOfFieldWithoutCell, at,
                               {field.text, known ? draft.diagnostics.sources().text(at) : std::string_view(draft.model[row].name),
                                kept != nullptr ? "no single cell" : cell == CellId::kNone ? "no cell" : "a satellite"});
    }
  }
}

/// The rows of an exclusive relation exclude each other. With a single row there is nothing to exclude.
void exclude_rows(Draft& draft) {
  for (const Relation& relation : draft.model.relations) {
    if (!relation.satellites || !relation.exclusive || relation.rows.size() < 2) continue;
    std::vector<CellId> cells;
    for (const RowId row : relation.rows) cells.push_back(draft.model[row].cell);
    draft.model.exclusive.push_back(std::move(cells));
  }
}

}  // namespace

void attach_satellites(Draft& draft) {
  draft.each<syntax::Declaration>([&](const syntax::Tree& tree, const auto&, const syntax::Declaration& declaration) {
    if (declaration.kind != syntax::Declaration::Kind::kSatellite) return;
    for (const syntax::Declaration::Item& item : declaration.items) {
      if (item.of) attach_item(draft, tree, item);
    }
  });
  draft.each<syntax::Relation>([&](const auto&, const auto&, const syntax::Relation& relation) { attach_rows(draft, relation); });
  exclude_rows(draft);
}

}  // namespace kb::model
