#include "tools/kbc/trace/coverage.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace kb::trace {
namespace {

using program::CellId;
using program::CellKind;
using program::Interpreter;
using program::Program;
using program::RuleId;

bool is_high(const Program& program, float value) { return value >= static_cast<float>(program.settings.firing); }

std::unordered_set<std::string_view> landmark_names(const model::Model& model) {
  std::unordered_set<std::string_view> names;
  for (const model::Map& map : model.maps) {
    for (const model::RowId row : map.landmarks)
      if (const model::CellId cell = model[row].cell; cell != model::CellId::kNone) names.insert(model[cell].name);
  }
  return names;
}

// Collects the instances of each rule as written. Rules are ordered by level, so the instances of one need not be neighbours.
std::vector<CoverageReport::Template> templates_of(const Program& program, const std::vector<bool>& dead, const Coverage& coverage) {
  std::vector<CoverageReport::Template> templates;
  std::unordered_map<std::string_view, std::size_t> places;
  for (std::size_t i = 0; i < program.rules.size(); ++i) {
    const program::Rule& rule = program.rules[i];
    const auto [place, is_new] = places.try_emplace(rule.tmpl(), templates.size());
    if (is_new)
      templates.push_back({.name = std::string(rule.tmpl()), .at = program.at(rule), .level = program.levels[rule.level], .instances = {},
                           .library = rule.standard && rule.span.known(), .dead = !dead.empty()});
    CoverageReport::Template& one = templates[place->second];
    one.dead = one.dead && dead[i];
    const Coverage::Rule& counts = coverage.rule(static_cast<RuleId>(i));
    one.fired += counts.fired;
    one.fired_instances += counts.fired > 0 ? 1 : 0;
    one.held_instances += counts.held > 0 ? 1 : 0;
    one.instances.push_back({std::string(rule.name), counts.fired, counts.held});
  }
  return templates;
}

// By cell: whether some rule raises it. The others, such as the unused satellites of most facts, need no coverage.
std::vector<bool> raisable_cells(const Program& program) {
  std::vector<bool> raisable(program.cells.size(), false);
  for (const program::Rule& rule : program.rules) {
    for (const program::Write& write : rule.writes)
      if (is_high(program, write.value)) raisable[index(write.cell)] = true;
  }
  return raisable;
}

}  // namespace

Coverage::Coverage(const Program& program)
    : program_(program),
      rules_(program.rules.size()),
      facts_(program.facts),
      raised_(program.cells.size(), 0),
      strategies_(program.cells.size()),
      high_(program.cells.size(), false) {}

void Coverage::begin_run() {
  ++runs_;
  last_strategy_ = CellId::kNone;
}

void Coverage::before(const Interpreter& interpreter) {
  for (std::uint32_t i = program_.facts; i < program_.first_strategy(); ++i) high_[i] = is_high(program_, interpreter.value(CellId{i}));
  attended_.clear();
  for (std::uint32_t i = 0; i < program_.facts; ++i) {
    const auto& satellites = program_.cells[i].satellites;
    attended_.push_back(std::any_of(satellites.begin(), satellites.end(), [&](CellId s) { return high_[index(s)]; }));
  }
}

// Also what a lower level takes back on the same tick has been raised.
void Coverage::count_raised(const Interpreter& interpreter) {
  for (std::uint32_t i = program_.facts; i < program_.first_strategy(); ++i) {
    const bool high = is_high(program_, interpreter.value(CellId{i}));
    raised_[i] += high && !high_[i] ? 1 : 0;
    high_[i] = high;
  }
}

void Coverage::level_evaluated(const Interpreter& interpreter, std::uint32_t level) {
  count_raised(interpreter);
  const auto [begin, end] = program::rules_of(program_, level);
  for (std::uint32_t rule = begin; rule < end; ++rule)
    if (interpreter.holds(program_.rules[rule].condition)) ++rules_[rule].held;
}

void Coverage::after(const program::Tick& tick, const Interpreter& interpreter) {
  ++ticks_;
  for (const RuleId rule : tick.fired) ++rules_[index(rule)].fired;
  for (const CellId fact : tick.events)
    ++(attended_[index(fact)] ? facts_[index(fact)].attended : facts_[index(fact)].unattended);
  for (std::uint32_t i = 0; i < program_.facts; ++i) facts_[i].seen += interpreter.seen(CellId{i}) ? 1 : 0;
  count_raised(interpreter);
  if (tick.strategy != CellId::kNone) {
    Strategy& strategy = strategies_[index(tick.strategy)];
    ++strategy.ticks;
    strategy.starts += tick.strategy != last_strategy_ ? 1 : 0;
  }
  last_strategy_ = tick.strategy;
}

void Coverage::add(const Coverage& other) {
  runs_ += other.runs_;
  ticks_ += other.ticks_;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    rules_[i].fired += other.rules_[i].fired;
    rules_[i].held += other.rules_[i].held;
  }
  for (std::size_t i = 0; i < facts_.size(); ++i) {
    facts_[i].attended += other.facts_[i].attended;
    facts_[i].unattended += other.facts_[i].unattended;
    facts_[i].seen += other.facts_[i].seen;
  }
  for (std::size_t i = 0; i < raised_.size(); ++i) {
    raised_[i] += other.raised_[i];
    strategies_[i].starts += other.strategies_[i].starts;
    strategies_[i].ticks += other.strategies_[i].ticks;
  }
}

CoverageReport summarise(std::string path, const Covered& covered, const Coverage& coverage) {
  const Program& program = covered.program;
  CoverageReport report{.program = std::move(path),
                        .runs = coverage.runs(),
                        .ticks = coverage.ticks(),
                        .templates = templates_of(program, covered.dead, coverage),
                        .facts = {},
                        .satellites = {},
                        .strategies = {},
                        .library = {}};
  const auto landmarks = landmark_names(covered.model);
  const std::vector<bool> raisable = raisable_cells(program);
  for (std::size_t i = 0; i < program.cells.size(); ++i) {
    const program::Cell& cell = program.cells[i];
    const auto id = static_cast<CellId>(i);
    const bool library = cell.declared.known() && covered.sources.standard(cell.declared.file);
    if (cell.kind == CellKind::kFact) {
      const Coverage::Fact& fact = coverage.fact(id);
      report.facts.push_back({std::string(cell.name), fact.attended, fact.unattended, fact.seen, landmarks.contains(cell.name), library});
    } else if (cell.kind == CellKind::kSatellite) {
      if (raisable[i]) report.satellites.push_back({std::string(cell.name), coverage.raised(id), is_high(program, cell.initial), library});
    } else {
      report.strategies.push_back({std::string(cell.name), coverage.strategy(id).starts, coverage.strategy(id).ticks, library});
    }
  }
  return report;
}

}  // namespace kb::trace
