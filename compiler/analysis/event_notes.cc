// What two rules that disagree can do about it if they meet only at an event.
//
// note [who gives way at an event]
// A rule that asks for `not event E` as well fires a tick later, if all else still holds. Not if it waits for an event of its own, which is
// over by then: it would lose that, and so gets this advice only if the other rule takes from it what else it asks for, so that nothing is
// lost. If it waits for `event E` itself, the advice would leave it nothing. On different levels both rules fire, unless one takes from the other
// what that asks for.
#include <algorithm>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::Cond;
using program::CondId;
using program::Rule;

class EventNotes {
 public:
  EventNotes(const Subject& subject, Satisfier& satisfier) : subject_(subject), program_(subject.program), satisfier_(satisfier) {}

  void add(const Rule& a, const Rule& b, diagnostics::Builder& message) {
    const CondId first = event_in(a.condition), second = event_in(b.condition);
    if (same(first, second)) return;
    const bool both = first != CondId::kNone && second != CondId::kNone;
    const bool second_goes_first = first == CondId::kNone || (both && b.standard);   // the other rule is to ask for more, which the user can write
    const CondId event = second_goes_first ? second : first;
    const std::string code = quoted(event);
    if (both) message.note(Kind::kEventsTogether, {}, {quoted(first), quoted(second)});
    if (second_goes_first) advise(b, a, event, code, both, message);
    else advise(a, b, event, code, both, message);
  }

 private:
  void advise(const Rule& winner, const Rule& other, CondId event, const std::string& code, bool both, diagnostics::Builder& message) {
    if (other.standard) {
      if (both) return;
      if (other.level + 2 < program_.levels.size()) message.note(Kind::kOnEventOfUsers, {}, {code, other.name, program_.levels[other.level]});
      else message.note(Kind::kOnEventAlone, {}, {code});
      return;
    }
    const std::string denied = "not " + code.substr(1, code.size() - 2);
    if (!waits_for_event(other.condition, CondId::kNone, true)) return (void)message.note(Kind::kOnEvent, {}, {code, other.name, denied});
    if (!both) message.note(Kind::kOnEventAlone, {}, {code});
    if (spoils(winner, other) && !waits_for_event(other.condition, event, true)) {
      message.note(Kind::kGoesFirst, {}, {code, other.name, denied});
    } else if (winner.span != other.span && !spoils(winner, other) && !spoils(other, winner)) {
      message.note(Kind::kLowerHasLastWord, {});
    }
  }

  /// An event without which the condition does not hold; `kNone` if there is none.
  [[nodiscard]] CondId event_in(CondId condition) const {
    const Cond& cond = program_[condition];
    if (is_event(cond)) return condition;
    if (cond.op != Cond::Op::kAnd) return CondId::kNone;
    for (const CondId part : cond.children) {
      if (const CondId found = event_in(part); found != CondId::kNone) return found;
    }
    return CondId::kNone;
  }

  /// Whether the event, or any if that is `kNone`, may be what makes the condition be as `wanted`.
  [[nodiscard]] bool waits_for_event(CondId condition, CondId event, bool wanted) const {
    const Cond& cond = program_[condition];
    if (is_event(cond)) return wanted && (event == CondId::kNone || same(condition, event));
    if (!program::has_parts(cond.op)) return false;
    return std::ranges::any_of(cond.children, [&](CondId part) { return waits_for_event(part, event, wanted != (cond.op == Cond::Op::kNot)); });
  }

  /// Whether `by` makes false what `rule` asks for.
  [[nodiscard]] bool spoils(const Rule& by, const Rule& rule) { return undone(subject_, satisfier_.demands(rule.condition, rule.level), by).has_value(); }

  [[nodiscard]] static bool is_event(const Cond& cond) { return cond.op == Cond::Op::kEvent || cond.op == Cond::Op::kLost; }
  [[nodiscard]] bool same(CondId a, CondId b) const {
    if (a == b || a == CondId::kNone || b == CondId::kNone) return a == b;
    return program_[a].op == program_[b].op && program_[a].cell == program_[b].cell;
  }
  [[nodiscard]] std::string quoted(CondId condition) const { return "`" + program::print_condition(program_, condition) + "`"; }

  const Subject& subject_;
  const program::Program& program_;
  Satisfier& satisfier_;
};

}  // namespace

void note_events(const Subject& subject, Satisfier& satisfier, const Rule& a, const Rule& b, diagnostics::Builder& message) {
  EventNotes(subject, satisfier).add(a, b, message);
}

}  // namespace kb::analysis
