#include "compiler/analysis/apart_in_time.h"

#include <algorithm>
#include <set>
#include <vector>

#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using program::CondId;
using program::Rule;

bool asks_what_it_writes(const Subject& subject, const Rule& rule, CondId condition) {
  const program::Cond& cond = subject.program[condition];
  if (!program::has_parts(cond.op)) return program::net_value(subject.program, subject.group_of, rule, cond.cell).has_value();
  return std::ranges::any_of(cond.children, [&](CondId part) { return asks_what_it_writes(subject, rule, part); });
}

/// Whether `rule` has fired before `timed` can: all that `rule` asks for must have held for a while for `timed` to fire, so it held on the
/// tick before, when `rule` fired (`when F`, `when F for 1 s`). Not if `rule` writes what it asks for, since then it may be armed again.
bool fired_before(const Subject& subject, const Rule& rule, const Rule& timed) {
  if (rule.mode != program::Mode::kWhen) return false;
  std::set<CondId> held;
  for (const CondId part : program::conjuncts(subject.program, timed.condition)) {
    const program::Cond& cond = subject.program[part];
    if (cond.op != program::Cond::Op::kFor || cond.duration_us == 0) continue;
    for (const CondId of_it : program::conjuncts(subject.program, cond.children.front())) held.insert(of_it);
  }
  const std::vector<CondId> asked = program::conjuncts(subject.program, rule.condition);
  return !held.empty() && std::ranges::all_of(asked, [&](CondId part) { return held.contains(part) && !asks_what_it_writes(subject, rule, part); });
}

/// Whether the rule fires on the first tick and never again: it asks for a satellite that begins high, lowers it, and nothing raises it.
bool fires_once(const Subject& subject, const Rule& rule) {
  const program::Program& program = subject.program;
  const program::Cond& asked = program[rule.condition];
  const bool high = asked.op == program::Cond::Op::kIs && asked.term == program::Term::kHigh && static_cast<double>(program[asked.cell].initial) >= program.settings.firing;
  if (!high || subject.raiser[program::index(asked.cell)] != program::RuleId::kNone || !subject.writers.by_reset.empty()) return false;
  return program::net_value(program, subject.group_of, rule, asked.cell).value_or(1.0f) < 0.0f;
}

bool waits_for_event(const Subject& subject, const Rule& rule) {
  const std::vector<CondId> asked = program::conjuncts(subject.program, rule.condition);
  return std::ranges::any_of(asked, [&](CondId part) { return subject.program[part].op == program::Cond::Op::kEvent || subject.program[part].op == program::Cond::Op::kLost; });
}

}  // namespace

bool apart_in_time(const Subject& subject, const Rule& a, const Rule& b) {
  const auto once_and_later = [&](const Rule& x, const Rule& y) { return waits_for_event(subject, y) && fires_once(subject, x); };
  return fired_before(subject, a, b) || fired_before(subject, b, a) || once_and_later(a, b) || once_and_later(b, a);
}

}  // namespace kb::analysis
