// Reports effects that are overridden, have no effect, are repeated, or undo what made the rule fire.
#include <algorithm>
#include <bit>
#include <map>
#include <optional>
#include <unordered_map>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/conditions.h"
#include "compiler/program/hash.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Program;
using program::Rule;
using program::RuleId;

// ---- overridden: asked of the rules as written, before their effects were folded

/// One effect of a rule as written (a place in the source), over all instances of the rule.
struct WrittenEffect {
  std::uint32_t instances = 0;   ///< that have the effect
  std::uint32_t overridden = 0;  ///< in which later effects write all that it writes
  model::CellId cell = model::CellId::kNone;
  std::uint32_t raised = 0;      ///< the number of members of one exclusive group that it raises; `cell` is the last of them
  std::string rule;
};
using Place = std::pair<std::uint32_t, std::uint32_t>;  // template, offset of the effect

using Groups = std::unordered_map<std::uint32_t, std::uint32_t>;        // cells of exclusive groups
/// The last effects of a rule that write a cell, raise a member of a group, and reset.
struct LastEffects {
  std::unordered_map<std::uint32_t, std::size_t> write, raise;
  std::optional<std::size_t> reset;
};

Groups exclusive_groups(const model::Model& model) {
  Groups groups;
  for (std::uint32_t i = 0; i < model.exclusive.size(); ++i) {
    for (const model::CellId cell : model.exclusive[i]) groups.emplace(static_cast<std::uint32_t>(cell), i);
  }
  return groups;
}

/// Whether later effects of an instance write again all that the effect beginning at `first` writes. Raising a member of an exclusive group
/// writes the whole group. Lowering the whole group before that has no effect either, but it is clear what is meant, so it does not count.
bool all_overridden(const model::Model& model, const model::Rule& rule, std::size_t first, std::size_t end, const Groups& groups, const LastEffects& last) {
  const auto again = [&](model::CellId cell) {
    const auto write = last.write.find(static_cast<std::uint32_t>(cell));
    return write != last.write.end() && write->second >= end;
  };
  for (std::size_t i = first; i < end; ++i) {
    const model::Write& write = rule.effects[i];
    if (write.reset) return false;
    const auto group = groups.find(static_cast<std::uint32_t>(write.cell));
    const bool raises = write.value > 0.0f && group != groups.end();
    const bool excluded = raises && last.raise.at(group->second) >= end;
    const bool undone = last.reset && *last.reset >= end && !model[write.cell].keep;
    if (excluded || undone) continue;
    if (raises ? !std::all_of(model.exclusive[group->second].begin(), model.exclusive[group->second].end(), again) : !again(write.cell)) return false;
  }
  return true;
}

/// How many members of the exclusive group of its last cell an effect raises.
std::uint32_t members_raised(const model::Rule& rule, std::size_t first, std::size_t end, const Groups& groups) {
  const auto group_of = [&](const model::Write& write) { return groups.find(static_cast<std::uint32_t>(write.cell)); };
  const auto last = group_of(rule.effects[end - 1]);
  if (rule.effects[first].reset || last == groups.end() || !(rule.effects[first].value > 0.0f)) return 0;
  return static_cast<std::uint32_t>(std::count_if(rule.effects.begin() + static_cast<std::ptrdiff_t>(first), rule.effects.begin() + static_cast<std::ptrdiff_t>(end),
                                                  [&](const model::Write& write) { return group_of(write) != groups.end() && group_of(write)->second == last->second; }));
}

