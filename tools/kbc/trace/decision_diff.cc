#include "tools/kbc/trace/decision_diff.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <nlohmann/json.hpp>
#include <set>
#include <string_view>
#include <unordered_map>

#include "tools/kbc/trace/json_number.h"

namespace kb::trace {
namespace {

using program::CellId;
using program::CellKind;
using program::Program;
using Names = std::vector<std::string>;

/// Cells of one kind by name.
std::unordered_map<std::string_view, CellId> cells_of(const Program& program, CellKind kind) {
  std::unordered_map<std::string_view, CellId> out;
  for (std::uint32_t i = 0; i < program.cells.size(); ++i) {
    if (program.cells[i].kind == kind) out.emplace(program.cells[i].name, CellId{i});
  }
  return out;
}

Names lacking(const Program& program, const Program& other, CellKind kind) {
  const auto there = cells_of(other, kind);
  Names out;
  for (const program::Cell& cell : program.cells) {
    if (cell.kind == kind && !there.contains(cell.name)) out.emplace_back(cell.name);
  }
  return out;
}

OnlyIn only_in(const Program& program, const Program& other) {
  OnlyIn out{lacking(program, other, CellKind::kFact), lacking(program, other, CellKind::kSatellite),
             lacking(program, other, CellKind::kStrategy), {}};
  std::set<std::string_view> rules;
  for (const program::Rule& rule : other.rules) rules.insert(rule.name);
  for (const program::Rule& rule : program.rules) {
    if (!rules.contains(rule.name)) out.rules.emplace_back(rule.name);
  }
  return out;
}

Names fired(const Program& program, const program::Tick& tick) {
  Names out;
  for (const program::RuleId rule : tick.fired) out.emplace_back(program[rule].name);
  return out;
}

/// The names in `names` that `other` lacks, in their order.
Names without(const Names& names, const Names& other) {
  const std::set<std::string_view> there(other.begin(), other.end());
  Names out;
  std::copy_if(names.begin(), names.end(), std::back_inserter(out), [&](const std::string& name) { return !there.contains(name); });
  return out;
}

std::string strategy_of(const Program& program, const program::Tick& tick) {
  return std::string(tick.strategy == CellId::kNone ? "" : program[tick.strategy].name);
}

}  // namespace

DecisionDiffer::DecisionDiffer(Side before, Side after, const Program& inputs)
    : before_{before.program, before.engine, Share(before.program, inputs), Senses(before.program, EngineKind::kTables)},
      after_{after.program, after.engine, Share(after.program, inputs), Senses(after.program, EngineKind::kTables)},
      only_before_(only_in(before.program, after.program)),
      only_after_(only_in(after.program, before.program)) {
  const auto there = cells_of(after.program, CellKind::kSatellite);
  for (const auto& cell : before.program.cells) {
    if (cell.kind != CellKind::kSatellite) continue;
    const auto found = there.find(cell.name);
    const auto place = static_cast<std::uint32_t>(&cell - before.program.cells.data());
    if (found != there.end()) satellites_.push_back({CellId{place}, found->second});
  }
}

program::Tick DecisionDiffer::Mind::tick(const FactsRow& row) {
  const auto facts = senses.look(share.of(row), [this](CellId cell) { return engine.value(cell); });
  return engine.tick(facts, row.dt_us);
}

TickDifference DecisionDiffer::tick(const FactsRow& row) {
  const program::Tick a = before_.tick(row), b = after_.tick(row);
  TickDifference out{.tick = a.number,
                     .time_us = a.time_us,
                     .strategy = {strategy_of(before_.program, a), strategy_of(after_.program, b)},
                     .status = {a.status, b.status},
                     .rules_before = {},
                     .rules_after = {},
                     .satellites = {}};
  const Names rules_a = fired(before_.program, a), rules_b = fired(after_.program, b);
  out.rules_before = without(rules_a, rules_b);
  out.rules_after = without(rules_b, rules_a);
  for (Shared& satellite : satellites_) {
    const float x = before_.engine.value(satellite.before), y = after_.engine.value(satellite.after);
    const std::uint64_t now = x == y ? 0 : std::uint64_t{std::bit_cast<std::uint32_t>(x)} << 32 | std::bit_cast<std::uint32_t>(y);
    if (now != satellite.last && x != y) out.satellites.push_back({std::string(before_.program[satellite.before].name), x, y});
    satellite.last = now;
  }
  return out;
}

namespace {

void print_only(std::string& out, std::string_view where, const OnlyIn& only, std::size_t most) {
  const auto list = [&](std::string_view what, const Names& names) {
    if (names.empty()) return;
    const std::size_t shown = std::min(most, names.size());
    fmt::format_to(std::back_inserter(out), "only in {}: {} {}", where, what, fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    if (shown < names.size()) fmt::format_to(std::back_inserter(out), "{}and {} more (--most)", shown == 0 ? "" : ", ", names.size() - shown);
    out += '\n';
  };
  list("facts", only.facts);
  list("satellites", only.satellites);
  list("strategies", only.strategies);
  list("rules", only.rules);
}

std::string_view or_none(const std::string& name) { return name.empty() ? "none" : std::string_view(name); }

nlohmann::ordered_json object_of(const OnlyIn& only) {
  return {{"facts", only.facts}, {"satellites", only.satellites}, {"strategies", only.strategies}, {"rules", only.rules}};
}

}  // namespace

std::string print(const OnlyIn& before, const OnlyIn& after, std::size_t most) {
  std::string out;
  print_only(out, "OLD", before, most);
  print_only(out, "NEW", after, most);
  return out;
}

std::string print(const TickDifference& d) {
  std::string out = fmt::format("tick {} at {:.3f} s", d.tick, static_cast<double>(d.time_us) / 1e6);
  if (d.strategy_differs()) out += fmt::format(": {} -> {}", or_none(d.strategy.first), or_none(d.strategy.second));
  else if (!d.strategy.first.empty()) out += fmt::format(": {} in both", d.strategy.first);
  out += '\n';
  if (d.status.first != d.status.second) out += fmt::format("  status {} -> {}\n", status_text(d.status.first), status_text(d.status.second));
  for (const std::string& rule : d.rules_before) out += fmt::format("  - {}\n", rule);
  for (const std::string& rule : d.rules_after) out += fmt::format("  + {}\n", rule);
  for (const auto& s : d.satellites) out += fmt::format("  {} = {} -> {}\n", s.name, s.before, s.after);
  return out;
}

std::string print_json(const OnlyIn& before, const OnlyIn& after) {
  const nlohmann::ordered_json object = {{"only_old", object_of(before)}, {"only_new", object_of(after)}};
  return object.dump();
}

std::string print_json(const TickDifference& d) {
  const auto name = [](const std::string& strategy) { return strategy.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(strategy); };
  nlohmann::ordered_json satellites = nlohmann::ordered_json::array();
  for (const auto& s : d.satellites) satellites.push_back({{"name", s.name}, {"old", json_number(s.before)}, {"new", json_number(s.after)}});
  const nlohmann::ordered_json object = {{"tick", d.tick},
                                         {"t", static_cast<double>(d.time_us) / 1e6},
                                         {"strategy", {{"old", name(d.strategy.first)}, {"new", name(d.strategy.second)}}},
                                         {"status", {{"old", status_text(d.status.first)}, {"new", status_text(d.status.second)}}},
                                         {"rules", {{"only_old", d.rules_before}, {"only_new", d.rules_after}}},
                                         {"satellites", satellites}};
  return object.dump();
}

}  // namespace kb::trace
