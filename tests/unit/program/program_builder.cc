#include "tests/unit/program/program_builder.h"

#include <algorithm>
#include <stdexcept>

#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::program::testing {
namespace {

Expression leaf(Cond::Op op, Term term, std::string cell) {
  Expression expression;
  expression.op = op;
  expression.term = term;
  expression.cell = std::move(cell);
  return expression;
}

Expression compound(Cond::Op op, std::vector<Expression> parts) {
  Expression expression;
  expression.op = op;
  expression.parts = std::move(parts);
  return expression;
}

CondId make(const Expression& expression, const Program& program, const std::map<std::string, CellId>& cells,
            ConditionPool& pool) {
  std::vector<CondId> parts;
  for (const Expression& part : expression.parts) parts.push_back(make(part, program, cells, pool));
  switch (expression.op) {
    case Cond::Op::kAnd: return pool.all_of(parts);
    case Cond::Op::kOr: return pool.any_of(parts);
    case Cond::Op::kNot: return pool.negation(parts.front());
    case Cond::Op::kFor: return pool.held_for(parts.front(), expression.duration_us);
    case Cond::Op::kEvent: return pool.event(cells.at(expression.cell));
    case Cond::Op::kLost: return pool.lost(cells.at(expression.cell));
    case Cond::Op::kSeen: return pool.seen(cells.at(expression.cell));
    case Cond::Op::kIs: return pool.is(cells.at(expression.cell), expression.term);
  }
  throw std::logic_error("no such condition");
}

}  // namespace

Expression high(std::string cell) { return leaf(Cond::Op::kIs, Term::kHigh, std::move(cell)); }
Expression low(std::string cell) { return leaf(Cond::Op::kIs, Term::kLow, std::move(cell)); }
Expression zero(std::string cell) { return leaf(Cond::Op::kIs, Term::kZero, std::move(cell)); }
Expression seen(std::string fact) { return leaf(Cond::Op::kSeen, Term::kHigh, std::move(fact)); }
Expression event(std::string fact) { return leaf(Cond::Op::kEvent, Term::kHigh, std::move(fact)); }
Expression lost(std::string fact) { return leaf(Cond::Op::kLost, Term::kHigh, std::move(fact)); }
Expression all(std::vector<Expression> parts) { return compound(Cond::Op::kAnd, std::move(parts)); }
Expression any(std::vector<Expression> parts) { return compound(Cond::Op::kOr, std::move(parts)); }
Expression no(Expression part) { return compound(Cond::Op::kNot, {std::move(part)}); }
Expression held(Expression part, std::uint32_t duration_us) {
  Expression expression = compound(Cond::Op::kFor, {std::move(part)});
  expression.duration_us = duration_us;
  return expression;
}

NamedEffect raise(std::string cell) { return {std::move(cell), 1.0f, false}; }
NamedEffect lower(std::string cell) { return {std::move(cell), -1.0f, false}; }
NamedEffect assign(std::string cell, float value) { return {std::move(cell), value, false}; }
NamedEffect reset_all() { return {"", 0.0f, true}; }

ProgramBuilder::ProgramBuilder(std::vector<std::string> levels) : levels_(std::move(levels)) {}

ProgramBuilder::NamedCell& ProgramBuilder::declare(const std::string& name, CellKind kind, float initial) {
  NamedCell named;
  named.cell.name = texts_->keep(name);
  named.cell.kind = kind;
  named.cell.initial = initial;
  std::vector<NamedCell>& cells = kind == CellKind::kFact        ? facts_
                                  : kind == CellKind::kSatellite ? satellites_
                                                                 : strategies_;
  return cells.emplace_back(std::move(named));
}

ProgramBuilder& ProgramBuilder::fact(const std::string& name, float satellite_initial) {
  fact(name, settings.event, settings.attention);
  satellites_.back().cell.initial = satellite_initial;
  return *this;
}

ProgramBuilder& ProgramBuilder::fact(const std::string& name, double own_event, double own_attention) {
  NamedCell& named = declare(name, CellKind::kFact, 0.0f);
  named.cell.event = own_event;
  named.cell.attention = own_attention;
  named.satellites = {"sat " + name};
  return satellite("sat " + name);
}

ProgramBuilder& ProgramBuilder::satellite(const std::string& name, float initial, bool keep) {
  declare(name, CellKind::kSatellite, initial).cell.keep = keep;
  return *this;
}

ProgramBuilder& ProgramBuilder::strategy(const std::string& name) {
  declare(name, CellKind::kStrategy, -1.0f).satellites = {"sat " + name};
  return satellite("sat " + name);
}

ProgramBuilder& ProgramBuilder::of(const std::string& satellite, const std::string& target) {
  for (std::vector<NamedCell>* cells : {&facts_, &strategies_}) {
    for (NamedCell& named : *cells) {
      if (named.cell.name == target) named.satellites.push_back(satellite);
    }
  }
  return *this;
}

