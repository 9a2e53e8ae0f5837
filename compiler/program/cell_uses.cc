#include "compiler/program/cell_uses.h"

#include <algorithm>

#include "compiler/program/conditions.h"
#include "compiler/program/net_effects.h"

namespace kb::program {

CellUses uses_of(const Program& program, const std::vector<CellId>& cells, const std::vector<RuleId>& rules) {
  const auto asked = [&](CellId cell) { return std::binary_search(cells.begin(), cells.end(), cell); };
  const std::vector<bool> asks = marked(program, [&](const Cond& cond) { return !has_parts(cond.op) && asked(cond.cell); });
  const std::vector<std::uint32_t> group_of = group_of_cells(program);
  std::vector<bool> of_one(program.exclusive.size(), false);   // by exclusive group
  bool resets = false;
  for (const CellId cell : cells) {
    if (group_of[index(cell)] != kNoGroup) of_one[group_of[index(cell)]] = true;
    resets = resets || (program[cell].kind == CellKind::kSatellite && !program[cell].keep);
  }
  CellUses uses;
  for (const RuleId id : rules) {
    const Rule& rule = program[id];
    const bool reads = asks[index(rule.condition)];
    if (std::any_of(rule.writes.begin(), rule.writes.end(), [&](const Write& write) { return asked(write.cell); })) {
      uses.writers.push_back(id);
      uses.reading_writers += reads ? 1 : 0;
    } else if (reads) {
      uses.readers.push_back(id);
    } else if (std::any_of(rule.clears.begin(), rule.clears.end(), [&](std::uint32_t group) { return of_one[group]; })) {
      uses.silencers.push_back(id);
    } else if (rule.reset && resets) {
      uses.resetters.push_back(id);
    }
  }
  return uses;
}

}  // namespace kb::program