void note_effects(const model::Model& model, const model::Rule& rule, const Groups& groups, std::map<Place, WrittenEffect>& effects) {
  LastEffects last;
  for (std::size_t i = 0; i < rule.effects.size(); ++i) {
    const model::Write& write = rule.effects[i];
    if (write.reset) {
      last.reset = i;
      continue;
    }
    last.write[static_cast<std::uint32_t>(write.cell)] = i;
    const auto group = groups.find(static_cast<std::uint32_t>(write.cell));
    if (group != groups.end() && write.value > 0.0f) last.raise[group->second] = i;
  }
  for (std::size_t first = 0, end = 0; first < rule.effects.size(); first = end) {
    while (end < rule.effects.size() && rule.effects[end].span == rule.effects[first].span) ++end;
    WrittenEffect& effect = effects[{static_cast<std::uint32_t>(rule.tmpl), rule.effects[first].span.begin}];
    ++effect.instances;
    if (const std::uint32_t raised = members_raised(rule, first, end, groups); raised > 1 && effect.raised == 0) {
      effect.raised = raised;
      effect.cell = rule.effects[end - 1].cell;
      effect.rule = rule.name;
    }
    if (!all_overridden(model, rule, first, end, groups, last)) continue;
    if (effect.overridden++ == 0) {
      effect.cell = rule.effects[first].cell;
      effect.rule = rule.name;
    }
  }
}

void diagnose_written(Subject& subject) {
  const model::Model& model = subject.model;
  const Groups groups = exclusive_groups(model);
  std::map<Place, WrittenEffect> effects;
  for (const model::Rule& rule : model.rules) {
    if (rule.effects.size() > 1) note_effects(model, rule, groups, effects);
  }
  for (const auto& [place, effect] : effects) {
    const source::FileId file = model.templates[place.first].span.file;
    const source::Span at{file, place.second, place.second + 1};
    if (effect.overridden == effect.instances) {
      subject.diagnostics.report(Kind::kOverriddenEffect, at, {model[effect.cell].name, effect.rule, more(effect.overridden)});
    } else if (effect.raised > 1) {
      subject.diagnostics.report(Kind::kRaisesExclusive, at, {std::to_string(effect.raised), effect.rule, model[effect.cell].name});
    }
  }
}

// ---- void, repeated, self-defeating: asked of the core rules

bool writes_nothing(const Rule& rule) { return rule.writes.empty() && rule.clears.empty() && !rule.reset; }

void diagnose_void(Subject& subject) {
  ByFamily<bool> found(subject);
  for (std::uint32_t i = 0; i < subject.program.rules.size(); ++i) {
    if (writes_nothing(subject.program.rules[i])) found.add(RuleId{i}, true);
  }
  found.for_each([&](RuleId id, bool, std::uint32_t count) {
    const Rule& rule = subject.program[id];
    if (count < subject.instances[subject.family[program::index(id)]]) return;
    subject.diagnostics.report(Kind::kNoEffect, rule.span, {rule.name, more(count)});
  });
}

/// By cell: the cell that it is a satellite of.
std::vector<CellId> attended_by(const Program& program) {
  std::vector<CellId> attended(program.cells.size(), CellId::kNone);
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) {
    for (const CellId satellite : program.cells[i].satellites) attended[program::index(satellite)] = CellId{i};
  }
  return attended;
}

/// Reports rules that raise a satellite of something, such as that of a command, which is high all the time. Where it is no satellite of
/// anything, the message is that rules read it and it never changes.
void diagnose_needless(Subject& subject) {
  const Program& program = subject.program;
  const std::vector<CellId> attended = attended_by(program);
  const auto firing = static_cast<float>(program.settings.firing);
  const auto always_high = [&](const program::Write& write) {
    const std::size_t cell = program::index(write.cell);
    const bool high = program[write.cell].initial >= firing && subject.domains.cells[cell] == region_of(program[write.cell].initial, firing);
    return high && write.value > 0.0f && attended[cell] != CellId::kNone && subject.group_of[cell] == program::kNoGroup;
  };
  ByFamily<CellId> found(subject);
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const Rule& rule = program.rules[i];
    const auto write = std::ranges::find_if(rule.writes, always_high);
    if (!Subject::generated(rule) && write != rule.writes.end()) found.add(RuleId{i}, write->cell);
  }
  found.for_each([&](RuleId id, CellId cell, std::uint32_t count) {
    const program::Cell& of = program[attended[program::index(cell)]];
    auto message = subject.diagnostics.report(Kind::kChangesNothing, program[id].span, {program[cell].name, program[id].name, more(count)});
    if (of.kind == program::CellKind::kFact) message.note(Kind::kAttentionAlone, {}, {program[cell].name, of.name});
  });
}

