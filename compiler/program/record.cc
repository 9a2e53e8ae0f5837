#include "compiler/program/net_effects.h"
#include "compiler/program/why.h"

namespace kb::program {

Recorder::Recorder(const Program& program, std::uint64_t wanted) : program_(program), wanted_(wanted) {
  record_.fired_before.assign(program.rules.size(), 0);
  record_.last_write.resize(program.cells.size());
  record_.levels.resize(program.levels.size());
}

void Recorder::level_evaluated(const Interpreter& interpreter, std::uint32_t level) {
  if (watched_ != CellId::kNone) found_[level] = interpreter.value(watched_);
  if (interpreter.ticks() + 1 != wanted_) return;
  LevelRecord& kept = record_.levels[level];
  for (std::uint32_t i = 0; i < program_.cells.size(); ++i) kept.cf.push_back(interpreter.value(CellId{i}));
  for (std::uint32_t i = 0; i < program_.conds.size(); ++i) {
    kept.truth.push_back(interpreter.holds(CondId{i}));
    kept.held_us.push_back(program_.conds[i].op == Cond::Op::kFor ? interpreter.held_us(CondId{i}, level)
                                                                  : std::nullopt);
  }
  for (std::uint32_t i = 0; i < program_.rules.size(); ++i) kept.armed.push_back(interpreter.armed(RuleId{i}));
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
  for (std::uint32_t i = 0; i < program_.facts; ++i) {
    record_.seen.push_back(interpreter.seen(CellId{i}));
    record_.event.push_back(interpreter.event(CellId{i}));
    record_.lost.push_back(interpreter.lost(CellId{i}));
  }
  for (std::uint32_t i = 0; i < program_.cells.size(); ++i) record_.cf_after.push_back(interpreter.value(CellId{i}));
}

void Recorder::go_on() {
  for (const RuleId rule : record_.tick.fired) record_.fired_before[index(rule)] = record_.tick.number;
  record_.levels.assign(program_.levels.size(), {});
  for (std::vector<bool>* facts : {&record_.seen, &record_.event, &record_.lost}) facts->clear();
  record_.cf_after.clear();
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
