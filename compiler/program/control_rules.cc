// The control level's own rules: one strategy runs at a time.
//
// note [prefix of priorities]
// `run[U]` must know that no strategy before U is wanted. Written out, that would be a `not` for each satellite of each strategy
// before it, which is quadratic in the number of strategies. So every 32 neighbours by priority share an `or`, every 32 of those
// another, and so on; the strategies before U are then at most 31 parts of each size. Up to 32 strategies, as most robots have,
// this is the plain list.

#include "compiler/program/conditions.h"

namespace kb::program {
namespace {

constexpr std::size_t kBlock = 32;

/// blocks[0][i]: strategy i is wanted; blocks[k][i]: at least one of the 32^k strategies from i * 32^k on is wanted.
using Blocks = std::vector<std::vector<CondId>>;

CondId wanted(const Program& program, CellId strategy, ConditionPool& pool) {
  std::vector<CondId> parts;
  for (const CellId satellite : program[strategy].satellites) parts.push_back(pool.is(satellite));
  return pool.any_of(parts);
}

Blocks build_blocks(const Program& program, ConditionPool& pool) {
  Blocks blocks(1);
  for (const CellId strategy : program.priority) blocks[0].push_back(wanted(program, strategy, pool));
  while (blocks.back().size() > kBlock) {
    const std::vector<CondId>& below = blocks.back();
    std::vector<CondId> above;
    for (std::size_t i = 0; i + kBlock <= below.size(); i += kBlock) {
      const auto begin = below.begin() + static_cast<std::ptrdiff_t>(i);
      above.push_back(pool.any_of({begin, begin + static_cast<std::ptrdiff_t>(kBlock)}));
    }
    blocks.push_back(std::move(above));
  }
  return blocks;
}

/// The fewest blocks that cover the first `count` strategies.
std::vector<CondId> cover(const Blocks& blocks, std::size_t count) {
  std::vector<CondId> parts;
  std::size_t covered = 0;
  std::size_t size = 1;
  for (std::size_t k = 1; k < blocks.size(); ++k) size *= kBlock;
  for (std::size_t k = blocks.size(); k-- > 0; size /= kBlock) {
    for (; covered + size <= count; covered += size) parts.push_back(blocks[k][covered / size]);
  }
  return parts;
}

}  // namespace

void append_control_rules(Program& program, ConditionPool& pool) {
  const Blocks blocks = build_blocks(program, pool);
  for (std::size_t i = 0; i < program.priority.size(); ++i) {
    const CellId strategy = program.priority[i];
    std::vector<CondId> parts = {blocks[0][i]};
    for (const CondId earlier : cover(blocks, i)) {
      const Cond& cond = program[earlier];
      const bool alternatives = cond.op == Cond::Op::kOr && cond.children.size() < kBlock;
      for (const CondId part : alternatives ? cond.children : decltype(cond.children){earlier}) {
        parts.push_back(pool.negation(part));
      }
    }
    Rule rule;
    rule.name = program.texts->keep({"run[", program[strategy].name, "]"});
    rule.level = static_cast<std::uint32_t>(program.levels.size() - 1);
    rule.mode = Mode::kWhile;
    rule.condition = pool.all_of(parts);
    rule.writes = {{strategy, 1.0f}};
    rule.place = program.place("priority");
    rule.standard = true;
    program.rules.push_back(std::move(rule));
  }
}

}  // namespace kb::program
