// Evaluating references in one instance of a rule.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/diagnostics/display.h"
#include "compiler/model/references.h"

namespace kb::model {

using diagnostics::Kind;

namespace {

Operand operand_of(const Model& model, const Value& value) {
  struct Reader {
    const Model& model;
    Operand operator()(std::monostate) const { return Operand::of(Operand::Kind::kMissing); }
    Operand operator()(PointId) const { return Operand::of(Operand::Kind::kPoint); }
    Operand operator()(RowId row) const { return Operand::of(row); }
    Operand operator()(CellId cell) const { return Operand::of(cell); }
    Operand operator()(Member member) const { return Operand::of(member); }
    Operand operator()(KeptId id) const {
      const KeptCondition& kept = model[id];
      if (!kept.is_resolved) return Operand::of(Operand::Kind::kBroken);  // it could not be read, which has been reported
      Operand operand = Operand::of(Operand::Kind::kCondition);
      operand.condition = kept.resolved;
      operand.depth = kept.depth;
      return operand;
    }
  };
  return std::visit(Reader{model}, value);
}

}  // namespace

Operand References::evaluate(std::uint32_t id, Environment values) {
  switch (patterns_[id].op) {
    case Pattern::Op::kConstant: return patterns_[id].constant;
    case Pattern::Op::kBinder: return values[patterns_[id].binder];
    case Pattern::Op::kField: return evaluate_field(id, values);
    case Pattern::Op::kIndex: return evaluate_index(id, values);
    case Pattern::Op::kCall: return evaluate_call(id, values);
  }
  return {};
}

/// Without recursion from field to field: a reference may have thousands.
Operand References::evaluate_field(std::uint32_t id, Environment values) {
  std::vector<std::uint32_t> fields{id};
  while (patterns_[patterns_[fields.back()].object].op == Pattern::Op::kField) fields.push_back(patterns_[fields.back()].object);
  Operand operand = evaluate(patterns_[fields.back()].object, values);
  for (auto at = fields.rbegin(); at != fields.rend(); ++at) operand = field_of(operand, patterns_[*at]);
  return operand;
}

Operand References::field_of(const Operand& object, Pattern& pattern) {
  if (object.kind == Operand::Kind::kBroken || object.kind == Operand::Kind::kMissing) return object;
  if (object.kind != Operand::Kind::kRow) {
    draft_.diagnostics.report(Kind::kNoFields, pattern.field.span, {text(pattern.object), describe(object), pattern.field.text});
    return {};
  }
  const Row& row = draft_.model[object.row];
  if (row.relation != pattern.cached_relation) {
    const Relation& relation = draft_.model[row.relation];
    const auto place = find_field(relation, pattern.field.text);
    if (!place) {
      report_unknown_field(draft_, relation, pattern.field);
      return {};
    }
    pattern.cached_relation = row.relation;
    pattern.cached_field = *place;
  }
  Operand operand = operand_of(draft_.model, draft_.model.fields(row)[pattern.cached_field]);
  if (operand.kind == Operand::Kind::kMissing) missing_ = std::min(missing_, pattern.depends_on);
  return operand;
}

Operand References::evaluate_argument(const Argument& argument, SetId set, std::string_view owner, bool table,
                                      Environment values) {
  Operand operand = evaluate(argument.pattern, values);
  if (operand.kind == Operand::Kind::kBroken || operand.kind == Operand::Kind::kMissing) return operand;
  const source::Span at = span(argument.pattern);
  if (operand.kind != Operand::Kind::kMember) {
    draft_.diagnostics.report(Kind::kIndexNotAMember, at, {text(at), describe(operand)});
    return {};
  }
  if (operand.member.set == set) return operand;
  const std::string& wanted = draft_.model.sets[index(set)].name;
  const std::string& given = draft_.model.sets[index(operand.member.set)].name;
  auto message = draft_.diagnostics.report(table ? Kind::kArgumentOfWrongSet : Kind::kIndexOfWrongSet, at,
                                           {draft_.name_of(operand.member), given, owner, wanted});
  if (table || owner != wanted) return {};
  // Both ways would make two groups of each other's members, so all messages about two sets give the advice of the first.
  const SetId given_set = operand.member.set;
  const SetId advised = draft_.other_owner_told.try_emplace(std::minmax(set, given_set), set).first->second;
  if (advised == set) message.note(Kind::kOwnMembers, draft_.model.sets[index(set)].declared, {owner, given});
  return {};
}

Operand References::evaluate_index(std::uint32_t id, Environment values) {
  const Group& group = draft_.model.groups[patterns_[id].target];
  source::Few<std::uint32_t, 8> places{0};
  bool many = false;
  for (std::size_t i = 0; i < group.dimensions.size(); ++i) {
    const Argument argument = patterns_[id].arguments[i];
    const auto size = static_cast<std::uint32_t>(draft_.model.sets[index(group.dimensions[i])].members.size());
    if (argument.star) {
      source::Few<std::uint32_t, 8> all;
      all.reserve(places.size() * size);
      for (const std::uint32_t place : places) {
        for (std::uint32_t member = 0; member < size; ++member) all.push_back(place * size + member);
      }
      places = std::move(all);
      many = true;
      continue;
    }
    const Operand member = evaluate_argument(argument, group.dimensions[i], group.name, false, values);
    if (member.kind != Operand::Kind::kMember) return member;
    for (std::uint32_t& place : places) place = place * size + member.member.index;
  }
  if (!many) return Operand::of(group.cells[places.front()]);
  Operand operand = Operand::of(Operand::Kind::kCells);
  for (const std::uint32_t place : places) operand.cells.push_back(group.cells[place]);
  return operand;
}

Operand References::evaluate_call(std::uint32_t id, Environment values) {
  const Table& table = draft_.model.tables[patterns_[id].target];
  std::size_t place = 0;
  for (std::size_t i = 0; i < table.parameters.size(); ++i) {
    const Operand member = evaluate_argument(patterns_[id].arguments[i], table.parameters[i], table.name, true, values);
    if (member.kind != Operand::Kind::kMember) return member;
    place = place * draft_.model.sets[index(table.parameters[i])].members.size() + member.member.index;
  }
  if (table.values[place] == kNone32) return {};  // the table is incomplete, which has been reported
  return Operand::of(Member{table.result, table.values[place]});
}

std::string References::describe(const Operand& operand) const {
  switch (operand.kind) {
    case Operand::Kind::kMember: return fmt::format("a member of `{}`", draft_.model.sets[index(operand.member.set)].name);
    case Operand::Kind::kCell: return std::string(words_for(draft_.model, operand.cell));
    case Operand::Kind::kRow: {
      const Row& row = draft_.model[operand.row];
      if (row.cell != CellId::kNone && draft_.model[row.cell].kind == CellKind::kFact) {
        return draft_.model[row.cell].command ? "a command" : "a landmark";
      }
      return fmt::format("a row of `{}`", draft_.model[row.relation].name);
    }
    case Operand::Kind::kCondition: return "a condition kept in a row";
    case Operand::Kind::kPoint: return "a place on a map";
    case Operand::Kind::kCells: return diagnostics::counted(operand.cells.size(), "cell");
    case Operand::Kind::kGroup:
      return "a group of " + diagnostics::counted(draft_.model.groups[operand.whole].cells.size(), "cell");
    case Operand::Kind::kRelation: return "a relation of " + diagnostics::counted(draft_.model.relations[operand.whole].rows.size(), "row");
    case Operand::Kind::kOther: return std::string(words_for(operand.other));
    case Operand::Kind::kBroken:
    case Operand::Kind::kMissing: break;
  }
  return "nothing";
}

std::optional<CellId> References::cell_of(const Operand& operand) const {
  if (operand.kind == Operand::Kind::kRow) {
    const CellId cell = draft_.model[operand.row].cell;
    return cell == CellId::kNone ? std::nullopt : std::optional<CellId>(cell);
  }
  const bool cell = operand.kind == Operand::Kind::kCell || operand.kind == Operand::Kind::kMember;
  return cell && operand.cell != CellId::kNone ? std::optional<CellId>(operand.cell) : std::nullopt;
}

std::optional<std::vector<CellId>> References::cells_of(const Operand& operand) const {
  if (operand.kind == Operand::Kind::kCells) return operand.cells;
  if (operand.kind == Operand::Kind::kGroup) return draft_.model.groups[operand.whole].cells;
  if (operand.kind != Operand::Kind::kRelation) {
    const auto cell = cell_of(operand);
    return cell ? std::optional(std::vector{*cell}) : std::nullopt;
  }
  std::vector<CellId> cells;
  const Relation& relation = draft_.model.relations[operand.whole];
  if (row_state(relation) == RowState::kNone) return std::nullopt;
  for (const RowId row : relation.rows) {
    if (draft_.model[row].cell == CellId::kNone) return std::nullopt;
    cells.push_back(draft_.model[row].cell);
  }
  return cells;
}

Outcome References::report_no_cell(std::uint32_t pattern, const Operand& operand) const {
  const bool row = operand.kind == Operand::Kind::kRow || operand.kind == Operand::Kind::kRelation;
  if (row && draft_.library_missing) return Outcome::kBroken;   // the library declares the relation with a state
  draft_.diagnostics.report(row ? Kind::kNoState : Kind::kNotACell, span(pattern), {text(pattern), describe(operand)});
  return Outcome::kBroken;
}

}  // namespace kb::model
