// Sets of small integers as words, and summaries of large sets, with which the next member is found in a few steps however large the
// set is.
#pragma once

#include <bit>
#include <cstdint>

#include "table.h"

namespace mts::bits {

[[nodiscard]] constexpr Word mask(std::uint32_t i) { return Word{1} << (i % kWordBits); }
[[nodiscard]] constexpr bool test(const Word* set, std::uint32_t i) { return (set[i / kWordBits] >> (i % kWordBits) & 1u) != 0; }
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

/// The word and the bit of a rule. `word_rule`: by word, the rule of its bit 0 (Tables::word_rule). Steps: log2 of `words`.
struct RuleBit { std::uint32_t word; Word bit; };
template <class Ix>
[[nodiscard]] constexpr RuleBit of_rule(const Ix* word_rule, std::uint32_t words, std::uint32_t rule) {
  std::uint32_t low = 0, high = words;
  while (high - low > 1) {
    const std::uint32_t middle = low + (high - low) / 2;
    if (word_rule[middle] <= rule) low = middle;
    else high = middle;
  }
  return {low, mask(rule - word_rule[low])};
}

// note [summaries]
// The summary of a set has a bit for each word of the set that is not 0. It consists of words itself and has a summary above it, and
// so on up to a single word. The layers are stored one after another, the lowest first. A search climbs and descends only as many
// layers as it must, and a note stops at the first layer that has it already. A million rules have four layers.

/// Notes that word `w` of a set of `words` words is no longer 0.
constexpr void note_full(Word* summary, std::uint32_t w, std::uint32_t words) {
  for (;;) {
    Word& layer = summary[w / kWordBits];
    const Word before = layer;
    layer |= mask(w);
    if (before != 0 || words <= kWordBits) return;
    words = Shape::words_for(words);
    summary += words;
    w /= kWordBits;
  }
}

/// Notes that word `w` of the set is 0 again.
constexpr void note_empty(Word* summary, std::uint32_t w, std::uint32_t words) {
  for (;;) {
    Word& layer = summary[w / kWordBits];
    layer &= ~mask(w);
    if (layer != 0 || words <= kWordBits) return;
    words = Shape::words_for(words);
    summary += words;
    w /= kWordBits;
  }
}

/// Notes word `w` of the set as it is now: it may have become 0, or have ceased to be 0.
constexpr void note(Word* summary, std::uint32_t w, std::uint32_t words, bool full) {
  if (full) note_full(summary, w, words);
  else note_empty(summary, w, words);
}

/// The first word of the set in [from, end) that is not 0, or `end`. Cost: a few steps for each layer.
[[nodiscard]] constexpr std::uint32_t next_full(const Word* summary, std::uint32_t from, std::uint32_t end, std::uint32_t words) {
  const Word* below[7];   // as many layers as 2^32 words could have
  std::uint32_t layers = 0;
  if (from >= end) return end;
  Word rest = summary[from / kWordBits] >> (from % kWordBits);
  while (rest == 0) {
    if (words <= kWordBits) return end;
    below[layers++] = summary;
    words = Shape::words_for(words);
    summary += words;
    from = from / kWordBits + 1;
    if (from == words) return end;
    rest = summary[from / kWordBits] >> (from % kWordBits);
  }
  from += static_cast<std::uint32_t>(std::countr_zero(rest));
  while (layers != 0) from = from * kWordBits + static_cast<std::uint32_t>(std::countr_zero(below[--layers][from]));
  return from < end ? from : end;
}

/// The first member of a set of numbers below `size` from `from` on, or `size`.
[[nodiscard]] constexpr std::uint32_t next(const Word* set, const Word* summary, std::uint32_t from, std::uint32_t size) {
  if (from >= size) return size;
  const std::uint32_t words = Shape::words_for(size);
  std::uint32_t w = from / kWordBits;
  Word rest = set[w] & (~Word{0} << (from % kWordBits));
  if (rest == 0) {
    w = next_full(summary, w + 1, words, words);
    if (w == words) return size;
    rest = set[w];
  }
  return w * kWordBits + static_cast<std::uint32_t>(std::countr_zero(rest));
}

}  // namespace mts::bits
