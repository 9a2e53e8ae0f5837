// What follows from one change: atoms flip, nodes count, rules wake, sleep, and are marked. Part of runtime/engine.h.
#pragma once

#include "engine.h"

namespace mts {

/// Marks these rules of the word to be evaluated at their level.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::ask(std::uint32_t word, Word rules) {
  if constexpr (kMasked) return;   // planes know
  s.rules[word].pending |= rules;
  if constexpr (kSummaries) {
    if (many_words() && rules != 0) bits::note_full(s.busy_sum, word, shape().words);
  }
}

/// For an atom that so many rules read that their masks are not kept: asks every rule that is awake, or that holds. This is exact,
/// because evaluating a rule once more changes nothing. All such atoms that flip before the next `settle` ask together.
template <class S, class T>
inline void Engine<S, T>::tell_all(std::uint8_t broad, bool now) {
  const std::uint32_t news = broad;
  if ((news >> now & 1u) != 0) s.ask_awake = true;
  if ((news >> !now & 1u) != 0) s.ask_done = true;
}

template <class S, class T>
[[gnu::noinline]] inline void Engine<S, T>::ask_all(Word RuleWord::*among) {
  const std::uint32_t words = shape().words;
  if constexpr (kSummaries) {
    if (many_words()) {
      const auto next = [&](std::uint32_t w) { return bits::next_full(s.awake_sum, w, words, words); };
      for (std::uint32_t w = next(0); w < words; w = next(w + 1)) ask(w, s.rules[w].*among);
      return;
    }
  }
  for (std::uint32_t w = 0; w < words; ++w) s.rules[w].pending |= s.rules[w].*among;
}

/// Asks the rules that read the atom. If its change is good news for a rule, the rule is asked if it is awake; if bad news, if it
/// holds. Rules that have the atom as their key wake and are asked; or they fall asleep, and those that held are asked, found false
/// and so armed.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::tell_readers(std::uint32_t atom, bool now) {
  if constexpr (kMasked) {
    constexpr const Planes& p = kPlanesOf<typename T::Knowledge>;
    for (std::uint32_t i = p.begin[atom]; i < p.begin[atom + 1]; ++i) s.plane[p.rows[i].plane] ^= p.rows[i].rules;
    return;
  }
  const Atom<J>* const a = t->atoms + atom;
  const Readers<J>* const end = t->readers + a[1].readers;
  const Word waking = now ? ~Word{0} : Word{0};
  for (const Readers<J>* r = first_told(t->readers + a[0].readers, end, waking); r != end; r = first_told(r + 1, end, waking)) {
    const std::uint32_t word = r->word;
    const Word awake = s.rules[word].awake, done = s.rules[word].done;
    ask(word, (r->good[now] & awake) | (r->good[!now] & done) | (r->keyed & (waking | done)));
    set_awake(word, (awake & ~r->keyed) | (waking & r->keyed));
  }
}

/// The first row from `r` on with rules that are awake or are to be woken. In a large program the rules of most rows are asleep and
/// stay asleep.
template <class S, class T>
inline const Readers<typename T::Ix>* Engine<S, T>::first_told(const Readers<J>* r, const Readers<J>* end, [[maybe_unused]] Word waking) const {
  if constexpr (kSummaries) {
    while (many_words() && r != end && !bits::test(s.awake_sum, r->word) && (r->keyed & waking) == 0) ++r;
  }
  return r;
}

/// Sets which rules of the word are awake. A rule that holds is awake, or has been pending since it fell asleep.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::set_awake(std::uint32_t word, Word rules) {
  if constexpr (kSummaries) {
    if (many_words() && (rules != 0) != (s.rules[word].awake != 0)) bits::note(s.awake_sum, word, shape().words, rules != 0);
  }
  s.rules[word].awake = rules;
}

/// The same with compact tables, which hold the three lists of an atom as one. Rules wake and fall asleep last, with the same result:
/// a rule that wakes is asked in any case, and one that is asked before it falls asleep is found false.
template <class S, class T>
inline void Engine<S, T>::follow(std::uint32_t atom, bool now) {
  const auto [begin, end] = t.effects_of(atom);
  for (std::uint32_t i = begin; i < end; ++i) {
    const auto e = t.effect(i);
    Word among = e.mask;
    if (e.kind != T::Effect::kKey) {
      among &= now == (e.kind == T::Effect::kWhenTrue) ? s.rules[e.word].awake : s.rules[e.word].done;
    } else if (now) {
      set_awake(e.word, s.rules[e.word].awake | e.mask);
    } else {
      among &= s.rules[e.word].done;
      set_awake(e.word, s.rules[e.word].awake & ~e.mask);
    }
    ask(e.word, among);
  }
}

