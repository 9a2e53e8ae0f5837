// Facts with names: `facts.Line = 0.9f`. The generated `Facts` of a knowledge base is a union of its store and of empty slots at the
// store's address, so access to a named fact costs as much as access to an array element.
#pragma once

#include <cstdint>

#include "bits.h"
#include "table.h"

namespace mts {

/// A certainty from the host, made fit for the engine: NaN becomes 0, all else is clamped to [-1, 1].
struct SaneFact {
  float value;
  bool bad;   ///< the host's value was NaN or outside [-1, 1]
};
[[nodiscard]] constexpr SaneFact sane_fact(float raw) {
  if (raw >= -1.0f && raw <= 1.0f) return {raw, false};
  return {raw > 1.0f ? 1.0f : raw < -1.0f ? -1.0f : 0.0f, true};
}

// note [who has read what]
// If a mind and a store name each other, they differ only in the facts that the store has marked as changed. The names are not copied:
// a copy has read nothing and was read by nobody, and an assignment makes its target forget. Numbers could not replace the names in a
// mind that is copied bytewise: two futures of one mind, each with a store at the same address, would have the same numbers.

/// The address of the counterpart: a mind holds the store it has read, a store the mind that has read it. Copies hold none.
struct Partner {
  const void* address = nullptr;

  constexpr Partner() = default;
  constexpr Partner(const Partner&) noexcept {}
  constexpr Partner& operator=(const Partner& other) noexcept {
    if (this != &other) address = nullptr;
    return *this;
  }
};

/// The values of all facts, and which of them were set since a mind last read them. A value is a certainty in [-1, 1]: +1 certainly so,
/// -1 certainly not, 0 no data. A value stays until it is set again.
template <std::uint32_t kCount>
struct FactStore {
  static constexpr std::uint32_t kWords = Shape::words_for(kCount) + (kCount == 0 ? 1 : 0);
  static constexpr std::uint32_t kSums = Shape::words_for(kWords);
  static constexpr bool kSummed = kWords > 4;   // a few words are as soon read as their summary

  float value[kCount == 0 ? 1 : kCount] = {};
  Word changed[kWords] = {};
  Word changed_sum[kSums] = {};
  Partner reader;   ///< the mind that read last; only for this mind is `changed` the whole difference

  constexpr void set(std::uint32_t fact, float v) {
    value[fact] = v;
    bits::set(changed, fact);
    if constexpr (kSummed) bits::set(changed_sum, fact / kWordBits);
  }
  /// Whether some fact was set since a mind last read them.
  [[nodiscard]] constexpr bool has_changed() const {
    Word any = 0;
    if constexpr (kSummed) {
      for (const Word words : changed_sum) any |= words;
    } else {
      for (const Word word : changed) any |= word;
    }
    return any != 0;
  }
};

/// A named fact: assign a certainty to it, or read it. It cannot be copied, so `auto x = facts.Line` does not compile; write
/// `float x = facts.Line`.
template <class Store, std::uint32_t kFact>
struct FactSlot {
  FactSlot() = default;
  FactSlot(const FactSlot&) = delete;
  constexpr FactSlot& operator=(const FactSlot& other) { return *this = static_cast<float>(other); }
  FactSlot& operator=(float value) {
    static_cast<Store*>(static_cast<void*>(this))->set(kFact, value);
    return *this;
  }
  operator float() const { return static_cast<const Store*>(static_cast<const void*>(this))->value[kFact]; }
};

}  // namespace mts
