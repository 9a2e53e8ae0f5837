// Facts, commands, satellites, strategies and their groups.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <limits>

#include "compiler/model/draft.h"

namespace kb::model {
namespace {

using diagnostics::Kind;
using syntax::Declaration;

CellKind cell_kind(Declaration::Kind kind) {
  switch (kind) {
    case Declaration::Kind::kFact:
    case Declaration::Kind::kCommand: return CellKind::kFact;
    case Declaration::Kind::kSatellite: return CellKind::kSatellite;
    case Declaration::Kind::kStrategy: return CellKind::kStrategy;
  }
  return CellKind::kFact;
}

Entity::Kind entity_kind(Declaration::Kind kind) {
  switch (kind) {
    case Declaration::Kind::kFact: return Entity::Kind::kFact;
    case Declaration::Kind::kCommand: return Entity::Kind::kCommand;
    case Declaration::Kind::kSatellite: return Entity::Kind::kSatellite;
    case Declaration::Kind::kStrategy: return Entity::Kind::kStrategy;
  }
  return Entity::Kind::kBroken;
}

class DeclarationReader {
 public:
  DeclarationReader(Draft& draft, const syntax::Tree& tree, const Declaration& declaration)
      : draft_(draft), tree_(tree), declaration_(declaration), kind_(cell_kind(declaration.kind)) {}

  void run() {
    check_attributes();
    for (const Declaration::Item& item : declaration_.items) read_item(item);
    if (declaration_.exclusive && kind_ != CellKind::kStrategy) make_exclusive(*declaration_.exclusive);
  }

 private:
  void refuse(std::string_view attribute, source::Span at, std::string_view hint = {}) {
    const std::string_view what = kind_ == CellKind::kFact        ? "facts"
                                  : kind_ == CellKind::kSatellite ? "satellites"
                                                                  : "strategies";
    draft_.diagnostics.report(Kind::kAttributeNotHere, at, {attribute, what, hint});
  }

  static constexpr std::string_view kWantedFromStart = "; a satellite that is declared `of` one, with `= 1`, makes it wanted from the start";

  void check_attributes() {
    if (kind_ != CellKind::kSatellite) {
      if (declaration_.keep) refuse("keep", *declaration_.keep);
      if (declaration_.output) refuse("output", *declaration_.output, kind_ == CellKind::kFact ? "; the program gives them" : "; the program is told which one runs");
      const std::string_view hint = kind_ == CellKind::kFact ? "; their satellites begin as `sat = v` says" : kWantedFromStart;
      if (declaration_.initial) refuse("= v", declaration_.initial->span, hint);
      for (const auto& value : member_values()) refuse("= v", value->span, hint);
      for (const Declaration::Item& item : declaration_.items) {
        if (item.of) refuse("of", tree_[*item.of].span);
      }
    }
    if (kind_ != CellKind::kFact) {
      if (declaration_.sat_initial) refuse("sat = v", declaration_.sat_initial->span, kind_ == CellKind::kStrategy ? kWantedFromStart : "; they begin as `= v` says");
      if (declaration_.event) refuse("event", declaration_.event->span);
      if (declaration_.attention) refuse("attention", declaration_.attention->span);
      if (declaration_.lazy) refuse("lazy", *declaration_.lazy);
      refuse_definitions();
    }
    if (kind_ == CellKind::kStrategy && declaration_.exclusive) {
      refuse("exclusive", *declaration_.exclusive, "; one runs at a time as it is, by `priority`");
    }
    if (kind_ == CellKind::kSatellite) {
      check_range(declaration_.initial);
      for (const auto& value : member_values()) check_range(value);
    }
    if (kind_ != CellKind::kFact) return;
    check_range(declaration_.sat_initial);
    refuse_unit(declaration_.event);
    refuse_unit(declaration_.attention);
  }

  [[nodiscard]] std::vector<std::optional<syntax::Number>> member_values() const {
    std::vector<std::optional<syntax::Number>> values;
    for (const Declaration::Item& item : declaration_.items) std::ranges::copy_if(item.values, std::back_inserter(values), [](const auto& value) { return value.has_value(); });
    return values;
  }

