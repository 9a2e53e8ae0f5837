// Reports rules that can never fire or always fire, and conditions that hardly say what was meant.
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"
#include "compiler/program/interpret.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::Cond;
using program::CondId;
using program::Program;
using program::Rule;
using program::RuleId;

/// Why a rule can never fire.
struct DeadEnd {
  Kind kind = Kind::kUnsatisfiableCondition;
  std::string first, second;
  bool said = false;  ///< its cause has been reported already
};

class ConditionQuestions {
 public:
  explicit ConditionQuestions(Subject& subject)
      : subject_(subject),
        program_(subject.program),
        narrow_satisfier_(subject.satisfier()),
        wide_satisfier_(subject.wide_satisfier()) {}

  void run() {
    diagnose_timers();
    diagnose_control_level();
    diagnose_dead_ends();
    diagnose_always_true();
    diagnose_start();
  }

  /// By rule: whether no instance of its rule as written can ever fire.
  [[nodiscard]] std::vector<bool> dead_rules() {
    std::vector<bool> families(subject_.instances.size(), false), dead(program_.rules.size(), false);
    find_dead_ends().for_each([&](RuleId id, bool, std::uint32_t count) {
      const std::uint32_t family = subject_.family[program::index(id)];
      families[family] = count >= subject_.instances[family];
    });
    for (std::size_t i = 0; i < dead.size(); ++i) dead[i] = families[subject_.family[i]];
    return dead;
  }

 private:
  [[nodiscard]] bool impossible(std::initializer_list<Goal> goals, std::uint32_t level) {
    return narrow_satisfier_.together(goals, level) == Answer::kNo;
  }

  /// By condition: whether it contains a `for`.
  [[nodiscard]] std::vector<bool> find_timed() const {
    return program::marked(program_, [](const Cond& cond) { return cond.op == Cond::Op::kFor; });
  }

