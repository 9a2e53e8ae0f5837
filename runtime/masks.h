// Rules as masks, for small programs whose tables are constants. Part of runtime/engine.h.
//
// note [masks]
// An effect brings a few of some hundred satellites to 1 or -1. If these fit into a few words, a rule has its effects as masks, which the
// C++ compiler makes from the tables; together, the rules that fire change `(raised & ~at_one) | (lowered & ~at_minus_one)`. Writing a
// value that a satellite has already costs nothing. Rules of a level contradict each other only if one raises what another lowers. And
// what a tick has changed is the difference of two such words.
//
// note [planes]
// The conditions of the rules of a word are laid out as *planes*: bit r of plane k says whether condition k of rule r holds; it is 1 if
// the rule has no condition k. So the rules that hold are the `and` of the planes of their word, and an atom that flips tells its readers
// by an exclusive or with a constant for each plane, in either direction: no rule is marked, kept awake or evaluated by itself. Which
// condition of a rule is which is chosen by `kbc` such that the readers of an atom stand in few planes: nearly always in one.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "bits.h"
#include "table.h"

namespace mts {

using Mask = std::uint64_t;
inline constexpr std::uint32_t kMaskBits = 64;

/// The largest program whose rules are masks: at most four words of satellites for each rule.
inline constexpr std::uint32_t kMostMasked = 256, kMostMaskedRules = 512;

[[nodiscard]] constexpr bool fits_masks(const Shape& n) {
  return n.atoms <= kMostMasked && n.satellites <= kMostMasked && n.rules <= kMostMaskedRules;
}
[[nodiscard]] constexpr std::uint32_t masks_for(std::uint32_t bits) { return bits == 0 ? 1 : (bits + kMaskBits - 1) / kMaskBits; }
[[nodiscard]] constexpr std::uint32_t words_of(std::uint32_t bits) { return bits == 0 ? 1 : Shape::words_for(bits); }
[[nodiscard]] constexpr Mask mask_of(std::uint32_t i) { return Mask{1} << (i % kMaskBits); }

/// The most planes of all words together; with more, going over them would cost more than it saves.
inline constexpr std::uint32_t kMostPlanes = 512;

/// Bytes of memory of MaskState below, and read-only bytes of the constants below, where the code is compiled for speed. Both are fewer where
/// 64 bits are aligned to 4 bytes, as on x86 of 32 bits.
[[nodiscard]] constexpr std::size_t mask_state_bytes(const Shape& n, std::uint32_t planes) {
  if (planes == 0) return 0;
  const std::uint32_t words = words_of(n.atoms) + 2 * words_of(n.facts) + 3 + planes;
  return sizeof(Mask) * (4 * masks_for(n.satellites) + (words + 1) / 2);
}
[[nodiscard]] constexpr std::size_t mask_table_bytes(const Shape& n, std::uint32_t planes) {
  if (planes == 0) return 0;
  const std::size_t masks = n.rules * (2 * masks_for(n.satellites) + 1) + (n.words * 5 + 7) / 8 + 2 * masks_for(n.satellites);
  return sizeof(Mask) * masks + sizeof(Word) * planes + 16 * (n.facts == 0 ? 1 : n.facts);
}

/// What the mind of a program of this shape keeps beside its values; nothing if its rules are no masks.
template <Shape kShape, std::uint32_t kPlanes>
struct MaskState {
  static constexpr std::uint32_t kMaskPlanes = kPlanes;
  Mask at_one[masks_for(kShape.satellites)] = {};             ///< satellites that are exactly 1
  Mask at_minus_one[masks_for(kShape.satellites)] = {};       ///< and exactly -1
  Mask before_one[masks_for(kShape.satellites)] = {};         ///< the same as the tick began
  Mask before_minus_one[masks_for(kShape.satellites)] = {};
  Word truth_set[words_of(kShape.atoms)] = {};                ///< atoms that are true
  Word recheck_set[words_of(kShape.facts)] = {};              ///< facts whose value or attention has changed
  Word seen_set[words_of(kShape.facts)] = {};
  Word timer_input = 0, timer_on = 0, timer_waits = 0;        ///< at most 32 timers: conditions that hold, that held when their level was last run, timers that run
  Word plane[kPlanes] = {};                                   ///< see note [planes]
};
template <Shape kShape>
struct MaskState<kShape, 0> {
  static constexpr std::uint32_t kMaskPlanes = 0;
};

/// The rules of a plane that read an atom.
struct PlaneRow { std::uint16_t plane; Word rules; };

/// The planes of a knowledge base. Emitted beside its tables, as a specialisation, and only where they are is it a constant.
struct Planes {
  const std::uint16_t* first;   ///< words + 1: the planes of each word
  const std::uint16_t* begin;   ///< atoms + 1: into `rows`
  const PlaneRow* rows;
  const Word* at_start;         ///< each plane at start-up
};
template <class K>
inline constexpr Planes kPlanesOf{};

/// The effects of a rule.
template <Shape kShape>
struct RuleMasks {
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
    bool wants_only[K::kShape.words == 0 ? 1 : K::kShape.words];   // each rule of the word wants a strategy and does nothing else
    Mask first_one[masks_for(K::kShape.satellites)], first_minus_one[masks_for(K::kShape.satellites)];   // satellites at start-up
  } all{};
  const auto& t = K::kTables;
  for (std::uint32_t i = 0; i < K::kShape.satellites; ++i) {
    if (t.initial[i] == 1.0f) all.first_one[i / kMaskBits] |= mask_of(i);
    if (t.initial[i] == -1.0f) all.first_minus_one[i / kMaskBits] |= mask_of(i);
  }
  for (bool& only : all.wants_only) only = true;
  for (std::uint32_t w = 0, r = 0; r < K::kShape.rules; ++r) {
    if (w + 1 < K::kShape.words && t.word_rule[w + 1] == r) ++w;
    const Word bit = Word{1} << (r - t.word_rule[w]);
    all.special[w] |= (t.reset_rules[w] & bit) | (t.rules[r].clears != t.rules[r + 1].clears ? bit : 0u);
    RuleMasks<K::kShape>& m = all.rule[r];
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
    if (all.special[w] != 0 || m.wants == 0 || m.wants == kListed) all.wants_only[w] = false;
    for (std::uint32_t i = 0; i < masks_for(K::kShape.satellites); ++i) {
      if ((m.raised[i] | m.lowered[i]) != 0) all.wants_only[w] = false;
    }
  }
  return all;
}();