  void refuse_definitions() {
    constexpr std::string_view kHint = "; only facts are perceived";
    if (declaration_.definition) refuse("= ...", declaration_.definition_span, kHint);
    for (const Declaration::Item& item : declaration_.items) {
      for (std::size_t i = 0; i < item.definitions.size(); ++i) {
        if (item.definitions[i]) refuse("= ...", item.names[i].span, kHint);
      }
    }
  }

  static bool has_unit(const std::optional<syntax::Number>& number) { return number && !number->unit.text.empty(); }

  /// True, after a message, if the number has a unit.
  bool refuse_unit(const std::optional<syntax::Number>& number) {
    if (!has_unit(number)) return false;
    draft_.diagnostics.report(Kind::kValueWithUnit, number->unit.span, {number->unit.text});
    return true;
  }

  void check_range(const std::optional<syntax::Number>& number) {
    if (!number || refuse_unit(number) || (number->value >= -1.0 && number->value <= 1.0)) return;
    draft_.diagnostics.report(Kind::kValueOutOfRange, number->span, {fmt::format("{}", number->value)});
  }

  void read_item(const Declaration::Item& item) {
    if (item.shape == Declaration::Item::Shape::kPlain) return read_plain(item);
    std::vector<SetId> dimensions;
    bool broken = false;
    if (item.shape == Declaration::Item::Shape::kMembers) {
      dimensions.push_back(draft_.set_of.at(item.name.text));
    } else {
      for (const syntax::Name& name : item.names) {
        if (const auto set = need_set(draft_, name)) dimensions.push_back(*set);
        else broken = true;
      }
    }
    broken = broken || too_large(item, dimensions);
    const auto id = static_cast<std::uint32_t>(draft_.model.groups.size());
    const Entity entity{broken ? Entity::Kind::kBroken : Entity::Kind::kGroup, id, {}};
    if (draft_.names.declare(item.name, entity, draft_.diagnostics) && !broken) make_group(item, std::move(dimensions));
  }

  void read_plain(const Declaration::Item& item) {
    const Entity::Kind kind = entity_kind(declaration_.kind);
    const bool command = declaration_.kind == Declaration::Kind::kCommand;
    const std::size_t next = command ? draft_.model.rows.size() : draft_.model.cells.size();
    if (!draft_.names.declare(item.name, {kind, static_cast<std::uint32_t>(next), {}}, draft_.diagnostics)) return;
    if (too_many_cells(draft_, 2, item.name.text, item.name.span)) return;
    make_cell(draft_.model.texts->keep(item.name.text), item.name.span);
  }

  bool too_large(const Declaration::Item& item, const std::vector<SetId>& dimensions) {
    std::size_t count = 2;
    for (const SetId set : dimensions) {
      const std::size_t size = draft_.model.sets[index(set)].members.size();
      count = size != 0 && count > kMaxCells ? count : count * size;
    }
    return too_many_cells(draft_, count, item.name.text, item.name.span);
  }

  void make_group(const Declaration::Item& item, std::vector<SetId> dimensions) {
    Group group;
    group.name = std::string(item.name.text);
    group.kind = kind_;
    group.dimensions = std::move(dimensions);
    group.declared = item.name.span;
    std::vector<std::size_t> at(group.dimensions.size(), 0);
    const std::vector<const syntax::Number*> own = own_values(item, group);
    std::size_t count = 1;
    for (const SetId set : group.dimensions) count *= draft_.model.sets[index(set)].members.size();
    for (std::size_t i = 0; i < count; ++i) {
      group.cells.push_back(make_cell(cell_name(group, at), item.name.span, own.empty() ? nullptr : own[at.front()]));
      next_combination(at, [&](std::size_t d) { return draft_.model.sets[index(group.dimensions[d])].members.size(); });
    }
    draft_.model.groups.push_back(std::move(group));
  }

  [[nodiscard]] std::string_view cell_name(const Group& group, const std::vector<std::size_t>& at) const {
    std::string members;
    for (std::size_t d = 0; d < at.size(); ++d) {
      if (d > 0) members += ',';
      members += draft_.model.sets[index(group.dimensions[d])].members[at[d]];
    }
    return at.size() == 1 ? draft_.model.texts->keep({group.name, ".", members}) : draft_.model.texts->keep({group.name, "[", members, "]"});
  }

