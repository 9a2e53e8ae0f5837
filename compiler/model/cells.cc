// The functions that make cells and rows.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/model/draft.h"

namespace kb::model {

using diagnostics::Kind;

CellId add_cell(Draft& draft, Cell cell, float own_initial) {
  std::vector<Cell>& cells = draft.model.cells;
  const CellId id{static_cast<std::uint32_t>(cells.size())};
  const bool has_own = cell.kind != CellKind::kSatellite;
  if (has_own) cell.satellites.push_back(CellId{static_cast<std::uint32_t>(cells.size() + 1)});
  cells.push_back(std::move(cell));
  if (!has_own) return id;
  Cell own;
  own.name = draft.model.texts->keep({"sat ", cells.back().name});
  own.kind = CellKind::kSatellite;
  own.initial = own_initial;
  own.own_satellite = true;
  own.of = id;
  own.declared = cells.back().declared;
  cells.push_back(std::move(own));
  return id;
}

bool too_many_cells(Draft& draft, std::size_t more, std::string_view name, source::Span at) {
  const std::size_t all = draft.model.cells.size() + more;
  if (all <= kMaxCells && more <= kMaxCells) return false;
  if (!std::exchange(draft.exhausted, true)) {
    draft.diagnostics.report(Kind::kTooManyCells, at, {name, fmt::format("{}", all), fmt::format("{}", kMaxCells)});
  }
  return true;
}

bool too_many_values(Draft& draft, std::size_t more, const Relation& relation, source::Span at) {
  if (draft.model.values.size() + more <= kMaxFieldValues && more <= kMaxFieldValues) return false;
  if (!std::exchange(draft.exhausted, true)) {
    draft.diagnostics.report(Kind::kTooManyFieldValues, at, {relation.name, fmt::format("{}", kMaxFieldValues)});
  }
  return true;
}

CellId own_satellite(const Model& model, CellId cell) {
  return model[cell].kind == CellKind::kSatellite ? CellId::kNone : model[cell].satellites.front();
}

void attach(Model& model, CellId satellite, CellId cell) {
  auto& satellites = model.cells[index(cell)].satellites;
  if (satellites.back() == satellite) return;  // two fields after `of` hold the same cell
  satellites.push_back(satellite);
  Cell& from = model.cells[index(satellite)];
  if (from.of == CellId::kNone) from.of = cell;
}

std::string_view words_for(const Model& model, CellId cell) {
  switch (model[cell].kind) {
    case CellKind::kFact: return model[cell].command ? "a command" : "a fact";
    case CellKind::kSatellite: return "a satellite";
    case CellKind::kStrategy: return "a strategy";
  }
  return "a cell";
}

std::optional<RelationId> find_relation(const Draft& draft, std::string_view name) {
  const Entity* entity = draft.names.find(name);
  if (entity == nullptr) return std::nullopt;
  if (entity->kind == Entity::Kind::kRelation) return RelationId{entity->id};
  // Something else has the name, and a relation that statements write rows of was made without one.
  const auto& all = draft.model.relations;
  const auto made = std::find_if(all.begin(), all.end(), [name](const Relation& relation) { return relation.name == name; });
  if (made == all.end()) return std::nullopt;
  return RelationId{static_cast<std::uint32_t>(made - all.begin())};
}

RelationId implicit_relation(Draft& draft, std::string_view name, source::Span at) {
  if (const auto known = find_relation(draft, name)) return *known;
  const RelationId made{static_cast<std::uint32_t>(draft.model.relations.size())};
  Relation relation;
  relation.name = std::string(name);
  relation.declared = at;
  draft.model.relations.push_back(std::move(relation));
  draft.names.declare_quietly(name, {Entity::Kind::kRelation, static_cast<std::uint32_t>(made), at});
  return made;
}

RelationId need_relation(Draft& draft, std::string_view name, std::string_view what, source::Span at) {
  const Entity* other = draft.names.find(name);
  const bool told = other != nullptr && other->twice;   // the library has the relation, but something else has its name
  if (!find_relation(draft, name) && !told && !std::exchange(draft.library_missing, true)) {
    draft.diagnostics.report(Kind::kLibraryMissing, at, {what, name});
  }
  return implicit_relation(draft, name, at);
}

RowId add_row_of(Draft& draft, RelationId relation, std::string_view name, source::Span at, CellId cell) {
  Model& model = draft.model;
  Relation& owner = model.relations[index(relation)];
  const RowId id{static_cast<std::uint32_t>(model.rows.size())};
  model.rows.push_back({name, relation, cell, Row::kNoFields, at});
  if (!too_many_values(draft, owner.fields.size(), owner, at)) {
    model.rows.back().first = static_cast<std::uint32_t>(model.values.size());
    model.values.resize(model.values.size() + owner.fields.size());
  }
  owner.rows.push_back(id);
  return id;
}

RowId add_row(Draft& draft, RelationId relation, std::initializer_list<std::string_view> name, source::Span at) {
  const std::string_view kept = draft.model.texts->keep(name);
  CellId own = CellId::kNone;
  if (draft.model[relation].satellites) {
    Cell cell;
    cell.name = kept;
    cell.kind = CellKind::kSatellite;
    cell.initial = -1.0f;
    cell.declared = at;
    own = add_cell(draft, std::move(cell));
  }
  return add_row_of(draft, relation, kept, at, own);
}

PointId add_point(Model& model, Point point) {
  model.points.push_back(point);
  return PointId{static_cast<std::uint32_t>(model.points.size() - 1)};
}

KeptId add_kept(Model& model, KeptCondition kept) {
  model.kept.push_back(kept);
  return KeptId{static_cast<std::uint32_t>(model.kept.size() - 1)};
}

std::optional<std::size_t> find_field(const Relation& relation, std::string_view field) {
  for (std::size_t i = 0; i < relation.fields.size(); ++i) {
    if (relation.fields[i] == field) return i;
  }
  return std::nullopt;
}

void report_unknown_field(Draft& draft, const Relation& relation, const syntax::Name& field) {
  draft.diagnostics.report(Kind::kUnknownField, field.span, {relation.name, field.text})
      .note(Kind::kNameDeclaredHere, relation.declared, {relation.name})
      .suggest(draft.diagnostics.nearest(field.text, relation.fields));
}

const Value* Model::field(const Row& row, std::string_view name) const {
  const auto place = find_field((*this)[row.relation], name);
  const std::span<const Value> all = fields(row);
  return place && *place < all.size() ? &all[*place] : nullptr;
}

const Row* Model::row_in(const Row& row, std::string_view name) const {
  const auto* id = std::get_if<RowId>(field(row, name));
  return id != nullptr && *id != RowId::kNone ? &(*this)[*id] : nullptr;
}

std::string_view Model::member_in(const Row& row, std::string_view name) const {
  const auto* member = std::get_if<Member>(field(row, name));
  return member == nullptr ? std::string_view{} : std::string_view(sets[index(member->set)].members[member->index]);
}

const Point* Model::point_in(const Row& row, std::string_view name) const {
  const auto* point = std::get_if<PointId>(field(row, name));
  return point == nullptr ? nullptr : &(*this)[*point];
}

std::span<const RowId> Model::rows_of(std::string_view relation) const {
  const auto found = std::find_if(relations.begin(), relations.end(), [relation](const Relation& one) { return one.name == relation; });
  return found == relations.end() ? std::span<const RowId>{} : std::span<const RowId>(found->rows);
}

void set_field(Draft& draft, RowId row, std::string_view field, Value value) {
  if (const auto place = find_field(draft.model[draft.model[row].relation], field)) set_field(draft, row, *place, std::move(value));
}

void set_field(Draft& draft, RowId row, std::size_t place, Value value) {
  const std::uint32_t first = draft.model[row].first;
  if (first != Row::kNoFields) draft.model.values[first + place] = std::move(value);
}

const Entity* need_entity(Draft& draft, const syntax::Name& name, Entity::Kind wanted, Kind unknown, Kind other) {
  const Entity* entity = draft.names.find(name.text);
  if (entity == nullptr) {
    draft.diagnostics.report(unknown, name.span, {name.text}).suggest(draft.names.nearest(name.text, wanted, draft.diagnostics));
    return nullptr;
  }
  if (entity->kind == wanted) return entity;
  if (entity->kind == Entity::Kind::kBroken) return nullptr;
  draft.diagnostics.report(other, name.span, {name.text, words_for(entity->kind)}).note(Kind::kNameDeclaredHere, entity->declared, {name.text});
  return nullptr;
}

}  // namespace kb::model
