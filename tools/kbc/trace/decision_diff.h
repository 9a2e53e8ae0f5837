// Two knowledge bases on the same facts: where they decide differently. Things are the same if they have the same name.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/program/tick.h"
#include "tools/kbc/trace/engine.h"

namespace kb::trace {

/// A program that has the facts of both, the old one's first, and nothing else: what a recording for both is read with.
[[nodiscard]] program::Program union_of_facts(const program::Program& before, const program::Program& after);

/// Names of what only one of them has, each list in its program's order.
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
  std::vector<Satellite> satellites;   ///< whose values differ, and did not differ so after the tick before
  [[nodiscard]] bool strategy_differs() const { return strategy.first != strategy.second; }
  [[nodiscard]] bool any() const {
    return strategy_differs() || status.first != status.second || !rules_before.empty() || !rules_after.empty() || !satellites.empty();
  }
};

/// Runs both, tick by tick. Programs and engines must outlive it. Memory: that of the two programs' names.
class Differ {
 public:
  struct Side {
    const program::Program& program;
    Engine& engine;
  };
  Differ(Side before, Side after);

  [[nodiscard]] const OnlyIn& only_before() const { return only_before_; }
  [[nodiscard]] const OnlyIn& only_after() const { return only_after_; }
  /// One tick of both; `facts` are those of `union_of_facts`.
  [[nodiscard]] TickDifference tick(std::span<const float> facts, std::uint32_t dt_us);

 private:
  struct Shared { program::CellId before, after; std::uint64_t last = 0; };

  Side before_, after_;
  OnlyIn only_before_, only_after_;
  std::vector<std::size_t> facts_before_, facts_after_;   // of each fact, its place in the union
  std::vector<float> given_before_, given_after_;
  std::vector<Shared> satellites_;                        // of both; `last`: the two values as bits, when they differed
};

/// For people.
[[nodiscard]] std::string print(const OnlyIn& before, const OnlyIn& after);
[[nodiscard]] std::string print(const TickDifference& difference);
/// For programs, on one line.
[[nodiscard]] std::string print_json(const OnlyIn& before, const OnlyIn& after);
[[nodiscard]] std::string print_json(const TickDifference& difference);

}  // namespace kb::trace