ProgramBuilder& ProgramBuilder::exclusive(std::vector<std::string> members) {
  exclusive_.push_back(std::move(members));
  return *this;
}

ProgramBuilder& ProgramBuilder::when(std::string name, std::string level, Expression condition,
                                     std::vector<NamedEffect> effects) {
  rules_.push_back({std::move(name), std::move(level), Mode::kWhen, std::move(condition), std::move(effects)});
  return *this;
}

ProgramBuilder& ProgramBuilder::while_true(std::string name, std::string level, Expression condition,
                                           std::vector<NamedEffect> effects) {
  rules_.push_back({std::move(name), std::move(level), Mode::kWhile, std::move(condition), std::move(effects)});
  return *this;
}

ProgramBuilder& ProgramBuilder::idle(const std::string& policy) {
  idle_ = policy;
  return *this;
}

struct ProgramBuilder::Building {
  const ProgramBuilder& from;
  Program program;
  std::map<std::string, CellId> cells;

  void add_cells() {
    program.texts = from.texts_;
    program.facts = static_cast<std::uint32_t>(from.facts_.size());
    program.satellites = static_cast<std::uint32_t>(from.satellites_.size());
    program.strategies = static_cast<std::uint32_t>(from.strategies_.size());
    const auto all_cells = {&from.facts_, &from.satellites_, &from.strategies_};
    for (const auto* kind : all_cells) {
      for (const NamedCell& named : *kind) {
        cells.emplace(named.cell.name, CellId{static_cast<std::uint32_t>(program.cells.size())});
        program.cells.push_back(named.cell);
      }
    }
    std::size_t next = 0;
    for (const auto* kind : all_cells) {
      for (const NamedCell& named : *kind) {
        for (const std::string& name : named.satellites) program.cells[next].satellites.push_back(cells.at(name));
        ++next;
      }
    }
    for (const NamedCell& named : from.strategies_) program.priority.push_back(cells.at(std::string(named.cell.name)));
    for (const std::vector<std::string>& group : from.exclusive_) {
      std::vector<CellId>& members = program.exclusive.emplace_back();
      for (const std::string& name : group) members.push_back(cells.at(name));
      std::sort(members.begin(), members.end());
    }
  }

  void add_rules() {
    const std::vector<std::uint32_t> group_of = group_of_cells(program);
    ConditionPool pool(program.conds);
    for (const NamedRule& named : from.rules_) {
      Rule rule;
      rule.name = program.texts->keep(named.name);
      rule.mode = named.mode;
      rule.place = program.place("built.kb:" + std::to_string(program.rules.size() + 1) + ":1");
      const auto level = std::find(program.levels.begin(), program.levels.end(), named.level);
      rule.level = static_cast<std::uint32_t>(level - program.levels.begin());
      rule.condition = make(named.condition, program, cells, pool);
      std::vector<Effect> effects;
      for (const NamedEffect& effect : named.effects) {
        effects.push_back({effect.reset ? CellId::kNone : cells.at(effect.cell), effect.value, effect.reset});
      }
      fold_effects(program, group_of, effects, rule);
      program.rules.push_back(std::move(rule));
    }
    std::stable_sort(program.rules.begin(), program.rules.end(),
                     [](const Rule& a, const Rule& b) { return a.level < b.level; });
    append_control_rules(program, pool);
  }
};

Program ProgramBuilder::build() const {
  Building building{*this, {}, {}};
  Program& program = building.program;
  program.settings = settings;
  program.levels = levels_;
  building.add_cells();
  if (idle_ == "hold") {
    program.settings.idle = Idle::kHold;
  } else if (idle_ != "stop") {
    program.settings.idle = Idle::kStrategy;
    program.settings.idle_strategy = building.cells.at(idle_);
  }
  building.add_rules();
  const std::vector<std::string> faults = verify(program);
  if (!faults.empty()) throw std::logic_error(faults.front());
  return std::move(program);
}

CellId cell(const Program& program, const std::string& name) {
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) {
    if (program.cells[i].name == name) return CellId{i};
  }
  throw std::logic_error("no cell " + name);
}

RuleId rule(const Program& program, const std::string& name) {
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    if (program.rules[i].name == name) return RuleId{i};
  }
  throw std::logic_error("no rule " + name);
}

std::vector<float> facts(const Program& program, const std::map<std::string, float>& values) {
  std::vector<float> all_facts(program.facts, 0.0f);
  for (const auto& [name, value] : values) all_facts.at(index(cell(program, name))) = value;
  return all_facts;
}

std::vector<std::string> names(const Program& program, const std::vector<RuleId>& rules) {
  std::vector<std::string> found;
  for (const RuleId id : rules) found.emplace_back(program[id].name);
  return found;
}

std::vector<std::string> names(const Program& program, const std::vector<CellId>& cells) {
  std::vector<std::string> found;
  for (const CellId id : cells) found.emplace_back(program[id].name);
  return found;
}

}  // namespace kb::program::testing
