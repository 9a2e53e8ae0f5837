#include "compiler/tables/fleet_rules.h"

#include <algorithm>

#include "compiler/program/net_effects.h"
#include "compiler/tables/lists.h"

namespace kb::tables {
namespace {

using Kind = AtomOrigin::Kind;
using program::Term;

}  // namespace

FleetRules::FleetRules(const program::Program& program, const Tables& tables) : p_(program), t_(tables), children_(parts_of_nodes(tables)), written_(program.levels.size(), std::vector<bool>(program.satellites, false)) {
  for (const program::Rule& rule : p_.rules) {
    std::vector<CellWrite>& out = writes_.emplace_back();
    program::for_each_net_write(p_, rule, [&](program::CellId cell, float value) {
      if (p_[cell].kind != program::CellKind::kSatellite) return;
      out.push_back({static_cast<std::uint32_t>(index(cell)) - p_.facts, value + 0.0f});
      written_[rule.level][out.back().satellite] = true;
    });
  }
  find_groups();
}

/// A group that begins with two high members does not count, because rules may leave both as they are. Neither does a group in which
/// `reset` may raise one member and spare another.
void FleetRules::find_groups() {
  group_.resize(p_.satellites, 0);
  for (const auto& members : p_.exclusive) {
    std::vector<std::uint32_t> group;
    std::size_t high = 0, kept = 0;
    for (const program::CellId member : members) {
      if (p_[member].kind != program::CellKind::kSatellite) continue;
      group.push_back(static_cast<std::uint32_t>(index(member)) - p_.facts);
      high += p_[member].initial >= t_.firing;
      kept += p_[member].keep;
    }
    if (group.size() < 2 || high > 1 || (high == 1 && kept > 0)) continue;
    exclusive_.push_back(std::move(group));
    for (const std::uint32_t member : exclusive_.back()) group_[member] = static_cast<std::uint32_t>(exclusive_.size());
  }
}

std::span<const I> FleetRules::literals(std::uint32_t rule) const {
  const std::uint32_t begin = t_.rules[rule].conditions;
  return std::span(t_.conditions).subspan(begin, t_.rules[rule + 1].conditions - begin);
}

bool FleetRules::compatible(std::uint32_t a, std::uint32_t b) const {
  if (p_.rules[a].reset != p_.rules[b].reset) return false;
  const auto group = [&](I literal) -> std::uint32_t {
    const AtomOrigin& o = t_.origins[literal >> 1];
    if ((literal & 1u) != 0 || o.kind != Kind::kTerm || o.term != Term::kHigh) return 0;
    return p_[o.cell].kind == program::CellKind::kSatellite ? group_[index(o.cell) - p_.facts] : 0;
  };
  for (const I x : literals(a)) {
    for (const I y : literals(b)) {
      if (x == (y ^ 1u) || (x != y && group(x) != 0 && group(x) == group(y))) return false;
    }
  }
  return true;
}

std::optional<bool> FleetRules::after_own_writes(I literal, const std::vector<CellWrite>& writes) const {
  const I atom = literal >> 1;
  const bool negated = (literal & 1u) != 0;
  const AtomOrigin& o = t_.origins[atom];
  if (o.kind == Kind::kTrue || o.kind == Kind::kFalse) return (o.kind == Kind::kTrue) != negated;
  if (o.kind == Kind::kTerm && p_[o.cell].kind == program::CellKind::kSatellite) {
    for (const CellWrite& w : writes) {
      if (w.satellite == index(o.cell) - p_.facts) return program::holds(o.term, w.value, t_.firing) != negated;
    }
  }
  if (o.kind != Kind::kNode) return std::nullopt;
  const std::uint32_t node = atom - t_.shape.first_node();
  const bool all = is_and(node);
  bool known = true;
  for (const I child : children_[node]) {
    const std::optional<bool> value = after_own_writes(child, writes);
    if (value && *value != all) return *value != negated;
    known = known && value.has_value();
  }
  if (!known) return std::nullopt;
  return all != negated;
}

bool FleetRules::disarms_itself(std::uint32_t rule) const {
  for (const I l : literals(rule)) {
    const Kind kind = t_.origins[l >> 1].kind;
    if ((l & 1u) == 0 && (kind == Kind::kEvent || kind == Kind::kLost)) return true;  // never on two successive ticks
    if (after_own_writes(l, writes_[rule]) == false) return true;
  }
  return false;
}

bool FleetRules::reads_written(I atom, const std::vector<bool>& written) const {
  const AtomOrigin& o = t_.origins[atom];
  if (o.kind == Kind::kTerm) return p_[o.cell].kind == program::CellKind::kSatellite && written[index(o.cell) - p_.facts];
  if (o.kind != Kind::kNode) return false;
  return std::ranges::any_of(children_[atom - t_.shape.first_node()], [&](I child) { return reads_written(child >> 1, written); });
}

bool FleetRules::disturbed(std::uint32_t rule) const {
  const std::vector<bool>& written = written_[p_.rules[rule].level];
  return std::ranges::any_of(literals(rule), [&](I l) { return reads_written(l >> 1, written); });
}

void FleetRules::weigh(std::uint32_t rule, std::vector<bool>& facts) const {
  const std::span<const I> all = literals(rule);
  std::vector<I> open(all.begin(), all.end());
  while (!open.empty()) {
    const I l = open.back();
    open.pop_back();
    if ((l & 1u) != 0) continue;  // the strength of a negated literal is 0 or 1
    const AtomOrigin& o = t_.origins[l >> 1];
    if (o.kind == Kind::kTerm && p_[o.cell].kind == program::CellKind::kFact) facts[index(o.cell)] = true;
    if (o.kind != Kind::kNode) continue;
    const auto& parts = children_[(l >> 1) - t_.shape.first_node()];
    open.insert(open.end(), parts.begin(), parts.end());
  }
}

}  // namespace kb::tables
