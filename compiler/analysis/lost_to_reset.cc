// Reports rules that follow a state which is kept, and lose what they raise to a `reset`: their condition stays true, so they do not fire again.
//
// By what a strategy is wanted is left out: a reset may well be there to stop the robot, which had better not set out again by itself.
#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::CellKind;
using program::Cond;
using program::CondId;
using program::Program;
using program::Rule;
using program::RuleId;

struct Lost {
  CellId cell = CellId::kNone;    // that a reset lowers
  CellId state = CellId::kNone;   // that the rule follows
  RuleId reset = RuleId::kNone;
};

class LostToReset {
 public:
  explicit LostToReset(const Subject& subject)
      : subject_(subject), program_(subject.program), firing_(static_cast<float>(program_.settings.firing)), satisfier_(subject.satisfier()),
        is_high_(program_.cells.size(), CondId::kNone), passed_over_(program_.cells.size(), false) {
    for (const CellId strategy : program_.priority) {
      for (const CellId satellite : program_[strategy].satellites) passed_over_[program::index(satellite)] = true;
    }
    for (std::uint32_t i = 0; i < program_.conds.size(); ++i) {
      const Cond& cond = program_.conds[i];
      if (cond.op == Cond::Op::kIs && cond.term == program::Term::kHigh) is_high_[program::index(cond.cell)] = CondId{i};
    }
  }

  void run() {
    if (subject_.writers.by_reset.empty()) return;
    ByFamily<Lost> found(subject_);
    for (std::uint32_t i = 0; i < program_.rules.size() && satisfier_.steps() < Satisfier::kTotalSteps; ++i) {
      if (const auto lost = lost_by(program_.rules[i])) found.add(RuleId{i}, *lost);
    }
    found.for_each([&](RuleId id, const Lost& lost, std::uint32_t count) {
      const program::Cell& cell = program_[lost.cell];
      const bool own = cell.name.starts_with("sat ");   // which cannot be declared `keep`
      const Rule& reset = program_[lost.reset];
      subject_.diagnostics.report(Kind::kLostToReset, program_[id].span, {cell.name, program_[id].name, program_[lost.state].name, own ? "" : "declare it `keep` too, or ", more(count)})
          .note(Kind::kOtherRuleHere, reset.span, {reset.name});
    });
  }

 private:
  static constexpr std::size_t kMostParts = 64;

  [[nodiscard]] std::optional<Lost> lost_by(const Rule& rule) {
    const CellId state = kept_state(rule);
    if (state == CellId::kNone) return std::nullopt;
    for (const program::Write& write : rule.writes) {
      if (write.value < firing_ || program_[write.cell].keep || program_[write.cell].initial >= firing_ || passed_over_[program::index(write.cell)]) continue;
      if (!follows(rule, write.cell)) continue;
      if (const RuleId reset = reset_beside(rule, write.cell); reset != RuleId::kNone) return Lost{write.cell, state, reset};
    }
    return std::nullopt;
  }

  /// A kept satellite that a `when` rule waits for, if it waits for nothing else. What must not be may be anything.
  [[nodiscard]] CellId kept_state(const Rule& rule) const {
    if (rule.mode != program::Mode::kWhen || rule.reset || Subject::generated(rule)) return CellId::kNone;
    CellId state = CellId::kNone;
    return waits_for_kept(rule.condition, true, state) ? state : CellId::kNone;
  }

  /// Recursion as deep as conditions nest.
  [[nodiscard]] bool waits_for_kept(CondId id, bool wanted, CellId& state) const {
    const Cond& cond = program_[id];
    switch (cond.op) {
      case Cond::Op::kNot: return waits_for_kept(cond.children.front(), !wanted, state);
      case Cond::Op::kAnd:
      case Cond::Op::kOr:
      case Cond::Op::kFor: return std::ranges::all_of(cond.children, [&](CondId part) { return waits_for_kept(part, wanted, state); });
      case Cond::Op::kIs:
        if (!wanted) return true;
        if (program_[cond.cell].kind != CellKind::kSatellite || !program_[cond.cell].keep) return false;
        if (state == CellId::kNone) state = cond.cell;
        return true;
      default: return !wanted;
    }
  }

