#include "tools/kbc/lsp/uses.h"

#include <algorithm>
#include <map>
#include <span>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

#include "tools/kbc/lsp/uses_fuzzy.h"

namespace kb::lsp {
namespace {

using model::RelationId;
using model::SetId;
using Space = Meaning::Space;
using Set = std::optional<SetId>;
using Rows = std::optional<RelationId>;
using Numbers = std::unordered_map<std::string_view, std::uint32_t>;   // looked up, never iterated

/// Things by name; the first one if several have the same name.
template <class Things>
Numbers by_name(const Things& things) {
  Numbers out;
  for (std::uint32_t i = 0; i < things.size(); ++i) out.try_emplace(things[i].name, i);
  return out;
}

/// Reads all trees as the model does (compiler/model).
class Reader {
 public:
  Reader(const driver::Compilation& compiled, const std::vector<model::KnownName>& names)
      : model_(compiled.model), names_(names), sets_(by_name(model_.sets)), groups_(by_name(model_.groups)),
        tables_(by_name(model_.tables)), relations_(by_name(model_.relations)) {
    for (std::uint32_t i = 0; i < model_.sets.size(); ++i) {
      const auto& members = model_.sets[i].members;
      members_.emplace_back(members.begin(), members.end());
      for (const std::string& member : members) set_with_.try_emplace(member, i);
    }
    exits_ = set_of_roads(model_, "exit");
    methods_ = set_of_roads(model_, "by");
  }

  std::vector<Use> run(const model::Forest& forest) {
    for (const syntax::Tree& tree : forest.trees) {
      for (const syntax::Statement& statement : tree.statements) {
        const auto* const block = std::get_if<syntax::Fuzzy>(&statement.node);
        if (block != nullptr) blocks_.try_emplace(block->name.text, static_cast<std::uint32_t>(blocks_.size()));
      }
    }
    for (const syntax::Tree& tree : forest.trees) {
      tree_ = &tree;
      for (const syntax::Statement& statement : tree.statements) {
        at_ = statement.span;
        variables_.clear();
        std::visit([this](const auto& node) { read(node); }, statement.node);
      }
    }
    const auto place = [](const Use& use) { return std::tuple(use.span.file, use.span.begin); };
    std::ranges::stable_sort(out_, {}, place);
    out_.erase(std::unique(out_.begin(), out_.end(), [&](const Use& a, const Use& b) { return place(a) == place(b); }), out_.end());
    return std::move(out_);
  }

 private:
  struct Variable {
    std::string_view name;
    std::optional<Meaning> meaning;
    Rows rows;   ///< the rows that the variable ranges over, if it does
  };

  // ---- what is known

  template <class Thing>
  static const Thing* called(const std::vector<Thing>& things, const Numbers& numbers, std::string_view name) {
    const auto at = numbers.find(name);
    return at == numbers.end() ? nullptr : &things[at->second];
  }
  [[nodiscard]] Rows relation_called(std::string_view name) const {
    const auto at = relations_.find(name);
    return at == relations_.end() ? Rows() : RelationId{at->second};
  }
  [[nodiscard]] Set set_called(std::string_view name) const {
    if (const auto at = sets_.find(name); at != sets_.end()) return SetId{at->second};
    const auto* group = called(model_.groups, groups_, name);
    return group == nullptr || group->dimensions.size() != 1 ? Set() : group->dimensions.front();
  }
  [[nodiscard]] bool holds(SetId set, std::string_view name) const { return members_[index(set)].contains(name); }
  [[nodiscard]] Set first_that_holds(std::string_view name) const {
    const auto at = set_with_.find(name);
    return at == set_with_.end() ? Set() : SetId{at->second};
  }
  /// The thing of this name that can be named anywhere; null if there is none.
  [[nodiscard]] const model::KnownName* known(std::string_view name) const {
    for (auto at = std::ranges::lower_bound(names_, name, {}, &model::KnownName::name); at != names_.end() && at->name == name; ++at) {
      if (at->kind != "rule" && at->kind != "level" && at->kind != "control") return &*at;
    }
    return nullptr;
  }

  // ---- what is found

