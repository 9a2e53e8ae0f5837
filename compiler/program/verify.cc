#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "compiler/program/conditions.h"
#include "compiler/program/program.h"

namespace kb::program {
namespace {

class Verifier {
 public:
  explicit Verifier(const Program& program) : program_(program) {}

  std::vector<std::string> run() {
    verify_cells();
    if (!faults_.empty()) return std::move(faults_);  // nothing else can be looked up
    verify_settings();
    verify_exclusive();
    verify_priority();
    verify_conditions();
    if (!faults_.empty()) return std::move(faults_);
    verify_rules();
    verify_perception();
    for (const Control& control : program_.controls) {
      if (!is(control.strategy, CellKind::kStrategy))
        fault("a control line drives no strategy: `{}`", control.controller);
    }
    for (const LegLimit& limit : program_.limits) {
      if (!is(limit.leg, CellKind::kSatellite) || !(limit.limit_m_per_s > 0.0f)) fault("a speed limit of {} m/s belongs to no leg", limit.limit_m_per_s);
    }
    return std::move(faults_);
  }

 private:
  template <class... Args>
  void fault(fmt::format_string<Args...> text, Args&&... args) {
    faults_.push_back(fmt::format(text, std::forward<Args>(args)...));
  }

  [[nodiscard]] bool is(CellId cell, CellKind kind) const {
    return index(cell) < program_.cells.size() && program_[cell].kind == kind;
  }
  [[nodiscard]] static bool in_range(float value) { return value >= -1.0f && value <= 1.0f; }

  void verify_perception() {
    const Perception& perception = program_.perception;
    std::vector<bool> there(program_.facts, true);  // given, or perceived before
    for (const Perceived& perceived : perception.perceived) {
      if (!is(perceived.fact, CellKind::kFact)) return fault("what is perceived is no fact");
      there[index(perceived.fact)] = false;
    }
    for (std::size_t i = 0; i < perception.percepts.size(); ++i) {
      const Percept& percept = perception.percepts[i];
      for (const PerceptId child : percept.children) {
        if (static_cast<std::size_t>(child) >= i) fault("percept {} stands before a part of it", i);
      }
      const bool reads = percept.op == Percept::Op::kFits || percept.op == Percept::Op::kReads;
      if (reads && percept.reading >= perception.readings()) fault("percept {} has no reading", i);
      if (percept.op == Percept::Op::kFits && percept.prototype >= perception.prototypes.size()) fault("percept {} has no prototype", i);
      if (percept.op == Percept::Op::kFact && !is(percept.cell, CellKind::kFact)) return fault("percept {} is no fact", i);
    }
    if (!faults_.empty()) return;
    for (const Perceived& perceived : perception.perceived) {
      std::vector<PerceptId> todo{perceived.percept};
      while (!todo.empty()) {
        const Percept& percept = perception[todo.back()];
        todo.pop_back();
        todo.insert(todo.end(), percept.children.begin(), percept.children.end());
        if (percept.op == Percept::Op::kFact && !there[index(percept.cell)]) fault("`{}` is perceived too late", program_[percept.cell].name);
      }
      there[index(perceived.fact)] = true;
    }
  }

  void verify_cells() {
    const std::size_t counted = std::size_t{program_.facts} + program_.satellites + program_.strategies;
    if (counted != program_.cells.size()) return fault("{} cells, {} counted", program_.cells.size(), counted);
    for (std::uint32_t i = 0; i < program_.cells.size(); ++i) {
      const Cell& cell = program_.cells[i];
      const CellKind kind = i < program_.facts                         ? CellKind::kFact
                            : i < program_.first_strategy()         ? CellKind::kSatellite
                                                                    : CellKind::kStrategy;
      if (cell.kind != kind) fault("cell `{}` stands among cells of another kind", cell.name);
      if (!in_range(cell.initial)) fault("cell `{}` starts outside [-1, 1]", cell.name);
      for (const CellId satellite : cell.satellites) {
        if (!is(satellite, CellKind::kSatellite)) fault("cell `{}` has a satellite that is none", cell.name);
      }
      if (kind == CellKind::kFact &&
          !(cell.attention >= 0.0 && cell.event - cell.attention >= 0.0 && cell.event <= 1.0)) {
        fault("fact `{}`: thresholds {} and {} leave [0, 1]", cell.name, cell.event, cell.attention);
      }
    }
  }

