// Makes conditions: equal conditions share one node, however often they are asked for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "compiler/program/program.h"

namespace kb::program {

/// Appends conditions to `conds` (which must outlive it), each once; about `expected` will come, or fewer. It simplifies where that
/// changes neither truth nor strength: an `and` in an `and` and a small `or` in an `or` are merged, equal parts become one, and an
/// `and` or `or` of one part is that part.
class ConditionPool {
 public:
  explicit ConditionPool(std::vector<Cond>& conds, std::size_t expected = 0);

  CondId is(CellId cell, Term term = Term::kHigh);
  CondId event(CellId fact);
  CondId lost(CellId fact);
  CondId seen(CellId fact);
  CondId negation(CondId part);
  /// True if there are no parts.
  CondId all_of(std::span<const CondId> parts);
  /// False if there are no parts.
  CondId any_of(std::span<const CondId> parts);
  CondId held_for(CondId part, std::uint32_t duration_us);

 private:
  CondId sighting(Cond::Op op, CellId fact);
  CondId several(Cond::Op op, std::span<const CondId> parts);
  CondId intern(Cond&& cond);
  void put(std::uint32_t hash, CondId id);
  void grow();

  struct Slot { std::uint32_t hash = 0; CondId id = CondId::kNone; };
  /// The slot of a known condition, else the free slot that it will get.
  template <class Known>
  [[nodiscard]] Slot& slot(const Cond& cond, std::uint32_t hash, Known known);

  std::vector<Cond>& conds_;
  std::vector<Slot> known_;                               // a power of two, three quarters of it used at most; see note [near slots]
  std::vector<std::uint32_t> mark_;                       // by condition: the last `several` that took it
  std::uint32_t round_ = 0;
};

/// True if `op` has parts.
[[nodiscard]] constexpr bool has_parts(Cond::Op op) {
  return op == Cond::Op::kAnd || op == Cond::Op::kOr || op == Cond::Op::kNot || op == Cond::Op::kFor;
}

/// By condition: whether `asks` holds of it or of a part of it.
template <class Asks>
[[nodiscard]] std::vector<bool> marked(const Program& program, Asks asks) {
  std::vector<bool> marks(program.conds.size(), false);   // parts come before the whole
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const Cond& cond = program.conds[i];
    marks[i] = asks(cond) || std::any_of(cond.children.begin(), cond.children.end(), [&](CondId part) { return marks[index(part)]; });
  }
  return marks;
}

/// The parts that must all hold: those of an `and`, else the condition itself.
[[nodiscard]] std::vector<CondId> conjuncts(const Program& program, CondId condition);

/// The conditions that `roots` are made of, themselves included, each once, ascending: parts before the whole.
[[nodiscard]] std::vector<CondId> reachable(const std::vector<Cond>& conds, const std::vector<CondId>& roots);

/// Appends a rule `run[U]` for every strategy, by priority, to the control level (the paper's rule (19)). It fires if the strategy
/// is wanted, that is, some satellite of it is high, and no strategy before it is wanted. Cells, priority and levels must be in place.
/// Cost: the number of strategies times its logarithm (see note [prefix of priorities]).
void append_control_rules(Program& program, ConditionPool& pool);

}  // namespace kb::program