  /// What the members of `satellites X { a = 1, b }` begin with, by member; null: as the statement says. Empty: none of them says so.
  [[nodiscard]] std::vector<const syntax::Number*> own_values(const Declaration::Item& item, const Group& group) const {
    std::vector<const syntax::Number*> own;
    if (kind_ != CellKind::kSatellite || item.shape != Declaration::Item::Shape::kMembers) return own;
    for (std::size_t i = 0; i < item.names.size(); ++i) {
      if (!item.values[i]) continue;
      own.resize(draft_.model.sets[index(group.dimensions.front())].members.size());
      if (const auto member = draft_.member(group.dimensions.front(), item.names[i].text)) own[member->index] = &*item.values[i];
    }
    return own;
  }

  /// `value`: an initial value of its own; null: that of the statement.
  CellId make_cell(std::string_view name, source::Span at, const syntax::Number* value = nullptr) {
    Cell cell;
    cell.name = name;
    cell.kind = kind_;
    cell.declared = at;
    cell.command = declaration_.kind == Declaration::Kind::kCommand;
    float own = cell.command ? 1.0f : -1.0f;
    if (kind_ == CellKind::kFact) {
      cell.event = declaration_.event ? declaration_.event->value : std::numeric_limits<double>::quiet_NaN();
      cell.attention = declaration_.attention ? declaration_.attention->value : std::numeric_limits<double>::quiet_NaN();
      if (declaration_.sat_initial) own = static_cast<float>(declaration_.sat_initial->value);
    } else {
      cell.initial = -1.0f;
    }
    if (kind_ == CellKind::kSatellite) {
      if (value == nullptr && declaration_.initial) value = &*declaration_.initial;
      if (value != nullptr) cell.initial = static_cast<float>(value->value);
      cell.keep = declaration_.keep.has_value();
      cell.output = declaration_.output.has_value();
    }
    const bool command = cell.command;
    const CellId id = add_cell(draft_, std::move(cell), own);
    made_.push_back(id);
    if (kind_ == CellKind::kFact && (declaration_.event || declaration_.attention)) note_threshold(id);
    if (command) add_command(id);
    return id;
  }

  void note_threshold(CellId fact) {
    if (has_unit(declaration_.event) || has_unit(declaration_.attention)) return;   // has been reported
    OwnThreshold own;
    own.fact = fact;
    if (declaration_.event) own.event = declaration_.event->span;
    if (declaration_.attention) own.attention = declaration_.attention->span;
    draft_.own_thresholds.push_back(own);
  }

  void add_command(CellId cell) {
    add_row_of(draft_, *find_relation(draft_, "Command"), draft_.model[cell].name, draft_.model[cell].declared, cell);
  }

  void make_exclusive(source::Span at) {
    if (made_.empty()) return;
    if (made_.size() == 1) {
      draft_.diagnostics.report(Kind::kLoneExclusive, at, {draft_.model[made_.front()].name});
      return;
    }
    std::vector<CellId> high;
    std::ranges::copy_if(made_, std::back_inserter(high), [&](CellId cell) { return draft_.model[cell].initial > 0.0f; });
    if (high.size() > 1) {
      std::vector<std::optional<syntax::Number>> own = member_values();
      std::erase_if(own, [](const auto& value) { return value->value <= 0.0; });
      const source::Span where = own.size() > 1 ? own[1]->span : declaration_.initial ? declaration_.initial->span : at;
      draft_.diagnostics.report(Kind::kTwoInitiallyHigh, where, {draft_.model[high[0]].name, draft_.model[high[1]].name});
    }
    draft_.model.exclusive.push_back(made_);
  }

