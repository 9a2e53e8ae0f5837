#include "tests/unit/sim_report/small_mind.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace kb::sim::testing {

using Condition = MindNames::Condition;
using CellKind = MindNames::Cell::Kind;

std::uint32_t MindBuilder::fact(const std::string& name, float initial) {
  names.cells.push_back({.name = name, .kind = CellKind::kFact, .initial = initial});
  return static_cast<std::uint32_t>(names.cells.size() - 1);
}
std::uint32_t MindBuilder::satellite(const std::string& name, float initial) {
  names.cells.push_back({.name = name, .kind = CellKind::kSatellite, .initial = initial});
  const auto id = static_cast<std::uint32_t>(names.cells.size() - 1);
  for (auto& other : names.cells) {
    if (name == "sat " + other.name) other.satellites.push_back(id);
  }
  return id;
}
std::uint32_t MindBuilder::strategy(const std::string& name, std::uint32_t of, const std::string& control) {
  names.cells.push_back({.name = name, .kind = CellKind::kStrategy, .initial = -1.0f, .control = control, .satellites = {of}});
  return static_cast<std::uint32_t>(names.cells.size() - 1);
}
std::uint32_t MindBuilder::cell(const std::string& name) const {
  for (std::uint32_t i = 0; i < names.cells.size(); ++i) {
    if (names.cells[i].name == name) return i;
  }
  throw std::out_of_range("no cell " + name);
}

std::uint32_t MindBuilder::add(Condition condition) {
  names.conditions.push_back(std::move(condition));
  return static_cast<std::uint32_t>(names.conditions.size() - 1);
}
std::uint32_t MindBuilder::is(const std::string& name, Condition::Term term) { return add({.op = Condition::Op::kIs, .term = term, .cell = cell(name)}); }
std::uint32_t MindBuilder::about(Condition::Op op, const std::string& name) { return add({.op = op, .cell = cell(name)}); }
std::uint32_t MindBuilder::all(std::vector<std::uint32_t> parts) { return add({.op = Condition::Op::kAnd, .children = std::move(parts)}); }
std::uint32_t MindBuilder::any(std::vector<std::uint32_t> parts) { return add({.op = Condition::Op::kOr, .children = std::move(parts)}); }
std::uint32_t MindBuilder::no(std::uint32_t part) { return add({.op = Condition::Op::kNot, .children = {part}}); }
std::uint32_t MindBuilder::lasting(std::uint32_t part, double duration_s) { return add({.op = Condition::Op::kFor, .duration_s = duration_s, .children = {part}}); }

MindNames::Rule& MindBuilder::rule(const std::string& name, const std::string& level, std::uint32_t condition, std::vector<MindNames::Write> writes) {
  line_ += 4;
  std::sort(writes.begin(), writes.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  names.rules.push_back({.name = name, .level = level, .at = "mission.kb:" + std::to_string(line_) + ":1", .condition = static_cast<std::int32_t>(condition), .writes = std::move(writes)});
  return names.rules.back();
}

SmallMind::SmallMind(const MindNames& names)
    : names_(names), seen_(names.cells.size()), event_(names.cells.size()), lost_(names.cells.size()), armed_(names.rules.size(), true), since_(names.conditions.size(), -1.0) {
  for (const auto& cell : names.cells) values_.push_back(cell.initial);
}

bool SmallMind::holds(std::uint32_t condition, double t_s) {
  const Condition& one = names_.conditions[condition];
  // Every part is looked at: timers must run also where the answer is known already.
  std::size_t count = 0;
  for (const std::uint32_t child : one.children) count += holds(child, t_s) ? 1 : 0;
  switch (one.op) {
    case Condition::Op::kAnd: return count == one.children.size();
    case Condition::Op::kOr: return count > 0;
    case Condition::Op::kNot: return count == 0;
    case Condition::Op::kFor:
      if (count == 0) since_[condition] = -1.0;
      else if (since_[condition] < 0.0) since_[condition] = t_s;
      return count > 0 && t_s - since_[condition] >= one.duration_s - 1e-9;
    case Condition::Op::kEvent: return event_[one.cell];
    case Condition::Op::kLost: return lost_[one.cell];
    case Condition::Op::kSeen: return seen_[one.cell];
    case Condition::Op::kIs: break;
  }
  const float x = before_[one.cell];
  const float degree = one.term == Condition::Term::kHigh ? x : one.term == Condition::Term::kLow ? -x : 1.0f - std::abs(x);
  return degree >= names_.firing;
}

void SmallMind::look(Frame& frame) {
  for (std::uint32_t i = 0; i < names_.cells.size(); ++i) {
    const auto& cell = names_.cells[i];
    if (cell.kind != CellKind::kFact) continue;
    const bool attended = seen_[i] || std::any_of(cell.satellites.begin(), cell.satellites.end(), [&](std::uint32_t id) { return values_[id] >= names_.firing; });
    const bool sees = values_[i] > (attended ? cell.attended : cell.plain);
    event_[i] = !first_ && sees && !seen_[i];
    lost_[i] = !first_ && !sees && seen_[i];
    seen_[i] = sees;
    if (event_[i]) frame.events.push_back(i);
    if (lost_[i]) frame.lost.push_back(i);
  }
  first_ = false;
}

void SmallMind::run_level(std::uint32_t level, Frame& frame) {
  if (level + 1 == names_.levels.size()) {
    for (std::uint32_t i = 0; i < names_.cells.size(); ++i) {
      if (names_.cells[i].kind == CellKind::kStrategy) values_[i] = -1.0f;
    }
  }
  before_ = values_;
  for (std::uint32_t i = 0; i < names_.rules.size(); ++i) {
    const MindNames::Rule& rule = names_.rules[i];
    if (rule.level != names_.levels[level]) continue;
    const bool now = holds(static_cast<std::uint32_t>(rule.condition), frame.t_s);
    const bool fires = now && (rule.each_tick || armed_[i]);
    armed_[i] = !now;
    if (!fires) continue;
    frame.fired.push_back(i);
    for (const std::uint32_t group : rule.clears) {
      for (const std::uint32_t cell : names_.exclusive[group]) values_[cell] = -1.0f;
    }
    for (const auto& write : rule.writes) values_[write.cell] = write.value;
  }
}

void SmallMind::tick(const std::vector<float>& facts, Frame& frame) {
  const std::vector<float> last = values_;
  for (std::size_t i = 0; i < facts.size(); ++i) values_[i] = facts[i];
  look(frame);
  for (std::uint32_t level = 0; level < names_.levels.size(); ++level) run_level(level, frame);
  for (std::uint32_t i = 0; i < values_.size(); ++i) {
    if (values_[i] != last[i]) frame.changed.push_back({i, values_[i]});
    if (names_.cells[i].kind == CellKind::kStrategy && values_[i] >= names_.firing) frame.strategy = static_cast<std::int32_t>(i);
  }
  frame.status = frame.strategy < 0 ? "no_strategy" : "ok";
}

}  // namespace kb::sim::testing
