// What a rule writes, written out. See note [net effects] in program.h.
#pragma once

#include <optional>
#include <vector>

#include "compiler/program/program.h"

namespace kb::program {

/// Every cell that `rule` writes, once, ascending, with its net value.
/// Cost: that of sorting the result; a `reset` writes (nearly) every satellite.
[[nodiscard]] std::vector<Write> net_writes(const Program& program, const Rule& rule);

/// `f(CellId, float)` for each of these.
template <class F>
void for_each_net_write(const Program& program, const Rule& rule, F&& f) {
  if (rule.clears.empty() && !rule.reset) {
    for (const Write& write : rule.writes) f(write.cell, write.value);
    return;
  }
  for (const Write& write : net_writes(program, rule)) f(write.cell, write.value);
}

/// What `rule` writes to `cell`; nothing if it leaves it alone. `group_of` is group_of_cells(program). Cost: two binary searches.
[[nodiscard]] std::optional<float> net_value(const Program& program, const std::vector<std::uint32_t>& group_of, const Rule& rule, CellId cell);

/// Whether two rules write the same.
[[nodiscard]] inline bool same_effects(const Rule& a, const Rule& b) { return a.reset == b.reset && a.clears == b.clears && a.writes == b.writes; }

/// The rules among `fired` that are of this level and write this cell: those behind a conflict. In the order of `fired`.
[[nodiscard]] std::vector<RuleId> writers_among(const Program& program, const std::vector<RuleId>& fired,
                                                std::uint32_t level, CellId cell);

/// The exclusive group of each cell, by cell; `kNoGroup` for most.
inline constexpr std::uint32_t kNoGroup = 0xFFFFFFFFu;
[[nodiscard]] std::vector<std::uint32_t> group_of_cells(const Program& program);

/// One effect as written: a value for a cell, or `reset`.
struct Effect {
  CellId cell = CellId::kNone;
  float value = 0.0f;
  bool reset = false;
};

/// Folds effects into the net form of `rule` (its `writes`, `clears` and `reset`, which are replaced).
/// Effects are taken in order: a positive value first clears the rest of the cell's exclusive group, later effects override
/// earlier ones, and `reset` overrides everything except writes to satellites declared `keep`. Cost: linear in the effects, however
/// large the groups are. `group_of` is group_of_cells(program).
void fold_effects(const Program& program, const std::vector<std::uint32_t>& group_of,
                  const std::vector<Effect>& effects, Rule& rule);

}  // namespace kb::program
