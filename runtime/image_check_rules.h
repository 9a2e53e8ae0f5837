// Verifying an image: levels, rules, who reads what, what is written. Part of runtime/image.h.
#pragma once

#include "bits.h"
#include "image_layout.h"
#include "image_status.h"

namespace mts::image {

/// What is being verified. The counts in the head have been compared with the size of the file, so every array is there in its full
/// length. Nothing else is known.
template <class Ix>
struct Subject {
  const ImageHead& h;
  const Tables<Ix>& t;
  Word* scratch;   ///< `scratch_words` words, zero before and after each check

  [[nodiscard]] constexpr const Shape& n() const { return h.shape; }
  [[nodiscard]] std::uint32_t rules_end(std::uint32_t word) const { return word + 1 < n().words ? t.word_rule[word + 1] : n().rules; }
  /// The bits for which the word has rules.
  [[nodiscard]] Word rule_bits(std::uint32_t word) const {
    return ~Word{0} >> (kWordBits - (rules_end(word) - t.word_rule[word]));
  }
};

/// How many bits are set. (std::popcount may call into a compiler's library.)
[[nodiscard]] constexpr std::uint32_t count_bits(Word x) {
  x -= x >> 1 & 0x55555555u;
  x = (x & 0x33333333u) + (x >> 2 & 0x33333333u);
  return ((x + (x >> 4)) & 0x0F0F0F0Fu) * 0x01010101u >> 24;
}

/// Levels partition the words, and words the rules. Every word but the last one of a level is full.
template <class Ix>
bool levels_fit(const Subject<Ix>& s) {
  std::uint32_t word = 0;
  if (s.n().levels == 0 || (s.n().words == 0) != (s.n().rules == 0)) return false;
  for (std::uint32_t l = 0; l < s.n().levels; ++l) {
    const Level<Ix>& level = s.t.levels[l];
    if (level.first_word != word || level.end_word < word || level.end_word > s.n().words) return false;
    for (; word < level.end_word; ++word) {
      const std::uint32_t first = s.t.word_rule[word], end = s.rules_end(word);
      if (word == 0 && first != 0) return false;
      if (end > s.n().rules || first >= end || end - first > kWordBits) return false;
      if (end - first < kWordBits && word + 1u != level.end_word) return false;
    }
  }
  if (word != s.n().words) return false;
  for (std::uint32_t w = 0; w < s.n().words; ++w) {
    if (((s.t.while_rules[w] | s.t.reset_rules[w]) & ~s.rule_bits(w)) != 0) return false;
  }
  return true;
}

/// The longest condition of a rule that the compiler writes out as literals; a longer one becomes a node.
inline constexpr std::uint32_t kMaxConditions = 96;

/// The ranges of the rules follow one another, and the conditions are literals, of which a rule has each at most once.
template <class Ix>
bool rules_fit(const Subject<Ix>& s) {
  const Rule<Ix>* rules = s.t.rules;
  if (rules[0].conditions != 0 || rules[0].writes != 0 || rules[0].clears != 0) return false;
  for (std::uint32_t r = 0; r < s.n().rules; ++r) {
    const Rule<Ix>&rule = rules[r], &next = rules[r + 1];
    if (next.conditions < rule.conditions || next.writes < rule.writes || next.clears < rule.clears) return false;
    if (next.conditions > s.h.conditions || next.writes > s.h.writes || next.clears > s.h.clears) return false;
    if (std::uint32_t{next.conditions} - rule.conditions > kMaxConditions) return false;
    for (std::uint32_t i = rule.conditions; i < next.conditions; ++i) {
      if (s.t.conditions[i] >> 1 == kTrueAtom || s.t.conditions[i] >> 1 >= s.n().atoms) return false;
      for (std::uint32_t k = rule.conditions; k < i; ++k) {
        if (s.t.conditions[k] == s.t.conditions[i]) return false;
      }
    }
  }
  const Rule<Ix>& end = rules[s.n().rules];
  return end.conditions == s.h.conditions && end.writes == s.h.writes && end.clears == s.h.clears;
}

/// How many rules the lists of atoms name.
struct Reading { std::uint64_t keys = 0, readers = 0; };

/// In an atom's list the words must ascend, and each must name at least one rule, and only rules that it has. Counts the rules.
template <class Ix>
bool readers_ascend(const Subject<Ix>& s, std::uint32_t atom, Reading& all) {
  const std::uint32_t begin = s.t.atoms[atom].readers, end = s.t.atoms[atom + 1].readers;
  for (std::uint32_t i = begin; i < end; ++i) {
    const Readers<Ix>& r = s.t.readers[i];
    if (r.word >= s.n().words || (i > begin && r.word <= s.t.readers[i - 1].word)) return false;
    const Word rules = r.good[0] | r.good[1] | r.keyed;
    if (rules == 0 || (rules & ~s.rule_bits(r.word)) != 0) return false;
    all.keys += count_bits(r.keyed);
    all.readers += count_bits(r.good[0]) + count_bits(r.good[1]);
  }
  return true;
}

/// The atom's rules of a word. The list must ascend. Steps: log2 of its length.
template <class Ix>
Readers<Ix> readers_in(const Subject<Ix>& s, std::uint32_t atom, std::uint32_t word) {
  std::uint32_t begin = s.t.atoms[atom].readers, end = s.t.atoms[atom + 1].readers;
  while (begin < end) {
    const std::uint32_t middle = begin + (end - begin) / 2;
    const Readers<Ix>& r = s.t.readers[middle];
    if (r.word == word) return r;
    if (r.word < word) begin = middle + 1;
    else end = middle;
  }
  return {};
}

/// The lists of all atoms follow one another.
template <class Ix>
bool atom_lists_fit(const Subject<Ix>& s) {
  const Atom<Ix>* atoms = s.t.atoms;
  const std::uint32_t n = s.n().atoms;
  const Atom<Ix>&first = atoms[0], &last = atoms[n];
  if (first.readers != 0 || first.parents != 0 || first.timers != 0) return false;
  if (last.readers != s.h.readers || last.parents != s.h.parents || last.timers != s.n().timers) return false;
  for (std::uint32_t a = 0; a < n; ++a) {
    const Atom<Ix>&x = atoms[a], &next = atoms[a + 1];
    if (next.readers < x.readers || next.parents < x.parents || next.timers < x.timers) return false;
  }
  return true;
}

/// `broad` is there only if some atom is broad, and the list of such an atom has no rule for that value.
template <class Ix>
bool broad_fits(const Subject<Ix>& s) {
  if (s.h.broad == 0) return true;
  std::uint8_t any = 0;
  for (std::uint32_t a = 0; a < s.n().atoms; ++a) {
    const std::uint8_t broad = s.t.broad[a];
    if (broad > 3) return false;
    for (std::uint32_t i = s.t.atoms[a].readers; i < s.t.atoms[a + 1].readers; ++i) {
      for (std::uint32_t now = 0; now < 2; ++now) {
        if ((broad >> now & 1u) != 0 && s.t.readers[i].good[now] != 0) return false;
      }
    }
    any |= broad;
  }
  return any != 0;
}

/// Each rule is in the lists of the atoms of its conditions, in the right way, and has one key: a positive condition, or the true
/// atom.
template <class Ix>
bool rule_is_read(const Subject<Ix>& s, std::uint32_t rule, std::uint32_t word, Word bit, Reading& found) {
  const auto& t = s.t;
  std::uint32_t keys = 0;
  for (std::uint32_t i = t.rules[rule].conditions; i < t.rules[rule + 1].conditions; ++i) {
    const std::uint32_t atom = t.conditions[i] >> 1;
    const std::uint32_t wanted = ~std::uint32_t{t.conditions[i]} & 1u;
    const Readers<Ix> r = readers_in(s, atom, word);
    if (wanted != 0 && (r.keyed & bit) != 0) {
      ++keys;
      continue;
    }
    if (s.h.broad != 0 && (t.broad[atom] >> wanted & 1u) != 0) continue;
    if ((r.good[wanted] & bit) == 0) return false;
    ++found.readers;
  }
  if (keys == 0 && (readers_in(s, kTrueAtom, word).keyed & bit) != 0) keys = 1;
  found.keys += keys;
  return keys == 1;
}

/// Keys and readers are the inverse of the conditions: nothing is missing and, since the numbers agree, nothing is too much.
template <class Ix>
ImageStatus readers_fit(const Subject<Ix>& s) {
  Reading all, found;
  for (std::uint32_t a = 0; a < s.n().atoms; ++a) {
    if (!readers_ascend(s, a, all)) return ImageStatus::kReaders;
  }
  for (std::uint32_t w = 0; w < s.n().words; ++w) {
    for (std::uint32_t r = s.t.word_rule[w]; r < s.rules_end(w); ++r) {
      if (!rule_is_read(s, r, w, Word{1} << (r - s.t.word_rule[w]), found)) return ImageStatus::kReaders;
    }
  }
  if (found.keys != all.keys) return ImageStatus::kKeys;
  return found.readers == all.readers ? ImageStatus::kOk : ImageStatus::kReaders;
}

/// Values ascend. A rule writes only satellites and strategies, each at most once, and strategies only to 1. It clears a group at most
/// once.
template <class Ix>
bool writes_fit(const Subject<Ix>& s) {
  for (std::uint32_t i = 0; i < s.h.values; ++i) {
    const float v = s.t.values[i];
    if (!(v >= -1.0f && v <= 1.0f) || (i > 0 && !(v > s.t.values[i - 1]))) return false;
    if (v == 0.0f && std::bit_cast<std::uint32_t>(v) != 0) return false;  // no -0
  }
  const std::uint32_t strategies = s.n().facts + s.n().satellites;
  for (std::uint32_t r = 0; r < s.n().rules; ++r) {
    const Rule<Ix>&rule = s.t.rules[r], &next = s.t.rules[r + 1];
    for (std::uint32_t i = rule.writes; i < next.writes; ++i) {
      const Write<Ix>& w = s.t.writes[i];
      if (w.cell < s.n().facts || w.cell >= s.n().cells() || w.value >= s.h.values) return false;
      if (i > rule.writes && w.cell <= s.t.writes[i - 1].cell) return false;
      if (w.cell >= strategies && s.t.values[w.value] != 1.0f) return false;
    }
    for (std::uint32_t i = rule.clears; i < next.clears; ++i) {
      if (s.t.clears[i] >= s.n().groups || (i > rule.clears && s.t.clears[i] <= s.t.clears[i - 1])) return false;
    }
  }
  return true;
}

/// How many cells of one level may be contested: those that its rules write differently and, if rules also clear groups or several
/// rules reset, all cells that they write. `scratch` by satellite: 0, or the first value's index + 1, or kDisputed.
template <class Ix>
std::uint64_t contested_in(const Subject<Ix>& s, const Level<Ix>& level) {
  if (level.first_word == level.end_word) return 0;
  constexpr Word kDisputed = ~Word{0};
  const std::uint32_t begin = s.t.word_rule[level.first_word], end = s.rules_end(level.end_word - 1u);
  const std::uint32_t first_write = s.t.rules[begin].writes, end_write = s.t.rules[end].writes;
  const bool clears = s.t.rules[begin].clears != s.t.rules[end].clears;
  std::uint32_t resets = 0;
  for (std::uint32_t w = level.first_word; w < level.end_word; ++w) resets += count_bits(s.t.reset_rules[w]);
  std::uint64_t written = 0, disputed = 0;
  for (std::uint32_t i = first_write; i < end_write; ++i) {
    const std::uint32_t satellite = s.t.writes[i].cell - s.n().facts;
    if (satellite >= s.n().satellites) continue;
    Word& seen = s.scratch[satellite];
    if (seen == 0) {
      ++written;
      seen = s.t.writes[i].value + Word{1};
    } else if (seen != kDisputed && seen != s.t.writes[i].value + Word{1}) {
      ++disputed;
      seen = kDisputed;
    }
  }
  for (std::uint32_t i = first_write; i < end_write; ++i) {
    const std::uint32_t satellite = s.t.writes[i].cell - s.n().facts;
    if (satellite < s.n().satellites) s.scratch[satellite] = 0;
  }
  return (clears || resets > 1 ? written : disputed) + (clears && resets > 1 ? s.n().satellites : 0u);
}

template <class Ix>
bool contested_fits(const Subject<Ix>& s) {
  std::uint64_t contested = 0;
  for (std::uint32_t l = 0; l < s.n().levels; ++l) contested += contested_in(s, s.t.levels[l]);
  return contested == s.n().contested;
}

}  // namespace mts::image
