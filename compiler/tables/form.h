// The tables as the compiler holds them: the runtime's contract (runtime/table.h), filled with 32-bit indexes, and the
// vectors that own them.
#pragma once

#include <cstdint>
#include <vector>

#include <waymark/runtime/image_layout.h>
#include <waymark/runtime/table.h>
#include "compiler/program/program.h"
#include "compiler/tables/fuzzy.h"

namespace kb::tables {

using I = std::uint32_t;

/// What an atom stands for: for printing, and for the names in emitted tables.
struct AtomOrigin {
  enum class Kind : std::uint8_t { kTrue, kFalse, kTerm, kSeen, kEvent, kLost, kTimer, kNode };
  Kind kind = Kind::kTrue;
  program::Term term = program::Term::kHigh;
  program::CellId cell = program::CellId::kNone;   ///< kTerm, kSeen, kEvent, kLost
  program::CondId condition = program::CondId::kNone;  ///< kTimer, kNode
};

struct Tables {
  mts::Shape shape;
  float firing = 0.5f;
  mts::Idle idle = mts::Idle::kStop;
  I idle_strategy = 0;
  std::uint32_t hold_limit_us = 0;
  bool narrow = false;    ///< every index fits into 16 bits

  std::vector<mts::Atom<I>> atoms;
  std::vector<mts::Readers<I>> readers;
  std::vector<I> parents, timer_inputs;
  std::vector<std::uint8_t> broad;
  std::vector<mts::CellAtoms<I>> cell_atoms;
  std::vector<mts::FactAtoms<I>> fact_atoms;
  std::vector<I> attends_begin, attends;
  std::vector<mts::Node<I>> nodes;
  std::vector<mts::Timer<I>> timers;
  std::vector<std::uint32_t> queue_us;
  std::vector<mts::Stage<I>> stages;
  std::vector<mts::Level<I>> levels;
  std::vector<mts::Rule<I>> rules;
  std::vector<I> word_rule;
  std::vector<mts::Word> while_rules, reset_rules;
  std::vector<I> conditions;
  std::vector<mts::Write<I>> writes;
  std::vector<I> clears;
  std::vector<float> values;
  std::vector<I> group_of, group_slot, group_begin;
  std::vector<I> priority;
  std::vector<float> initial;
  std::vector<mts::Word> keep, initial_truth;
  std::vector<I> initial_count;
  std::vector<I> child_begin, children;
  std::vector<std::uint8_t> is_and;
  std::vector<I> atom_cell;
  std::vector<std::uint8_t> atom_term;

  std::vector<FuzzyForm> fuzzy;      ///< by fuzzy controller

  std::vector<AtomOrigin> origins;   ///< by atom
  std::vector<I> rule_key;           ///< by rule: its key atom (kTrueAtom if it never sleeps)
};

/// Calls `f(name, array)` for each array of MTS_IMAGE_TABLES, in its order, which is that of the members of mts::Tables.
template <class F>
void for_each_array(const Tables& tables, F&& f) {
#define KB_ARRAY(name, type, length) f(#name, tables.name);
  MTS_IMAGE_TABLES(KB_ARRAY)
#undef KB_ARRAY
}

/// The same tables as the engine reads them; valid for as long as `tables` is neither moved nor changed.
[[nodiscard]] mts::Tables<I> view(const Tables& tables);

}  // namespace kb::tables
