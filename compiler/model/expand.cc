// Rules: an instance of each template for every combination of what its binders range over.
#include <fmt/format.h>

#include <algorithm>

#include "compiler/model/binders.h"
#include "compiler/model/effects.h"

namespace kb::model {
namespace {

using diagnostics::Kind;

class RuleReader {
 public:
  RuleReader(Draft& draft, const syntax::Tree& tree, const syntax::Rule& rule)
      : draft_(draft), rule_(rule), references_(draft, tree, binders_, rule.name.text), conditions_(draft, tree, references_), effects_(draft, references_) {}

  void run() {
    const std::size_t errors = draft_.diagnostics.errors();
    const bool bound = read_binders(draft_, rule_.binders, binders_, ranges_);
    const bool level = read_level();
    condition_ = conditions_.compile(rule_.condition);
    const bool written = effects_.compile(rule_.effects);
    if (!bound || !level || !written) return;
    make_instances();
    if (draft_.diagnostics.errors() != errors) return;  // the part that could not be read may be the part that uses them
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
      if (!std::exchange(draft_.said_no_levels, true) && !draft_.library_missing) report_no_levels(draft_, rule_.level.span);
      return false;
    }
    const std::vector<std::string_view> candidates(levels.begin(), levels.end());
    draft_.diagnostics.report(Kind::kUnknownLevel, rule_.level.span, {rule_.level.text})
        .note(Kind::kLevelsStandHere, draft_.model.level_spans.front())
        .suggest(diagnostics::closest(rule_.level.text, candidates));
    return false;
  }

  void make_instances() {
    const auto count = combinations(draft_, ranges_, rule_.name);
    if (!count) return;
    const TemplateId tmpl{static_cast<std::uint32_t>(draft_.model.templates.size())};
    draft_.model.templates.push_back({std::string(rule_.name.text), rule_.name.span, draft_.standard(rule_.name.span), level_, rule_.mode});
    make_room(draft_.model.rules, std::min(*count, kMaxRules));
    make_room(draft_.model.conds, std::min(*count, kMaxRules));
    std::vector<std::size_t> at(ranges_.size(), 0);
    std::vector<Operand> values;
    for (bool more = *count > 0; more;) {
      values.clear();
      for (std::size_t b = 0; b < at.size(); ++b) values.push_back(ranges_[b].value(at[b]));
      if (!make_instance(tmpl, values, at)) return;
      // What is missing whatever the last variables are need not be tried with each of their values.
      for (std::size_t b = references_.take_missing(); b < at.size(); ++b) at[b] = ranges_[b].size() - 1;
      more = next_combination(at, [this](std::size_t b) { return ranges_[b].size(); });
    }
  }

  /// False if the template is broken or a limit is reached: the other instances would give the same message.
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

  [[nodiscard]] std::string_view instance_name(const std::vector<std::size_t>& at) const {
    std::string members;
    for (std::size_t b = 0; b < at.size(); ++b) (members += b == 0 ? '[' : ',') += ranges_[b].name(at[b]);
    return draft_.model.texts->keep({rule_.name.text, members, at.empty() ? "" : "]"});
  }

  Draft& draft_;
  const syntax::Rule& rule_;
  std::vector<Binder> binders_;
  std::vector<Range> ranges_;  // by binder
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
      draft.diagnostics.report(Kind::kRuleTwice, rule.name.span, {rule.name.text}).note(Kind::kFirstDeclaredHere, first->second).note(Kind::kRuleNamesShared, {});
    }
    RuleReader(draft, tree, rule).run();
  });
}

}  // namespace kb::model
