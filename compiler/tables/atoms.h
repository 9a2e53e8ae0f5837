// From conditions to atoms: the first half of building tables. See note [atoms] in runtime/table.h.
#pragma once

#include <cstdint>
#include <vector>

#include "compiler/program/program.h"
#include "compiler/tables/form.h"

namespace kb::tables {

/// `atom << 1 | negated`.
using Literal = std::uint32_t;

/// An atom before numbering: numbers here follow the order of making, parts before the whole.
struct Proto {
  AtomOrigin origin;
  bool is_and = false;               ///< kNode
  std::vector<Literal> children = {};  ///< kNode
  Literal input = 0;                 ///< kTimer
  std::uint32_t duration_us = 0;     ///< kTimer
  std::uint32_t level = 0;           ///< kTimer
  std::uint32_t rank = 0;            ///< kTimer: how many timers of its level are nested in its condition
};

/// All atoms of a program, and each rule's condition as a conjunction of literals (ascending, each once; a rule that can
/// never hold is {false}).
struct Atoms {
  std::vector<Proto> protos;
  std::vector<std::vector<Literal>> rules;
};

/// Numbered as the tables want it: constants, terms and sightings, then timers (by level, rank, duration), then nodes
/// (parts before the whole).
[[nodiscard]] Atoms make_atoms(const program::Program& program);

}  // namespace kb::tables
