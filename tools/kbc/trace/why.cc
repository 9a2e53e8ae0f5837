#include "tools/kbc/trace/why.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "compiler/program/net_effects.h"

namespace kb::trace {
namespace {

using program::CellId;
using program::Cond;
using program::CondId;
using program::Detail;
using program::Program;
using program::Record;
using program::RuleId;

float firing(const Program& program) { return static_cast<float>(program.settings.firing); }

/// Measures conditions of one level.
class Measure {
 public:
  Measure(const Program& program, const Record& record, std::uint32_t level)
      : program_(program), level_(record.levels[level]) {}

  /// How much would have to change for the condition to be as wanted. Recursion as deep as conditions nest.
  [[nodiscard]] Nearness of(CondId id, bool wanted) const {
    if (level_.truth[index(id)] == wanted) return {};
    const Cond& cond = program_[id];
    switch (cond.op) {
      case Cond::Op::kNot: return of(cond.children.front(), !wanted);
      case Cond::Op::kFor: return timer(id, cond, wanted);
      case Cond::Op::kAnd: return wanted ? sum(cond, wanted) : least(cond, wanted);
      case Cond::Op::kOr: return wanted ? least(cond, wanted) : sum(cond, wanted);
      default: return {1, gap(cond), id, wanted};
    }
  }

 private:
  [[nodiscard]] Nearness sum(const Cond& cond, bool wanted) const {
    Nearness all;
    for (const CondId part : cond.children) {
      const Nearness one = of(part, wanted);
      all.lacking += one.lacking;
      all.gap += one.gap;
      if (one.lacking > 0) all.last = one.last, all.wanted = one.wanted;
    }
    return all;
  }
  [[nodiscard]] Nearness least(const Cond& cond, bool wanted) const {
    Nearness best{UINT32_MAX, 0.0};
    for (const CondId part : cond.children) {
      const Nearness one = of(part, wanted);
      if (one < best) best = one;
    }
    return cond.children.empty() ? Nearness{1, 1.0} : best;
  }
  // Missing time counts like missing certainty, a second as much as half of the scale and no time as much as all of it. Where the time does not
  // run, all of it is missing.
  [[nodiscard]] Nearness timer(CondId id, const Cond& cond, bool wanted) const {
    const auto held = level_.held_us[index(id)];
    const double missing_s = std::abs(static_cast<double>(cond.duration_us) - static_cast<double>(held.value_or(0))) / 1e6;
    const double gap = missing_s / (missing_s + 1.0);
    if (!wanted || held) return {1, gap, id, wanted};
    const Nearness begin = of(cond.children.front(), true);
    return {begin.lacking, begin.gap + gap, id, true};
  }
  [[nodiscard]] double gap(const Cond& cond) const {
    const double value = static_cast<double>(level_.cf[index(cond.cell)]), cut = static_cast<double>(firing(program_));
    if (cond.op != Cond::Op::kIs)
      return std::abs(value - static_cast<double>(program::thresholds(program_[cond.cell]).attended));
    switch (cond.term) {
      case program::Term::kHigh: return std::abs(value - cut);
      case program::Term::kLow: return std::abs(value + cut);
      case program::Term::kZero: return std::abs(std::abs(value) - (1.0 - cut));
    }
    return 1.0;
  }

