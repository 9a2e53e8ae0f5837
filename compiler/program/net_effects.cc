#include "compiler/program/net_effects.h"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace kb::program {
namespace {

constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

/// A value and the time at which it was written; of two values the later one counts.
struct Stamped {
  CellId cell;
  float value;
  std::size_t time;
};

struct Cleared {
  std::uint32_t group;
  std::size_t time;
};

struct Folding {
  std::vector<Stamped> writes;  // by cell: the last write of each
  std::vector<Cleared> clears;  // by group: the last clear of each
  std::size_t reset = kNever;   // the last reset
};

/// Keeps the last of all items that are the same. `items` are in the order of time before, and in the order of their keys afterwards.
template <class Item, class Key>
void keep_last(std::vector<Item>& items, Key key) {
  std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) { return key(a) < key(b); });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (i + 1 < items.size() && key(items[i]) == key(items[i + 1])) continue;
    items[kept++] = items[i];
  }
  items.resize(kept);
}

Folding in_order(const std::vector<std::uint32_t>& group_of, const std::vector<Effect>& effects) {
  Folding folding;
  for (std::size_t time = 0; time < effects.size(); ++time) {
    const Effect& effect = effects[time];
    if (effect.reset) {
      folding.reset = time;
      continue;
    }
    const std::uint32_t group = group_of[index(effect.cell)];
    if (effect.value > 0.0f && group != kNoGroup) folding.clears.push_back({group, time});
    folding.writes.push_back({effect.cell, effect.value + 0.0f, time});  // + 0.0f: no negative zero
  }
  keep_last(folding.writes, [](const Stamped& write) { return write.cell; });
  keep_last(folding.clears, [](const Cleared& clear) { return clear.group; });
  return folding;
}

/// A clear that a later reset overrides still holds for the members that the reset spares: it becomes single writes to these.
void clear_what_is_kept(const Program& program, Folding& folding) {
  std::vector<Stamped> spared;
  std::erase_if(folding.clears, [&](const Cleared& clear) {
    const std::vector<CellId>& members = program.exclusive[clear.group];
    const auto kept = [&](CellId cell) { return program[cell].keep; };
    if (clear.time > folding.reset || std::all_of(members.begin(), members.end(), kept)) return false;
    for (const CellId member : members) {
      if (kept(member)) spared.push_back({member, -1.0f, clear.time});
    }
    return true;
  });
  // The write that cleared has the same time and comes after its clear.
  spared.insert(spared.end(), folding.writes.begin(), folding.writes.end());
  std::stable_sort(spared.begin(), spared.end(), [](const Stamped& a, const Stamped& b) { return a.time < b.time; });
  keep_last(spared, [](const Stamped& write) { return write.cell; });
  folding.writes = std::move(spared);
}

void apply_reset(const Program& program, Folding& folding) {
  if (folding.reset == kNever) return;
  clear_what_is_kept(program, folding);
  std::erase_if(folding.writes,
                [&](const Stamped& write) { return write.time < folding.reset && !program[write.cell].keep; });
}

/// When the group of `cell` was last cleared.
std::size_t cleared_at(const Folding& folding, std::uint32_t group) {
  const auto found = std::lower_bound(folding.clears.begin(), folding.clears.end(), group,
                                      [](const Cleared& clear, std::uint32_t g) { return clear.group < g; });
  return found != folding.clears.end() && found->group == group ? found->time : kNever;
}

/// Writing every member to -1 one by one (`-G[*]`) is the same as a clear, which is shorter.
void clear_what_is_all_low(const Program& program, const std::vector<std::uint32_t>& group_of, Folding& folding) {
  std::vector<std::pair<std::uint32_t, std::size_t>> lowered;  // group, and how many of its members are written to -1
  for (const Stamped& write : folding.writes) {
    const std::uint32_t group = group_of[index(write.cell)];
    if (group != kNoGroup && write.value == -1.0f && cleared_at(folding, group) == kNever)
      lowered.push_back({group, 1});
  }
  std::sort(lowered.begin(), lowered.end());
  for (std::size_t i = 0; i < lowered.size();) {
    const std::uint32_t group = lowered[i].first;
    std::size_t count = 0;
    for (; i < lowered.size() && lowered[i].first == group; ++i) ++count;
    if (count == program.exclusive[group].size() && count > 1) folding.clears.push_back({group, 0});
  }
  std::sort(folding.clears.begin(), folding.clears.end(),
            [](const Cleared& a, const Cleared& b) { return a.group < b.group; });
}