  void diagnose_timers() {
    const std::vector<bool> timed = find_timed();
    ByFamily<CondId> events(subject_);
    ByFamily<CondId> hasty(subject_);
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      if (!timed[program::index(program_.rules[i].condition)]) continue;
      std::vector<CondId> pending = {program_.rules[i].condition};
      std::optional<CondId> event, quick;   // an instance counts once, even with several timers
      while (!pending.empty()) {
        const CondId id = pending.back();
        pending.pop_back();
        const Cond& cond = program_[id];
        if (wide_satisfier_.is_timed_event(id)) event = event.value_or(id);
        if (cond.op == Cond::Op::kFor && cond.duration_us == 0) quick = quick.value_or(id);
        for (const CondId part : cond.children) {
          if (timed[program::index(part)]) pending.push_back(part);
        }
      }
      if (event) events.add(RuleId{i}, *event);
      if (quick) hasty.add(RuleId{i}, *quick);
    }
    report_timers(events, Kind::kTimedEvent);
    report_timers(hasty, Kind::kZeroDuration);
  }

  void report_timers(const ByFamily<CondId>& found, Kind kind) {
    found.for_each([&](RuleId id, CondId condition, std::uint32_t count) {
      const Rule& rule = program_[id];
      subject_.diagnostics.report(kind, rule.span, {print_condition(program_, condition), rule.name, more(count)});
    });
  }

  [[nodiscard]] bool asks_what_runs(const Cond& cond) const {
    return cond.op == Cond::Op::kIs && program_[cond.cell].kind == program::CellKind::kStrategy;
  }

  /// Reports rules of the control level that ask which strategy runs, which only that level decides. Other forms, such as `A or Go` and
  /// `not Go`, compile as well.
  void diagnose_control_level() {
    const std::size_t control = program_.levels.size() - 1;
    undecided_.assign(subject_.instances.size(), false);
    const std::vector<bool> ask = program::marked(program_, [this](const Cond& cond) { return asks_what_runs(cond); });
    ByFamily<CondId> found(subject_);
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      const Rule& rule = program_.rules[i];
      if (rule.level != control || Subject::generated(rule) || !ask[program::index(rule.condition)]) continue;
      const std::vector<CondId> parts = program::reachable(program_.conds, {rule.condition});
      found.add(RuleId{i}, *std::ranges::find_if(parts, [this](CondId part) { return asks_what_runs(program_[part]); }));
    }
    found.for_each([&](RuleId id, CondId asks, std::uint32_t count) {
      const Rule& rule = program_[id];
      undecided_[subject_.family[program::index(id)]] = true;
      subject_.diagnostics.report(Kind::kStrategyAtControl, rule.span,
                                  {rule.name, print_condition(program_, asks), program_.levels[control], program_[program_[asks].cell].name, more(count)});
    });
  }

  /// Whether, for the question at hand, some instance of the rule's family has given the answer no, so that the others need not be asked.
  /// To be cleared before each question.
  [[nodiscard]] std::vector<bool>::reference settled(std::uint32_t rule) { return settled_[subject_.family[rule]]; }

  /// The instances of which the test is true, of rules all of whose instances so far pass it.
  template <class Test>
  [[nodiscard]] ByFamily<bool> all_of(Test&& test) {
    settled_.assign(subject_.instances.size(), false);
    ByFamily<bool> found(subject_);
    for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
      const Rule& rule = program_.rules[i];
      if (Subject::generated(rule) || settled(i)) continue;
      if (test(rule)) found.add(RuleId{i}, true);
      else settled(i) = true;
    }
    return found;
  }
  [[nodiscard]] ByFamily<bool> find_dead_ends() {
    return all_of([&](const Rule& rule) { return impossible({{rule.condition, true}}, rule.level); });
  }

  void diagnose_dead_ends() {
    // In most knowledge bases some instances of a general rule can never fire. It is reported only if none of them can.
    find_dead_ends().for_each([&](RuleId id, bool, std::uint32_t count) {
      const Rule& rule = program_[id];
      const std::uint32_t family = subject_.family[program::index(id)];
      if (count < subject_.instances[family] || undecided_[family]) return;
      const DeadEnd end = explain(rule);
      if (end.said) return;
      if (end.kind == Kind::kContradictoryCondition) {
        subject_.diagnostics.report(end.kind, rule.span, {rule.name, end.first, end.second, more(count)});
      } else {
        subject_.diagnostics.report(end.kind, rule.span, {rule.name, end.first, more(count)});
      }
    });
  }

  DeadEnd explain(const Rule& rule) {
    const std::vector<CondId> parts = program::conjuncts(program_, rule.condition);
    for (const CondId part : parts) {
      if (impossible({{part, true}}, rule.level)) return explain_part(part);
    }
    for (std::size_t i = 0; i < parts.size(); ++i) {
      for (std::size_t j = i + 1; j < parts.size(); ++j) {
        if (!impossible({{parts[i], true}, {parts[j], true}}, rule.level)) continue;
        return {Kind::kContradictoryCondition, print_condition(program_, parts[i]), print_condition(program_, parts[j]),
                false};
      }
    }
    return {Kind::kUnsatisfiableCondition, "no state makes all parts of its condition true", {}, false};
  }

  /// Explains a part that can never hold. What has been reported about its cell is not repeated.
  DeadEnd explain_part(CondId part) {
    DeadEnd end;
    for (const CondId id : program::reachable(program_.conds, {part})) {
      const Cond& cond = program_[id];
      end.said = end.said || wide_satisfier_.is_timed_event(id) || (!program::has_parts(cond.op) && subject_.reported[program::index(cond.cell)]);
    }
    const Cond& cond = program_[part];
    if (cond.op == Cond::Op::kOr && cond.children.empty()) {
      end.first = "an `any` in its condition asks a relation that has no rows";
      return end;
    }
    end.first = "`" + print_condition(program_, part) + "` never holds" + reason(part);
    return end;
  }

  /// Why a part that can never hold does not, if that comes from one satellite.
  [[nodiscard]] std::string reason(CondId part) {
    const CondId whole = part;
    for (const Cond* cond = &program_[part]; cond->op == Cond::Op::kFor || cond->op == Cond::Op::kAnd; cond = &program_[part]) {
      const auto dead = std::ranges::find_if(cond->children, [&](CondId one) { return impossible({{one, true}}, 0); });
      if (dead == cond->children.end()) return {};
      part = *dead;
    }
    const Cond& cond = program_[part];
    if (cond.op != Cond::Op::kIs || program_[cond.cell].kind != program::CellKind::kSatellite) return {};
    const bool never_raised = cond.term == program::Term::kHigh && subject_.raiser[program::index(cond.cell)] == RuleId::kNone;
    if (!never_raised) return part == whole ? ", whatever the rules write" : "";
    return part == whole ? ": no rule raises it" : fmt::format(": no rule raises `{}`", program_[cond.cell].name);
  }

  void diagnose_always_true() {
    const ByFamily<bool> always = all_of([&](const Rule& rule) {
      const Goal goal{rule.condition, false};
      return wide_satisfier_.together({&goal, 1}, rule.level) == Answer::kNo;
    });
    always_true_.assign(subject_.instances.size(), false);
    always.for_each([&](RuleId id, bool, std::uint32_t count) {
      const std::uint32_t family = subject_.family[program::index(id)];
      if (count < subject_.instances[family]) return;
      always_true_[family] = true;
      if (undecided_[family]) return;
      subject_.diagnostics.report(Kind::kAlwaysTrue, program_[id].span, {program_[id].name, more(count)});
    });
  }

  /// By condition: whether it holds at start-up, when no fact has any data.
  [[nodiscard]] std::vector<bool> truth_at_start() const {
    const auto firing = static_cast<float>(program_.settings.firing);
    std::vector<bool> truth(program_.conds.size(), false);
    for (std::size_t i = 0; i < program_.conds.size(); ++i) {
      const Cond& cond = program_.conds[i];
      const auto holds = [&](CondId part) { return truth[program::index(part)]; };
      switch (cond.op) {
        case Cond::Op::kAnd: truth[i] = std::all_of(cond.children.begin(), cond.children.end(), holds); break;
        case Cond::Op::kOr: truth[i] = std::any_of(cond.children.begin(), cond.children.end(), holds); break;
        case Cond::Op::kNot: truth[i] = !holds(cond.children.front()); break;
        case Cond::Op::kFor: truth[i] = cond.duration_us == 0 && holds(cond.children.front()); break;
        case Cond::Op::kIs:
          truth[i] = (region_of(program_[cond.cell].initial, firing) & regions_of(cond.term)) != 0;
          break;
        default: break;  // no fact is seen
      }
    }
    return truth;
  }

  /// Whether the rule's effects change the state of start-up. If not, it may well fire there. A `reset` by itself puts that state back.
  [[nodiscard]] bool changes_start(const Rule& rule) const {
    bool changes = false;
    program::for_each_net_write(program_, rule, [&](program::CellId cell, float value) { changes = changes || value != program_[cell].initial; });
    return changes;
  }

  /// Whether the condition is as wanted at start-up, whatever facts there are. Recursion as deep as conditions nest.
  [[nodiscard]] bool holds_without_facts(CondId id, bool wanted) const {
    const Cond& cond = program_[id];
    const auto part_holds = [&](CondId part) { return holds_without_facts(part, wanted); };
    switch (cond.op) {
      case Cond::Op::kNot: return holds_without_facts(cond.children.front(), !wanted);
      case Cond::Op::kAnd:
      case Cond::Op::kOr: return (cond.op == Cond::Op::kAnd) == wanted ? std::ranges::all_of(cond.children, part_holds) : std::ranges::any_of(cond.children, part_holds);
      case Cond::Op::kFor: return cond.duration_us > 0 ? !wanted : part_holds(cond.children.front());   // none has run out
      case Cond::Op::kIs: {
        const bool is = (region_of(program_[cond.cell].initial, static_cast<float>(program_.settings.firing)) & regions_of(cond.term)) != 0;
        return program_[cond.cell].kind != program::CellKind::kFact && is == wanted;
      }
      default: return false;   // about sightings
    }
  }

  /// Whether the rule is clearly meant for the start: it gives an exclusive group that has no member high its first one, or takes back a satellite that
  /// was declared to begin high, and asks nothing of facts.
  [[nodiscard]] bool begins(const Rule& rule) {
    if (!holds_without_facts(rule.condition, true)) return false;
    const auto firing = static_cast<float>(program_.settings.firing);
    const Demands demands = narrow_satisfier_.demands(rule.condition, rule.level);
    const auto asks = [&](program::CellId cell, bool high) {
      const auto asked = std::ranges::find(demands.each, program::index(cell), &Restriction::variable);
      const Regions wrong = high ? static_cast<Regions>(~regions_of(program::Term::kHigh)) : regions_of(program::Term::kHigh);
      return asked != demands.each.end() && (asked->allowed & wrong) == 0;
    };
    return std::ranges::any_of(rule.writes, [&](const program::Write& write) {
      const std::uint32_t group = subject_.group_of[program::index(write.cell)];
      if (write.value < firing) return group == program::kNoGroup && program_[write.cell].initial >= firing && asks(write.cell, true);
      return group != program::kNoGroup && std::ranges::all_of(program_.exclusive[group], [&](program::CellId cell) { return asks(cell, false); });
    });
  }

  void diagnose_start() {
    const std::vector<bool> truth = truth_at_start();
    ByFamily<bool> found(subject_);
    for (const RuleId id : program::Interpreter(program_).tick({}, 0).fired) {   // a higher level may change what holds at start-up
      const Rule& rule = program_[id];
      if (rule.mode != program::Mode::kWhen || Subject::generated(rule)) continue;
      if (truth[program::index(rule.condition)] && changes_start(rule) && !begins(rule)) found.add(id, true);
    }
    found.for_each([&](RuleId id, bool, std::uint32_t count) {
      const std::uint32_t family = subject_.family[program::index(id)];
      if (always_true_[family] || count < subject_.instances[family]) return;
      subject_.diagnostics.report(Kind::kFiresAtStart, program_[id].span, {program_[id].name, more(count)});
    });
  }

  Subject& subject_;
  const Program& program_;
  Satisfier &narrow_satisfier_, &wide_satisfier_;
  std::vector<bool> undecided_;    // by family: it asks which strategy runs before that is decided
  std::vector<bool> always_true_;  // by family
  std::vector<bool> settled_;      // by family: see `settled`
};

}  // namespace

void diagnose_conditions(Subject& subject) { ConditionQuestions(subject).run(); }

std::vector<bool> find_dead_rules(const model::Model& model, const Program& program, diagnostics::Diagnostics& diagnostics) {
  Subject subject(model, program, diagnostics);
  return ConditionQuestions(subject).dead_rules();
}

}  // namespace kb::analysis