/// A rule raises one of them, or it is high from the start.
bool any_raised(const Subject& subject, const source::Few<CellId, 4>& cells) {
  return std::any_of(cells.begin(), cells.end(), [&](CellId cell) {
    return subject.raiser[program::index(cell)] != RuleId::kNone || subject.program[cell].initial >= 0.0f;
  });
}

/// Reports rules that lower a satellite of something that no rule raises, nor any that was declared with it. Where it is no satellite of
/// anything, or of a strategy that has no other, the message is that it is never set, never read, or never wanted.
void diagnose_lowered_in_vain(Subject& subject) {
  const Program& program = subject.program;
  const std::vector<CellId> attended = attended_by(program);
  const auto says_otherwise = [&](CellId cell) {
    const CellId of = attended[program::index(cell)];
    if (of == CellId::kNone || subject.reported[program::index(cell)]) return true;
    return program[of].kind == program::CellKind::kStrategy && !can_be_high(subject.written, of);
  };
  std::vector<bool> vain(program.cells.size(), false);
  for (const Clan& clan : subject.clans) {
    if (any_raised(subject, clan.cells)) continue;
    for (const CellId cell : clan.cells) vain[program::index(cell)] = !says_otherwise(cell);
  }
  ByFamily<CellId> found(subject);
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const auto write = std::ranges::find_if(program.rules[i].writes, [&](const program::Write& one) { return one.value < 0.0f && vain[program::index(one.cell)]; });
    if (!Subject::generated(program.rules[i]) && write != program.rules[i].writes.end()) found.add(RuleId{i}, write->cell);
  }
  found.for_each([&](RuleId id, CellId cell, std::uint32_t count) {
    auto message = subject.diagnostics.report(Kind::kLoweredInVain, program[id].span, {program[id].name, program[cell].name, more(count)});
    const program::Cell& of = program[attended[program::index(cell)]];
    for (const CellId other : of.satellites) {
      const RuleId raiser = subject.raiser[program::index(other)];
      if (raiser != RuleId::kNone) return (void)message.note(Kind::kOtherIsRaised, program[raiser].span, {program[raiser].name, program[other].name, of.name});
    }
  });
}

/// Equal for rules that are `same`. Many rules may have one condition, and write different things.
struct HashOfRule {
  std::size_t operator()(const Rule* rule) const {
    std::uint64_t hash = 0;
    const auto add = [&](std::uint64_t part) { hash = program::mix(hash, part); };
    add(program::index(rule->condition));
    add(std::uint64_t{rule->level} << 2 | (rule->mode == program::Mode::kWhile ? 2u : 0u) | (rule->reset ? 1u : 0u));
    for (const program::Write& write : rule->writes) add(program::index(write.cell)), add(std::bit_cast<std::uint32_t>(write.value));
    for (const std::uint32_t group : rule->clears) add(group);
    return static_cast<std::size_t>(hash);
  }
};
struct SameRule {
  bool operator()(const Rule* a, const Rule* b) const { return a->level == b->level && a->mode == b->mode && a->condition == b->condition && program::same_effects(*a, *b); }
};

/// By condition: whether several rules have it.
std::vector<bool> shared_conditions(const Program& program) {
  std::vector<bool> met(program.conds.size(), false), shared(program.conds.size(), false);
  for (const Rule& rule : program.rules) {
    const std::size_t condition = program::index(rule.condition);
    shared[condition] = met[condition];
    met[condition] = true;
  }
  return shared;
}

void diagnose_duplicates(Subject& subject) {
  const Program& program = subject.program;
  const std::vector<bool> shared = shared_conditions(program);
  std::unordered_map<const Rule*, RuleId, HashOfRule, SameRule> first_of;   // of rules that are the same
  ByFamily<RuleId> found(subject);
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const Rule& rule = program.rules[i];
    if (!shared[program::index(rule.condition)] || writes_nothing(rule)) continue;
    const auto [twin, fresh] = first_of.try_emplace(&rule, RuleId{i});
    if (!fresh && program[twin->second].span != rule.span) found.add(RuleId{i}, twin->second);   // instances of one rule: see KB1060, unused-binder
  }
  found.for_each([&](RuleId id, RuleId twin, std::uint32_t count) {
    const Rule& rule = program[id];
    const Rule& first = program[twin];
    // If a rule of the user and one of the library repeat each other, the message is about the user's.
    const bool here = !rule.standard || first.standard;
    subject.diagnostics
        .report(Kind::kDuplicateRule, here ? rule.span : first.span, {here ? rule.name : first.name, here ? first.name : rule.name, more(count)})
        .note(Kind::kOtherRuleHere, here ? first.span : rule.span, {here ? first.name : rule.name});
  });
}

