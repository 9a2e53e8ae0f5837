#include "tools/kbc/lsp/uses.h"

#include <algorithm>
#include <optional>
#include <span>
#include <tuple>

namespace kb::lsp {
namespace {

using model::SetId;
using Space = Meaning::Space;
using Set = std::optional<SetId>;

/// Reads all trees as the model does (compiler/model), for the places of one text alone.
class Reader {
 public:
  Reader(const Knowledge& knowledge, std::string_view text) : sources_(knowledge.compiled->sources), model_(knowledge.compiled->model), names_(knowledge.names), text_(text) {
    exits_ = set_of_roads("exit");
    methods_ = set_of_roads("by");
  }

  std::vector<Use> run(const model::Forest& forest) {
    for (const syntax::Tree& tree : forest) {
      tree_ = &tree;
      for (const syntax::Statement& statement : tree.statements) {
        at_ = statement.span;
        variables_ = {};
        std::visit([this](const auto& node) { read(node); }, statement.node);
      }
    }
    const auto place = [](const Use& use) { return std::tuple(use.span.file, use.span.begin); };
    std::ranges::stable_sort(out_, {}, place);
    out_.erase(std::unique(out_.begin(), out_.end(), [&](const Use& a, const Use& b) { return place(a) == place(b); }), out_.end());
    return std::move(out_);
  }

 private:
  using Binders = std::vector<syntax::Rule::Binder>;

  // ---- what is known

  template <class Things>
  static auto* called(const Things& things, std::string_view name) {
    const auto at = std::ranges::find(things, name, [](const auto& thing) -> std::string_view { return thing.name; });
    return at == things.end() ? nullptr : &*at;
  }
  [[nodiscard]] Set set_called(std::string_view name) const {
    if (const auto* set = called(model_.sets, name)) return SetId{static_cast<std::uint32_t>(set - model_.sets.data())};
    const auto* group = called(model_.groups, name);
    return group == nullptr || group->dimensions.size() != 1 ? Set() : group->dimensions.front();
  }
  [[nodiscard]] bool holds(SetId set, std::string_view name) const {
    const auto& members = model_.sets[index(set)].members;
    return std::ranges::find(members, name) != members.end();
  }
  [[nodiscard]] Set first_that_holds(std::string_view name) const {
    for (std::uint32_t i = 0; i < model_.sets.size(); ++i) {
      if (holds(SetId{i}, name)) return SetId{i};
    }
    return {};
  }
  /// Whether it is known where anything can be named.
  [[nodiscard]] bool is_name(std::string_view name) const {
    for (auto at = std::ranges::lower_bound(names_, name, {}, &model::KnownName::name); at != names_.end() && at->name == name; ++at) {
      if (at->kind != "rule" && at->kind != "level" && at->kind != "control") return true;
    }
    return false;
  }
  [[nodiscard]] Set set_of_roads(std::string_view field) const {
    const auto* const roads = called(model_.relations, "Road");
    if (roads == nullptr) return {};
    for (const model::RowId row : roads->rows) {
      const model::Value* const value = model_.field(model_[row], field);
      if (const auto* member = value == nullptr ? nullptr : std::get_if<model::Member>(value)) return member->set;
    }
    return {};
  }

  // ---- what is found

  void add(source::Span span, Meaning meaning, bool declares = false) {
    if (sources_.text(span) == text_) out_.push_back({span, meaning, declares});
  }
  void name(const syntax::Name& name, bool declares = false) { add(name.span, {Space::kName}, declares); }
  /// `find`: the set, asked only if it matters.
  template <class Find>
  void member(source::Span span, Find find, bool declares = false) {
    if (sources_.text(span) != text_) return;
    if (const Set set = find()) add(span, {Space::kMember, index(*set)}, declares);
  }
  [[nodiscard]] Meaning variable() const { return {Space::kVariable, (static_cast<std::uint64_t>(at_.file) << 32u) | at_.begin}; }
  [[nodiscard]] bool bound(std::string_view name) const { return std::ranges::find(variables_, name) != variables_.end(); }

