// Whether an exclusive group can have two members up, that is above 0, at once.
//
// note [two members up]
// Say that one member at most is up, and that a level then leaves both A and B up. Then one of them has just been raised, say A by the rule r.
// - If r does not write B, B was up before, or another rule raises it. Only a reset raises a member without writing all others: it leaves
//   alone what is kept.
// - If r gives B a value above 0, r alone has raised both: `+B, reset`, where B is kept and A begins up.
// - Else r writes a to A, and b <= 0 to B. The values are means, weighted by the strengths of the rules, and for both means to be above 0 some
//   rule must have a + b > 0: by a later effect (`+A, B = 0`), or where a reset brings B back to more than -1. It also takes another rule that
//   raises B and can fire with r: on the same level, and one that resets if and only if r does, since a reset silences the others.
// What the rules' conditions say is not looked at.
#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "compiler/analysis/satisfier.h"
#include "compiler/analysis/writers.h"
#include "compiler/program/net_effects.h"

namespace kb::analysis {
namespace {

using program::CellId;
using program::Program;
using program::Rule;

class Exclusivity {
 public:
  explicit Exclusivity(const Program& program)
      : program_(program), group_of_(program::group_of_cells(program)), exclusive_(program.exclusive.size(), true), can_rise_(program.cells.size(), false) {}

  std::vector<bool> run() {
    for (std::uint32_t group = 0; group < exclusive_.size(); ++group) begin(group);
    for (const Rule& rule : program_.rules) {
      for (const program::Write& write : rule.writes) {
        if (write.value > 0.0f) can_rise_[program::index(write.cell)] = true;
      }
    }
    for (const Rule& rule : program_.rules) {
      for (const program::Write& write : rule.writes) check_raised(rule, write.cell, write.value);
      if (rule.reset) check_reset(rule);
    }
    return std::move(exclusive_);
  }

 private:
  struct BroughtBack { std::uint32_t group; CellId member; };   // by a reset

  void begin(std::uint32_t group) {
    std::size_t up = 0;
    for (const CellId member : program_.exclusive[group]) {
      if (program_[member].initial <= 0.0f) continue;
      exclusive_[group] = ++up <= 1;
      can_rise_[program::index(member)] = true;
      if (!program_[member].keep && program_[member].kind == program::CellKind::kSatellite) brought_back_.push_back({group, member});
    }
  }

  /// What a reset brings back in groups that it does not write is the same for all resets of a level, so only one of them is asked.
  void check_reset(const Rule& rule) {
    std::vector<std::uint32_t> written(rule.clears.begin(), rule.clears.end());
    for (const program::Write& write : rule.writes) written.push_back(group_of_[program::index(write.cell)]);
    source::sort_unique(written);
    const auto check = [&](const BroughtBack& back) { check_raised(rule, back.member, program_[back.member].initial); };
    std::vector<BroughtBack>& unasked = unasked_.try_emplace(rule.level, brought_back_).first->second;
    std::erase_if(unasked, [&](const BroughtBack& back) {
      if (std::ranges::binary_search(written, back.group)) return false;
      check(back);
      return true;
    });
    for (const std::uint32_t group : written) {
      if (std::ranges::binary_search(rule.clears, group)) continue;
      for (auto back = std::ranges::lower_bound(brought_back_, group, {}, &BroughtBack::group); back != brought_back_.end() && back->group == group; ++back) {
        if (std::ranges::find(rule.writes, back->member, &program::Write::cell) == rule.writes.end()) check(*back);
      }
    }
  }

  /// `rule` gives `raised` this value.
  void check_raised(const Rule& rule, CellId raised, float value) {
    const std::uint32_t group = group_of_[program::index(raised)];
    if (value <= 0.0f || group == program::kNoGroup || !exclusive_[group]) return;
    const auto check = [&](CellId other) { exclusive_[group] = exclusive_[group] && (other == raised || !both_up(rule, value, other)); };
    if (std::binary_search(rule.clears.begin(), rule.clears.end(), group)) {   // the members that it does not name become -1
      for (const program::Write& write : rule.writes) {
        if (group_of_[program::index(write.cell)] == group) check(write.cell);
      }
    } else {
      for (const CellId member : program_.exclusive[group]) check(member);
    }
  }

  /// Whether `other` may be up after `rule` has given another member this value: see note [two members up].
  [[nodiscard]] bool both_up(const Rule& rule, float value, CellId other) {
    const std::optional<float> written = program::net_value(program_, group_of_, rule, other);
    if (!written) return can_rise_[program::index(other)];
    return *written > 0.0f || (*written > -value && raised_beside(rule, other));
  }

  /// Whether another rule raises the cell that can fire with `rule`, which does not raise it.
  [[nodiscard]] bool raised_beside(const Rule& rule, CellId cell) {
    const auto [known, fresh] = beside_.try_emplace({cell, rule.level, rule.reset}, false);
    if (!fresh) return known->second;
    const auto raises = [&](const Rule& other) {
      return other.level == rule.level && other.reset == rule.reset && program::net_value(program_, group_of_, other, cell).value_or(0.0f) > 0.0f;
    };
    const auto by_name = [&](program::RuleId id) { return raises(program_[id]); };
    if (rule.reset && program_[cell].initial > 0.0f) return known->second = std::ranges::any_of(program_.rules, raises);   // a reset may bring it back
    if (!writers_) writers_.emplace(program_);   // most programs never ask
    return known->second = std::ranges::any_of(writers_->by_name[program::index(cell)], by_name);
  }

  const Program& program_;
  std::vector<std::uint32_t> group_of_;   // by cell
  std::vector<bool> exclusive_;           // by group
  std::vector<bool> can_rise_;            // by cell
  std::optional<Writers> writers_;
  std::vector<BroughtBack> brought_back_;                         // ascending by group
  std::map<std::uint32_t, std::vector<BroughtBack>> unasked_;     // by level: those of groups that each reset so far writes to
  std::map<std::tuple<CellId, std::uint32_t, bool>, bool> beside_;
};

}  // namespace

std::vector<bool> exclusive_at_all_times(const Program& program) { return Exclusivity(program).run(); }

}  // namespace kb::analysis