  void add(source::Span span, Meaning meaning, bool declares = false) { out_.push_back({span, meaning, declares}); }
  void name(const syntax::Name& name, bool declares = false) { add(name.span, {Space::kName}, declares); }
  void member(source::Span span, Set set, bool declares = false) {
    if (set) add(span, {Space::kMember, index(*set)}, declares);
  }
  void field(const syntax::Name& name, Rows of, bool declares = false) {
    if (of) add(name.span, {Space::kField, index(*of)}, declares);
  }
  /// Declares a variable of this statement.
  void variable(const syntax::Name& name, Rows rows = {}) {
    const Meaning meaning{Space::kVariable, (static_cast<std::uint64_t>(at_.file) << 32u) | at_.begin};
    variables_.push_back({name.text, meaning, rows});
    add(name.span, meaning, true);
  }
  [[nodiscard]] const Variable* bound(std::string_view name) const {
    const auto at = std::ranges::find(variables_, name, &Variable::name);
    return at == variables_.end() ? nullptr : &*at;
  }

  // ---- references

  void read(syntax::RefId id) {
    const syntax::Ref& ref = (*tree_)[id];
    const std::string_view base = ref.base.text;
    const Variable* const variable = bound(base);
    Rows rows = variable != nullptr ? variable->rows : Rows();
    if (variable == nullptr) {
      name(ref.base);
      if (const auto* row = ref.postfixes.empty() ? nullptr : known(base)) rows = relation_called(row->kind);   // a row is of the kind of its relation
    } else if (variable->meaning) {
      add(ref.base.span, *variable->meaning);
    }
    for (const syntax::Postfix& postfix : ref.postfixes) {
      if (postfix.kind != syntax::Postfix::Kind::kField) {
        arguments(postfix, base);
        rows = {};
      } else if (rows) {
        field(postfix.field, rows);
        rows = held(*rows, postfix.field.text);
      } else if (&postfix == &ref.postfixes.front() && variable == nullptr) {
        member(postfix.field.span, set_called(base));
      }
    }
  }
  Rows held(RelationId relation, std::string_view field) {
    const auto [at, fresh] = held_.try_emplace({relation, field});
    if (fresh) at->second = rows_in(model_, relation, field);
    return at->second;
  }
  /// The sets of a group's indexes, or of a table's arguments.
  [[nodiscard]] std::span<const SetId> sets_of(std::string_view base) const {
    if (const auto* group = called(model_.groups, groups_, base)) return group->dimensions;
    if (const auto* table = called(model_.tables, tables_, base)) return table->parameters;
    return {};
  }
  void arguments(const syntax::Postfix& postfix, std::string_view base) {
    const std::span<const SetId> sets = sets_of(base);
    for (std::size_t i = 0; i < postfix.arguments.size(); ++i) {
      const syntax::Index& argument = postfix.arguments[i];
      if (argument.star || argument.number) continue;
      const syntax::Ref& ref = (*tree_)[argument.ref];
      const bool asked = ref.postfixes.empty() && bound(ref.base.text) == nullptr;
      if (asked && i < sets.size() && holds(sets[i], ref.base.text)) member(ref.base.span, sets[i]);
      else if (asked && known(ref.base.text) == nullptr) member(ref.base.span, first_that_holds(ref.base.text));
      else read(argument.ref);
    }
  }
  void read(syntax::CondId id) {
    const syntax::Cond& cond = (*tree_)[id];
    for (const syntax::CondId child : cond.children) read(child);
    using Kind = syntax::Cond::Kind;
    if (cond.kind == Kind::kEvent || cond.kind == Kind::kLost || cond.kind == Kind::kSeen || cond.kind == Kind::kIs || cond.kind == Kind::kAny) read(cond.ref);
  }
  void read(syntax::PerceptId id) {
    const syntax::Percept& percept = (*tree_)[id];
    for (const syntax::PerceptId child : percept.children) read(child);
    using Kind = syntax::Percept::Kind;
    if (percept.kind == Kind::kFact || percept.kind == Kind::kFits || percept.kind == Kind::kFitsNamed || percept.kind == Kind::kReads) read(percept.ref);
    if (percept.kind != Kind::kFitsNamed) return;
    const Variable* const variable = bound(percept.word.text);
    variable != nullptr ? add(percept.word.span, *variable->meaning) : name(percept.word);
  }
  template <class Part>
  void read(const std::optional<Part>& part) {
    if (part) read(*part);
  }
  void read(const syntax::Name& written) { name(written); }
  void bind(const std::vector<syntax::Rule::Binder>& binders) {
    for (const syntax::Rule::Binder& binder : binders) {
      variable(binder.variable, relation_called(binder.set.text));
      name(binder.set);
    }
  }
  /// Reads a condition in which `exit` is that of `leg`.
  void read_of_leg(const std::optional<syntax::CondId>& when) {
    const Rows legs = relation_called("Leg");
    variables_ = {{"exit", legs ? std::optional(Meaning{Space::kField, index(*legs)}) : std::nullopt, {}}, {"leg", {}, legs}};
    read(when);
  }

