#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"
#include "compiler/program/why.h"

namespace kb::program {

Recorder::Recorder(const Program& program, std::uint64_t wanted) : program_(program), wanted_(wanted) {
  record_.fired_before.assign(program.rules.size(), 0);
  record_.last_write.resize(program.cells.size());
  std::vector<std::vector<CondId>> roots(program.levels.size());
  for (const Rule& rule : program.rules) roots[rule.level].push_back(rule.condition);
  for (const std::vector<CondId>& of_level : roots) {
    conditions_.push_back(reachable(program.conds, of_level));
    record_.levels.push_back({std::vector<float>(program.cells.size()), std::vector<bool>(program.conds.size()),
                              std::vector<std::optional<std::int64_t>>(program.conds.size()), std::vector<bool>(program.rules.size())});
  }
}

void Recorder::level_evaluated(const Interpreter& interpreter, std::uint32_t level) {
  if (watched_ != CellId::kNone) found_[level] = interpreter.value(watched_);
  if (interpreter.ticks() + 1 != wanted_) return;
  LevelRecord& kept = record_.levels[level];
  for (std::uint32_t i = 0; i < program_.cells.size(); ++i) kept.cf[i] = interpreter.value(CellId{i});
  for (const CondId id : conditions_[level]) {
    kept.truth[index(id)] = interpreter.holds(id);
    if (program_[id].op == Cond::Op::kFor) kept.held_us[index(id)] = interpreter.held_us(id, level);
  }
  for (std::uint32_t i = 0; i < program_.rules.size(); ++i) {
    if (program_.rules[i].level == level) kept.armed[i] = interpreter.armed(RuleId{i});
  }
}

void Recorder::tick_ended(const Tick& tick, const Interpreter& interpreter) {
  if (watched_ != CellId::kNone) found_.back() = interpreter.value(watched_);
  if (tick.number > wanted_) return;
  note_writes(tick);
  if (tick.number < wanted_) {
    for (const RuleId rule : tick.fired) record_.fired_before[index(rule)] = tick.number;
    return;
  }
  record_.tick = tick;
  for (std::vector<bool>* facts : {&record_.seen, &record_.event, &record_.lost}) facts->resize(program_.facts);
  for (std::uint32_t i = 0; i < program_.facts; ++i) {
    record_.seen[i] = interpreter.seen(CellId{i});
    record_.event[i] = interpreter.event(CellId{i});
    record_.lost[i] = interpreter.lost(CellId{i});
  }
  record_.cf_after.resize(program_.cells.size());
  for (std::uint32_t i = 0; i < program_.cells.size(); ++i) record_.cf_after[i] = interpreter.value(CellId{i});
}

void Recorder::go_on() {
  for (const RuleId rule : record_.tick.fired) record_.fired_before[index(rule)] = record_.tick.number;
  ++wanted_;
}

void Recorder::note_writes(const Tick& tick) {
  for (const RuleId id : tick.fired) {
    const Rule& rule = program_[id];
    for_each_net_write(program_, rule, [&](CellId cell, float value) {
      LastWrite& last = record_.last_write[index(cell)];
      const bool joins = last.tick == tick.number && program_[last.rules.back()].level == rule.level;
      if (!joins) last = {tick.number, {}, {}, true};
      last.rules.push_back(id);
      last.values.push_back(value);
      last.of_one_mind = last.of_one_mind && last.values.front() == value;
    });
  }
}

}  // namespace kb::program
