// Rules as masks, for small programs whose tables are constants. Part of runtime/engine.h.
//
// note [masks]
// A condition asks a few of some hundred truth bits, and an effect brings a few of some hundred satellites to 1 or -1. If these sets
// fit into a few words, a rule has both as masks, which the C++ compiler makes from the tables: a condition holds if
// `(truth & asked) == wanted`, and an effect changes `(raised & ~at_one) | (lowered & ~at_minus_one)`. So a rule costs the same
// handful of operations however many conditions it has, without a jump that depends on them. Writing a value that a satellite has
// already costs nothing. And rules of a level contradict each other only if one raises what another lowers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "table.h"

namespace mts {

using Mask = std::uint64_t;
inline constexpr std::uint32_t kMaskBits = 64;

/// The largest program whose rules are masks: at most four words of truth and four of satellites for each rule.
inline constexpr std::uint32_t kMostMasked = 256, kMostMaskedRules = 512;

[[nodiscard]] constexpr bool fits_masks(const Shape& n) {
  return n.atoms <= kMostMasked && n.satellites <= kMostMasked && n.rules <= kMostMaskedRules;
}
[[nodiscard]] constexpr std::uint32_t masks_for(std::uint32_t bits) { return bits == 0 ? 1 : (bits + kMaskBits - 1) / kMaskBits; }
[[nodiscard]] constexpr Mask mask_of(std::uint32_t i) { return Mask{1} << (i % kMaskBits); }

/// Bytes of memory of MaskState below, and read-only bytes of kMasksOf, where the code is compiled for speed. The latter are fewer where
/// 64 bits are aligned to 4 bytes, as on x86 of 32 bits.
[[nodiscard]] constexpr std::size_t mask_state_bytes(const Shape& n) {
  return fits_masks(n) ? sizeof(Mask) * (masks_for(n.atoms) + 2 * masks_for(n.satellites)) : 0;
}
[[nodiscard]] constexpr std::size_t mask_table_bytes(const Shape& n) {
  if (!fits_masks(n)) return 0;
  const std::uint32_t rule = 2 * (masks_for(n.atoms) + masks_for(n.satellites)) + 1;   // and what it wants
  const std::uint32_t special = (n.words == 0 ? 2 : n.words + 1) / 2;
  return sizeof(Mask) * ((n.rules == 0 ? 1 : n.rules) * rule + special + 2 * masks_for(n.satellites));
}

/// What the mind of a program of this shape keeps beside its values; nothing if the program is too large for masks.
template <Shape kShape, bool = fits_masks(kShape)>
struct MaskState {};
template <Shape kShape>
struct MaskState<kShape, true> {
  Mask truth_mask[masks_for(kShape.atoms)] = {};            ///< atoms that are true
  Mask at_one[masks_for(kShape.satellites)] = {};           ///< satellites that are exactly 1
  Mask at_minus_one[masks_for(kShape.satellites)] = {};     ///< and exactly -1
};

/// One rule. The masks are constants: 88 bytes for a rule of a program of 192 atoms and 128 satellites.
template <Shape kShape>
struct RuleMasks {
  Mask asked[masks_for(kShape.atoms)] = {}, wanted[masks_for(kShape.atoms)] = {};
  Mask raised[masks_for(kShape.satellites)] = {}, lowered[masks_for(kShape.satellites)] = {};
  std::uint32_t wants = 0;   ///< a strategy + 1, or 0; or kListed
};

/// Stands in `RuleMasks::wants` if the rule has no masks of effects: it writes other values than 1 and -1, or wants several strategies.
inline constexpr std::uint32_t kListed = ~std::uint32_t{0};

/// All rules of `K`, and the satellites at start-up. The C++ compiler computes them from the lists that `kbc` emits, in linear time; an
/// image has no masks, so there is nothing to verify. Only where `K::kTables` is a constant: in the emitted source.
template <class K>
inline constexpr auto kMasksOf = [] {
  struct {
    RuleMasks<K::kShape> rule[K::kShape.rules == 0 ? 1 : K::kShape.rules];
    Word special[K::kShape.words == 0 ? 1 : K::kShape.words];   // rules that reset, or clear a group
    Mask first_one[masks_for(K::kShape.satellites)], first_minus_one[masks_for(K::kShape.satellites)];   // satellites at start-up
  } all{};
  static_assert(sizeof all <= mask_table_bytes(K::kShape) && sizeof(MaskState<K::kShape, true>) == mask_state_bytes(K::kShape));
  const auto& t = K::kTables;
  for (std::uint32_t i = 0; i < K::kShape.satellites; ++i) {
    if (t.initial[i] == 1.0f) all.first_one[i / kMaskBits] |= mask_of(i);
    if (t.initial[i] == -1.0f) all.first_minus_one[i / kMaskBits] |= mask_of(i);
  }
  for (std::uint32_t w = 0, r = 0; r < K::kShape.rules; ++r) {
    if (w + 1 < K::kShape.words && t.word_rule[w + 1] == r) ++w;
    const Word bit = Word{1} << (r - t.word_rule[w]);
    all.special[w] |= (t.reset_rules[w] & bit) | (t.rules[r].clears != t.rules[r + 1].clears ? bit : 0u);
    RuleMasks<K::kShape>& m = all.rule[r];
    for (std::uint32_t i = t.rules[r].conditions; i < t.rules[r + 1].conditions; ++i) {
      std::uint32_t atom = t.conditions[i] >> 1;
      bool wanted = (t.conditions[i] & 1u) == 0;
      if ((m.asked[atom / kMaskBits] & mask_of(atom)) != 0) {   // the condition asks for the atom and for its opposite
        atom = kFalseAtom;
        wanted = true;
      }
      m.asked[atom / kMaskBits] |= mask_of(atom);
      if (wanted) m.wanted[atom / kMaskBits] |= mask_of(atom);
    }
    RuleMasks<K::kShape> effects = m;
    for (std::uint32_t i = t.rules[r].writes; i < t.rules[r + 1].writes && effects.wants != kListed; ++i) {
      const std::uint32_t satellite = t.writes[i].cell - K::kShape.facts;
      const float value = t.values[t.writes[i].value];
      if (satellite >= K::kShape.satellites) {
        effects.wants = effects.wants == 0 ? satellite - K::kShape.satellites + 1 : kListed;
      } else if (value == 1.0f) {
        effects.raised[satellite / kMaskBits] |= mask_of(satellite);
      } else if (value == -1.0f) {
        effects.lowered[satellite / kMaskBits] |= mask_of(satellite);
      } else {
        effects.wants = kListed;
      }
    }
    if (effects.wants == kListed) m.wants = kListed;
    else m = effects;
  }
  return all;
}();

}  // namespace mts