/// The conditions of timers that hold at start-up. For at most 32 timers.
template <class K>
inline constexpr Word kTimersAtStart = [] {
  Word on = 0;
  for (std::uint32_t i = 0; i < K::kShape.timers; ++i) {
    const std::uint32_t input = K::kTables.timers[i].input, atom = input >> 1;
    if (bits::test(K::kTables.initial_truth, atom) != ((input & 1u) != 0)) on |= bits::mask(i);
  }
  return on;
}();

/// What noticing a fact asks: FactAtoms in an order in which nothing has to be chosen by a jump. `momentary`: `lost`, then `event`.
struct Notice { float above[2]; std::uint16_t seen, momentary[2]; };
template <class K>
inline constexpr auto kNoticeOf = [] {
  struct { Notice fact[K::kShape.facts == 0 ? 1 : K::kShape.facts]; } all{};
  for (std::uint32_t i = 0; i < K::kShape.facts; ++i) {
    const auto& a = K::kTables.fact_atoms[i];
    all.fact[i] = {{a.plain, a.attended}, static_cast<std::uint16_t>(a.seen), {static_cast<std::uint16_t>(a.lost), static_cast<std::uint16_t>(a.event)}};
  }
  return all;
}();

/// Whether what is said of bytes above holds of `K`, which has `kPlanes` planes.
template <class K, std::uint32_t kPlanes>
inline constexpr bool kMasksFit = sizeof(kMasksOf<K>) + sizeof(kNoticeOf<K>) + sizeof(Word) * kPlanes <= mask_table_bytes(K::kShape, kPlanes) &&
                                  sizeof(MaskState<K::kShape, kPlanes>) <= mask_state_bytes(K::kShape, kPlanes);

/// Whether a condition asks whether a fact is `zero`.
template <class K>
inline constexpr bool kFactsAskZero = [] {
  bool any = false;
  for (std::uint32_t i = 0; i < K::kShape.facts; ++i) any = any || K::kTables.cell_atoms[i].zero != 0;
  return any;
}();

}  // namespace mts
