// Two knowledge bases on the same recording: where they decide differently. Things are the same if they have the same name.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "tools/kbc/trace/diff_inputs.h"
#include "tools/kbc/trace/engine.h"
#include "tools/kbc/trace/senses.h"

namespace kb::trace {

/// Names that only one of them has, each list in its program's order.
struct OnlyIn {
  std::vector<std::string> facts, satellites, strategies, rules;
};

/// What differs in one tick. Pairs are old and new.
struct TickDifference {
  std::uint64_t tick = 0;
  std::int64_t time_us = 0;
  std::pair<std::string, std::string> strategy;   ///< names; empty: none runs
  std::pair<program::Status, program::Status> status;
  std::vector<std::string> rules_before, rules_after;   ///< fired in one only
  struct Satellite { std::string name; float before, after; };
  std::vector<Satellite> satellites;   ///< those whose values differ, and did not differ in the same way after the tick before
  [[nodiscard]] bool strategy_differs() const { return strategy.first != strategy.second; }
  [[nodiscard]] bool any() const {
    return strategy_differs() || status.first != status.second || !rules_before.empty() || !rules_after.empty() || !satellites.empty();
  }
};

/// Runs both, tick by tick. Programs and engines must outlive it. Memory: that of the two programs' names.
class DecisionDiffer {
 public:
  struct Side {
    const program::Program& program;
    Engine& engine;
  };
  /// `inputs` is their `union_of_inputs`.
  DecisionDiffer(Side before, Side after, const program::Program& inputs);

  [[nodiscard]] const OnlyIn& only_before() const { return only_before_; }
  [[nodiscard]] const OnlyIn& only_after() const { return only_after_; }
  /// One tick of both; `row` was read with their `union_of_inputs`.
  [[nodiscard]] TickDifference tick(const FactsRow& row);

 private:
  struct Shared { program::CellId before, after; std::uint64_t last = 0; };
  struct Mind {
    const program::Program& program;
    Engine& engine;
    Share share;
    Senses senses;
    program::Tick tick(const FactsRow& row);
  };

  Mind before_, after_;
  OnlyIn only_before_, only_after_;
  std::vector<Shared> satellites_;                        // of both; `last`: the two values as bits, when they differed
};

/// For people. Of each kind `most` names are written, the others counted.
[[nodiscard]] std::string print(const OnlyIn& before, const OnlyIn& after, std::size_t most);
[[nodiscard]] std::string print(const TickDifference& difference);
/// For programs, on one line.
[[nodiscard]] std::string print_json(const OnlyIn& before, const OnlyIn& after);
[[nodiscard]] std::string print_json(const TickDifference& difference);

}  // namespace kb::trace