  // ---- statements

  void read(const syntax::Import&) {}
  void read(const syntax::Levels& levels) {
    for (const syntax::Name& level : levels.names) add(level.span, {Space::kLevel}, true);
  }
  void read(const syntax::Set& set) {
    for (const syntax::Setting& setting : set.settings) {
      if (setting.key.text == "idle" && !setting.number && setting.word.text != "stop" && setting.word.text != "hold") read(setting.ref);
    }
  }
  void read(const syntax::NameSet& set) {
    name(set.name, !set.more);
    for (const syntax::Name& one : set.members) member(one.span, set_called(set.name.text), true);
  }
  void read(const syntax::Declaration& declaration) {
    for (const syntax::Declaration::Item& item : declaration.items) {
      const bool makes_set = item.shape == syntax::Declaration::Item::Shape::kMembers;
      name(item.name, true);
      for (const syntax::Name& one : item.names) makes_set ? member(one.span, set_called(item.name.text), true) : name(one);
      for (const auto& definition : item.definitions) read(definition);
      read(item.of);
    }
    read(declaration.definition);
  }
  void read(const syntax::Priority& priority) {
    for (const syntax::RefId ref : priority.order) read(ref);
  }
  void read(const syntax::Relation& relation) {
    const Rows rows = relation_called(relation.name.text);
    name(relation.name, true);
    for (const syntax::Name& one : relation.fields) field(one, rows, true);
    for (const syntax::Name& one : relation.of) field(one, rows);
  }
  void read(const syntax::Row& row) {
    if (row.name) name(*row.name, true);
    name(row.relation);
    for (const syntax::Row::Field& one : row.fields) {
      field(one.name, relation_called(row.relation.text));
      const syntax::Cond& cond = (*tree_)[one.value];
      const bool plain = cond.kind == syntax::Cond::Kind::kIs && !cond.sat && !cond.negated && cond.term.text.empty() && (*tree_)[cond.ref].postfixes.empty();
      if (plain && known((*tree_)[cond.ref].base.text) == nullptr) member((*tree_)[cond.ref].base.span, first_that_holds((*tree_)[cond.ref].base.text));
      else read(one.value);
    }
  }
  void read(const syntax::Map& map) {
    name(map.name, true);
    for (const syntax::Landmark& landmark : map.landmarks) name(landmark.name, true);
    for (const syntax::Road& road : map.roads) {
      add(road.from, {Space::kName});
      add(road.to, {Space::kName});
      member(road.exit, exits_);
      member(road.approach, exits_);
      if (road.by.known()) member(road.by, methods_);
    }
  }
  void read(const std::vector<syntax::Stop>& stops) {
    for (const syntax::Stop& stop : stops) {
      name(stop.landmark);
      if (stop.exit) member(stop.exit->span, exits_);
    }
  }
  void read(const syntax::Route& route) {
    name(route.name, true);
    name(route.map);
    name(route.command);
    read(route.stops);
  }
  void read(const syntax::Detour& detour) {
    read(detour.stops);
    read(detour.on);
    read_of_leg(detour.when);
  }
  void read(const syntax::Detours& detours) {
    name(detours.route);
    read_of_leg(detours.when);
  }
  void read(const syntax::Table& table) {
    name(table.name, !table.more);
    for (const syntax::Name& parameter : table.parameters) name(parameter);
    if (!table.more) name(table.result);
    const auto* const known = called(model_.tables, tables_, table.name.text);
    if (known == nullptr) return;
    for (const syntax::Name& column : table.columns) member(column.span, known->parameters.back());
    for (const syntax::Table::Line& line : table.lines) {
      member(line.label.span, known->parameters.front());
      for (const syntax::Name& value : line.values) member(value.span, known->result);
    }
  }
  void read(const syntax::Rule& rule) {
    add(rule.name.span, {Space::kRule}, true);
    bind(rule.binders);
    add(rule.level.span, {Space::kLevel});
    read(rule.condition);
    for (const syntax::Effect& effect : rule.effects) {
      if (effect.kind != syntax::Effect::Kind::kReset) read(effect.ref);
    }
  }
  /// A bare index that is not a member is a variable: it stands for every member, and an argument with the same word gets that member.
  void read(const syntax::Control& control) {
    const syntax::Ref& ref = (*tree_)[control.strategy];
    const std::span<const SetId> sets = sets_of(ref.base.text);
    for (const syntax::Postfix& postfix : ref.postfixes) {   // `G.member` has no index
      for (std::size_t i = 0; i < std::min(postfix.arguments.size(), sets.size()); ++i) {
        const auto* const at = postfix.arguments[i].star || postfix.arguments[i].number ? nullptr : &(*tree_)[postfix.arguments[i].ref];
        if (at != nullptr && at->postfixes.empty() && !holds(sets[i], at->base.text) && bound(at->base.text) == nullptr) variable(at->base);
      }
    }
    read(control.strategy);
    const auto block = blocks_.find(control.controller.text);
    const bool fuzzy = block != blocks_.end();
    fuzzy ? name(control.controller) : add(control.controller.span, {Space::kController});
    const Meaning argument_of = fuzzy ? Meaning{Space::kInput, block->second} : Meaning{Space::kArgument, controllers_.try_emplace(control.controller.text, static_cast<std::uint32_t>(controllers_.size())).first->second};
    for (const syntax::Control::Argument& argument : control.arguments) {
      add(argument.name.span, argument_of);
      const Variable* const variable = argument.number ? nullptr : bound(argument.word.text);
      if (variable != nullptr) add(argument.word.span, *variable->meaning);
    }
  }
  void read(const syntax::Prototype& prototype) { name(prototype.name, true); }
  void read(const syntax::Sensor& sensor) { name(sensor.name, true); }
  void read(const syntax::Perceive& perceive) {
    bind(perceive.binders);
    read(perceive.target);
    read(perceive.percept);
  }