/// Tells the nodes and timers that read the atom. They settle later, in order, so one that flips to and fro within a commit
/// costs nothing more.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::count(std::uint32_t atom, bool now) {
  if constexpr (kCompact) {
    const auto [begin, end] = t.feeds_of(atom);
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t feed = t.feed(i);
      if (feed < 2 * shape().nodes) count_in(feed, now);
      else time(feed - 2 * shape().nodes);
    }
  } else {
    const Atom<J>* const a = t->atoms + atom;
    for (std::uint32_t i = a[0].parents; i < a[1].parents; ++i) count_in(t->parents[i], now);
    if constexpr (kMaskedTimers) {
      Word timers = 0;
      for (std::uint32_t i = a[0].timers; i < a[1].timers; ++i) timers |= bits::mask(t->timer_inputs[i]);
      s.timer_input ^= timers;
    } else {
      for (std::uint32_t i = a[0].timers; i < a[1].timers; ++i) time(t->timer_inputs[i]);
    }
  }
}

/// `parent`: the node, doubled, plus 1 if it counts the atom negated. A node changes sides when its count reaches what it needs or
/// falls below that. It is in `node_set` if it has done so an odd number of times, because then its truth has to flip.
template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::count_in(std::uint32_t parent, bool now) {
  const std::uint32_t node = parent >> 1;
  const std::uint32_t more = static_cast<std::uint32_t>(now) ^ (parent & 1u), larger = s.count[node] + more;
  s.count[node] = static_cast<Ix>(larger + more - 1u);
  if (larger != t->nodes[node].need) return;
  s.node_set[node / kWordBits] ^= bits::mask(node);
  if (shape().nodes <= kWordBits) return;
  bits::note_full(s.node_sum, node / kWordBits, node_words());
  s.nodes_changed = true;
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::time(std::uint32_t timer) {
  bits::set(s.timer_set, timer);
  if (shape().timers <= kWordBits) return;
  bits::note_full(s.timer_sum, timer / kWordBits, timer_words());
  s.timers_changed = true;
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::flip_at(std::uint32_t atom) {
  if constexpr (kMasked) {   // in either direction: see note [planes]
    s.truth_set[atom / kWordBits] ^= bits::mask(atom);
    tell_readers(atom, false);
    count(atom, truth(atom));
  } else if constexpr (kStraight) {   // here `now` becomes a constant, too
    if (truth(atom)) turn(atom, false);
    else turn(atom, true);
  } else {
    turn(atom, !truth(atom));
  }
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::turn(std::uint32_t atom, bool now) {
  set_truth(atom, now);
  s.busy = true;
  if constexpr (kCompact) {
    follow(atom, now);
  } else {
    if (t->broad != nullptr && t->broad[atom] != 0) tell_all(t->broad[atom], now);
    tell_readers(atom, now);
  }
  count(atom, now);
}

/// Does what may wait until a commit is done: nodes flip, and atoms that ask all rules ask them.
template <class S, class T>
inline void Engine<S, T>::settle() {
  if (nodes_changed()) {
    if constexpr (kMasked && kShape.nodes <= kWordBits) settle_nodes_in(s);
    else settle_changed_nodes();
  }
  if constexpr (!kCompact && !kMasked) {
    if (t->broad == nullptr || !(s.ask_awake || s.ask_done)) return;
    ask_all(s.ask_awake ? &RuleWord::awake : &RuleWord::done);   // a rule that holds is awake, or has been asked already
    s.ask_awake = s.ask_done = false;
  }
}

template <class S, class T>
inline bool Engine<S, T>::nodes_changed() const {
  if (shape().nodes == 0) return false;
  return shape().nodes > kWordBits ? s.nodes_changed : s.node_set[0] != 0;
}

/// Children have smaller numbers than their parents, so one pass upwards settles all nodes. A parent may stand in the same word as
/// its child, so the word is read again after each node.
template <class S, class T>
[[gnu::noinline]] inline void Engine<S, T>::settle_changed_nodes() {
  const std::uint32_t words = node_words();
  if (words <= 1) {
    settle_node_word(0);
  } else {
    const auto next = [&](std::uint32_t w) { return bits::next_full(s.node_sum, w, words, words); };
    for (std::uint32_t w = next(0); w < words; w = next(w)) {
      settle_node_word(w);
      bits::note_empty(s.node_sum, w, words);
    }
  }
  s.nodes_changed = false;
}

template <class S, class T>
inline void Engine<S, T>::settle_node_word(std::uint32_t word) {
  const std::uint32_t first_atom = shape().first_node();
  if constexpr (kMasked) s.busy = true;   // otherwise flips say so
  while (s.node_set[word] != 0) {
    const std::uint32_t n = word * kWordBits + static_cast<std::uint32_t>(std::countr_zero(s.node_set[word]));
    s.node_set[word] &= s.node_set[word] - 1u;
    flip(first_atom + n);
  }
}

template <class S, class T>
inline void Engine<S, T>::set_terms(std::uint32_t cell, float value) {
  const CellAtoms<J>& a = t->cell_atoms[cell];
  if (a.high != 0 && at_least(value, t->firing) != truth(a.high)) flip(a.high);
  if (a.low != 0 && at_least(-t->firing, value) != truth(a.low)) flip(a.low);
  if (a.zero != 0) {
    if (at_least(distance_from_one(value), t->firing) != truth(a.zero)) flip(a.zero);
  }
}

template <class S, class T>
inline void Engine<S, T>::note_touched(std::uint32_t satellite, float before) {
  if (kMasked && (before == 1.0f || before == -1.0f)) return;   // see note_turned
  if (bits::test(s.touched_set, satellite)) return;
  bits::set(s.touched_set, satellite);
  s.before[s.touched] = before;
  s.touched_list[s.touched++] = static_cast<Ix>(satellite);
}

/// Keeps the list of the members of a large exclusive group that are not -1, so that clearing the group costs only one step for
/// each of them.
template <class S, class T>
inline void Engine<S, T>::note_live([[maybe_unused]] std::uint32_t satellite, [[maybe_unused]] bool live) {
  if constexpr (!kCompact) {
    if (t->group_of == nullptr || t->group_of[satellite] == 0) return;
    const std::uint32_t group = t->group_of[satellite] - 1u;
    const std::uint32_t base = t->group_begin[group];
    const std::uint32_t slot = t->group_slot[satellite];
    if (live) {
      s.live[base + s.live_count[group]] = static_cast<Ix>(satellite);
      s.live_place[base + slot] = s.live_count[group]++;
      return;
    }
    const std::uint32_t place = s.live_place[base + slot];
    const Ix moved = s.live[base + --s.live_count[group]];
    s.live[base + place] = moved;
    s.live_place[base + t->group_slot[moved]] = static_cast<Ix>(place);
  }
}

template <class S, class T>
inline void Engine<S, T>::recheck(std::uint32_t fact) {
  if constexpr (kMasked) {
    bits::set(s.recheck_set, fact);
    return;
  }
  if (flag(fact, kRecheck)) return;
  flip_flag(fact, kRecheck);
  if constexpr (kCompact) s.recheck = 1;  // some fact is marked
  else s.recheck_list[s.recheck++] = static_cast<Ix>(fact);
}

template <class S, class T>
[[gnu::always_inline]] inline void Engine<S, T>::attend(std::uint32_t satellite, bool high) {
  for (std::uint32_t i = t->attends_begin[satellite]; i < t->attends_begin[satellite + 1]; ++i) {
    const std::uint32_t fact = t->attends[i];
    s.attended[fact] = static_cast<Ix>(high ? s.attended[fact] + 1 : s.attended[fact] - 1);
    recheck(fact);
  }
}

template <class S, class T>
inline void Engine<S, T>::note_moved(std::uint32_t satellite, bool moved) {
  if constexpr (kMasked) return;   // see collect_moved
  if (moved) bits::set(s.moved_set, satellite);
  else bits::clear(s.moved_set, satellite);
  if constexpr (!kCompact) {
    const std::uint32_t w = satellite / kWordBits, words = satellite_words();
    if (words > kWordBits) bits::note(s.moved_sum, w, words, s.moved_set[w] != 0);
  }
}

/// The same for all satellites at once. A satellite that is neither 1 nor -1 counts as moved; if that is its initial value, it is
/// looked at in vain.
template <class S, class T>
inline void Engine<S, T>::collect_moved() {
  const auto& all = kMasksOf<typename T::Knowledge>;
  constexpr std::uint32_t kWords = kMaskBits / kWordBits;
  for (std::uint32_t w = 0; w < satellite_words(); ++w) {
    const std::uint32_t m = w / kWords, shift = w % kWords * kWordBits;
    const Mask moved = (s.at_one[m] ^ all.first_one[m]) | (s.at_minus_one[m] ^ all.first_minus_one[m]) | ~(s.at_one[m] | s.at_minus_one[m]);
    s.moved_set[w] = static_cast<Word>(moved >> shift);
  }
}

/// The first satellite from `from` on that is not at its initial value, or how many there are.
template <class S, class T>
inline std::uint32_t Engine<S, T>::next_moved(std::uint32_t from) const {
  if constexpr (!kCompact) {
    if (satellite_words() > kWordBits) return bits::next(s.moved_set, s.moved_sum, from, shape().satellites);
  }
  return bits::next(s.moved_set, from, shape().satellites);
}

template <class S, class T>
inline void Engine<S, T>::set_satellite(std::uint32_t cell, float value) {
  const float old = value_of(cell);
  if (same(old, value)) return;
  const std::uint32_t satellite = cell - shape().facts;
  note_touched(satellite, old);
  put_satellite(cell, value);
  s.busy = true;
  set_terms(cell, value);
  const bool high = at_least(value, t->firing);
  if (at_least(old, t->firing) != high) attend(satellite, high);
  note_moved(satellite, !same(value, t->initial[satellite]));
  if (same(old, -1.0f) != same(value, -1.0f)) note_live(satellite, !same(value, -1.0f));
}

}  // namespace mts
