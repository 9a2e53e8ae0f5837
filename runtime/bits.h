// Sets of small integers as words with a summary (a bit for each word that is not 0), so that the next member is found
// in a few steps however large the set is.
#pragma once

#include <bit>
#include <cstdint>

#include "runtime/table.h"

namespace mts::bits {

[[nodiscard]] constexpr Word mask(std::uint32_t i) { return Word{1} << (i % kWordBits); }
[[nodiscard]] constexpr bool test(const Word* set, std::uint32_t i) { return (set[i / kWordBits] & mask(i)) != 0; }
constexpr void set(Word* set, std::uint32_t i) { set[i / kWordBits] |= mask(i); }
constexpr void clear(Word* set, std::uint32_t i) { set[i / kWordBits] &= ~mask(i); }

/// Those bits of word `w` that lie in [from, end); `w` must meet that range, and the range must not be empty.
[[nodiscard]] constexpr Word within(std::uint32_t w, std::uint32_t from, std::uint32_t end) {
  Word mask = ~Word{0};
  if (w == from / kWordBits) mask &= ~Word{0} << (from % kWordBits);
  if (w == (end - 1) / kWordBits) mask &= ~Word{0} >> (kWordBits - 1 - (end - 1) % kWordBits);
  return mask;
}

/// The first member of `set` in [from, end), or `end`. Cost: (end - from) / 32 steps.
[[nodiscard]] constexpr std::uint32_t next(const Word* set, std::uint32_t from, std::uint32_t end) {
  if (from >= end) return end;
  std::uint32_t w = from / kWordBits;
  Word word = set[w] & (~Word{0} << (from % kWordBits));
  const std::uint32_t last = (end - 1) / kWordBits;
  while (word == 0) {
    if (w == last) return end;
    word = set[++w];
  }
  const std::uint32_t found = w * kWordBits + static_cast<std::uint32_t>(std::countr_zero(word));
  return found < end ? found : end;
}

/// The same with the set's summary: (end - from) / 1024 steps.
[[nodiscard]] constexpr std::uint32_t next(const Word* set, const Word* summary, std::uint32_t from, std::uint32_t end) {
  if (from >= end) return end;
  std::uint32_t w = from / kWordBits;
  const std::uint32_t words = (end - 1) / kWordBits + 1;
  Word word = set[w] & (~Word{0} << (from % kWordBits));
  while (word == 0) {
    w = next(summary, w + 1, words);
    if (w >= words) return end;
    word = set[w];
  }
  const std::uint32_t found = w * kWordBits + static_cast<std::uint32_t>(std::countr_zero(word));
  return found < end ? found : end;
}

}  // namespace mts::bits
