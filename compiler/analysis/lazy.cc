// Reports rules that take a lazy fact for absent while nobody has looked at it. Such a fact is perceived only while a rule waits for it, and
// is 0 and unseen otherwise.
#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Cond;
using program::CondId;
using program::Program;
using program::Rule;
using program::RuleId;
using Op = program::Cond::Op;

/// What is known of satellites at a moment: the regions that each can be in. One without an entry can be in any of its domain.
using Known = std::map<CellId, Regions>;

Regions allowed_by(const program::Demand& demand, const Domains& domains) {
  const Regions regions = regions_of(demand.term);
  return static_cast<Regions>((demand.negated ? ~regions : regions) & domains.all);
}

class Lazy {
 public:
  explicit Lazy(const Subject& subject) : subject_(subject), program_(subject.program), facts_(program_.perception.lazy_facts()) {
    for (std::size_t i = 0; i < facts_.size(); ++i) place_of_.emplace(facts_[i], i);
    reads_ = program::marked(program_, [&](const Cond& cond) { return !program::has_parts(cond.op) && is_lazy(cond.cell); });
  }

  void diagnose() {
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      const Rule& rule = program_.rules[i];
      if (Subject::generated(rule) || !reads_[program::index(rule.condition)]) continue;
      blind_.clear();
      look_through(RuleId{i}, rule.condition, false);
      for (const CellId fact : blind_) {
        if (!told(RuleId{i}, fact)) diagnose_blind(RuleId{i}, fact);
      }
    }
  }

 private:
  enum class Truth : std::uint8_t { kFalse, kOpen, kTrue };

  [[nodiscard]] bool is_lazy(CellId cell) const { return place_of_.contains(cell); }
  [[nodiscard]] bool told(RuleId rule, CellId fact) const { return told_.contains({subject_.family[program::index(rule)], fact, Op::kNot}); }

  /// Reports `event` and `lost` of lazy facts. Adds to `blind_` each lazy fact of which the condition asks what is also true while nobody
  /// looks: `not F`, `F zero`.
  void look_through(RuleId rule, CondId id, bool negated) {
    const Cond& cond = program_[id];
    for (const CondId child : cond.children) {
      if (reads_[program::index(child)]) look_through(rule, child, negated != (cond.op == Op::kNot));
    }
    if (program::has_parts(cond.op)) return;
    if (cond.op == Op::kEvent || cond.op == Op::kLost) return diagnose_edge(rule, cond);
    if (negated != (cond.op == Op::kIs && cond.term == program::Term::kZero)) blind_.insert(cond.cell);
  }

  void diagnose_edge(RuleId rule, const Cond& cond) {
    if (!told_.insert({subject_.family[program::index(rule)], cond.cell, cond.op}).second) return;
    const program::Cell& fact = program_[cond.cell];
    subject_.diagnostics.report(Kind::kLazyEdge, program_[rule].span, {fact.name, cond.op == Op::kEvent ? "event" : "lost"})
        .note(Kind::kSeenOfLazy, fact.declared, {fact.name});
  }

  /// Reports the rule if a rule of a higher level can let it begin to wait for the fact and fire on the same tick, before anybody looks.
  void diagnose_blind(RuleId id, CellId fact) {
    const Rule& rule = program_[id];
    const std::vector<program::Demand> demands = program::demands(program_, rule.condition);
    for (const program::Demand& demand : demands) {
      for (const RuleId waker : writers_of(demand.cell)) {
        if (program_[waker].level >= rule.level) break;   // rules are ordered by level
        const auto written = written_by(program_[waker], demand.cell);
        if ((region_of(*written, firing_) & allowed_by(demand, subject_.domains)) == 0 || !fires_blind(rule, demands, program_[waker], demand, fact)) continue;
        told_.insert({subject_.family[program::index(id)], fact, Op::kNot});
        subject_.diagnostics.report(Kind::kLazyNot, rule.span, {rule.name, program_[fact].name, program_[waker].name, program_[demand.cell].name})
            .note(Kind::kOtherRuleHere, program_[waker].span, {program_[waker].name})
            .note(Kind::kLowOfLazy, program_[fact].declared, {program_[fact].name});
        return;
      }
    }
  }

  /// Whether the rule can fire on the tick on which `waker` meets the demand `met`, although nobody has looked at the fact yet.
  [[nodiscard]] bool fires_blind(const Rule& rule, const std::vector<program::Demand>& demands, const Rule& waker, const program::Demand& met, CellId fact) {
    Known before;
    const auto narrow = [&](const program::Demand& demand) {
      Regions& regions = before.try_emplace(demand.cell, subject_.domains.cells[program::index(demand.cell)]).first->second;
      regions = static_cast<Regions>(regions & allowed_by(demand, subject_.domains));
      return regions != 0;
    };
    for (const program::Demand& demand : demands) {
      const auto written = written_by(waker, demand.cell);
      if (written ? (region_of(*written, firing_) & allowed_by(demand, subject_.domains)) == 0 : !narrow(demand)) return false;
    }
    for (const program::Demand& demand : program::demands(program_, waker.condition)) {
      if (!narrow(demand)) return false;
    }
    if (follows({met}, before) || awake(fact, before)) return false;
    return truth(rule.condition, before) != Truth::kFalse;
  }

  [[nodiscard]] bool follows(const std::vector<program::Demand>& demands, const Known& known) const {
    return std::all_of(demands.begin(), demands.end(), [&](const program::Demand& demand) {
      const auto at = known.find(demand.cell);
      const Regions can = at != known.end() ? at->second : subject_.domains.cells[program::index(demand.cell)];
      return (can & ~allowed_by(demand, subject_.domains)) == 0;
    });
  }

  /// Whether the fact is certainly looked at, by what is known.
  [[nodiscard]] bool awake(CellId fact, const Known& known) {
    if (users_.empty()) find_users();
    std::set<CellId> found{fact};
    for (std::vector<CellId> todo{fact}; !todo.empty();) {
      if (!is_lazy(todo.back())) return true;
      const std::size_t place = place_of_.at(todo.back());
      todo.pop_back();
      if (std::ranges::any_of(alternatives_[place], [&](const auto& demands) { return follows(demands, known); })) return true;
      std::ranges::copy_if(users_[place], std::back_inserter(todo), [&](CellId user) { return found.insert(user).second; });
    }
    return false;
  }

  /// Whether the condition holds while the lazy facts that nobody waits for are 0. Of all else nothing is known.
  [[nodiscard]] Truth truth(CondId id, const Known& known) {
    if (!reads_[program::index(id)]) return Truth::kOpen;
    const Cond& cond = program_[id];
    if (!program::has_parts(cond.op)) {
      if (cond.op == Op::kLost || awake(cond.cell, known)) return Truth::kOpen;
      return cond.op == Op::kIs && cond.term == program::Term::kZero ? Truth::kTrue : Truth::kFalse;
    }
    if (cond.op == Op::kNot) return static_cast<Truth>(2 - static_cast<int>(truth(cond.children.front(), known)));
    Truth all = cond.op == Op::kOr ? Truth::kFalse : Truth::kTrue;
    for (const CondId child : cond.children) {
      const Truth part = truth(child, known);
      all = cond.op == Op::kOr ? std::max(all, part) : std::min(all, part);
    }
    return cond.op == Op::kFor ? std::min(all, Truth::kOpen) : all;
  }

  void find_users() {
    alternatives_ = program::alternatives(program_, facts_);
    users_.resize(facts_.size());
    for (const program::Perceived& user : program_.perception.perceived) {
      std::vector<program::PerceptId> pending{user.percept};
      while (!pending.empty()) {
        const program::Percept& percept = program_.perception[pending.back()];
        pending.pop_back();
        pending.insert(pending.end(), percept.children.begin(), percept.children.end());
        if (percept.op == program::Percept::Op::kFact && is_lazy(percept.cell)) users_[place_of_.at(percept.cell)].push_back(user.fact);
      }
    }
  }

  /// The rules that write a cell by name or with the rest of its group, ascending.
  [[nodiscard]] std::vector<RuleId> writers_of(CellId cell) {
    const auto& named = subject_.writers.by_name[program::index(cell)];
    const std::uint32_t group = subject_.group_of[program::index(cell)];
    if (group == program::kNoGroup) return {named.begin(), named.end()};
    const std::vector<RuleId>& cleared = subject_.writers.by_clear[group];
    std::vector<RuleId> all;
    std::set_union(named.begin(), named.end(), cleared.begin(), cleared.end(), std::back_inserter(all));
    return all;
  }

  [[nodiscard]] std::optional<float> written_by(const Rule& rule, CellId cell) const {
    return program::net_value(program_, subject_.group_of, rule, cell);
  }

  const Subject& subject_;
  const Program& program_;
  const float firing_ = static_cast<float>(program_.settings.firing);
  std::vector<CellId> facts_;
  std::map<CellId, std::size_t> place_of_;                // by fact: its place among `facts_`
  std::vector<bool> reads_;                               // by condition: whether it reads a lazy fact
  std::vector<program::Alternatives> alternatives_;       // by place
  std::vector<std::vector<CellId>> users_;                // by place: the facts that are defined by it
  std::set<CellId> blind_;                                // of the rule at hand: see `look_through`
  std::set<std::tuple<std::uint32_t, CellId, Op>> told_;  // reported: rule as written, fact, and `event`, `lost`, or `not` for a blind one
};

}  // namespace

void diagnose_lazy(Subject& subject) {
  if (!subject.program.perception.lazy_facts().empty()) Lazy(subject).diagnose();
}

}  // namespace kb::analysis