  const Program& program_;
  const program::LevelRecord& level_;
};

RuleAnswer answer_rule(const Program& program, const Record& record, RuleId rule, Detail detail) {
  return {program::explain_rule(program, record, rule, detail), nearness(program, record, rule)};
}

void sort_by_nearness(std::vector<RuleAnswer>& answers) {
  std::stable_sort(answers.begin(), answers.end(), [](const RuleAnswer& a, const RuleAnswer& b) {
    return std::make_tuple(!a.fired(), a.near) < std::make_tuple(!b.fired(), b.near);
  });
}

// The threshold that a fact had to pass on this tick.
std::string threshold_text(const Program& program, const Record& record, CellId fact) {
  const program::Thresholds limits = program::thresholds(program[fact]);
  if (seen_before(record, fact)) return fmt::format("seen above {:.2f}, as it was seen on the tick before", limits.attended);
  if (const CellId satellite = attending(program, record, fact); satellite != CellId::kNone)
    return fmt::format("seen above {:.2f}, as `{}` was high when the tick began", limits.attended, program[satellite].name);
  return fmt::format("seen above {:.2f}, as no satellite of it was high when the tick began (above {:.2f} if one were)",
                     limits.plain, limits.attended);
}

CellAnswer answer_cell(const Program& program, const Record& record, CellId cell, Detail detail) {
  CellAnswer out{.story = program::explain_cell(program, record, cell), .threshold = {}, .raisers = {}};
  if (program[cell].kind == program::CellKind::kFact) out.threshold = threshold_text(program, record, cell);
  if (program[cell].kind != program::CellKind::kSatellite) return out;
  std::vector<float> found;
  for (const program::LevelRecord& level : record.levels) found.push_back(level.cf[index(cell)]);
  found.push_back(out.story.value);
  out.passing = levels_in_passing(found);
  if (record.last_write[index(cell)].tick == record.tick.number) {
    for (const RuleId rule : out.story.rules) out.writers.push_back(answer_rule(program, record, rule, detail));
  }
  if (out.story.value >= firing(program)) return out;
  for (const RuleId rule : raisers(program, cell, out.story.value)) out.raisers.push_back(answer_rule(program, record, rule, detail));
  sort_by_nearness(out.raisers);
  out.lacks_raiser = out.raisers.empty();
  return out;
}

StrategyAnswer answer_strategy(const Program& program, const Record& record, CellId strategy, Detail detail) {
  StrategyAnswer out{.story = program::explain_strategy(program, record, strategy, detail), .before = {}};
  const std::vector<float>& cf = record.levels.back().cf;
  for (const CellId other : program.priority) {
    if (other == strategy) break;
    const auto& satellites = program[other].satellites;
    if (std::any_of(satellites.begin(), satellites.end(), [&](CellId s) { return cf[index(s)] >= firing(program); }))
      out.before.push_back(other);
  }
  return out;
}

}  // namespace

std::vector<std::uint32_t> levels_in_passing(const std::vector<float>& found) {
  std::vector<std::uint32_t> levels;
  for (std::uint32_t i = 0; i + 1 < found.size(); ++i) {
    if (found[i] != found.front() && found[i] != found.back()) levels.push_back(i);
  }
  return levels;
}

std::vector<RuleId> raisers(const Program& program, CellId cell, float above) {
  const std::vector<std::uint32_t> group_of = program::group_of_cells(program);
  std::vector<RuleId> found;
  float most = above;
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) {
    const auto value = program::net_value(program, group_of, program.rules[i], cell);
    const float counted = std::min(value.value_or(above), firing(program));
    if (counted > most) found.clear();
    most = std::max(most, counted);
    if (counted == most && most > above) found.push_back(RuleId{i});
  }
  return found;
}

Nearness nearness(const Program& program, const Record& record, RuleId rule) {
  return Measure(program, record, program[rule].level).of(program[rule].condition, true);
}

Answer answer(const Program& program, const Record& record, const Question& question) {
  Answer out;
  for (const RuleId rule : question.rules) out.rules.push_back(answer_rule(program, record, rule, question.detail));
  sort_by_nearness(out.rules);
  if (question.cell != CellId::kNone) out.cells.push_back(answer_cell(program, record, question.cell, question.detail));
  if (question.strategy != CellId::kNone) {
    out.strategy = answer_strategy(program, record, question.strategy, question.detail);
    for (const CellId satellite : program[question.strategy].satellites) out.cells.push_back(answer_cell(program, record, satellite, question.detail));
    const auto wants_it = [&](const CellAnswer& cell) { return cell.story.value >= firing(program); };
    std::stable_partition(out.cells.begin(), out.cells.end(), wants_it);
  }
  if (!question.rules.empty() || question.cell != CellId::kNone || question.strategy != CellId::kNone) return out;
  out.of_whole_tick = true;
  for (const RuleId rule : record.tick.fired) out.rules.push_back(answer_rule(program, record, rule, question.detail));
  if (record.tick.strategy != CellId::kNone) out.strategy = answer_strategy(program, record, record.tick.strategy, question.detail);
  return out;
}

}  // namespace kb::trace
