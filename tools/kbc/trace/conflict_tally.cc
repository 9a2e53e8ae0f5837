#include "tools/kbc/trace/conflict_tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "compiler/program/net_effects.h"
#include "tools/kbc/trace/grid.h"

namespace kb::trace {

using program::CellId;
using program::RuleId;

ConflictTally::ConflictTally(const program::Program& program) : program_(program), group_of_(program::group_of_cells(program)) {
  std::unordered_map<std::string_view, std::uint32_t> first;
  for (std::uint32_t i = 0; i < program.rules.size(); ++i) written_.push_back(first.try_emplace(program.rules[i].tmpl(), i).first->second);
}

void ConflictTally::add(const program::Tick& tick) {
  for (const program::Conflict& conflict : tick.conflicts) {
    std::vector<std::pair<RuleId, bool>> raises;
    for (const RuleId rule : conflict.rules) {
      const float value = program::net_value(program_, group_of_, program_[rule], conflict.cell).value_or(0.0f);
      if (value != 0.0f) raises.emplace_back(rule, value > 0.0f);
    }
    for (std::size_t i = 0; i < raises.size(); ++i) {
      for (std::size_t j = i + 1; j < raises.size(); ++j)
        if (raises[i].second != raises[j].second) add(tick, conflict.cell, raises[i].first, raises[j].first);
    }
  }
}

void ConflictTally::add(const program::Tick& tick, CellId cell, RuleId one, RuleId other) {
  if (written_[index(other)] < written_[index(one)]) std::swap(one, other);
  const auto [at, is_new] = pairs_.try_emplace({cell, written_[index(one)], written_[index(other)]});
  Pair& pair = at->second;
  if (is_new) pair = {{one}, {other}, 0, tick.number, 0, tick.time_us};
  pair.one.several = pair.one.several || pair.one.rule != one;
  pair.other.several = pair.other.several || pair.other.rule != other;
  pair.ticks += pair.last != tick.number ? 1 : 0;
  pair.last = tick.number;
}

std::string ConflictTally::name(const Side& side) const {
  const program::Rule& rule = program_[side.rule];
  return std::string(side.several ? rule.tmpl() : rule.name);
}

std::string ConflictTally::print() const {
  if (pairs_.empty()) return "no conflicts\n";
  std::vector<const std::pair<const Key, Pair>*> order;
  for (const auto& entry : pairs_) order.push_back(&entry);
  std::stable_sort(order.begin(), order.end(), [](const auto* a, const auto* b) {
    return a->second.ticks != b->second.ticks ? a->second.ticks > b->second.ticks : a->second.first < b->second.first;
  });
  std::vector<std::string> ticks{"ticks"}, firsts{"first"}, times{"t"}, cells{"cell"}, rules{"rules"};
  for (const auto* entry : order) {
    const Pair& pair = entry->second;
    ticks.push_back(fmt::format("{}", pair.ticks));
    firsts.push_back(fmt::format("{}", pair.first));
    times.push_back(fmt::format("{}", static_cast<double>(pair.first_us) / 1e6));
    cells.emplace_back(program_[std::get<0>(entry->first)].name);
    rules.push_back(fmt::format("{}, {}", name(pair.one), name(pair.other)));
  }
  Grid grid(ticks.size());
  for (const auto* numbers : {&ticks, &firsts, &times}) grid.add_column(*numbers, false);
  for (const auto* words : {&cells, &rules}) grid.add_column(*words, true);
  return grid.text();
}

}  // namespace kb::trace
