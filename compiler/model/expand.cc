// Rules: every template once for each combination of what its binders range over.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/model/effects.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

/// The values of one binder, and how instances are named after them.
struct Domain {
  std::vector<Operand> values;
  std::vector<std::string_view> names;
};

class RuleReader {
 public:
  RuleReader(Draft& draft, const syntax::Tree& tree, const syntax::Rule& rule)
      : draft_(draft), rule_(rule), references_(draft, tree, binders_), conditions_(draft, tree, references_), effects_(draft, references_) {}

  void run() {
    const std::size_t errors = draft_.diagnostics.errors();
    const bool bound = read_binders();
    const bool level = read_level();
    condition_ = conditions_.compile(rule_.condition);
    const bool written = effects_.compile(rule_.effects);
    if (!bound || !level || !written) return;
    make_instances();
    if (draft_.diagnostics.errors() != errors) return;  // what was not read may be what uses them
    for (const Binder& binder : binders_) {
      if (!binder.used) draft_.diagnostics.report(Kind::kUnusedBinder, binder.name.span, {binder.name.text, rule_.name.text});
    }
  }

 private:
  bool read_level() {
    const std::vector<std::string>& levels = draft_.model.levels;
    const auto found = std::find(levels.begin(), levels.end(), rule_.level.text);
    if (found != levels.end()) {
      level_ = static_cast<std::uint32_t>(found - levels.begin());
      return true;
    }
    if (levels.empty()) {
      if (!std::exchange(draft_.said_no_levels, true) && !draft_.library_missing) draft_.diagnostics.report(Kind::kNoLevels, rule_.level.span);
      return false;
    }
    const std::vector<std::string_view> candidates(levels.begin(), levels.end());
    draft_.diagnostics.report(Kind::kUnknownLevel, rule_.level.span, {rule_.level.text})
        .note(Kind::kFirstDeclaredHere, draft_.model.level_spans.front())
        .suggest(diagnostics::closest(rule_.level.text, candidates));
    return false;
  }

  bool read_binders() {
    bool good = true;
    for (const syntax::Rule::Binder& from : rule_.binders) {
      const bool twice = std::any_of(binders_.begin(), binders_.end(), [&](const Binder& b) { return b.name.text == from.variable.text; });
      if (twice) {
        draft_.diagnostics.report(Kind::kBinderTwice, from.variable.span, {from.variable.text});
        good = false;
        continue;
      }
      Binder binder;
      binder.name = from.variable;
      Domain domain;
      const bool known = read_domain(from.set, binder, domain);
      binder.used = !known;  // nothing more is said of it
      good = good && known;
      binders_.push_back(binder);
      domains_.push_back(std::move(domain));
    }
    return good;
  }

  /// A relation's rows, a group's cells, or a set's members; the members of a group over one set stand for its cells too.
  bool read_domain(syntax::Name name, Binder& binder, Domain& domain) {
    const Entity* entity = draft_.names.find(name.text);
    if (entity != nullptr && entity->kind == Entity::Kind::kRelation) {
      binder.over = Binder::Over::kRows;
      binder.relation = RelationId{entity->id};
      for (const RowId row : draft_.model[binder.relation].rows) {
        Operand operand;
        operand.kind = Operand::Kind::kRow;
        operand.row = row;
        domain.values.push_back(std::move(operand));
        domain.names.push_back(draft_.model[row].name);
      }
      return true;
    }
    if (entity != nullptr && entity->kind == Entity::Kind::kGroup) return read_group(draft_.model.groups[entity->id], binder, domain);
    const auto set = need_set(draft_, name);
    if (set) add_members(*set, {}, domain);
    return set.has_value();
  }

  bool read_group(const Group& group, Binder& binder, Domain& domain) {
    if (group.dimensions.size() == 1) {
      add_members(group.dimensions.front(), group.cells, domain);
      return true;
    }
    binder.over = Binder::Over::kCells;
    for (const CellId cell : group.cells) {
      Operand operand;
      operand.kind = Operand::Kind::kCell;
      operand.cell = cell;
      domain.values.push_back(std::move(operand));
      domain.names.push_back(draft_.model[cell].name);
    }
    return true;
  }

