// Compiles references: looks up names, and evaluates what does not depend on binders.
#include "compiler/model/references.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "compiler/diagnostics/display.h"
#include "compiler/model/known_names.h"

namespace kb::model {

using diagnostics::Kind;

namespace {

/// What the compiler writes into the fields of the relations that maps, routes and detours fill: the relation of the row, or nothing
/// if the field holds something else. Fields that are not listed belong to the library.
struct WrittenField { std::string_view relation, field, holds; };
constexpr std::array kWritten = {
    WrittenField{"Landmark", "at", ""},
    WrittenField{"Road", "from", "Landmark"}, WrittenField{"Road", "to", "Landmark"}, WrittenField{"Road", "exit", ""},
    WrittenField{"Road", "approach", ""},     WrittenField{"Road", "by", ""},
    WrittenField{"Leg", "from", "Landmark"},  WrittenField{"Leg", "to", "Landmark"},  WrittenField{"Leg", "exit", ""},
    WrittenField{"Leg", "approach", ""},      WrittenField{"Leg", "by", ""},          WrittenField{"Leg", "road", "Road"},
    WrittenField{"Leg", "next", "Leg"},       WrittenField{"Leg", "ends", "Route"},
    WrittenField{"Route", "command", "Command"}, WrittenField{"Route", "first", "Leg"},
    WrittenField{"Detour", "instead", "Leg"}, WrittenField{"Detour", "first", "Leg"}, WrittenField{"Detour", "when", ""},
    WrittenField{"Retreat", "leg", "Leg"},    WrittenField{"Retreat", "back", "Leg"},
    WrittenField{"Recheck", "leg", "Leg"},    WrittenField{"Recheck", "back", "Leg"},
    WrittenField{"Rejoin", "route", "Route"}, WrittenField{"Rejoin", "at", "Landmark"}, WrittenField{"Rejoin", "leg", "Leg"}, WrittenField{"Rejoin", "last", "Leg"},
};

}  // namespace

std::optional<std::string_view> rows_written_in(std::string_view relation, std::string_view field) {
  const auto* const written = std::find_if(kWritten.begin(), kWritten.end(), [&](const WrittenField& one) { return one.relation == relation && one.field == field; });
  return written == kWritten.end() ? std::nullopt : std::optional(written->holds);
}

std::uint32_t References::add(Pattern pattern) {
  if (pattern.op == Pattern::Op::kBinder) pattern.depends_on = pattern.binder + std::size_t{1};
  if (pattern.op == Pattern::Op::kField) pattern.depends_on = patterns_[pattern.object].depends_on;
  for (const Argument& argument : pattern.arguments) {
    if (!argument.star) pattern.depends_on = std::max(pattern.depends_on, patterns_[argument.pattern].depends_on);
  }
  patterns_.push_back(std::move(pattern));
  return static_cast<std::uint32_t>(patterns_.size() - 1);
}

std::uint32_t References::add_constant(Operand operand, source::Span span, RelationId relation) {
  Pattern pattern;
  pattern.span = span;
  pattern.constant = std::move(operand);
  pattern.relation = relation;
  return add(std::move(pattern));
}

References::RowState References::row_state(std::uint32_t pattern) const {
  if (patterns_[pattern].relation == RelationId::kNone || constant(pattern)) return RowState::kUnknown;
  return row_state(draft_.model[patterns_[pattern].relation]);
}

References::RowState References::row_state(const Relation& relation) {
  if (relation.satellites) return RowState::kSatellite;
  return relation.name == "Landmark" || relation.name == "Command" ? RowState::kFact : RowState::kNone;
}

std::string References::describe_row(std::uint32_t pattern) const {
  return "a row of `" + draft_.model[patterns_[pattern].relation].name + "`";
}

/// Evaluates a pattern whose parts are all constant.
std::uint32_t References::fold(std::uint32_t id) {
  const Pattern& pattern = patterns_[id];
  bool same = pattern.op != Pattern::Op::kBinder;
  if (pattern.op == Pattern::Op::kField) same = constant(pattern.object);
  for (const Argument& argument : pattern.arguments) same = same && (argument.star || constant(argument.pattern));
  if (!same) return id;
  Operand operand = evaluate(id, {});
  if (operand.kind == Operand::Kind::kRow) patterns_[id].relation = draft_.model[operand.row].relation;
  patterns_[id].constant = std::move(operand);
  patterns_[id].op = Pattern::Op::kConstant;
  return id;
}

std::uint32_t References::compile(syntax::RefId id) {
  const syntax::Ref& ref = tree_[id];
  std::size_t next = 0;
  std::uint32_t pattern = compile_base(ref, next);
  for (; next < ref.postfixes.size(); ++next) {
    if (constant(pattern) && value(pattern).kind == Operand::Kind::kBroken) return pattern;
    const syntax::Postfix& postfix = ref.postfixes[next];
    const source::Span span = source::join(ref.base.span, postfix.span);
    switch (postfix.kind) {
      case syntax::Postfix::Kind::kField: pattern = compile_field(pattern, postfix, span); break;
      case syntax::Postfix::Kind::kIndex: pattern = compile_index(pattern, postfix, span); break;
      case syntax::Postfix::Kind::kCall:
        draft_.diagnostics.report(Kind::kNotATable, ref.base.span, {text(pattern), constant(pattern) ? describe(value(pattern)) : "no name of a table"});
        return add_broken(span);
    }
  }
  return pattern;
}

std::uint32_t References::compile_base(const syntax::Ref& ref, std::size_t& postfix) {
  for (std::uint32_t i = 0; i < binders_.size(); ++i) {
    if (binders_[i].name.text != ref.base.text) continue;
    binders_[i].used = true;
    if (binders_[i].broken) return add_broken(ref.base.span);
    Pattern pattern;
    pattern.op = Pattern::Op::kBinder;
    pattern.span = ref.base.span;
    pattern.binder = i;
    pattern.relation = binders_[i].relation;
    return add(std::move(pattern));
  }
  if (const Entity* entity = draft_.names.find(ref.base.text)) return compile_entity(*entity, ref, postfix);
  report_unknown(ref.base);
  return add_broken(ref.base.span);
}

std::uint32_t References::compile_entity(const Entity& entity, const syntax::Ref& ref, std::size_t& postfix) {
  Operand operand;
  RelationId relation = RelationId::kNone;
  switch (entity.kind) {
    case Entity::Kind::kBroken: break;
    case Entity::Kind::kFact:
    case Entity::Kind::kSatellite:
    case Entity::Kind::kStrategy:
      operand = Operand::of(CellId{entity.id});
      break;
    case Entity::Kind::kGroup:
      operand.kind = Operand::Kind::kGroup;
      operand.whole = entity.id;
      break;
    case Entity::Kind::kRelation:
      operand.kind = Operand::Kind::kRelation;
      operand.whole = entity.id;
      break;
    case Entity::Kind::kLandmark:
    case Entity::Kind::kCommand:
    case Entity::Kind::kRoute:
    case Entity::Kind::kRow:
      operand = Operand::of(RowId{entity.id});
      relation = draft_.model[operand.row].relation;
      break;
    case Entity::Kind::kTable:
      if (postfix < ref.postfixes.size() && ref.postfixes[postfix].kind == syntax::Postfix::Kind::kCall) {
        const syntax::Postfix& call = ref.postfixes[postfix++];
        return compile_call(entity.id, call, source::join(ref.base.span, call.span));
      }
      draft_.diagnostics.report(Kind::kTableWithoutArguments, ref.base.span, {ref.base.text})
          .note(Kind::kNameDeclaredHere, entity.declared, {ref.base.text});
      break;
    case Entity::Kind::kSet:
    case Entity::Kind::kMap:
    case Entity::Kind::kPrototype:
    case Entity::Kind::kSensor:
    case Entity::Kind::kFuzzy:
      operand.kind = Operand::Kind::kOther;
      operand.other = entity.kind;
      break;
  }
  return add_constant(std::move(operand), ref.base.span, relation);
}

void References::report_unknown(const syntax::Name& name) {
  if (name.text.empty() || !draft_.unknown_names.emplace(name.text, true).second) return;
  if (const auto member = draft_.member_anywhere(name.text)) {
    const FiniteSet& set = draft_.model.sets[index(member->set)];
    draft_.diagnostics.report(Kind::kBareMember, name.span, {name.text, set.name})
        .note(Kind::kNameDeclaredHere, set.places[member->index], {name.text});
    return;
  }
  if (std::ranges::find(kTermWords, name.text) != kTermWords.end()) {
    draft_.diagnostics.report(Kind::kUnknownName, name.span, {name.text}).note(Kind::kTermAlone, {}, {name.text});
    return;
  }
  model::report_unknown(draft_, Kind::kUnknownName, name, draft_.diagnostics.nearest_of(name.text, [&](auto& candidates) {
    for (const Binder& binder : binders_) candidates.push_back(binder.name.text);
    for (const Names::Named& known : draft_.names.all()) candidates.push_back(known.text);
  }));
}

std::uint32_t References::compile_field(std::uint32_t object, const syntax::Postfix& postfix, source::Span span) {
  if (constant(object) && value(object).kind == Operand::Kind::kGroup) return compile_member_field(object, postfix, span);
  if (constant(object) && value(object).kind == Operand::Kind::kOther) {
    if (const auto member = member_of(object, postfix.field)) return add_constant(*member, span);
  }
  const bool row = patterns_[object].op == Pattern::Op::kField || patterns_[object].relation != RelationId::kNone;
  if (!row) {
    std::string what = constant(object)                                   ? describe(value(object))
                       : patterns_[object].op == Pattern::Op::kIndex ? "a cell"
                                                                     : "a member of a finite set";
    if (constant(object) && has_row(value(object), postfix.field.text)) {
      what.append(", which are called by their own names (`").append(postfix.field.text).append("`),");
    }
    draft_.diagnostics.report(Kind::kNoFields, postfix.field.span, {text(object), what, postfix.field.text});
    return add_broken(span);
  }
  Pattern pattern;
  pattern.op = Pattern::Op::kField;
  pattern.span = span;
  pattern.object = object;
  pattern.field = postfix.field;
  if (const RelationId relation = patterns_[object].relation; relation != RelationId::kNone) {
    const Relation& known = draft_.model[relation];
    if (!find_field(known, postfix.field.text)) {
      report_unknown_field(draft_, known, postfix.field);
      return add_broken(span);
    }
    if (const auto holds = rows_written_in(known.name, postfix.field.text)) {
      if (!holds->empty()) pattern.relation = find_relation(draft_, *holds).value_or(RelationId::kNone);
    } else {
      check_filled(relation, postfix.field);
    }
  }
  return fold(add(std::move(pattern)));
}

/// `Direction.N`, where nothing else says to which set the member belongs.
std::optional<Operand> References::member_of(std::uint32_t object, const syntax::Name& name) const {
  const auto set = draft_.set_of.find(text(object));
  const auto member = set == draft_.set_of.end() ? std::nullopt : draft_.member(set->second, name.text);
  if (!member) return std::nullopt;
  return Operand::of(*member);
}

/// Warns about a field that no row has, although the relation has rows: a rule that reads it has no instances, which is hardly meant.
void References::check_filled(RelationId relation, const syntax::Name& field) {
  if (!draft_.rows_written) return;
  const Relation& known = draft_.model[relation];
  const std::size_t place = *find_field(known, field.text);
  for (const RowId row : known.rows) {
    if (!std::holds_alternative<std::monostate>(draft_.model.fields(draft_.model[row])[place])) return;
  }
  if (!known.rows.empty()) draft_.diagnostics.report(Kind::kUnfilledField, field.span, {known.name, field.text});
}

/// `In.N`
std::uint32_t References::compile_member_field(std::uint32_t object, const syntax::Postfix& postfix, source::Span span) {
  const Group& group = draft_.model.groups[value(object).whole];
  if (group.dimensions.size() != 1) {
    report_index_count(group, 1, postfix.field.span, true);
    return add_broken(span);
  }
  const FiniteSet& set = draft_.model.sets[index(group.dimensions.front())];
  if (const auto member = draft_.member(group.dimensions.front(), postfix.field.text)) {
    return add_constant(Operand::of(group.cells[member->index]), span);
  }
  if (std::ranges::any_of(binders_, [&](const Binder& b) { return b.name.text == postfix.field.text; })) {
    draft_.diagnostics.report(Kind::kUnknownMember, span, {postfix.field.text, group.name})
        .note(Kind::kNameDeclaredHere, group.declared, {group.name})
        .suggest(fmt::format("{}[{}]", text(object), postfix.field.text));
  } else {
    report_unknown_member(draft_, Kind::kUnknownMember, postfix.field, {group.name, group.declared, set});
  }
  return add_broken(span);
}

void References::report_index_count(const Group& group, std::size_t given, source::Span at, bool dotted) {
  std::string wanted, together;
  for (const SetId set : group.dimensions) {
    wanted += (wanted.empty() ? "`" : " and `") + draft_.model.sets[index(set)].name + "`";
    together += (together.empty() ? "" : ", ") + draft_.model.sets[index(set)].name;
  }
  auto message = draft_.diagnostics.report(Kind::kIndexCount, at, {group.name, "a member of " + wanted, diagnostics::counted(given, "index", "indexes")});
  if (dotted) message.note(Kind::kIndexesTogether, {}, {group.name, together});
  message.note(Kind::kNameDeclaredHere, group.declared, {group.name});
}

bool References::has_row(const Operand& relation, std::string_view name) const {
  if (relation.kind != Operand::Kind::kRelation) return false;
  const auto& rows = draft_.model.relations[relation.whole].rows;
  return std::any_of(rows.begin(), rows.end(), [&](RowId row) { return draft_.model[row].name == name; });
}

std::string References::named_member(std::uint32_t pattern, std::string_view name) const {
  if (!constant(pattern)) return {};
  const Operand& whole = value(pattern);
  if (has_row(whole, name)) return std::string(name);
  if (whole.kind != Operand::Kind::kGroup || draft_.model.groups[whole.whole].dimensions.size() != 1) return {};
  const SetId set = draft_.model.groups[whole.whole].dimensions.front();
  const bool variable = std::ranges::any_of(binders_, [&](const Binder& one) { return one.name.text == name && one.set == set; });
  if (variable) return fmt::format("{}[{}]", text(pattern), name);
  return draft_.member(set, name) ? fmt::format("{}.{}", text(pattern), name) : std::string();
}

std::uint32_t References::compile_index(std::uint32_t object, const syntax::Postfix& postfix, source::Span span) {
  const bool lone_star = postfix.arguments.size() == 1 && postfix.arguments.front().star;
  const Operand::Kind kind = constant(object) ? value(object).kind : Operand::Kind::kRow;
  if (kind == Operand::Kind::kRelation && lone_star) return add_constant(Operand(value(object)), span);
  if (kind != Operand::Kind::kGroup) {
    const std::string what = constant(object) ? describe(value(object)) : "one of many values";
    draft_.diagnostics.report(Kind::kNotIndexed, postfix.span, {text(object), what});
    return add_broken(span);
  }
  Pattern pattern;
  pattern.op = Pattern::Op::kIndex;
  pattern.span = span;
  pattern.target = value(object).whole;
  const Group& group = draft_.model.groups[pattern.target];
  if (postfix.arguments.size() != group.dimensions.size() && !lone_star) {
    report_index_count(group, postfix.arguments.size(), postfix.span);
    return add_broken(span);
  }
  for (std::size_t i = 0; i < group.dimensions.size(); ++i) {
    if (lone_star) {
      pattern.arguments.push_back({true, 0});
      continue;
    }
    const syntax::Index& argument = postfix.arguments[i];
    pattern.arguments.push_back({argument.star, argument.star ? 0 : compile_argument(argument, group.dimensions[i])});
  }
  return fold(add(std::move(pattern)));
}

std::uint32_t References::compile_call(std::uint32_t id, const syntax::Postfix& postfix, source::Span span) {
  const Table& table = draft_.model.tables[id];
  if (postfix.arguments.size() != table.parameters.size()) {
    draft_.diagnostics.report(Kind::kArgumentCount, postfix.span,
                              {table.name, diagnostics::counted(table.parameters.size(), "argument"),
                               diagnostics::counted(postfix.arguments.size(), "stands", "stand")})
        .note(Kind::kNameDeclaredHere, table.declared, {table.name});
    return add_broken(span);
  }
  Pattern pattern;
  pattern.op = Pattern::Op::kCall;
  pattern.span = span;
  pattern.target = id;
  for (std::size_t i = 0; i < postfix.arguments.size(); ++i) {
    if (postfix.arguments[i].star) {
      draft_.diagnostics.report(Kind::kStarInCall, postfix.arguments[i].span, {table.name});
      return add_broken(span);
    }
    pattern.arguments.push_back({false, compile_argument(postfix.arguments[i], table.parameters[i])});
  }
  return fold(add(std::move(pattern)));
}

/// Where a member of `set` is wanted, a bare name is a binder if there is one of that name, else the member, else anything else.
std::uint32_t References::compile_argument(const syntax::Index& argument, SetId set) {
  if (argument.number) {
    draft_.diagnostics.report(Kind::kNumberAsIndex, argument.span, {text(argument.span)});
    return add_broken(argument.span);
  }
  const syntax::Ref& ref = tree_[argument.ref];
  const bool bound = std::any_of(binders_.begin(), binders_.end(), [&](const Binder& b) { return b.name.text == ref.base.text; });
  if (bound || !ref.postfixes.empty()) return compile(argument.ref);
  if (const auto member = draft_.member(set, ref.base.text)) return add_constant(Operand::of(*member), ref.span);
  if (draft_.names.find(ref.base.text) != nullptr) return compile(argument.ref);
  // A member of the wrong set is reported when it is evaluated.
  if (const auto member = draft_.member_anywhere(ref.base.text)) return add_constant(Operand::of(*member), ref.span);
  report_unknown_index(ref.base, set);
  return add_broken(ref.span);
}

/// What is no member may be a variable that was misspelt or not declared.
void References::report_unknown_index(const syntax::Name& name, SetId set) {
  const FiniteSet& known = draft_.model.sets[index(set)];
  Variables variables{{}, {}, rule_};
  for (const Binder& binder : binders_) {
    variables.names.push_back(binder.name.text);
    if (binder.set == set && !binder.used) variables.unused = binder.name.text;
  }
  report_unknown_member(draft_, Kind::kUnknownMember, name, {known.name, {}, known}, variables);
}

}  // namespace kb::model