  void verify_settings() {
    const Settings& settings = program_.settings;
    constexpr double kLeast = std::numeric_limits<float>::denorm_min();   // smaller values are 0 in the float of the runtime
    if (!(settings.firing >= kLeast && settings.firing <= 1.0)) fault("firing = {} is outside (0, 1]", settings.firing);
    if (settings.idle == Idle::kStrategy && !is(settings.idle_strategy, CellKind::kStrategy)) {
      fault("the idle strategy is no strategy");
    }
  }

  void verify_exclusive() {
    std::vector<bool> taken(program_.cells.size(), false);
    for (const std::vector<CellId>& group : program_.exclusive) {
      if (group.empty()) return fault("an exclusive group is empty");
      if (!std::is_sorted(group.begin(), group.end())) fault("an exclusive group is not ascending");
      for (const CellId member : group) {
        if (index(member) >= program_.cells.size()) return fault("an exclusive group holds no cell");
        if (program_[member].kind == CellKind::kStrategy)
          fault("strategy `{}` is in an exclusive group", program_[member].name);
        if (program_[member].kind != program_[group.front()].kind)
          fault("an exclusive group mixes facts and satellites");
        if (taken[index(member)]) fault("cell `{}` is in two exclusive groups", program_[member].name);
        taken[index(member)] = true;
      }
    }
  }

  void verify_priority() {
    std::vector<CellId> order = program_.priority;
    std::sort(order.begin(), order.end());
    const bool each_once =
        order.size() == program_.strategies && std::adjacent_find(order.begin(), order.end()) == order.end() &&
        std::all_of(order.begin(), order.end(), [&](CellId u) { return is(u, CellKind::kStrategy); });
    if (!each_once) fault("the priority does not hold every strategy once");
  }

  void verify_conditions() {
    for (std::uint32_t i = 0; i < program_.conds.size(); ++i) {
      const Cond& cond = program_.conds[i];
      for (const CondId part : cond.children) {
        if (index(part) >= i) fault("condition {} has part {}, which is not before it", i, index(part));
      }
      const bool one = cond.op == Cond::Op::kNot || cond.op == Cond::Op::kFor;
      if (one && cond.children.size() != 1) fault("condition {} has {} parts, not one", i, cond.children.size());
      if (has_parts(cond.op)) continue;
      if (!cond.children.empty()) fault("condition {} asks for a cell and has parts", i);
      if (index(cond.cell) >= program_.cells.size()) {
        fault("condition {} asks for no cell", i);
      } else if (cond.op != Cond::Op::kIs && program_[cond.cell].kind != CellKind::kFact) {
        fault("condition {}: `{}` is no fact and cannot be seen", i, program_[cond.cell].name);
      }
    }
  }

  void verify_rules() {
    std::uint32_t level = 0;
    for (const Rule& rule : program_.rules) {
      if (rule.level >= program_.levels.size()) return fault("rule `{}` is at no level", rule.name);
      if (rule.level < level) fault("rule `{}` stands below a lower level", rule.name);
      level = rule.level;
      if (index(rule.condition) >= program_.conds.size()) fault("rule `{}` has no condition", rule.name);
      verify_writes(rule);
    }
  }

  void verify_writes(const Rule& rule) {
    const bool generated = rule.tmpl() == "run" && !rule.span.known();
    for (std::size_t i = 0; i < rule.writes.size(); ++i) {
      const Write& write = rule.writes[i];
      if (i > 0 && !(rule.writes[i - 1].cell < write.cell)) fault("rule `{}`: its writes are not ascending", rule.name);
      if (!in_range(write.value)) fault("rule `{}` writes a value outside [-1, 1]", rule.name);
      if (!is(write.cell, CellKind::kSatellite) && !(generated && is(write.cell, CellKind::kStrategy))) {
        fault("rule `{}` writes a cell that is no satellite", rule.name);
      }
    }
    for (const std::uint32_t group : rule.clears) {
      if (group >= program_.exclusive.size()) return fault("rule `{}` clears no exclusive group", rule.name);
      if (!is(program_.exclusive[group].front(), CellKind::kSatellite)) fault("rule `{}` clears facts", rule.name);
    }
    if (std::adjacent_find(rule.clears.begin(), rule.clears.end(), std::greater_equal<>()) != rule.clears.end()) {
      fault("rule `{}`: its clears are not ascending", rule.name);
    }
  }

  const Program& program_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> verify(const Program& program) {
  std::vector<std::string> faults = Verifier(program).run();
  for (const fuzzy::Controller& controller : program.fuzzy) {
    for (std::string& fault : fuzzy::verify(controller)) faults.push_back(std::move(fault));
  }
  return faults;
}

}  // namespace kb::program
