// The contract between the compiler and the engine: a knowledge base as packed read-only tables.
//
// note [atoms]
// Everything that a condition can ask is an *atom* with one truth bit: a term of a cell (`X is high`), `seen f`,
// `event f`, `lost f`, a timer (`C for 300 ms`), or a node (an `and` or `or` below the top of a condition). Atom 0 is
// always true, atom 1 always false. A *literal* is an atom, perhaps negated: `atom << 1 | negated`. A rule's condition
// is a conjunction of literals; a node counts how many of its child literals hold.
//
// note [rule words]
// Rules stand in words of 32, each level beginning a new word, so that a set of rules is a few words. A changed atom
// marks the rules that read it with a handful of word operations.
//
// note [keys]
// Each rule sleeps under one literal of its condition, its *key*: a positive literal that is rarely true and that few rules
// read (the current leg, say). While the key is false the rule is false, and no other change concerns it. So a change costs what
// the rules cost that are awake, not what all rules cost that read the atom.
#pragma once

#include <cstdint>

#include "cpp20.h"

namespace mts {

/// Number of this layout. Emitted code asserts that it was made for the runtime that it meets.
inline constexpr std::uint32_t kAbi = 2;
// check_abi: 2 5efc81eec6fb

using Word = std::uint32_t;
inline constexpr std::uint32_t kWordBits = 32;
inline constexpr std::uint32_t kTrueAtom = 0;
inline constexpr std::uint32_t kFalseAtom = 1;

/// Nodes nest at most so deep (the language allows 64 levels of parentheses).
inline constexpr std::uint32_t kMaxDepth = 80;

enum class Idle : std::uint8_t { kStop, kHold, kStrategy };

/// How many there are of each thing. The size of the state follows from it.
struct Shape {
  std::uint32_t facts = 0, satellites = 0, strategies = 0;  ///< cells are numbered in this order
  std::uint32_t atoms = 0;      ///< with the two constants
  std::uint32_t rules = 0;
  std::uint32_t words = 0;      ///< of rules
  std::uint32_t nodes = 0;      ///< the last `nodes` atoms
  std::uint32_t timers = 0;     ///< the `timers` atoms before them
  std::uint32_t queues = 0;
  std::uint32_t levels = 0;
  std::uint32_t groups = 0;     ///< large exclusive groups
  std::uint32_t group_members = 0;  ///< of all large groups together
  std::uint32_t contested = 0;  ///< (level, cell) pairs that rules write differently: there are never more blends and conflicts in one tick