  /// Whether the cell is raised by rules of this kind only, and lowered only where the rule's condition does not hold: then it says no more than the
  /// condition. What no rule lowers may be there for the reset to lower.
  [[nodiscard]] bool follows(const Rule& rule, CellId cell) {
    bool lowered = false;
    const auto agrees = [&](RuleId id) {
      const Rule& other = program_[id];
      const auto value = program::net_value(program_, subject_.group_of, other, cell);
      if (!value || other.reset) return true;
      if (*value > 0.0f) return kept_state(other) != CellId::kNone;
      lowered = lowered || fires(other);
      return meet(rule, other.condition, other.level) == Answer::kNo;
    };
    const std::uint32_t group = subject_.group_of[program::index(cell)];
    const bool all = std::ranges::all_of(subject_.writers.by_name[program::index(cell)], agrees) &&
                     (group == program::kNoGroup || std::ranges::all_of(subject_.writers.by_clear[group], agrees));
    const CondId high = is_high_[program::index(cell)];
    return all && lowered && (high == CondId::kNone || meet(rule, high, rule.level) == Answer::kYes);
  }

  [[nodiscard]] bool fires(const Rule& rule) { return meet(rule, rule.condition, rule.level) == Answer::kYes; }
  [[nodiscard]] Answer meet(const Rule& rule, CondId other, std::uint32_t level) {
    const Goal goals[] = {{rule.condition, true}, {other, true}};
    return satisfier_.together(goals, level);
  }

  /// A rule that resets the cell while the condition of `rule` holds, and leaves the condition as it is.
  [[nodiscard]] RuleId reset_beside(const Rule& rule, CellId cell) {
    const Demands demands = satisfier_.demands(rule.condition, rule.level);
    for (const RuleId id : subject_.writers.by_reset) {
      const Rule& reset = program_[id];
      const float value = program::net_value(program_, subject_.group_of, reset, cell).value_or(1.0f);
      if (value >= firing_ || undone(subject_, demands, reset) || meet(rule, reset.condition, reset.level) != Answer::kYes) continue;
      if (!ended_beside(demands, id)) return id;
    }
    return RuleId::kNone;
  }

  /// Whether another rule ends what is demanded on the occasion of the reset: it waits for the same fact, or for what the rule raises that resets.
  [[nodiscard]] bool ended_beside(const Demands& demands, RuleId reset) {
    const auto [known, fresh] = beside_.try_emplace(reset);
    if (fresh) {
      const std::vector<std::uint32_t> facts = awaited(program_[reset]);
      const auto beside = [&](const Rule& other) {
        const std::vector<std::uint32_t> also = facts.empty() ? facts : awaited(other);
        return std::ranges::find_first_of(facts, also) != facts.end() || waits_for_effect(other, program_[reset]);
      };
      for (const Rule& other : program_.rules) {
        if (beside(other)) known->second.push_back(&other);
      }
    }
    return std::ranges::any_of(known->second, [&](const Rule* other) { return undone(subject_, demands, *other).has_value(); });
  }

  /// Whether the rule demands anything of a cell that `reset` raises.
  [[nodiscard]] bool waits_for_effect(const Rule& rule, const Rule& reset) {
    const auto raised = [&](std::size_t cell) {
      return std::ranges::any_of(reset.writes, [&](const program::Write& write) { return write.value >= firing_ && program::index(write.cell) == cell; });
    };
    if (reset.writes.empty()) return false;
    const Demands demands = satisfier_.demands(rule.condition, rule.level, kMostParts);
    return std::ranges::any_of(demands.each, [&](const Restriction& demand) { return raised(demand.variable); });
  }

  /// The facts of which the rule demands anything at all. A longer part, such as `no` over a large group, is about satellites.
  [[nodiscard]] std::vector<std::uint32_t> awaited(const Rule& rule) {
    std::vector<std::uint32_t> facts;
    const std::size_t cells = program_.cells.size();
    for (const Restriction& demand : satisfier_.demands(rule.condition, rule.level, kMostParts).each) {
      const std::size_t fact = demand.variable >= cells ? demand.variable - cells : demand.variable;
      if (fact < program_.facts) facts.push_back(static_cast<std::uint32_t>(fact));
    }
    return facts;
  }

  const Subject& subject_;
  const Program& program_;
  float firing_;
  Satisfier& satisfier_;
  std::map<RuleId, std::vector<const Rule*>> beside_;   // by rule that resets: those that wait for the same facts
  std::vector<CondId> is_high_;   // by cell: the condition that it is, if any rule asks for that
  std::vector<bool> passed_over_;   // by cell: a strategy is wanted by it
};

}  // namespace

void diagnose_lost_to_reset(const Subject& subject) { LostToReset(subject).run(); }

}  // namespace kb::analysis
