#include "sim/drive/mind_names.h"

#include <fmt/format.h>

#include "compiler/source/same_number.h"
#include "sim/mind/control_words.h"

namespace kb::sim {
namespace {

std::uint32_t number(auto id) { return static_cast<std::uint32_t>(id); }

std::vector<std::uint32_t> numbers(const auto& ids) {
  std::vector<std::uint32_t> out;
  for (const auto id : ids) out.push_back(number(id));
  return out;
}

using source::same_number;
static_assert(same_number(program::CellKind::kFact, MindNames::Cell::Kind::kFact) && same_number(program::CellKind::kSatellite, MindNames::Cell::Kind::kSatellite) &&
              same_number(program::CellKind::kStrategy, MindNames::Cell::Kind::kStrategy));

MindNames::Cell cell_of(const program::Cell& cell) {
  MindNames::Cell out;
  out.name = cell.name;
  out.kind = static_cast<MindNames::Cell::Kind>(cell.kind);
  out.initial = cell.initial;
  out.command = cell.command;
  out.keep = cell.keep;
  out.satellites = numbers(cell.satellites);
  const program::Thresholds thresholds = program::thresholds(cell);
  out.plain = thresholds.plain;
  out.attended = thresholds.attended;
  return out;
}

MindNames::Rule rule_of(const program::Program& program, const program::Rule& rule) {
  MindNames::Rule out;
  out.name = rule.name;
  out.level = program.levels[rule.level];
  out.at = program.at(rule);
  if (rule.condition != program::CondId::kNone) out.condition = static_cast<std::int32_t>(rule.condition);
  for (const program::Write& write : rule.writes) out.writes.push_back({number(write.cell), write.value});
  out.clears.assign(rule.clears.begin(), rule.clears.end());
  out.reset = rule.reset;
  out.each_tick = rule.mode == program::Mode::kWhile;
  return out;
}

/// A control line as it was written: `follow_line(speed: 0.4 m/s)`.
std::string control_text(const program::Control& control) {
  std::string arguments;
  for (const auto& argument : control.arguments) arguments += fmt::format("{}{}: {}", arguments.empty() ? "" : ", ", argument.name, value_text(argument));
  return fmt::format("{}({})", control.controller, arguments);
}

}  // namespace

MindNames names_of(const program::Program& program) {
  MindNames names;
  for (const program::Cell& cell : program.cells) names.cells.push_back(cell_of(cell));
  for (const program::Control& control : program.controls) names.cells[program::index(control.strategy)].control = control_text(control);
  for (const program::Rule& rule : program.rules) names.rules.push_back(rule_of(program, rule));
  for (const program::Cond& cond : program.conds) {
    names.conditions.push_back({static_cast<MindNames::Condition::Op>(cond.op), static_cast<MindNames::Condition::Term>(cond.term),
                                number(cond.cell), static_cast<double>(cond.duration_us) / 1e6, numbers(cond.children)});
  }
  for (const auto& group : program.exclusive) names.exclusive.push_back(numbers(group));
  names.levels = program.levels;
  names.firing = static_cast<float>(program.settings.firing);
  return names;
}

CellChanges::CellChanges(const MindNames& names) {
  for (const MindNames::Cell& cell : names.cells) values_.push_back(cell.initial);
}

void CellChanges::put(std::size_t cell, float value, Frame& frame) {
  if (values_[cell] == value) return;
  values_[cell] = value;
  frame.changed.push_back({static_cast<std::uint32_t>(cell), value});
}

void tell(const program::Tick& tick, const program::Program& program, Frame& frame) {
  frame.events = numbers(tick.events);
  frame.lost = numbers(tick.lost);
  frame.fired = numbers(tick.fired);
  for (const program::Conflict& conflict : tick.conflicts) {
    std::string rules;
    for (const program::RuleId rule : conflict.rules) rules += fmt::format("{}{}", rules.empty() ? "" : ", ", program.rules[program::index(rule)].name);
    frame.notes.push_back(fmt::format("conflict about {}: {}", program.cells[program::index(conflict.cell)].name, rules));
  }
}

}  // namespace kb::sim
