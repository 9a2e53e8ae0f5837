// Reports timers that a reader may take to time a whole `and`, where what they do time may have held for long when the rest comes.
//
// Where the rest is a state and the timer waits for something not to happen, the reader most likely takes it for a time in the state. Else the timer more
// likely says how long a fact must have been there to be believed, unless it is certain that the time is over whenever the state begins, which the rule
// is to end. A timer over another state times that one.
#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include <fmt/format.h>

#include "compiler/analysis/satisfier.h"
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

struct Loose {
  const program::LooseTimer* timer = nullptr;
  CondId state = CondId::kNone;   // the part beside it that asks for a satellite
  std::uint32_t count = 0;        // of instances
};

class LooseTimers {
 public:
  explicit LooseTimers(const Subject& subject)
      : subject_(subject), program_(subject.program), satisfier_(subject.satisfier()) {}

  void run() {
    std::map<std::tuple<source::FileId, std::uint32_t, std::uint32_t>, Loose> found;   // by place, and by rule as written
    for (const program::LooseTimer& one : program_.loose_timers) {
      if (satisfier_.steps() >= Satisfier::kTotalSteps) break;
      if (!lasts(one.timer) || needs_state(timed(one.timer), true)) continue;
      const auto part = std::ranges::find_if(one.beside, [&](CondId state) { return is_loose(one, state); });
      if (part == one.beside.end()) continue;
      Loose& loose = found[{one.at.file, one.at.begin, subject_.family[program::index(one.rule)]}];
      if (loose.count++ == 0) loose = {&one, *part, 1};
    }
    for (const auto& [place, loose] : found) report(loose);
  }

 private:
  [[nodiscard]] CondId timed(CondId timer) const { return program_[timer].children.front(); }
  [[nodiscard]] bool lasts(CondId timer) const { return program_[timer].duration_us > 0 && !satisfier_.is_timed_event(timer); }

  /// Whether the reader may take the timer for a time in the state.
  [[nodiscard]] bool is_loose(const program::LooseTimer& one, CondId state) {
    const Cond& waits = program_[timed(one.timer)];
    const bool of_absence = waits.op == Cond::Op::kNot || (waits.op == Cond::Op::kIs && waits.term == program::Term::kLow);
    return (of_absence || ends(program_[one.rule], state)) && runs_before(program_[one.rule], one.timer, state, !of_absence);
  }

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
      return std::ranges::any_of(subject_.writers.by_name[program::index(cell)], [&](RuleId id) {
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

  void report(const Loose& loose) {
    const CondId timer = loose.timer->timer;
    const std::string what = print_condition(program_, timed(timer)), all = print_condition(program_, timer);
    const std::string time = all.substr(all.rfind(" for ") + 5), state = words_of(loose.state);
    subject_.diagnostics.report(Kind::kLooseTimer, loose.timer->at, {what, program_[loose.timer->rule].name, time, state, more(loose.count)});
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
  Satisfier& satisfier_;
};

}  // namespace

void diagnose_loose_timers(const Subject& subject) {
  if (!subject.program.loose_timers.empty()) LooseTimers(subject).run();
}

}  // namespace kb::analysis