/// A rule with a timer is left out: there `when` is armed again only when the timer has been found not to hold.
void diagnose_self_defeating(Subject& subject) {
  const Program& program = subject.program;
  const std::vector<bool> timed = program::marked(program, [](const program::Cond& cond) { return cond.op == program::Cond::Op::kFor; });
  Satisfier& satisfier = subject.wide_satisfier();
  ByFamily<CellId> found(subject);
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const Rule& rule = program.rules[i];
    if (rule.mode != program::Mode::kWhile || Subject::generated(rule) || timed[program::index(rule.condition)]) continue;
    const Demands demands = satisfier.demands(rule.condition, rule.level);
    if (!demands.possible) continue;
    if (const auto cell = undone(subject, demands, rule)) found.add(RuleId{i}, *cell);
  }
  found.for_each([&](RuleId id, CellId cell, std::uint32_t count) {
    subject.diagnostics.report(Kind::kSelfDefeating, program[id].span,
                               {program[id].name, program[cell].name, more(count)});
  });
}

void diagnose_resets(Subject& subject) {
  ByFamily<bool> found(subject);
  for (std::uint32_t i = 0; i < subject.program.rules.size(); ++i) {
    const Rule& rule = subject.program.rules[i];
    if (rule.reset && rule.level + 1 == subject.program.levels.size()) found.add(RuleId{i}, true);
  }
  found.for_each([&](RuleId id, bool, std::uint32_t count) {
    const Rule& rule = subject.program[id];
    subject.diagnostics.report(Kind::kResetAtControl, rule.span, {rule.name, subject.program.levels[rule.level], more(count)});
  });
}

/// Reports rules of the control level that write what strategies are wanted by. The level chooses from the state before it.
void diagnose_late(Subject& subject) {
  const Program& program = subject.program;
  std::vector<CellId> strategy_of(program.cells.size(), CellId::kNone);
  for (const CellId strategy : program.priority) {
    for (const CellId satellite : program[strategy].satellites) strategy_of[program::index(satellite)] = strategy;
  }
  ByFamily<CellId> found(subject);
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const Rule& rule = program.rules[i];
    if (rule.level + 1 < program.levels.size() || Subject::generated(rule)) continue;
    const auto write = std::find_if(rule.writes.begin(), rule.writes.end(),
                                    [&](const program::Write& one) { return strategy_of[program::index(one.cell)] != CellId::kNone; });
    if (write != rule.writes.end()) found.add(RuleId{i}, write->cell);
  }
  found.for_each([&](RuleId id, CellId cell, std::uint32_t count) {
    const Rule& rule = program[id];
    subject.diagnostics.report(Kind::kWantedAtControl, rule.span,
                               {rule.name, program[cell].name, program.levels[rule.level], program[strategy_of[program::index(cell)]].name, more(count)});
  });
}

}  // namespace

std::optional<CellId> undone(const Subject& subject, const Demands& demands, const Rule& rule) {
  const Program& program = subject.program;
  const auto firing = static_cast<float>(program.settings.firing);
  for (const Restriction& demand : demands.each) {
    if (demand.variable >= program.cells.size()) break;
    const CellId cell{demand.variable};
    const auto written = program::net_value(program, subject.group_of, rule, cell);
    if (written && (region_of(*written, firing) & demand.allowed) == 0) return cell;
  }
  return std::nullopt;
}

void diagnose_effects(Subject& subject) {
  diagnose_written(subject);
  diagnose_resets(subject);
  diagnose_late(subject);
  diagnose_void(subject);
  diagnose_needless(subject);
  diagnose_lowered_in_vain(subject);
  diagnose_duplicates(subject);
  diagnose_self_defeating(subject);
}

}  // namespace kb::analysis
