// The conditions of a small program as planes of bits: see note [planes] in runtime/masks.h.
#pragma once

#include <cstdint>
#include <vector>

#include <waymark/runtime/masks.h>
#include "compiler/tables/form.h"

namespace kb::tables {

/// What mts::Planes points to. All are empty if the rules of the program are no masks.
struct PlaneForm {
  std::vector<std::uint16_t> first;   ///< words + 1: the planes of each word of rules
  std::vector<std::uint16_t> begin;   ///< atoms + 1: into `rows`
  std::vector<mts::PlaneRow> rows;
  std::vector<mts::Word> at_start;    ///< each plane at start-up

  [[nodiscard]] std::uint32_t planes() const { return first.empty() ? 0 : first.back(); }
};

/// Gives each condition of a rule a plane of its own among those of the rule's word, of which there are as many as the longest rule has conditions.
/// Atoms that many rules of a word read choose first, and take the plane that is free for most of these. Deterministic; small programs only.
[[nodiscard]] PlaneForm build_planes(const Tables& tables);

}  // namespace kb::tables