  void read(const syntax::Fuzzy& fuzzy) {
    name(fuzzy.name, true);
    add_uses(fuzzy, blocks_.at(fuzzy.name.text), out_);
  }

  const model::Model& model_;
  const std::vector<model::KnownName>& names_;
  Numbers sets_, groups_, tables_, relations_, blocks_, controllers_;
  std::vector<std::unordered_set<std::string_view>> members_;   // by set
  Numbers set_with_;                                            // by member: the first such set
  Set exits_, methods_;
  std::map<std::pair<RelationId, std::string_view>, Rows> held_;
  const syntax::Tree* tree_ = nullptr;
  source::Span at_;                    // the place of the statement
  std::vector<Variable> variables_;    // of the statement
  std::vector<Use> out_;
};

}  // namespace

std::vector<Use> uses(const driver::Compilation& compiled, const std::vector<model::KnownName>& names) { return Reader(compiled, names).run(compiled.forest); }

std::optional<model::RelationId> relation_called(const model::Model& model, std::string_view name) {
  const auto at = std::ranges::find(model.relations, name, &model::Relation::name);
  return at == model.relations.end() ? Rows() : RelationId{static_cast<std::uint32_t>(at - model.relations.begin())};
}

std::optional<model::SetId> set_of_roads(const model::Model& model, std::string_view field) {
  const auto road = relation_called(model, "Road");
  if (!road) return {};
  for (const model::RowId row : model[*road].rows) {
    const model::Value* const value = model.field(model[row], field);
    if (const auto* member = value == nullptr ? nullptr : std::get_if<model::Member>(value)) return member->set;
  }
  return {};
}

std::optional<model::RelationId> rows_in(const model::Model& model, model::RelationId relation, std::string_view field) {
  if (const auto written = model::rows_written_in(model[relation].name, field)) return relation_called(model, *written);
  for (const model::RowId row : model[relation].rows) {
    const model::Value* const value = model.field(model[row], field);
    if (const auto* held = value == nullptr ? nullptr : std::get_if<model::RowId>(value)) return model[*held].relation;
  }
  return {};
}

}  // namespace kb::lsp
