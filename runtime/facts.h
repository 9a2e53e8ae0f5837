// Facts with names: `facts.Line = 0.9f`. The generated `Facts` of a knowledge base is a union of its store and of empty
// slots that stand at the store's address, so a named fact costs what an array element costs.
#pragma once

#include <cstdint>

#include "bits.h"
#include "table.h"

namespace mts {

/// A certainty as the host gave it, made one that engines can take: NaN becomes 0, the rest is clamped to [-1, 1].
struct SaneFact {
  float value;
  bool bad;   ///< it was not so before
};
[[nodiscard]] constexpr SaneFact sane_fact(float raw) {
  if (raw >= -1.0f && raw <= 1.0f) return {raw, false};
  return {raw > 1.0f ? 1.0f : raw < -1.0f ? -1.0f : 0.0f, true};
}

// note [who has read what]
// A mind and a store that name each other agree but for the facts that the store has marked as changed. Neither name is copied: a
// copy has read nothing and was read by nobody, and what is assigned forgets. No number could stand for the names in a mind that
// is copied as bytes are: two futures of one mind, each with a store at the same place, have the same numbers.

/// The other one: for a mind the store that it has read, for a store the mind that has read it.
struct Partner {
  const void* address = nullptr;

  constexpr Partner() = default;
  constexpr Partner(const Partner&) noexcept {}
  constexpr Partner& operator=(const Partner& other) noexcept {
    if (this != &other) address = nullptr;
    return *this;
  }
};

/// The values of all facts, and which have been changed since a mind has read them. A value is a certainty factor in
/// [-1, 1]: +1 certainly so, -1 certainly not, 0 no data. Values stay until they are set again.
template <std::uint32_t kCount>
struct FactStore {
  static constexpr std::uint32_t kWords = Shape::words_for(kCount) + (kCount == 0 ? 1 : 0);
  static constexpr std::uint32_t kSums = Shape::words_for(kWords);

  float value[kCount == 0 ? 1 : kCount] = {};
  Word changed[kWords] = {};
  Word changed_sum[kSums] = {};
  Partner reader;   ///< the mind that read last: only for it is `changed` the whole difference

  constexpr void set(std::uint32_t fact, float v) {
    value[fact] = v;
    bits::set(changed, fact);
    bits::set(changed_sum, fact / kWordBits);
  }
  /// Whether some fact has been set since then.
  [[nodiscard]] constexpr bool has_changed() const {
    Word any = 0;
    for (const Word words : changed_sum) any |= words;
    return any != 0;
  }
};

/// A named fact: assign a certainty to it, or read it. Not copyable, so that `auto x = facts.Line` does not compile; write
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