  [[nodiscard]] constexpr std::uint32_t cells() const { return facts + satellites + strategies; }
  // Among the atoms. Not left to g++, which with -Os makes functions of them.
  [[nodiscard, gnu::always_inline]] constexpr std::uint32_t first_node() const { return atoms - nodes; }
  [[nodiscard, gnu::always_inline]] constexpr std::uint32_t first_timer() const { return atoms - nodes - timers; }
  [[nodiscard]] static constexpr std::uint32_t words_for(std::uint32_t bits) { return (bits + kWordBits - 1) / kWordBits; }
  /// Words of the summary of a set of so many words: see note [summaries].
  [[nodiscard]] static constexpr std::uint32_t summary_for(std::uint32_t words) {
    std::uint32_t total = 0;
    do total += words = words_for(words);
    while (words > 1);
    return total;
  }
};

/// The rules of one word that read an atom. Each row has at least one rule.
template <class Ix>
struct Readers {
  Ix word;
  Word good[2];  ///< rules for which its becoming false ([0]) or true ([1]) is good news
  Word keyed;    ///< rules that sleep under it
};

/// Where an atom's lists begin; those of the next atom are their ends.
template <class Ix>
struct Atom {
  Ix readers;     ///< into `readers`, ascending by word
  Ix parents;     ///< into `parents`: nodes that count it (`node << 1 | negated`)
  Ix timers;      ///< into `timer_inputs`: timers that time it
};

/// The atoms of a cell's terms; 0 if no condition asks for the term.
template <class Ix>
struct CellAtoms { Ix high, low, zero; };

/// The atoms of noticing a fact (0 if no condition asks), and the thresholds of certainty above which it is noticed.
template <class Ix>
struct FactAtoms { Ix seen, event, lost; float plain, attended; };

template <class Ix>
struct Node { Ix need; };  ///< true while at least `need` of its child literals hold

template <class Ix>
struct Timer { Ix input, queue; };  ///< `input` a literal

/// Timers of one level that may be settled together. A timer whose condition contains another timer is in a later stage than that one.
template <class Ix>
struct Stage { Ix first_timer, end_timer, first_queue, end_queue; };

template <class Ix>
struct Level { Ix first_word, end_word, first_stage, end_stage; };

template <class Ix>
struct Rule {
  Ix conditions;  ///< into `conditions`; the next rule's is the end
  Ix writes;      ///< into `writes`
  Ix clears;      ///< into `clears`
};

template <class Ix>
struct Write { Ix cell; Ix value; };  ///< `value` into `values`

/// A knowledge base. All pointers are to arrays of static storage (or of the caller's), never null where the count is
/// not 0. `Ix` is std::uint16_t where every index fits, else std::uint32_t. Arrays that are indexed by the next item's
/// beginning have one item more than their count.
template <class Ix>
struct Tables {
  std::uint32_t abi = kAbi;
  Shape shape;
  float firing = 0.5f;                  ///< a term holds from this membership on
  Idle idle = Idle::kStop;
  Ix idle_strategy = 0;                  ///< index of a strategy, for Idle::kStrategy
  std::uint32_t hold_limit_us = 0;

  const Atom<Ix>* atoms = nullptr;               // atoms + 1
  const Readers<Ix>* readers = nullptr;
  const Ix* parents = nullptr;
  const Ix* timer_inputs = nullptr;
  const std::uint8_t* broad = nullptr;          // atoms: bit b: so many rules want it to become b that all awake ones are asked; null if none is

  const CellAtoms<Ix>* cell_atoms = nullptr;     // cells
  const FactAtoms<Ix>* fact_atoms = nullptr;     // facts
  const Ix* attends_begin = nullptr;             // satellites + 1: into `attends`
  const Ix* attends = nullptr;                   // facts that the satellite draws attention to

  const Node<Ix>* nodes = nullptr;
  const Timer<Ix>* timers = nullptr;
  const std::uint32_t* queue_us = nullptr;      // queues: their timers' duration
  const Stage<Ix>* stages = nullptr;
  const Level<Ix>* levels = nullptr;

  const Rule<Ix>* rules = nullptr;               // rules + 1
  const Ix* word_rule = nullptr;                 // words: the rule of bit 0
  const Word* while_rules = nullptr;            // words
  const Word* reset_rules = nullptr;            // words
  const Ix* conditions = nullptr;                // literals
  const Write<Ix>* writes = nullptr;             // ascending by cell within a rule
  const Ix* clears = nullptr;                    // large groups; their members that the rule does not write become -1
  const float* values = nullptr;

  const Ix* group_of = nullptr;                  // satellites: its large group + 1, or 0; null if there are no groups
  const Ix* group_slot = nullptr;                // satellites: its place among the group's members
  const Ix* group_begin = nullptr;               // groups + 1

  const Ix* priority = nullptr;                  // strategies, the highest first

  const float* initial = nullptr;               // satellites
  const Word* keep = nullptr;                   // satellites as bits: survives `reset`
  const Word* initial_truth = nullptr;          // atoms as bits
  const Ix* initial_count = nullptr;             // nodes

  // For the strength of rules that contradict each other; null if `shape.contested` is 0.
  const Ix* child_begin = nullptr;               // nodes + 1
  const Ix* children = nullptr;                  // literals
  const std::uint8_t* is_and = nullptr;         // nodes
  const Ix* atom_cell = nullptr;                 // atoms: the cell of a term, or the number of cells for others
  const std::uint8_t* atom_term = nullptr;      // atoms: 0 low, 1 zero, 2 high
};

}  // namespace mts