  void add_members(SetId set, const std::vector<CellId>& cells, Domain& domain) {
    const std::vector<std::string>& members = draft_.model.sets[index(set)].members;
    for (std::uint32_t i = 0; i < members.size(); ++i) {
      Operand operand;
      operand.kind = Operand::Kind::kMember;
      operand.member = {set, i};
      if (!cells.empty()) operand.cell = cells[i];
      domain.values.push_back(std::move(operand));
      domain.names.push_back(members[i]);
    }
  }

  /// How many combinations there are; nothing, and said so, if they are too many.
  std::optional<std::size_t> combinations() {
    double exact = 1.0;
    for (const Domain& domain : domains_) exact *= static_cast<double>(domain.values.size());
    if (exact <= static_cast<double>(kMaxInstances)) return static_cast<std::size_t>(exact);
    draft_.diagnostics.report(Kind::kTooManyInstances, rule_.name.span,
                              {rule_.name.text, fmt::format("{:.0f}", exact), fmt::format("{}", kMaxInstances)});
    return std::nullopt;
  }

  void make_instances() {
    const auto count = combinations();
    if (!count) return;
    const TemplateId tmpl{static_cast<std::uint32_t>(draft_.model.templates.size())};
    draft_.model.templates.push_back({std::string(rule_.name.text), rule_.name.span, draft_.standard(rule_.name.span)});
    std::vector<std::size_t> at(domains_.size(), 0);
    std::vector<Operand> values;
    for (std::size_t i = 0; i < *count; ++i) {
      values.clear();
      for (std::size_t b = 0; b < at.size(); ++b) values.push_back(domains_[b].values[at[b]]);
      if (!make_instance(tmpl, values, at)) return;
      for (std::size_t b = at.size(); b-- > 0;) {
        if (++at[b] < domains_[b].values.size()) break;
        at[b] = 0;
      }
    }
  }

  /// False if the template is broken or a limit is reached: the other instances would say the same.
  bool make_instance(TemplateId tmpl, Environment values, const std::vector<std::size_t>& at) {
    const std::size_t conds = draft_.model.conds.size();
    Rule rule;
    const Outcome condition = conditions_.evaluate(condition_, values, rule.condition);
    const Outcome effects = condition == Outcome::kBroken ? Outcome::kBroken : effects_.evaluate(values, rule.effects);
    const Outcome worst = std::max(condition, effects);
    if (worst == Outcome::kBroken) return false;
    if (worst == Outcome::kMissing) {
      draft_.model.conds.resize(conds);
      return true;
    }
    if (over_limits(rule)) return false;
    rule.tmpl = tmpl;
    rule.name = instance_name(at);
    rule.level = level_;
    rule.mode = rule_.mode;
    rule.span = rule_.name.span;
    draft_.model.rules.push_back(std::move(rule));
    return true;
  }

  bool over_limits(const Rule& rule) {
    draft_.effects += rule.effects.size();
    const bool rules = draft_.model.rules.size() >= kMaxRules;
    if (!rules && draft_.effects <= kMaxEffects) return false;
    draft_.exhausted = true;
    draft_.diagnostics.report(rules ? Kind::kTooManyRules : Kind::kTooManyEffects, rule_.name.span,
                              {rule_.name.text, fmt::format("{}", rules ? kMaxRules : kMaxEffects)});
    return true;
  }

  [[nodiscard]] std::string instance_name(const std::vector<std::size_t>& at) const {
    std::string name(rule_.name.text);
    for (std::size_t b = 0; b < at.size(); ++b) {
      name += b == 0 ? '[' : ',';
      name += domains_[b].names[at[b]];
    }
    if (!at.empty()) name += ']';
    return name;
  }

  Draft& draft_;
  const syntax::Rule& rule_;
  std::vector<Binder> binders_;
  std::vector<Domain> domains_;  // by binder
  References references_;
  Conditions conditions_;
  Effects effects_;
  std::uint32_t condition_ = 0;
  std::uint32_t level_ = 0;
};

}  // namespace

void expand_rules(Draft& draft) {
  std::unordered_map<std::string_view, source::Span> known;
  draft.each<syntax::Rule>([&](const syntax::Tree& tree, const auto&, const syntax::Rule& rule) {
    if (draft.exhausted) return;
    const auto [first, fresh] = known.emplace(rule.name.text, rule.name.span);
    if (!fresh) {
      draft.diagnostics.report(Kind::kRuleTwice, rule.name.span, {rule.name.text}).note(Kind::kFirstDeclaredHere, first->second);
    }
    RuleReader(draft, tree, rule).run();
  });
}

}  // namespace kb::model
