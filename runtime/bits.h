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

/// The word and the bit of a rule. `word_rule`: by word, the rule of its bit 0 (Tables::word_rule). Steps: log2 of `words`.
struct RuleBit { std::uint32_t word; Word bit; };
template <class I>
[[nodiscard]] constexpr RuleBit of_rule(const I* word_rule, std::uint32_t words, std::uint32_t rule) {
  std::uint32_t low = 0, high = words;
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (word_rule[middle] <= rule) low = middle;
    else high = middle;
  }
  return {low, mask(rule - word_rule[low])};
}

// note [tops]
// A summary of a million rules is itself a thousand words long. Sets of so many words have a summary of the summary, their
// *top*, so that finding the members never costs more for what is empty. Smaller sets have none, and do not pay for it.

/// Whether a set of so many words has a top; `kMayHave` false says at compile time that it has none.
template <bool kMayHave>
[[nodiscard]] constexpr bool has_top(std::uint32_t words) { return kMayHave && Shape::has_top(words); }

/// Word `w` of the set is not 0 any more.
template <bool kTops>
constexpr void note_full(Word* summary, [[maybe_unused]] Word* top, std::uint32_t w, [[maybe_unused]] std::uint32_t words) {
  set(summary, w);
  if (has_top<kTops>(words)) set(top, w / kWordBits);
}

/// Word `w` of the set is 0 again.
template <bool kTops>
constexpr void note_empty(Word* summary, [[maybe_unused]] Word* top, std::uint32_t w, [[maybe_unused]] std::uint32_t words) {
  clear(summary, w);
  if (has_top<kTops>(words) && summary[w / kWordBits] == 0) clear(top, w / kWordBits);
}

/// Word `w` of the set may have become 0, or have ceased to be.
template <bool kTops>
constexpr void note(Word* summary, Word* top, std::uint32_t w, std::uint32_t words, bool full) {
  if (full) note_full<kTops>(summary, top, w, words);
  else note_empty<kTops>(summary, top, w, words);
}

/// The first word of the summary in [from, end) that is not 0, or `end`. Cost: (end - from) / 32 steps, or all where there
/// is no top.
template <bool kTops>
[[nodiscard]] constexpr std::uint32_t next_group(const Word* summary, [[maybe_unused]] const Word* top, std::uint32_t from,
                                                 std::uint32_t end, [[maybe_unused]] std::uint32_t words) {
  if (has_top<kTops>(words)) return next(top, from, end);
  while (from < end && summary[from] == 0) ++from;
  return from;
}

/// The first word of the set in [from, end) that is not 0, or `end`.
template <bool kTops>
[[nodiscard]] constexpr std::uint32_t next_word(const Word* summary, [[maybe_unused]] const Word* top, std::uint32_t from,
                                                std::uint32_t end, [[maybe_unused]] std::uint32_t words) {
  return has_top<kTops>(words) ? next(summary, top, from, end) : next(summary, from, end);
}

}  // namespace mts::bits