  Draft& draft_;
  const syntax::Tree& tree_;
  const Declaration& declaration_;
  CellKind kind_;
  std::vector<CellId> made_;
};

/// How far the line of `at` is indented, in bytes.
std::size_t indentation(const source::Sources& sources, source::Span at) {
  const std::string_view line = sources.line_of(at.file, at.begin).text;
  return std::min(line.find_first_not_of(" \t"), line.size());
}

/// After the fields of a relation, `satellites NAME` is the next statement. If it stands where the clause `satellites ...` would stand, or
/// names something that belongs in that clause, the clause was meant.
void check_clause(Draft& draft, const syntax::Tree& tree, const syntax::Statement& statement, const syntax::Relation& from) {
  const syntax::Statement* next = &statement + 1;
  if (from.satellites || next == tree.statements.data() + tree.statements.size()) return;
  const auto* declaration = std::get_if<Declaration>(&next->node);
  if (declaration == nullptr || declaration->kind != Declaration::Kind::kSatellite || !declaration->plural) return;
  const Declaration::Item& item = declaration->items.front();
  if (item.shape != Declaration::Item::Shape::kPlain) return;
  const source::Sources& sources = draft.diagnostics.sources();
  const bool field = std::any_of(from.fields.begin(), from.fields.end(), [&](const syntax::Name& f) { return f.text == item.name.text; });
  const bool exclusive = diagnostics::is_slip_of(item.name.text, "exclusive");
  const bool same_line = sources.line_of(statement.span.file, statement.span.end).begin == sources.line_of(next->span.file, next->span.begin).begin;
  const bool indented = indentation(sources, next->span) > indentation(sources, statement.span);
  if (!field && !exclusive && item.name.text != "output" && !same_line && !indented) return;
  auto message = draft.diagnostics.report(Kind::kRelationSatellites, source::join({next->span.file, next->span.begin, next->span.begin}, item.name.span),
                                          {item.name.text, from.name.text, from.fields.front().text});
  if (field) message.suggest(fmt::format("satellites of {}", item.name.text));
  if (exclusive) message.suggest("satellites exclusive");
}

void declare_relation(Draft& draft, const syntax::Relation& from) {
  const auto id = static_cast<std::uint32_t>(draft.model.relations.size());
  if (!draft.names.declare(from.name, {Entity::Kind::kRelation, id, {}}, draft.diagnostics)) return;
  Relation relation;
  relation.name = std::string(from.name.text);
  relation.satellites = from.satellites;
  relation.exclusive = from.exclusive;
  relation.declared = from.name.span;
  for (const syntax::Name& field : from.fields) {
    if (find_field(relation, field.text)) {
      draft.diagnostics.report(Kind::kFieldTwice, field.span, {field.text, relation.name});
    } else {
      relation.fields.emplace_back(field.text);
    }
  }
  for (const syntax::Name& field : from.of) {
    if (find_field(relation, field.text)) continue;
    draft.diagnostics.report(Kind::kOfUnknownField, field.span, {relation.name, field.text})
        .suggest(draft.diagnostics.nearest(field.text, relation.fields));
  }
  draft.model.relations.push_back(std::move(relation));
}

/// Commands are rows of a relation that nobody declares: it has no fields, since a command says nothing but its name. (Sets and relations
/// have been declared before; whatever else has its name is reported where it is declared.)
void implicit_commands(Draft& draft) {
  const Entity* other = draft.names.find("Command");
  if (other != nullptr) draft.diagnostics.report(Kind::kNameOfCommands, other->declared, {"Command"});
  implicit_relation(draft, "Command", {});
}

}  // namespace

void declare_all(Draft& draft) {
  draft.each<syntax::Relation>([&](const syntax::Tree& tree, const syntax::Statement& statement, const syntax::Relation& relation) {
    check_clause(draft, tree, statement, relation);
    declare_relation(draft, relation);
  });
  implicit_commands(draft);
  choose_exits(draft);
  for (const syntax::Tree& tree : draft.forest.trees) {
    for (const syntax::Statement& statement : tree.statements) {
      if (draft.exhausted) return;
      if (const auto* declaration = std::get_if<Declaration>(&statement.node)) DeclarationReader(draft, tree, *declaration).run();
      if (const auto* map = std::get_if<syntax::Map>(&statement.node)) declare_map(draft, *map);
    }
  }
}

}  // namespace kb::model
