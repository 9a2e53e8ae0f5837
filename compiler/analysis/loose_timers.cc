// Reports timers that a reader may take to time a whole `and`, where what they do time may have held for long when the rest comes.
//
// Where the rest is a state and the timer waits for something not to happen, the reader most likely takes it for a time in the state. Else the timer more
// likely says how long a fact must have been there to be believed, unless it is certain that the time is over whenever the state begins, which the rule
// is to end. A timer over another state times that one.
#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/analysis/writers.h"
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

struct Loose {
  CondId timer = CondId::kNone;
  CondId state = CondId::kNone;   // the part beside it that asks for a satellite
};

class LooseTimers {
 public:
  explicit LooseTimers(const Subject& subject)
      : subject_(subject), program_(subject.program), writers_(program_), satisfier_(program_, subject.domains, subject.confusions.get()) {}

  void run() {
    ByFamily<Loose> found(subject_);
    for (const program::LooseTimer& one : program_.loose_timers) {
      if (satisfier_.steps() >= Satisfier::kTotalSteps) break;
      const Rule& rule = program_[one.rule];
      if (rule.mode != program::Mode::kWhen || !lasts(one.timer) || needs_state(timed(one.timer), true)) continue;
      for (const CondId part : beside(rule.condition, one.timer)) {
        const bool of_absence = program_[timed(one.timer)].op == Cond::Op::kNot;
        if (!of_absence && !ends(rule, part)) continue;
        if (!runs_before(rule, one.timer, part, !of_absence)) continue;
        found.add(one.rule, {one.timer, part});
        break;
      }
    }
    found.for_each([&](RuleId id, const Loose& loose, std::uint32_t count) { report(program_[id], loose, count); });
  }

 private:
  [[nodiscard]] CondId timed(CondId timer) const { return program_[timer].children.front(); }
  [[nodiscard]] bool lasts(CondId timer) const { return program_[timer].duration_us > 0 && !satisfier_.is_timed_event(timer); }

  /// Whether the condition needs a satellite or a strategy to be as it asks. Recursion as deep as conditions nest.
  [[nodiscard]] bool needs_state(CondId id, bool wanted) const {
    const Cond& cond = program_[id];
    if (!program::has_parts(cond.op)) return wanted && program_[cond.cell].kind != program::CellKind::kFact;
    return std::ranges::any_of(cond.children, [&](CondId part) { return needs_state(part, cond.op == Cond::Op::kNot ? !wanted : wanted); });
  }

  /// Whether the rule lowers a satellite that the state asks for.
  [[nodiscard]] bool ends(const Rule& rule, CondId state) const {
    return std::ranges::any_of(asked(state), [&](CellId cell) { return program::net_value(program_, subject_.group_of, rule, cell).value_or(1.0f) <= 0.0f; });
  }

  /// The other parts of the `and` that the timer is a part of.
  [[nodiscard]] std::vector<CondId> beside(CondId around, CondId timer) const {
    const Cond& cond = program_[around];
    std::vector<CondId> parts(cond.children.begin(), cond.children.end());
    if (cond.op == Cond::Op::kAnd && std::erase(parts, timer) > 0) return parts;
    if (cond.op == Cond::Op::kAnd || cond.op == Cond::Op::kOr) {
      for (const CondId part : parts) {
        std::vector<CondId> found = beside(part, timer);
        if (!found.empty()) return found;
      }
    }
    return {};
  }

  /// The satellites of which the condition asks whether one is high; none if it asks for something else.
  [[nodiscard]] std::vector<CellId> asked(CondId id) const {
    const Cond& cond = program_[id];
    if (cond.op == Cond::Op::kIs && cond.term == program::Term::kHigh && program_[cond.cell].kind == program::CellKind::kSatellite) return {cond.cell};
    std::vector<CellId> all;
    if (cond.op != Cond::Op::kOr) return all;
    for (const CondId part : cond.children) {
      const std::vector<CellId> one = program_[part].op == Cond::Op::kIs ? asked(part) : std::vector<CellId>();
      if (one.empty()) return {};
      all.push_back(one.front());
    }
    return all;
  }

  /// Whether what is timed may have held for long, or has `always` held for the time, when a rule raises a satellite that `state` asks for.
  [[nodiscard]] bool runs_before(const Rule& rule, CondId timer, CondId state, bool always) {
    const Goal apart[] = {{timed(timer), true}, {state, false}};
    if (satisfier_.together(apart, rule.level) != Answer::kYes) return false;
    return std::ranges::any_of(asked(state), [&](CellId cell) {
      return std::ranges::any_of(writers_.by_name[program::index(cell)], [&](RuleId id) {
        return begins(program_[id], cell, state) && fires_while(program_[id], timed(timer)) && (!always || implies(program_[id], timer));
      });
    });
  }

  [[nodiscard]] bool implies(const Rule& rule, CondId timer) {
    const Goal goals[] = {{rule.condition, true}, {timer, false}};
    return satisfier_.together(goals, rule.level) == Answer::kNo;
  }

  /// Whether the rule raises the cell where the state is not yet.
  [[nodiscard]] bool begins(const Rule& rule, CellId cell, CondId state) {
    const auto firing = static_cast<float>(program_.settings.firing);
    const Goal goals[] = {{rule.condition, true}, {state, false}};
    return std::ranges::any_of(rule.writes, [&](const program::Write& write) { return write.cell == cell && write.value >= firing; }) &&
           satisfier_.together(goals, rule.level) == Answer::kYes;
  }

  /// Whether the rule can fire while the condition holds, and leaves it as it is.
  [[nodiscard]] bool fires_while(const Rule& rule, CondId condition) {
    const Goal goals[] = {{rule.condition, true}, {condition, true}};
    return satisfier_.together(goals, rule.level) == Answer::kYes && !undone(subject_, satisfier_.demands(condition, rule.level), rule);
  }

  void report(const Rule& rule, const Loose& loose, std::uint32_t count) {
    const std::string what = print_condition(program_, timed(loose.timer)), all = print_condition(program_, loose.timer);
    const std::string time = all.substr(all.rfind(" for ") + 5), state = words_of(loose.state);
    subject_.diagnostics.report(Kind::kLooseTimer, rule.span, {what, rule.name, time, state, more(count)});
  }

  /// `any Try` or `any sat Move` where all of that group are asked for.
  [[nodiscard]] std::string words_of(CondId state) const {
    const std::vector<CellId> cells = asked(state);
    if (cells.size() == 1) return print_condition(program_, state);
    const std::string_view first = program_[cells.front()].name;
    const std::string_view sat = first.starts_with("sat ") ? first.substr(0, 4) : std::string_view();
    const std::string_view name = model::declared_name(first.substr(sat.size()));
    const bool whole = std::ranges::any_of(subject_.model.groups, [&](const model::Group& group) { return group.name == name && group.cells.size() == cells.size(); });
    return whole ? fmt::format("any {}{}", sat, name) : fmt::format("({})", print_condition(program_, state));
  }

  const Subject& subject_;
  const Program& program_;
  Writers writers_;
  Satisfier satisfier_;
};

}  // namespace

void diagnose_loose_timers(const Subject& subject) {
  if (!subject.program.loose_timers.empty()) LooseTimers(subject).run();
}

}  // namespace kb::analysis