/// Takes the only effect of a rule; there is nothing to fold.
void take_effect(const std::vector<std::uint32_t>& group_of, const Effect& effect, Rule& rule) {
  const std::uint32_t group = group_of[index(effect.cell)];
  rule.reset = false;
  rule.writes = {{effect.cell, effect.value + 0.0f}};
  rule.clears.clear();
  if (effect.value > 0.0f && group != kNoGroup) rule.clears.push_back(group);
}

bool writes_cell(const Program& program, const Rule& rule, CellId cell) {
  if (rule.reset && program[cell].kind == CellKind::kSatellite && !program[cell].keep) return true;
  return std::any_of(rule.writes.begin(), rule.writes.end(), [&](const Write& write) { return write.cell == cell; }) ||
         std::any_of(rule.clears.begin(), rule.clears.end(), [&](std::uint32_t group) {
           return std::binary_search(program.exclusive[group].begin(), program.exclusive[group].end(), cell);
         });
}

}  // namespace

void fold_effects(const Program& program, const std::vector<std::uint32_t>& group_of,
                  const std::vector<Effect>& effects, Rule& rule) {
  if (effects.size() == 1 && !effects.front().reset) return take_effect(group_of, effects.front(), rule);
  Folding folding = in_order(group_of, effects);
  apply_reset(program, folding);
  std::erase_if(folding.writes, [&](const Stamped& write) {
    const std::size_t time = cleared_at(folding, group_of[index(write.cell)]);
    return time != kNever && write.time < time;
  });
  clear_what_is_all_low(program, group_of, folding);

  rule.reset = folding.reset != kNever;
  rule.clears.clear();
  for (const Cleared& clear : folding.clears) rule.clears.push_back(clear.group);
  rule.writes.clear();
  for (const Stamped& write : folding.writes) {
    const bool cleared = cleared_at(folding, group_of[index(write.cell)]) != kNever;
    const bool initial = rule.reset && !program[write.cell].keep && write.value == program[write.cell].initial;
    if (cleared ? write.value == -1.0f : initial) continue;  // the clear or the reset writes that anyway
    rule.writes.push_back({write.cell, write.value});
  }
}

std::vector<Write> net_writes(const Program& program, const Rule& rule) {
  std::vector<Write> all(rule.writes.begin(), rule.writes.end());
  for (const std::uint32_t group : rule.clears) {
    for (const CellId member : program.exclusive[group]) all.push_back({member, -1.0f});
  }
  if (rule.reset) {
    for (std::uint32_t i = program.facts; i < program.first_strategy(); ++i) {
      if (!program.cells[i].keep) all.push_back({CellId{i}, program.cells[i].initial});
    }
  }
  // The first write of a cell counts: single writes come before clears, and clears before the reset.
  std::stable_sort(all.begin(), all.end(), [](const Write& a, const Write& b) { return a.cell < b.cell; });
  const auto end = std::unique(all.begin(), all.end(), [](const Write& a, const Write& b) { return a.cell == b.cell; });
  all.erase(end, all.end());
  return all;
}

std::optional<float> net_value(const Program& program, const std::vector<std::uint32_t>& group_of, const Rule& rule, CellId cell) {
  const auto write = std::lower_bound(rule.writes.begin(), rule.writes.end(), cell, [](const Write& w, CellId c) { return w.cell < c; });
  if (write != rule.writes.end() && write->cell == cell) return write->value;
  if (std::binary_search(rule.clears.begin(), rule.clears.end(), group_of[index(cell)])) return -1.0f;
  if (rule.reset && program[cell].kind == CellKind::kSatellite && !program[cell].keep) return program[cell].initial;
  return std::nullopt;
}

std::vector<RuleId> writers_among(const Program& program, const std::vector<RuleId>& fired, std::uint32_t level, CellId cell) {
  std::vector<RuleId> writers;
  for (const RuleId id : fired) {
    if (program[id].level == level && writes_cell(program, program[id], cell)) writers.push_back(id);
  }
  return writers;
}

std::vector<std::uint32_t> group_of_cells(const Program& program) {
  std::vector<std::uint32_t> group_of(program.cells.size(), kNoGroup);
  for (std::uint32_t group = 0; group < program.exclusive.size(); ++group) {
    for (const CellId member : program.exclusive[group]) group_of[index(member)] = group;
  }
  return group_of;
}

}  // namespace kb::program