  // ---- references

  void read(syntax::RefId id) {
    const syntax::Ref& ref = (*tree_)[id];
    const std::string_view base = ref.base.text;
    if (bound(base)) add(ref.base.span, variable());
    else name(ref.base);
    for (const syntax::Postfix& postfix : ref.postfixes) {
      if (postfix.kind != syntax::Postfix::Kind::kField) arguments(postfix, base);
      else if (&postfix == &ref.postfixes.front() && !bound(base)) member(postfix.field.span, [&] { return set_called(base); });
    }
  }
  /// Of the indexes of a group, the arguments of a table.
  [[nodiscard]] std::span<const SetId> sets_of(std::string_view base) const {
    if (const auto* group = called(model_.groups, base)) return group->dimensions;
    if (const auto* table = called(model_.tables, base)) return table->parameters;
    return {};
  }
  void arguments(const syntax::Postfix& postfix, std::string_view base) {
    for (std::size_t i = 0; i < postfix.arguments.size(); ++i) {
      const syntax::Index& argument = postfix.arguments[i];
      if (argument.star || argument.number) continue;
      const syntax::Ref& ref = (*tree_)[argument.ref];
      const bool asked = ref.postfixes.empty() && ref.base.text == text_ && !bound(text_);
      const std::span<const SetId> sets = asked ? sets_of(base) : std::span<const SetId>();
      if (i < sets.size() && holds(sets[i], text_)) add(ref.base.span, {Space::kMember, index(sets[i])});
      else if (asked && !is_name(text_)) member(ref.base.span, [&] { return first_that_holds(text_); });
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
    if (percept.kind == Kind::kFitsNamed) bound(percept.word.text) ? add(percept.word.span, variable()) : name(percept.word);
  }
  template <class Part>
  void read(const std::optional<Part>& part) {
    if (part) read(*part);
  }
  void read(const syntax::Name& written) { name(written); }
  void bind(const Binders& binders) {
    for (const syntax::Rule::Binder& binder : binders) {
      variables_.push_back(binder.variable.text);
      add(binder.variable.span, variable(), true);
      name(binder.set);
    }
  }
  /// `exit` and `leg` in it are those of a road.
  void read_of_leg(const std::optional<syntax::CondId>& when) {
    variables_ = {"exit", "leg"};
    if (when && text_ != "exit" && text_ != "leg") read(*when);
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
    for (const syntax::Name& one : set.members) member(one.span, [&] { return set_called(set.name.text); }, true);
  }
  void read(const syntax::Declaration& declaration) {
    for (const syntax::Declaration::Item& item : declaration.items) {
      const bool makes_set = item.shape == syntax::Declaration::Item::Shape::kMembers;
      name(item.name, true);
      for (const syntax::Name& one : item.names) makes_set ? member(one.span, [&] { return set_called(item.name.text); }, true) : name(one);
      for (const auto& definition : item.definitions) read(definition);
      read(item.of);
    }
    read(declaration.definition);
  }
  void read(const syntax::Priority& priority) {
    for (const syntax::RefId ref : priority.order) read(ref);
  }
  void read(const syntax::Relation& relation) { name(relation.name, true); }
  void read(const syntax::Row& row) {
    if (row.name) name(*row.name, true);
    name(row.relation);
    for (const syntax::Row::Field& field : row.fields) {
      const syntax::Cond& cond = (*tree_)[field.value];
      const bool plain = cond.kind == syntax::Cond::Kind::kIs && !cond.sat && !cond.negated && cond.term.text.empty() && (*tree_)[cond.ref].postfixes.empty();
      if (plain && (*tree_)[cond.ref].base.text == text_ && !is_name(text_)) member((*tree_)[cond.ref].base.span, [&] { return first_that_holds(text_); });
      else read(field.value);
    }
  }
  void read(const syntax::Map& map) {
    name(map.name, true);
    for (const syntax::Landmark& landmark : map.landmarks) name(landmark.name, true);
    for (const syntax::Road& road : map.roads) {
      add(road.from, {Space::kName});
      add(road.to, {Space::kName});
      member(road.exit, [&] { return exits_; });
      member(road.approach, [&] { return exits_; });
      if (road.by.known()) member(road.by, [&] { return methods_; });
    }
  }
  void read(const std::vector<syntax::Stop>& stops) {
    for (const syntax::Stop& stop : stops) {
      name(stop.landmark);
      if (stop.exit) member(stop.exit->span, [&] { return exits_; });
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
    const auto of = [&](auto set) {
      return [this, &table, set] {
        const auto* const known = called(model_.tables, table.name.text);
        return known == nullptr ? Set() : Set(set(*known));
      };
    };
    for (const syntax::Name& column : table.columns) member(column.span, of([](const model::Table& known) { return known.parameters.back(); }));
    for (const syntax::Table::Line& line : table.lines) {
      member(line.label.span, of([](const model::Table& known) { return known.parameters.front(); }));
      for (const syntax::Name& value : line.values) member(value.span, of([](const model::Table& known) { return known.result; }));
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
  /// A bare index that is no member is a variable: every member, and what an argument of that word takes.
  void read(const syntax::Control& control) {
    const syntax::Ref& ref = (*tree_)[control.strategy];
    for (const syntax::Postfix& postfix : ref.postfixes) {   // of `G.member` no index
      for (std::size_t i = 0; i < postfix.arguments.size(); ++i) {
        const auto* const at = postfix.arguments[i].star || postfix.arguments[i].number ? nullptr : &(*tree_)[postfix.arguments[i].ref];
        if (at == nullptr || !at->postfixes.empty() || at->base.text != text_) continue;
        const std::span<const SetId> sets = sets_of(ref.base.text);
        if (i >= sets.size() || holds(sets[i], text_)) continue;
        variables_.push_back(text_);
        add(at->base.span, variable(), true);
      }
    }
    read(control.strategy);
    if (control.controller.text == text_ && called(model_.fuzzy, text_) != nullptr) name(control.controller);
    for (const syntax::Control::Argument& argument : control.arguments) {
      if (!argument.number && bound(argument.word.text)) add(argument.word.span, variable());
    }
  }
  void read(const syntax::Prototype& prototype) { name(prototype.name, true); }
  void read(const syntax::Sensor& sensor) { name(sensor.name, true); }
  void read(const syntax::Perceive& perceive) {
    bind(perceive.binders);
    read(perceive.target);
    read(perceive.percept);
  }
  void read(const syntax::Fuzzy& fuzzy) { name(fuzzy.name, true); }

  const source::Sources& sources_;
  const model::Model& model_;
  const std::vector<model::KnownName>& names_;
  std::string_view text_;
  Set exits_, methods_;
  const syntax::Tree* tree_ = nullptr;
  source::Span at_;                            // the statement
  std::vector<std::string_view> variables_;    // that it has
  std::vector<Use> out_;
};

}  // namespace

std::vector<Use> uses(const Knowledge& knowledge, std::string_view text) {
  return Reader(knowledge, text).run(knowledge.compiled->forest);
}

std::vector<Use> uses_of_same(const Knowledge& knowledge, std::string_view text, std::string_view path, std::uint32_t begin) {
  const auto file = knowledge.file(path);
  std::vector<Use> all = uses(knowledge, text);
  const auto here = std::ranges::find_if(all, [&](const Use& use) { return use.span.file == file && use.span.begin == begin; });
  if (here == all.end()) return {};
  std::erase_if(all, [meaning = here->meaning](const Use& use) { return use.meaning != meaning; });
  return all;
}

}  // namespace kb::lsp
