// From conditions to atoms: the first half of building tables. See note [atoms] in runtime/table.h.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// `atom << 1 | negated`.
using Literal = std::uint32_t;

/// An atom before its final number: here atoms are numbered as they are made, parts before the whole.
struct Proto {
  AtomOrigin origin;
  bool is_and = false;               ///< kNode
  std::vector<Literal> children = {};  ///< kNode
  Literal input = 0;                 ///< kTimer
  std::uint32_t duration_us = 0;     ///< kTimer
  std::uint32_t level = 0;           ///< kTimer
  std::uint32_t rank = 0;            ///< kTimer, kNode: how many timers are nested in its condition, all of its level
};

/// All atoms of a program, and each rule's condition as a conjunction of literals (ascending, each once; a rule that can
/// never hold is {false}).
struct Atoms {
  std::vector<Proto> protos;
  std::vector<Literal> literals;        ///< of all rules, end to end
  std::vector<std::size_t> begin;       ///< rules + 1: into `literals`
  [[nodiscard]] std::span<const Literal> rule(std::size_t r) const {
    return std::span(literals).subspan(begin[r], begin[r + 1] - begin[r]);
  }
};

/// The atoms in the order that the tables need: constants, terms and sightings, then timers (by level, rank, duration), then nodes
/// (parts before the whole). A conjunction of more than `longest` literals becomes a node that rules can share.
[[nodiscard]] Atoms make_atoms(const program::Program& program, std::size_t longest);

/// How often each atom is true, as a guess: 0 momentary, or one of an exclusive group; 1 a satellite or a sighting; 2 a
/// fact; 3 an atom made of others (it may hold nearly always, as `not seen X for 300 ms` does).
[[nodiscard]] std::vector<int> rarity(const program::Program& program, const Atoms& atoms);

}  // namespace kb::tables
