// Runs an emitted mind beside the interpreter and compares every tick.
#pragma once

#include <algorithm>
#include <cstdio>

#include <waymark/runtime/compact_mind.h>
#include "compiler/program/interpret.h"
#include "compiler/program/net_effects.h"
#include "compiler/program/tick.h"
#include "tests/unit/program/random_program.h"

namespace kb::emitted {

/// A decision as the compiler's own record of a tick.
template <class K>
program::Tick record(const program::Program& program, const mts::Decision<K>& decision) {
  program::Tick tick;
  tick.number = decision.tick();
  tick.time_us = decision.time_us();
  for (const auto fact : decision.events()) tick.events.push_back(program::CellId{static_cast<std::uint32_t>(fact)});
  for (const auto fact : decision.lost()) tick.lost.push_back(program::CellId{static_cast<std::uint32_t>(fact)});
  for (const auto rule : decision.fired()) tick.fired.push_back(program::RuleId{static_cast<std::uint32_t>(rule)});
  for (const auto& change : decision.changed()) tick.set.push_back({program::CellId{change.cell}, change.value});
  for (const auto strategy : decision.active()) {
    tick.active.push_back(program::CellId{static_cast<std::uint32_t>(strategy) + program.first_strategy()});
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> conflicts;
  for (const auto& c : decision.conflicts()) conflicts.emplace_back(c.level, c.cell);
  std::sort(conflicts.begin(), conflicts.end());
  for (const auto& [level, cell] : conflicts) {
    const program::CellId contested{cell};
    tick.conflicts.push_back({contested, program::writers_among(program, tick.fired, level, contested)});
  }
  std::sort(tick.events.begin(), tick.events.end());
  std::sort(tick.lost.begin(), tick.lost.end());
  std::sort(tick.set.begin(), tick.set.end(), [](const auto& a, const auto& b) { return a.cell < b.cell; });
  if (decision.drives()) {
    tick.strategy = program::CellId{static_cast<std::uint32_t>(decision.strategy()) + program.first_strategy()};
  }
  tick.bad_facts = decision.bad_facts();
  tick.status = static_cast<program::Status>(decision.status());
  return tick;
}

/// Facts are given in three ways in turn: all set again, only what differs, and a new object, as host programs do.
template <class K, class Mind = mts::Mind<K>>
bool agrees(std::uint64_t seed) {
  using Fact = typename K::Fact;
  const program::Program program = program::testing::random_program(seed);
  program::Interpreter oracle(program);
  Mind mind;
  typename K::Facts facts;
  std::size_t n = 0;
  for (const auto& step : program::testing::random_trace(program, seed, 60)) {
    const auto expected = oracle.tick(step.facts, step.dt_us);
    typename K::Facts fresh;
    typename K::Facts& given = ++n % 7 == 0 ? fresh : facts;
    for (std::uint32_t f = 0; f != program.facts; ++f) {
      const Fact fact = static_cast<Fact>(f);
      if (n % 3 == 0 || !(given.get(fact) == step.facts[f])) given.set(fact, step.facts[f]);
    }
    const auto got = record<K>(program, mind.tick(given, mts::microseconds(step.dt_us)));
    if (got == expected) continue;
    std::printf("seed %llu, tick %zu\n  interpreter: %s\n  emitted:     %s\n", static_cast<unsigned long long>(seed), n,
                print_json(program, expected).c_str(), print_json(program, got).c_str());
    return false;
  }
  return true;
}

}  // namespace kb::emitted
