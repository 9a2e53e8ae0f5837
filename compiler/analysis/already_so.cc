// Reports rules that change nothing, because all that they write is so already.
#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/subject.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using diagnostics::Kind;
using program::CellId;
using program::Program;
using program::Rule;
using program::RuleId;

/// By cell: the values that rules write to it or that it has from the start.
std::vector<std::vector<float>> values_of_cells(const Program& program) {
  std::vector<std::vector<float>> values(program.cells.size());
  const auto add = [&](CellId cell, float value) {
    std::vector<float>& known = values[program::index(cell)];
    if (std::ranges::find(known, value) == known.end()) known.push_back(value);
  };
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) add(CellId{i}, program.cells[i].initial);
  for (const auto& group : program.exclusive) {
    for (const CellId cell : group) add(cell, -1.0f);
  }
  for (const Rule& rule : program.rules) {
    for (const program::Write& write : rule.writes) add(write.cell, write.value);
  }
  return values;
}

class AlreadySo {
 public:
  explicit AlreadySo(const Subject& subject)
      : subject_(subject), program_(subject.program), firing_(static_cast<float>(program_.settings.firing)), values_(values_of_cells(program_)),
        satisfier_(subject.satisfier()) {}

  void run() {
    ByFamily<bool> found(subject_);
    std::vector<bool> settled(subject_.instances.size(), false);   // by family: an instance is not so, and none is reported
    for (std::uint32_t i = 0; i < program_.rules.size() && satisfier_.steps() < Satisfier::kTotalSteps; ++i) {
      const std::uint32_t family = subject_.family[i];
      if (settled[family]) continue;
      const Rule& rule = program_.rules[i];
      if (changes_nothing(rule) && !meets_another_value(rule)) found.add(RuleId{i}, true);
      else settled[family] = true;
    }
    found.for_each([&](RuleId id, bool, std::uint32_t count) {
      if (count < subject_.instances[subject_.family[program::index(id)]]) return;
      subject_.diagnostics.report(Kind::kAlreadySo, program_[id].span, {program_[id].name, more(count)});
    });
  }

 private:
  [[nodiscard]] bool changes_nothing(const Rule& rule) {
    if (rule.reset || rule.writes.empty() || Subject::generated(rule)) return false;
    const Demands demands = satisfier_.demands(rule.condition, rule.level);
    return demands.possible && std::ranges::all_of(rule.writes, [&](const program::Write& write) { return is_so(demands, write); }) &&
           std::ranges::all_of(rule.clears, [&](std::uint32_t group) { return is_clear(rule, group); });
  }

  /// The cell is asked for, and where it is as asked it has no other value than the one that is written.
  [[nodiscard]] bool is_so(const Demands& demands, const program::Write& write) const {
    const auto asked = std::ranges::find(demands.each, program::index(write.cell), &Restriction::variable);
    if (asked == demands.each.end()) return false;
    return std::ranges::all_of(values_[program::index(write.cell)], [&](float value) { return value == write.value || (region_of(value, firing_) & asked->allowed) == 0; });
  }

  /// The member that the rule writes, of which `is_so` holds, keeps the others down.
  [[nodiscard]] bool is_clear(const Rule& rule, std::uint32_t group) const {
    const auto whole = [this](CellId cell) { return std::ranges::all_of(values_[program::index(cell)], [](float value) { return value == 1.0f || value == -1.0f; }); };
    return subject_.exclusive(group) && std::ranges::all_of(program_.exclusive[group], whole) &&
           std::ranges::any_of(rule.writes, [&](const program::Write& write) { return write.value >= firing_ && subject_.group_of[program::index(write.cell)] == group; });
  }

  /// Whether another rule of the level can fire with it and write otherwise, so that the rule has a say in what comes of it. A `reset` silences the rule.
  [[nodiscard]] bool meets_another_value(const Rule& rule) {
    return std::ranges::any_of(rule.writes, [&](const program::Write& write) { return differs(subject_.writers.by_name[program::index(write.cell)], rule, write); }) ||
           std::ranges::any_of(rule.clears, [&](std::uint32_t group) { return raised_beside(rule, group); });
  }

  /// Whether rules of the level write different values to the cell by name.
  [[nodiscard]] bool disputed(CellId cell, std::uint32_t level) {
    const auto [known, fresh] = disputed_.try_emplace({cell, level}, false);
    if (!fresh) return known->second;
    std::optional<float> first;
    return known->second = std::ranges::any_of(of_level(program_, subject_.writers.by_name[program::index(cell)], level), [&](RuleId id) {
             const auto value = program::net_value(program_, subject_.group_of, program_[id], cell);
             if (!first) first = value;
             return value != first;
           });
  }

  [[nodiscard]] bool differs(std::span<const RuleId> others, const Rule& rule, const program::Write& write) {
    if (!disputed(write.cell, rule.level)) return false;
    return std::ranges::any_of(of_level(program_, others, rule.level), [&](RuleId id) {
      const auto value = program::net_value(program_, subject_.group_of, program_[id], write.cell);
      return value && *value != write.value && may_meet(rule, id);
    });
  }

  /// Whether another rule raises another member of a group that the rule clears.
  [[nodiscard]] bool raised_beside(const Rule& rule, std::uint32_t group) {
    return std::ranges::any_of(of_level(program_, subject_.writers.by_clear[group], rule.level), [&](RuleId id) {
      return (program_[id].clears != rule.clears || program_[id].writes != rule.writes) && may_meet(rule, id);
    });
  }

  [[nodiscard]] bool may_meet(const Rule& rule, RuleId other) {
    const Goal goals[] = {{rule.condition, true}, {program_[other].condition, true}};
    return !program_[other].reset && satisfier_.together(goals, rule.level) != Answer::kNo;
  }

  const Subject& subject_;
  const Program& program_;
  float firing_;
  std::vector<std::vector<float>> values_;   // by cell
  std::map<std::pair<CellId, std::uint32_t>, bool> disputed_;   // by cell and level
  Satisfier& satisfier_;
};

}  // namespace

void diagnose_already_so(const Subject& subject) { AlreadySo(subject).run(); }

}  // namespace kb::analysis
